// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <utility>

#include "enfilade/model/types.h"

namespace enfilade {

/// Six times the signed volume of the tetrahedron from the origin to the triangle.
inline double SixfoldVolume(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

/// Volume that each room's faces enclose, counted positive when they face inwards, by
/// (storey_idx, room_id).
inline std::map<std::pair<int, int>, double> EnclosedVolumes(const BuildingModel& model) {
  std::map<std::pair<int, int>, double> volumes;
  for (const ModelFace& face : model.faces) {
    double& volume = volumes[{face.storey_idx, face.room_id}];
    for (const std::array<int, 3>& t : face.triangles) {
      volume -= SixfoldVolume(face.vertices[t[0]], face.vertices[t[1]], face.vertices[t[2]]) / 6;
    }
  }
  return volumes;
}

/// Expects that the faces of every room close it: every directed edge occurs once and its reverse
/// once, with bit-identical end points; triangles turn as their face's normal says, none is
/// degenerate, and the volume enclosed is positive.
inline void ExpectWatertight(const BuildingModel& model) {
  using Point = std::array<double, 3>;
  std::map<std::pair<int, int>, std::map<std::pair<Point, Point>, int>> edges_of_room;
  const auto key = [](const Eigen::Vector3d& p) { return Point{p.x(), p.y(), p.z()}; };
  for (size_t f = 0; f < model.faces.size(); ++f) {
    const ModelFace& face = model.faces[f];
    EXPECT_NEAR(face.normal.norm(), 1, 1e-12) << "face " << f;
    for (const std::array<int, 3>& t : face.triangles) {
      const Eigen::Vector3d &a = face.vertices[t[0]], &b = face.vertices[t[1]],
                            &c = face.vertices[t[2]];
      const Eigen::Vector3d area = (b - a).cross(c - a);
      EXPECT_GT(area.norm(), 0) << "degenerate triangle in face " << f;
      EXPECT_GT(area.normalized().dot(face.normal), 1 - 1e-9) << "turned triangle in face " << f;
      for (int i = 0; i < 3; ++i) {
        const auto edge = std::pair(key(face.vertices[t[i]]), key(face.vertices[t[(i + 1) % 3]]));
        ++edges_of_room[{face.storey_idx, face.room_id}][edge];
      }
    }
  }
  for (const auto& [room, edges] : edges_of_room) {
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << "edge used twice in one direction, room " << room.second;
      EXPECT_TRUE(edges.contains({edge.second, edge.first})) << "open edge, room " << room.second;
    }
  }
  for (const auto& [room, volume] : EnclosedVolumes(model)) {
    EXPECT_GT(volume, 0) << "room " << room.second << " is inside out";
  }
}

}  // namespace enfilade
