// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// A picture with its pose, ready to look at walls.
struct FacadeView {
  Camera camera;
  Rigid3 home_from_cam;
  ImageU8 gray;
  ImageU8 mask;  ///< 0 = ignore; empty = none
};

/// What pictures show on the plane of a wall, the room before it: means over pictures of upright
/// and level edges. What lies in the plane adds up; what lies before or behind it does not.
///
/// Cell (row, col) has its centre (col + ½)·step_m from `a` towards `b` and (row + ½)·step_m above
/// the floor.
class Facade {
 public:
  /// Requires a wall longer than one step and a ceiling above the floor.
  Facade(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double floor_z, double ceiling_z,
         double step_m);

  /// Adds what the view sees of the wall from within `room`; nothing from closer than 0.25 m to
  /// its plane, along rays nearly parallel to it, or past other walls of the room.
  void Add(const FacadeView& view, const Polygon2& room);

  /// Divides the sums by their weights; Add must not be called afterwards.
  void Finish();

  [[nodiscard]] int rows() const { return upright_.rows(); }
  [[nodiscard]] int cols() const { return upright_.cols(); }
  [[nodiscard]] double step_m() const { return step_m_; }
  [[nodiscard]] int num_views() const { return num_views_; }
  /// Of memory.
  [[nodiscard]] size_t NumBytes() const {
    return sizeof(float) * (upright_.data().size() + level_.data().size() +
                            brightness_.data().size() + weight_.data().size());
  }
  /// Change of brightness along the wall, −1…1; after Finish.
  [[nodiscard]] const ImageF& upright() const { return upright_; }
  /// Change of brightness with height, −1…1; after Finish.
  [[nodiscard]] const ImageF& level() const { return level_; }
  /// Mean brightness, 0–255; after Finish.
  [[nodiscard]] const ImageF& brightness() const { return brightness_; }

 private:
  [[nodiscard]] std::vector<float> ColumnWeights(const Eigen::Vector2d& camera,
                                                 const Polygon2& room) const;
  void AddSmoothed(const ImageF& gray, const std::vector<float>& weights);
  [[nodiscard]] Eigen::Vector2d PlanPoint(int col) const {
    return a_ + (col + 0.5) * step_m_ * along_;
  }

  Eigen::Vector2d a_, along_, inward_;
  double floor_z_ = 0, step_m_ = 0;
  int num_views_ = 0;
  ImageF upright_, level_, brightness_, weight_;
};

}  // namespace enfilade
