// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/point_labels.h"

#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr double kHeightTolerance_m = 0.3;
const double kCosTolerance = std::cos(DegToRad(15));
const double kSinTolerance = std::sin(DegToRad(15));

}  // namespace

bool IsAtStorey(double z, double floor_z, double ceiling_z) {
  return z >= floor_z - kHeightTolerance_m && z <= ceiling_z + kHeightTolerance_m;
}

SurfaceLabel LabelOfPoint(const ScenePoint& point, double floor_z, double ceiling_z) {
  const double z = point.position.z(), nz = point.normal.z();
  if (!point.position.allFinite() || !IsAtStorey(z, floor_z, ceiling_z))
    return SurfaceLabel::kOther;
  const bool at_floor = z <= floor_z + kHeightTolerance_m,
             at_ceiling = z >= ceiling_z - kHeightTolerance_m;
  if (!(point.normal.squaredNorm() > 0.5)) {
    if (at_floor) return SurfaceLabel::kFloor;
    return at_ceiling ? SurfaceLabel::kCeiling : SurfaceLabel::kWall;
  }
  if (at_floor && nz >= kCosTolerance) return SurfaceLabel::kFloor;
  if (at_ceiling && nz <= -kCosTolerance) return SurfaceLabel::kCeiling;
  if (z > floor_z && z < ceiling_z && std::abs(nz) <= kSinTolerance) return SurfaceLabel::kWall;
  return SurfaceLabel::kOther;
}

}  // namespace enfilade
