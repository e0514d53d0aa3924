// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/render.h"

namespace enfilade {

/// A planar piece of the home: triangles in its own frame, a point being origin + u·axis_u +
/// v·axis_v.
struct Surface {
  Eigen::Vector3f origin{0, 0, 0};
  Eigen::Vector3f axis_u{1, 0, 0}, axis_v{0, 1, 0};  ///< unit, at right angles
  Eigen::Vector3f normal{0, 0, 1};                   ///< towards the visible side
  Eigen::Vector2f extent{0, 0};                      ///< the vertices lie in [0, extent]
  std::vector<Eigen::Vector2f> vertices;
  std::vector<std::array<int, 3>> triangles;
  Finish finish = Finish::kPlain;
  Eigen::Vector3f rgb{0.5f, 0.5f, 0.5f};  ///< diffuse reflectance, linear
  float gloss = 0;                        ///< weight of the mirror image, 0–1
  uint64_t seed = 0;                      ///< of its pattern
  SurfaceLabel label = SurfaceLabel::kOther;
  int room_id = -1;
  int wall_id = -1;

  [[nodiscard]] Eigen::Vector3f Point(float u, float v) const {
    return origin + u * axis_u + v * axis_v;
  }
};

/// What all surfaces of one thing share.
struct SurfaceTraits {
  Finish finish = Finish::kPlain;
  Eigen::Vector3f rgb{0.5f, 0.5f, 0.5f};
  SurfaceLabel label = SurfaceLabel::kOther;
  int room_id = -1;
  int wall_id = -1;
  float gloss = 0;
};

/// Collects surfaces; every one gets its own pattern seed.
class SurfaceList {
 public:
  explicit SurfaceList(uint64_t seed) : seed_(seed) {}

  /// The parallelogram origin, +u, +v, seen from the side of `normal`.
  void AddRectangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& u,
                    const Eigen::Vector3d& v, const Eigen::Vector3d& normal,
                    const SurfaceTraits& traits);
  /// Six faces of an upright box.
  void AddBox(const HomeBox& box, const SurfaceTraits& traits);
  /// A surface whose vertices are already in its frame.
  void Add(Surface surface);

  [[nodiscard]] std::vector<Surface> Take() { return std::move(surfaces_); }

 private:
  uint64_t seed_;
  std::vector<Surface> surfaces_;
};

/// All surfaces of a home: shell, trim and furniture. Lamps are not among them.
[[nodiscard]] std::vector<Surface> MakeSurfaces(const Home& home);

/// Those of one storey: what its cameras see.
[[nodiscard]] std::vector<Surface> MakeSurfaces(const Home& home, int storey_idx);

/// Floors, ceilings and walls with their holes, and the reveals of the holes.
void AddShell(const Home& home, SurfaceList& list);

/// Baseboards, door frames and leaves, window frames and sills.
void AddTrim(const Home& home, SurfaceList& list);

}  // namespace enfilade
