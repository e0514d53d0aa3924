// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/mesh_section.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A mesh's edge by its ends, the smaller one first.
using EdgeKey = std::pair<int, int>;

// Where a triangle's edges cross the height: the inside lies on the left of the way from the edge
// that goes up to the one that goes down.
struct Segment {
  EdgeKey to;
  Vector2d start;
};

// By the edge where they start.
using Segments = std::map<EdgeKey, Segment>;

Vector2d CrossingOf(const Vector3d& a, const Vector3d& b, double z) {
  const double share = (z - a.z()) / (b.z() - a.z());
  return a.head<2>() + share * (b - a).head<2>();
}

Segments CutAt(const TriangleMesh& mesh, double z) {
  const auto is_above = [&](int vertex) {
    return mesh.vertices[static_cast<size_t>(vertex)].z() >= z;
  };
  Segments segments;
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    EdgeKey up, down;
    bool is_cut = false;
    for (size_t k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      if (is_above(a) == is_above(b)) continue;
      (is_above(b) ? up : down) = std::minmax(a, b);
      is_cut = true;
    }
    if (!is_cut) continue;
    segments.emplace(up,
                     Segment{down, CrossingOf(mesh.vertices[static_cast<size_t>(up.first)],
                                              mesh.vertices[static_cast<size_t>(up.second)], z)});
  }
  return segments;
}

std::vector<Ring2> ChainsOf(Segments segments) {
  std::vector<Ring2> rings;
  while (!segments.empty()) {
    Ring2 ring;
    for (auto next = segments.begin(); next != segments.end();) {
      ring.push_back(next->second.start);
      const EdgeKey to = next->second.to;
      segments.erase(next);
      next = segments.find(to);
    }
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

MultiPolygon2 LevelSection(const TriangleMesh& mesh, double z, double min_part_m2,
                           double min_hole_m2) {
  std::vector<Ring2> rings = ChainsOf(CutAt(mesh, z));
  // What lies within another ring comes after it.
  std::stable_sort(rings.begin(), rings.end(), [](const Ring2& a, const Ring2& b) {
    return std::abs(SignedArea(a)) > std::abs(SignedArea(b));
  });
  MultiPolygon2 section;
  for (Ring2& ring : rings) {
    const double area = SignedArea(ring);
    if (area >= 0 ? area < min_part_m2 : -area < min_hole_m2) continue;
    if (area >= 0) {
      section = Union(section, {{ring, {}}});
    } else {
      std::reverse(ring.begin(), ring.end());
      section = Difference(section, {{ring, {}}});
    }
  }
  return section;
}

}  // namespace enfilade
