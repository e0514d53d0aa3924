// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr FigureInfo kFigures[] = {
    {"area_iou_net", "area", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"area_iou_gross", "area", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"area_iou_net_largest", "area", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"area_iou_gross_largest", "area", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"area_error_gross", "area", FigureUnit::kShare, FigureSense::kLowerIsBetter},
    {"area_net_m2", "area", FigureUnit::kSquareMetres, FigureSense::kNeutral},
    {"area_gross_m2", "area", FigureUnit::kSquareMetres, FigureSense::kNeutral},
    {"truth_area_net_m2", "area", FigureUnit::kSquareMetres, FigureSense::kNeutral},
    {"truth_area_gross_m2", "area", FigureUnit::kSquareMetres, FigureSense::kNeutral},
    {"wall_plan_to_truth_median_m", "walls", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"wall_plan_to_truth_p95_m", "walls", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"wall_truth_to_plan_median_m", "walls", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"wall_truth_to_plan_p95_m", "walls", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"wall_within_10cm", "walls", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"column_median_deg", "columns", FigureUnit::kDegrees, FigureSense::kLowerIsBetter},
    {"columns_within_5pct", "columns", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"columns_within_10pct", "columns", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"panorama_iou_median", "columns", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"panoramas_judged", "columns", FigureUnit::kCount, FigureSense::kNeutral},
    {"ceiling_median_m", "ceilings", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"panorama_ceiling_median_m", "ceilings", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"rooms_total", "rooms", FigureUnit::kCount, FigureSense::kNeutral},
    {"rooms_iou50", "rooms", FigureUnit::kCount, FigureSense::kNeutral},
    {"rooms_iou70", "rooms", FigureUnit::kCount, FigureSense::kNeutral},
    {"rooms_iou90", "rooms", FigureUnit::kCount, FigureSense::kNeutral},
    {"rooms_split", "rooms", FigureUnit::kCount, FigureSense::kLowerIsBetter},
    {"rooms_merged", "rooms", FigureUnit::kCount, FigureSense::kLowerIsBetter},
    {"rooms_false", "rooms", FigureUnit::kCount, FigureSense::kLowerIsBetter},
    {"room_f1_10cm", "rooms", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"corner_f1_10cm", "rooms", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"room_f1", "rooms, Structured3D protocol", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"corner_f1", "rooms, Structured3D protocol", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"angle_f1", "rooms, Structured3D protocol", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"door_precision", "doors", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"door_recall", "doors", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"door_graph_precision", "doors", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"door_graph_recall", "doors", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"pose_total", "poses", FigureUnit::kCount, FigureSense::kNeutral},
    {"pose_registered", "poses", FigureUnit::kCount, FigureSense::kNeutral},
    {"pose_inferred", "poses", FigureUnit::kCount, FigureSense::kNeutral},
    {"pose_components", "poses", FigureUnit::kCount, FigureSense::kLowerIsBetter},
    {"pose_median_m", "poses", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"pose_max_m", "poses", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"pose_yaw_median_deg", "poses", FigureUnit::kDegrees, FigureSense::kLowerIsBetter},
    {"pose_tilt_median_deg", "poses", FigureUnit::kDegrees, FigureSense::kLowerIsBetter},
    {"pose_scale_error", "poses", FigureUnit::kShare, FigureSense::kLowerIsBetter},
    {"label_accuracy", "labels", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"label_iou_mean", "labels", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"label_accuracy_points", "labels", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"label_accuracy_free_space", "labels", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"label_accuracy_superpixels", "labels", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"sigma1_coverage", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma2_coverage", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma1_coverage_seen", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma2_coverage_seen", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma1_coverage_partly", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma2_coverage_partly", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma1_coverage_inferred", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"sigma2_coverage_inferred", "uncertainty", FigureUnit::kShare, FigureSense::kNeutral},
    {"model_hit_share", "model", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"depth_median_m", "model", FigureUnit::kMetres, FigureSense::kLowerIsBetter},
    {"depth_within_5pct", "model", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"normal_median_deg", "model", FigureUnit::kDegrees, FigureSense::kLowerIsBetter},
    {"self_score", "without truth", FigureUnit::kShare, FigureSense::kHigherIsBetter},
    {"seconds", "cost", FigureUnit::kSeconds, FigureSense::kLowerIsBetter},
    {"peak_memory_mb", "cost", FigureUnit::kMegabytes, FigureSense::kLowerIsBetter},
};
constexpr size_t kKeyWidth = 30;

std::string FormatValue(const std::optional<double>& value, FigureUnit unit) {
  if (!value) return fmt::format("{:>9}", "n/a");
  switch (unit) {
    case FigureUnit::kCount:
      return fmt::format("{:>9.0f}", *value);
    case FigureUnit::kShare:
      return fmt::format("{:>9.3f}", *value);
    case FigureUnit::kMetres:
      return fmt::format("{:>9.3f} m", *value);
    case FigureUnit::kSquareMetres:
      return fmt::format("{:>9.1f} m²", *value);
    case FigureUnit::kDegrees:
      return fmt::format("{:>9.2f} °", *value);
    case FigureUnit::kSeconds:
      return fmt::format("{:>9.1f} s", *value);
    case FigureUnit::kMegabytes:
      return fmt::format("{:>9.0f} MB", *value);
  }
  return {};
}

