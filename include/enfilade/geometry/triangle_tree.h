// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace enfilade {

struct TriangleHit {
  int triangle_idx = 0;
  float distance = 0;  ///< along the ray, in lengths of its direction
};

/// Triangles in a bounding volume hierarchy for fast ray casting (Embree, robust mode: no ray slips
/// between neighbours). Thread-safe once built. Same triangles, same answers on every processor:
/// one instruction set and one building thread.
class TriangleTree {
 public:
  /// `triangles` are indices into `vertices`; both are copied. Throws DependencyError when Embree
  /// cannot start or lacks memory. Cost O(n log n).
  TriangleTree(const std::vector<Eigen::Vector3f>& vertices,
               const std::vector<std::array<int, 3>>& triangles);
  ~TriangleTree();
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  /// The first triangle on origin + t · direction with near ≤ t ≤ far, whichever side it shows.
  [[nodiscard]] std::optional<TriangleHit> FirstHit(const Eigen::Vector3f& origin,
                                                    const Eigen::Vector3f& direction, float near,
                                                    float far) const;

  /// FirstHit for many rays from one origin, hits[i] for directions[i]: faster where neighbours in
  /// the list look nearly the same way. On an edge that two triangles share it may name the other.
  void FirstHits(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                 float near, float far, std::span<std::optional<TriangleHit>> hits) const;

  /// Whether there is any: faster than FirstHit.
  [[nodiscard]] bool IsHit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                           float near, float far) const;

  /// IsHit for many rays from one origin, are_hit[i] for directions[i] up to far[i].
  void AreHit(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
              float near, std::span<const float> far, std::span<bool> are_hit) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace enfilade
