// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ply_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <set>
#include <utility>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

TEST(PlyWriter, WritesHeaderAndRecords) {
  const TempFolder temp;
  std::vector<ScenePoint> points(2);
  points[1].position = {1, 2, 3.5};
  points[1].normal = {0, 0, -1};
  points[1].rgb = {1, 128, 255};
  WritePointsPly(temp / "points.ply", points);
  const std::string bytes = ReadFile(temp / "points.ply");
  EXPECT_TRUE(bytes.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(bytes, testing::HasSubstr("element vertex 2\n"));
  const size_t body = bytes.find("end_header\n") + 11;
  constexpr size_t kRecord = 6 * 4 + 3;
  ASSERT_EQ(bytes.size(), body + 2 * kRecord);
  float values[6];
  std::memcpy(values, bytes.data() + body + kRecord, sizeof(values));
  EXPECT_THAT(values, testing::ElementsAre(1, 2, 3.5, 0, 0, -1));
  EXPECT_EQ(bytes.substr(body + kRecord + 24), "\x01\x80\xFF");
}

TEST(PlyWriter, LeavesNormalsOutWhereNoneIsKnown) {
  const TempFolder temp;
  std::vector<ScenePoint> points(2);
  points[1].position = {1, 2, 3.5};
  WritePointsPly(temp / "points.ply", points);
  const std::string bytes = ReadFile(temp / "points.ply");
  EXPECT_THAT(bytes, testing::Not(testing::HasSubstr("nx")));
  EXPECT_EQ(bytes.size() - bytes.find("end_header\n") - 11, 2 * (3 * 4 + 3));
}

TEST(PlyWriter, WritesACloudWithoutPoints) {
  const TempFolder temp;
  WritePointsPly(temp / "points.ply", {});
  EXPECT_TRUE(ReadFile(temp / "points.ply").ends_with("end_header\n"));
}

TEST(PlyWriter, SaysWhyItCannotWrite) {
  const TempFolder temp;
  WriteFileAtomic(temp / "file", "x");
  EXPECT_THROW(WritePointsPly(temp / "file" / "points.ply", {}), IoError);
  EXPECT_THROW(WriteCamerasPly(temp / "file" / "cameras.ply", {}), IoError);
}

struct CameraMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int32_t, 3>> triangles;
};

CameraMesh ReadCameraMesh(const std::string& bytes, size_t num_vertices, size_t num_triangles) {
  CameraMesh mesh;
  mesh.vertices.resize(num_vertices);
  mesh.triangles.resize(num_triangles);
  const char* at = bytes.data() + bytes.find("end_header\n") + 11;
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    std::memcpy(vertex.data(), at, 12);
    at += 15;  // and the colour
  }
  for (std::array<int32_t, 3>& triangle : mesh.triangles) {
    EXPECT_EQ(*at, 3);
    std::memcpy(triangle.data(), at + 1, 12);
    at += 13;
  }
  EXPECT_EQ(at, bytes.data() + bytes.size());
  return mesh;
}

// The first camera looks along +y with +z up.
TEST(PlyWriter, CamerasAreClosedPyramidsThatPointForward) {
  const TempFolder temp;
  std::vector<View> views(2);
  views[0].world_from_cam.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  views[0].world_from_cam.translation = {1, 2, 3};
  views[1].camera.model = CameraModel::kPinhole;
  WriteCamerasPly(temp / "cameras.ply", views, 0.5);
  const std::string bytes = ReadFile(temp / "cameras.ply");
  EXPECT_THAT(bytes, testing::HasSubstr("element vertex 12\n"));
  EXPECT_THAT(bytes, testing::HasSubstr("element face 14\n"
                                        "property list uchar int vertex_indices\n"));
  const CameraMesh mesh = ReadCameraMesh(bytes, 12, 14);
  EXPECT_EQ(mesh.vertices[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_LT((mesh.vertices[1] - Eigen::Vector3f(0.625f, 2.5f, 3.25f)).norm(), 1e-6f);
  EXPECT_GT(mesh.vertices[5].z(), mesh.vertices[1].z());
  // Every edge of the first six triangles is used once each way, and they enclose a volume that
  // lies inside: base times length over three.
  std::multiset<std::pair<int, int>> edges;
  float volume = 0;
  for (size_t t = 0; t < 6; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) edges.insert(edge);
    const Eigen::Vector3f tip = mesh.vertices[0];
    volume += (mesh.vertices[static_cast<size_t>(a)] - tip)
                  .cross(mesh.vertices[static_cast<size_t>(b)] - tip)
                  .dot(mesh.vertices[static_cast<size_t>(c)] - tip) /
              6;
  }
  for (const auto& [from, to] : edges) {
    EXPECT_EQ(edges.count({from, to}), 1U);
    EXPECT_EQ(edges.count({to, from}), 1U);
  }
  EXPECT_NEAR(volume, 0.75 * 0.5 * 0.5 / 3, 1e-5);
  EXPECT_EQ(mesh.triangles[7][0], 6);
}

TEST(PlyWriter, WritesNoCameras) {
  const TempFolder temp;
  WriteCamerasPly(temp / "cameras.ply", {});
  EXPECT_THAT(ReadFile(temp / "cameras.ply"), testing::HasSubstr("element face 0\n"));
}

}  // namespace
}  // namespace enfilade
