// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/evaluate.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/evaluate/coverage.h"
#include "enfilade/evaluate/doors.h"
#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/evaluate/poses.h"
#include "enfilade/evaluate/regions.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/evaluate/rooms.h"
#include "enfilade/evaluate/structured3d.h"
#include "enfilade/evaluate/walls.h"
#include "enfilade/geometry/angles.h"
#include "src/evaluate/moved_result.h"

namespace enfilade {
namespace {

int CountMatches(const std::vector<int>& matches) {
  return static_cast<int>(
      std::count_if(matches.begin(), matches.end(), [](int i) { return i >= 0; }));
}

// Pairs that agree in name although both hashes are known.
int CountChanged(const std::vector<PictureKey>& result, const std::vector<PictureKey>& truth,
                 const std::vector<int>& matches) {
  int count = 0;
  for (size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) continue;
    const std::string& true_hash = truth[static_cast<size_t>(matches[i])].sha256;
    count += !result[i].sha256.empty() && !true_hash.empty() && result[i].sha256 != true_hash;
  }
  return count;
}

// Throws when pictures are named on both sides and none agree.
void RequireMatch(const std::vector<PictureKey>& result, const std::vector<PictureKey>& truth,
                  int num_matched) {
  if (num_matched > 0 || result.empty() || truth.empty()) return;
  throw InvalidInputError("truth",
                          "none of its " + std::to_string(truth.size()) +
                              " pictures is among the result's " + std::to_string(result.size()) +
                              " (neither by hash nor by file name)",
                          "give the truth of the same home");
}

void AddColumns(const ColumnFigures& columns, MetricReport& figures) {
  figures["column_median_deg"] = columns.error_median_deg;
  figures["columns_within_5pct"] = columns.within_5pct;
  figures["columns_within_10pct"] = columns.within_10pct;
  figures["panorama_iou_median"] = columns.iou_median;
  figures["panorama_ceiling_median_m"] = columns.ceiling_error_median_m;
  figures["panoramas_judged"] = static_cast<double>(columns.panoramas.size());
}

void AddRegions(const RegionFigures& regions, MetricReport& figures) {
  figures["area_iou_net"] = regions.iou_net;
  figures["area_iou_gross"] = regions.iou_gross;
  figures["area_error_gross"] = regions.error_gross;
  figures["area_net_m2"] = regions.area_net_m2;
  figures["area_gross_m2"] = regions.area_gross_m2;
  figures["truth_area_net_m2"] = regions.truth_area_net_m2;
  figures["truth_area_gross_m2"] = regions.truth_area_gross_m2;
}

void AddWalls(const WallFigures& walls, MetricReport& figures) {
  figures["wall_plan_to_truth_median_m"] = walls.plan_to_truth_median_m;
  figures["wall_plan_to_truth_p95_m"] = walls.plan_to_truth_p95_m;
  figures["wall_truth_to_plan_median_m"] = walls.truth_to_plan_median_m;
  figures["wall_truth_to_plan_p95_m"] = walls.truth_to_plan_p95_m;
  figures["wall_within_10cm"] = walls.within_10cm;
}

void AddRooms(const RoomFigures& rooms, MetricReport& figures) {
  figures["rooms_total"] = rooms.total;
  figures["rooms_iou50"] = rooms.iou50;
  figures["rooms_iou70"] = rooms.iou70;
  figures["rooms_iou90"] = rooms.iou90;
  figures["rooms_split"] = rooms.split;
  figures["rooms_merged"] = rooms.merged;
  figures["rooms_false"] = rooms.false_rooms;
  figures["room_f1_10cm"] = rooms.f1_10cm;
  figures["corner_f1_10cm"] = rooms.corner_f1_10cm;
  figures["ceiling_median_m"] = rooms.ceiling_median_m;
}

void AddStructured3d(const Structured3dFigures& structured3d, MetricReport& figures) {
  figures["room_f1"] = structured3d.room_f1;
  figures["corner_f1"] = structured3d.corner_f1;
  figures["angle_f1"] = structured3d.angle_f1;
}

void AddDoors(const DoorFigures& doors, MetricReport& figures) {
  figures["door_precision"] = doors.precision;
  figures["door_recall"] = doors.recall;
  figures["door_graph_precision"] = doors.graph_precision;
  figures["door_graph_recall"] = doors.graph_recall;
}

std::optional<double> InDegrees(const std::optional<double>& rad) {
  return rad ? std::optional(RadToDeg(*rad)) : std::nullopt;
}

void AddPoses(const PoseFigures& poses, MetricReport& figures) {
  figures["pose_total"] = poses.total;
  figures["pose_registered"] = poses.registered;
  figures["pose_inferred"] = poses.inferred;
  figures["pose_components"] = poses.components;
  figures["pose_median_m"] = poses.median_m;
  figures["pose_max_m"] = poses.max_m;
  figures["pose_yaw_median_deg"] = InDegrees(poses.yaw_median_rad);
  figures["pose_tilt_median_deg"] = InDegrees(poses.tilt_median_rad);
  figures["pose_scale_error"] = poses.scale_error;
}

void AddCoverage(const std::string& suffix, const Coverage& coverage, MetricReport& figures) {
  figures["sigma1_coverage" + suffix] = coverage.sigma1;
  figures["sigma2_coverage" + suffix] = coverage.sigma2;
}

void AddModelError(const ModelErrorFigures& model, MetricReport& figures) {
  figures["model_hit_share"] = model.hit_share;
  figures["depth_median_m"] = model.depth_median_m;
  figures["depth_within_5pct"] = model.depth_within_5pct;
  figures["normal_median_deg"] = model.normal_median_deg;
}

// The true rooms without those that only cameras of other components stand in.
JudgedPlan RoomsOf(int component_idx, std::span<const JudgedCamera> cameras,
                   const GroundTruth& truth, std::span<const int> truth_idx,
                   const JudgedPlan& truth_plan) {
  JudgedPlan part;
  for (const JudgedRoom& room : truth_plan.rooms) {
    bool is_own = false, is_others = false;
    for (size_t i = 0; i < cameras.size(); ++i) {
      if (truth_idx[i] < 0) continue;
      const TruthView& view = truth.views[static_cast<size_t>(truth_idx[i])];
      if (!view.world_from_cam) continue;
      const Eigen::Vector2d at = view.world_from_cam->translation.head<2>();
      const bool is_inside =
          std::any_of(room.region.begin(), room.region.end(),
                      [&](const Polygon2& polygon) { return Contains(polygon, at); });
      if (is_inside) (cameras[i].component_idx == component_idx ? is_own : is_others) = true;
    }
    if (is_own || !is_others) part.rooms.push_back(room);
  }
  return part;
}

// With poses in several components, which lie anyhow to each other: the storeys of the largest one
// against what is not the others'.
void EvaluateLargestPart(const Floorplan& floorplan, std::span<const JudgedCamera> cameras,
                         const GroundTruth& truth, std::span<const int> truth_idx,
                         const JudgedPlan& truth_plan, MetricReport& figures) {
  const std::optional<int> largest = LargestComponent(cameras);
  const bool is_all = std::all_of(cameras.begin(), cameras.end(), [&](const JudgedCamera& camera) {
    return camera.component_idx == largest;
  });
  if (!largest || is_all) return;
  std::set<int> storeys;
  for (const PlanCamera& camera : floorplan.cameras) {
    if (camera.component_idx == *largest) storeys.insert(camera.storey_idx);
  }
  Floorplan part = floorplan;
  for (size_t i = 0; i < part.storeys.size(); ++i) {
    if (!storeys.contains(static_cast<int>(i))) part.storeys[i] = Storey{};
  }
  const RegionFigures regions =
      EvaluateRegions(JudgedPlanOf(part), RoomsOf(*largest, cameras, truth, truth_idx, truth_plan));
  figures["area_iou_net_largest"] = regions.iou_net;
  figures["area_iou_gross_largest"] = regions.iou_gross;
}

void EvaluatePlan(const Floorplan& floorplan, std::span<const JudgedCamera> cameras,
                  const GroundTruth& truth, std::span<const int> truth_idx, MetricReport& figures) {
  const JudgedPlan result_plan = JudgedPlanOf(floorplan);
  const JudgedPlan truth_plan = JudgedPlanOf(truth);
  if (Area(NetRegion(truth_plan)) > 0) {
    AddRegions(EvaluateRegions(result_plan, truth_plan), figures);
    AddRooms(EvaluateRooms(result_plan, truth_plan), figures);
    AddStructured3d(EvaluateStructured3d(result_plan, truth_plan), figures);
    EvaluateLargestPart(floorplan, cameras, truth, truth_idx, truth_plan, figures);
  }
  AddWalls(EvaluateWalls(result_plan, truth_plan), figures);
  AddDoors(EvaluateDoors(result_plan, truth_plan), figures);
  const CoverageFigures coverage = EvaluateCoverage(floorplan, truth_plan);
  AddCoverage("", coverage.all, figures);
  AddCoverage("_seen", coverage.seen, figures);
  AddCoverage("_partly", coverage.partly, figures);
  AddCoverage("_inferred", coverage.inferred, figures);
}

// Everything about the result in the truth's world.
void EvaluateMoved(const EvaluationInput& input, const GroundTruth& truth,
                   const std::vector<int>& truth_idx, const EvaluateOptions& options,
                   EvaluationReport& report, RunContext& context) {
  const std::vector<JudgedCamera> cameras =
      input.scene != nullptr ? JudgedCameras(*input.scene) : JudgedCameras(*input.floorplan);
  report.poses = EvaluatePoses(cameras, truth, truth_idx);
  if (report.poses) AddPoses(*report.poses, report.figures);
  if (input.structure != nullptr) {
    report.columns =
        EvaluateColumns(*input.scene, *input.structure, truth, truth_idx, options.columns);
    AddColumns(report.columns, report.figures);
    report.labels = EvaluateLabels(*input.scene, *input.structure, truth, truth_idx,
                                   input.label_source, context);
    report.figures["label_accuracy"] = report.labels.accuracy;
    report.figures["label_iou_mean"] = report.labels.iou_mean;
    report.figures["label_accuracy_points"] = report.labels.points_accuracy;
    report.figures["label_accuracy_free_space"] = report.labels.free_space_accuracy;
    report.figures["label_accuracy_superpixels"] = report.labels.superpixel_accuracy;
  }
  context.CheckStop();
  if (input.floorplan != nullptr) {
    EvaluatePlan(*input.floorplan, cameras, truth, truth_idx, report.figures);
  }
  if (input.model != nullptr) {
    report.model_error = EvaluateModel(*input.model, *input.floorplan, truth, truth_idx,
                                       options.model_error, input.model_error_sink, context);
    AddModelError(report.model_error, report.figures);
  }
}

}  // namespace

