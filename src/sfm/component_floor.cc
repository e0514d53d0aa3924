// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/component_floor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kCell_m = 0.2;
constexpr double kFarthest_m = 9;
constexpr double kOutlineError_m = 0.1;

}  // namespace

ComponentFloor::ComponentFloor(std::vector<RoomView> views) : views_(std::move(views)) {
  if (views_.empty()) return;
  Eigen::AlignedBox2d box;
  for (const RoomView& view : views_) {
    double reach_m = 0;
    for (const float wall_m : view.outline->wall_m) {
      reach_m = std::max(reach_m, std::min(static_cast<double>(wall_m), kFarthest_m));
    }
    const Vector2d center = view.position.head<2>(), reach(reach_m, reach_m);
    box.extend(Eigen::AlignedBox2d(center - reach, center + reach));
  }
  for (double y = box.min().y(); y <= box.max().y(); y += kCell_m) {
    for (double x = box.min().x(); x <= box.max().x(); x += kCell_m) {
      const Vector2d cell(x + kCell_m / 2, y + kCell_m / 2);
      if (Contains(cell, 0)) cells_.push_back(cell);
    }
  }
}

bool ComponentFloor::Contains(const Vector2d& point, double margin_m) const {
  return std::any_of(views_.begin(), views_.end(), [&](const RoomView& view) {
    const Vector2d ray = point - view.position.head<2>();
    const double range_m = ray.norm();
    return range_m < kFarthest_m && range_m < view.outline->WallDistance(ray) + margin_m;
  });
}

double ComponentFloor::OverlapShare(const ComponentFloor& other,
                                    const Rigid3& this_from_other) const {
  const double least_m2 = std::min(Area_m2(), other.Area_m2());
  return SharedArea_m2(other, this_from_other, -kOutlineError_m) / std::max(least_m2, 1e-9);
}

double ComponentFloor::Area_m2() const {
  return static_cast<double>(cells_.size()) * kCell_m * kCell_m;
}

double ComponentFloor::SharedArea_m2(const ComponentFloor& other, const Rigid3& this_from_other,
                                     double margin_m) const {
  const auto count =
      std::count_if(other.cells_.begin(), other.cells_.end(), [&](const Vector2d& cell) {
        const Eigen::Vector3d placed = this_from_other * Eigen::Vector3d(cell.x(), cell.y(), 0);
        return Contains(placed.head<2>(), margin_m);
      });
  return static_cast<double>(count) * kCell_m * kCell_m;
}

}  // namespace enfilade
