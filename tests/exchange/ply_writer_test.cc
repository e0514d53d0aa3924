// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ply_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

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

TEST(PlyWriter, WritesACloudWithoutPoints) {
  const TempFolder temp;
  WritePointsPly(temp / "points.ply", {});
  EXPECT_TRUE(ReadFile(temp / "points.ply").ends_with("end_header\n"));
}

TEST(PlyWriter, SaysWhyItCannotWrite) {
  const TempFolder temp;
  WriteFileAtomic(temp / "file", "x");
  EXPECT_THROW(WritePointsPly(temp / "file" / "points.ply", {}), IoError);
}

}  // namespace
}  // namespace enfilade
