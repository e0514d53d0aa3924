// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/regions.h"

#include "enfilade/base/check.h"
#include "enfilade/geometry/boolean.h"

namespace enfilade {

MultiPolygon2 NetRegion(const JudgedPlan& plan) {
  MultiPolygon2 all;
  for (const JudgedRoom& room : plan.rooms) {
    all.insert(all.end(), room.region.begin(), room.region.end());
  }
  return Union(all);
}

MultiPolygon2 TrueRegion(const GroundTruth& truth, const Rigid3& frame_from_truth) {
  MultiPolygon2 region = NetRegion(JudgedPlanOf(truth));
  const auto move = [&](Ring2& ring) {
    for (Eigen::Vector2d& p : ring)
      p = (frame_from_truth * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
  };
  for (Polygon2& part : region) {
    move(part.outer);
    for (Ring2& hole : part.holes) move(hole);
  }
  return region;
}

MultiPolygon2 GrossRegion(const MultiPolygon2& net) {
  return CloseRegion(net, kGrossClosingRadius_m, kGrossMaxHole_m2);
}

RegionFigures EvaluateRegions(const JudgedPlan& result, const JudgedPlan& truth) {
  const MultiPolygon2 net = NetRegion(result), truth_net = NetRegion(truth);
  const MultiPolygon2 gross = GrossRegion(net), truth_gross = GrossRegion(truth_net);
  RegionFigures figures;
  figures.area_net_m2 = Area(net);
  figures.area_gross_m2 = Area(gross);
  figures.truth_area_net_m2 = Area(truth_net);
  figures.truth_area_gross_m2 = Area(truth_gross);
  ENFILADE_CHECK(figures.truth_area_gross_m2 > 0);
  figures.iou_net = AreaIou(net, truth_net);
  figures.iou_gross = AreaIou(gross, truth_gross);
  const double over = Area(Difference(gross, truth_gross));
  const double under = Area(Difference(truth_gross, gross));
  figures.error_gross = (over + under) / figures.truth_area_gross_m2;
  return figures;
}

}  // namespace enfilade