void EvaluateOptions::Visit(OptionVisitor& v) {
  v("columns", columns, "Wall distances of single panoramas.");
  v("model_error", model_error, "Depth and normals of the model in the panoramas.");
}

EvaluationReport Evaluate(const EvaluationInput& input, const GroundTruth& truth,
                          const EvaluateOptions& options, RunContext& context) {
  ENFILADE_CHECK(input.structure == nullptr || input.scene != nullptr);
  ENFILADE_CHECK(input.model == nullptr || (input.scene != nullptr && input.floorplan != nullptr));
  EvaluationReport report;
  report.figures = EmptyReport();
  const std::vector<PictureKey> truth_keys = PictureKeys(truth);
  if (input.scene != nullptr || input.floorplan != nullptr) {
    const std::vector<PictureKey> keys =
        input.scene != nullptr ? PictureKeys(*input.scene) : PictureKeys(*input.floorplan);
    const std::vector<int> matches = MatchPictures(keys, truth_keys);
    report.num_matched = CountMatches(matches);
    RequireMatch(keys, truth_keys, report.num_matched);
    report.num_changed = CountChanged(keys, truth_keys, matches);
    for (const PictureKey& key : keys) report.pictures.push_back(key.picture);
    if (input.scene != nullptr && input.scene->pose_source == PoseSource::kEstimated) {
      report.truth_from_world = FitTruthFromWorld(JudgedCameras(*input.scene), truth, matches);
    }
    const MovedResult moved(input, report.truth_from_world);
    EvaluateMoved(moved.input(), truth, matches, options, report, context);
  }
  context.log().Info("evaluate: " + std::to_string(report.num_matched) + " of " +
                     std::to_string(truth_keys.size()) + " true pictures matched");
  if (report.num_changed > 0) {
    context.log().Warning("evaluate: " + std::to_string(report.num_changed) +
                          " pictures have the truth's names but another content; is it the truth "
                          "of this home?");
  }
  return report;
}

}  // namespace enfilade