nlohmann::json ToJson(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json ValueToJson(const std::optional<double>& value, FigureUnit unit) {
  if (value && unit == FigureUnit::kCount) return static_cast<int64_t>(*value);
  return ToJson(value);
}

// What is known of each panorama, by view.
std::map<int, nlohmann::json> PanoramasToJson(const EvaluationReport& report) {
  std::map<int, nlohmann::json> panoramas;
  for (const PanoramaFigures& columns : report.columns.panoramas) {
    panoramas[columns.view_idx].update({{"columns", columns.num_columns},
                                        {"column_median_deg", ToJson(columns.error_median_deg)},
                                        {"relative_median", ToJson(columns.relative_error_median)},
                                        {"distance_median_m", ToJson(columns.error_median_m)},
                                        {"within_5pct", ToJson(columns.within_5pct)},
                                        {"within_10pct", ToJson(columns.within_10pct)},
                                        {"iou", ToJson(columns.iou)},
                                        {"ceiling_m", ToJson(columns.ceiling_error_m)}});
  }
  if (report.poses) {
    for (const PoseError& pose : report.poses->errors) {
      panoramas[pose.view_idx].update({{"pose_registered", pose.is_registered},
                                       {"pose_m", pose.distance_m},
                                       {"pose_yaw_deg", RadToDeg(pose.yaw_rad)},
                                       {"pose_tilt_deg", RadToDeg(pose.tilt_rad)}});
    }
  }
  for (const PanoramaLabels& labels : report.labels.panoramas) {
    panoramas[labels.view_idx].update(
        {{"label_accuracy", ToJson(labels.accuracy)},
         {"label_iou_mean", ToJson(labels.iou_mean)},
         {"label_accuracy_points", ToJson(labels.points_accuracy)},
         {"label_accuracy_free_space", ToJson(labels.free_space_accuracy)},
         {"label_accuracy_superpixels", ToJson(labels.superpixel_accuracy)}});
  }
  for (const PanoramaModelError& model : report.model_error.panoramas) {
    panoramas[model.view_idx].update({{"model_hit_share", ToJson(model.hit_share)},
                                      {"depth_median_m", ToJson(model.depth_median_m)},
                                      {"depth_within_5pct", ToJson(model.depth_within_5pct)},
                                      {"normal_median_deg", ToJson(model.normal_median_deg)}});
  }
  return panoramas;
}

const FigureInfo* FindFigure(std::string_view key) {
  const auto* info =
      std::find_if(std::begin(kFigures), std::end(kFigures),
                   [&](const FigureInfo& candidate) { return candidate.key == key; });
  return info != std::end(kFigures) ? info : nullptr;
}

std::string FormatGroup(std::string_view group, const MetricReport& report) {
  std::string lines;
  bool has_value = false;
  for (const FigureInfo& info : kFigures) {
    const auto entry = report.find(std::string(info.key));
    if (info.group != group || entry == report.end()) continue;
    has_value = has_value || entry->second.has_value();
    lines +=
        fmt::format("  {:<{}}{}\n", info.key, kKeyWidth, FormatValue(entry->second, info.unit));
  }
  return has_value ? fmt::format("{}\n{}", group, lines) : std::string();
}

}  // namespace

std::span<const FigureInfo> FigureInfos() { return kFigures; }

MetricReport EmptyReport() {
  MetricReport report;
  for (const FigureInfo& info : kFigures) report.emplace(info.key, std::nullopt);
  return report;
}

std::string FormatReport(const MetricReport& report) {
  std::string table;
  std::string_view group;
  for (const FigureInfo& info : kFigures) {
    if (info.group == group) continue;
    group = info.group;
    table += FormatGroup(group, report);
  }
  std::string others;
  for (const auto& [key, value] : report) {
    if (FindFigure(key) != nullptr) continue;
    others += fmt::format("  {:<{}}{}\n", key, kKeyWidth, FormatValue(value, FigureUnit::kShare));
  }
  return others.empty() ? table : table + "other\n" + others;
}

nlohmann::json ReportToJson(const MetricReport& report) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [key, value] : report) {
    const FigureInfo* info = FindFigure(key);
    json[key] = ValueToJson(value, info != nullptr ? info->unit : FigureUnit::kShare);
  }
  return json;
}

nlohmann::json ReportToJson(const EvaluationReport& report) {
  nlohmann::json json = ReportToJson(report.figures);
  json["panoramas"] = nlohmann::json::array();
  for (auto& [view_idx, panorama] : PanoramasToJson(report)) {
    panorama["picture"] = report.pictures.at(static_cast<size_t>(view_idx));
    json["panoramas"].push_back(std::move(panorama));
  }
  return json;
}

}  // namespace enfilade
