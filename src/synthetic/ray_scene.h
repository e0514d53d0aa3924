// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "enfilade/geometry/triangle_tree.h"
#include "src/synthetic/surface.h"

namespace enfilade {

struct RayHit {
  int surface_idx = 0;
  float distance_m = 0;
  float u = 0, v = 0;  ///< in the surface's frame
};

/// Surfaces in a tree for fast ray casting. Thread-safe once built; the surfaces must outlive it.
class RayScene {
 public:
  /// Throws DependencyError when Embree cannot start.
  explicit RayScene(const std::vector<Surface>& surfaces);

  /// The first surface along the unit direction.
  [[nodiscard]] std::optional<RayHit> Trace(const Eigen::Vector3f& origin,
                                            const Eigen::Vector3f& direction) const;

  /// Trace for many rays from one origin, hits[i] for directions[i]: faster where neighbours in the
  /// list look nearly the same way.
  void TraceFrom(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                 std::span<std::optional<RayHit>> hits) const;

  /// Whether anything stands between the two points, ends left out.
  [[nodiscard]] bool IsBlocked(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;

  /// IsBlocked for many ends, is_blocked[i] for to[i].
  void FindBlocked(const Eigen::Vector3f& from, std::span<const Eigen::Vector3f> to,
                   std::span<bool> is_blocked) const;

 private:
  [[nodiscard]] RayHit MakeHit(const TriangleHit& hit, const Eigen::Vector3f& origin,
                               const Eigen::Vector3f& direction) const;

  const std::vector<Surface>& surfaces_;
  std::vector<int> surface_of_triangle_;
  TriangleTree tree_;
};

}  // namespace enfilade
