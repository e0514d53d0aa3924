// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/self_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "enfilade/base/check.h"
#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/polygon2.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A bend of the profile by more than this is an upright line; it is measured over chords that span
// this much azimuth, longer than the steps of a bin that a profile of free form is made of.
constexpr double kLineTurn_rad = DegToRad(35);
constexpr double kChord_deg = 2.0;

// What the plan says of one column.
struct PredictedColumn {
  double wall_m = kInfinity;
  const Wall* wall = nullptr;  // null where no wall is predicted
};

// The camera in the plan, and all that is predicted round it.
struct Prediction {
  double floor_m = 0;    // below the camera
  double ceiling_m = 0;  // above it
  std::vector<PredictedColumn> columns;
};

const Room* RoomAt(const Storey& storey, const Vector2d& place) {
  const auto it = std::find_if(storey.rooms.begin(), storey.rooms.end(),
                               [&](const Room& room) { return Contains(room.polygon, place); });
  return it != storey.rooms.end() ? &*it : nullptr;
}

// Distance to the first door or opening of a storey along a ray; a ring of two vertices is a
// segment there and back.
double PassageDistance(const Storey& storey, const Vector2d& origin, const Vector2d& direction) {
  double nearest = kInfinity;
  for (const Opening& opening : storey.openings) {
    if (opening.kind == OpeningKind::kWindow) continue;
    nearest = std::min(nearest, RayDistance({opening.a, opening.b}, origin, direction));
  }
  return nearest;
}

PredictedColumn PredictColumn(const Storey& storey, int room_id, const Vector2d& origin,
                              const Vector2d& direction) {
  PredictedColumn column;
  for (const Wall& wall : storey.walls) {
    if (wall.room_id != room_id) continue;
    const double r = RayDistance({wall.a, wall.b}, origin, direction);
    if (r < column.wall_m) column = {r, &wall};
  }
  const bool is_predicted =
      column.wall != nullptr && column.wall->seen != WallSeen::kInferred &&
      PassageDistance(storey, origin, direction) > column.wall_m + kOpeningReach_m;
  if (!is_predicted) column.wall = nullptr;
  return column;
}

// None when the camera stands in no room. The columns are those of a profile in another home frame.
std::optional<Prediction> Predict(const Floorplan& plan, const View& view,
                                  const Rigid3& home_from_world, int num_columns) {
  if (static_cast<size_t>(view.storey_idx) >= plan.storeys.size()) return std::nullopt;
  const Storey& storey = plan.storeys[static_cast<size_t>(view.storey_idx)];
  const Vector3d camera = plan.home_from_world * view.world_from_cam.translation;
  const Room* room = RoomAt(storey, camera.head<2>());
  if (room == nullptr) return std::nullopt;
  const Eigen::Matrix3d plan_from_home =
      plan.home_from_world.rotation * home_from_world.rotation.transpose();
  Prediction prediction{camera.z() - room->floor_z, room->ceiling_z - camera.z(), {}};
  for (int c = 0; c < num_columns; ++c) {
    const double azimuth = AzimuthOfColumn(c, num_columns);
    const Vector3d ray = plan_from_home * Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
    prediction.columns.push_back(
        PredictColumn(storey, room->id, camera.head<2>(), ray.head<2>().normalized()));
  }
  return prediction;
}

int ColumnsOf(double azimuth_deg, int num_columns) {
  return std::max(1, static_cast<int>(std::lround(azimuth_deg / 360 * num_columns)));
}

// The columns in which upright lines are judged: the bends of a profile are found over chords, so
// those must be judged too.
std::vector<uint8_t> LineColumns(const std::vector<uint8_t>& is_judged) {
  const int num_columns = static_cast<int>(is_judged.size());
  const int chord = ColumnsOf(kChord_deg, num_columns);
  std::vector<uint8_t> is_line_judged(is_judged.size(), 1);
  for (int c = 0; c < num_columns; ++c) {
    if (is_judged[static_cast<size_t>(c)] != 0) continue;
    for (int k = -chord; k <= chord; ++k) {
      is_line_judged[static_cast<size_t>((c + k + num_columns) % num_columns)] = 0;
    }
  }
  return is_line_judged;
}

// Upright lines as columns (the line lies at the left edge of its column): where one wall follows
// another.
std::vector<int> PredictedLines(const Prediction& prediction,
                                const std::vector<uint8_t>& is_line_judged) {
  std::vector<int> lines;
  const size_t num_columns = prediction.columns.size();
  for (size_t c = 0; c < num_columns; ++c) {
    const size_t before = (c + num_columns - 1) % num_columns;
    if (is_line_judged[c] != 0 && prediction.columns[c].wall != prediction.columns[before].wall)
      lines.push_back(static_cast<int>(c));
  }
  return lines;
}

// The same of a profile: the middles of the stretches in which it bends.
std::vector<int> ShownLines(const WallProfile& profile,
                            const std::vector<uint8_t>& is_line_judged) {
  const int num_columns = profile.num_columns();
  const int chord = ColumnsOf(kChord_deg, num_columns);
  const auto point = [&](int c) -> Vector2d {
    c = (c + num_columns) % num_columns;
    const double azimuth = AzimuthOfColumn(c, num_columns);
    return profile.wall_m[static_cast<size_t>(c)] * Vector2d(std::cos(azimuth), std::sin(azimuth));
  };
  const auto bends = [&](int c) {
    const Vector2d before = point(c) - point(c - chord), after = point(c + chord) - point(c);
    const double cross = before.x() * after.y() - before.y() * after.x();
    return std::abs(std::atan2(cross, before.dot(after))) > kLineTurn_rad;
  };
  std::vector<uint8_t> is_bent(static_cast<size_t>(num_columns));
  for (int c = 0; c < num_columns; ++c) is_bent[static_cast<size_t>(c)] = bends(c);
  std::vector<int> lines;
  const auto at = [&](int c) { return is_bent[static_cast<size_t>(c % num_columns)] != 0; };
  for (int c = 0; c < num_columns; ++c) {
    if (!at(c) || at(c + num_columns - 1)) continue;
    int end = c;
    while (end < c + num_columns && at(end)) ++end;
    const int middle = (c + end) / 2 % num_columns;
    if (is_line_judged[static_cast<size_t>(middle)] != 0) lines.push_back(middle);
  }
  return lines;
}

// How many of `lines` have one of `others` within `reach` columns.
double CountNear(const std::vector<int>& lines, const std::vector<int>& others, double reach,
                 int num_columns) {
  return static_cast<double>(std::count_if(lines.begin(), lines.end(), [&](int a) {
    return std::any_of(others.begin(), others.end(), [&](int b) {
      const int apart = std::abs(a - b);
      return std::min(apart, num_columns - apart) <= reach;
    });
  }));
}

std::optional<double> LineF1(const std::vector<int>& predicted, const std::vector<int>& shown,
                             double reach, int num_columns) {
  if (predicted.empty() && shown.empty()) return std::nullopt;
  if (predicted.empty() || shown.empty()) return 0.0;
  const double precision =
      CountNear(predicted, shown, reach, num_columns) / static_cast<double>(predicted.size());
  const double recall =
      CountNear(shown, predicted, reach, num_columns) / static_cast<double>(shown.size());
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0.0;
}

std::optional<double> ScoreOf(const PredictionFigures& figures) {
  std::vector<double> shares;
  for (const auto& share :
       {figures.floor_line, figures.ceiling_line, figures.vertical_lines, figures.depth}) {
    if (share) shares.push_back(*share);
  }
  return Mean(shares);
}

std::string Cell(const std::optional<double>& share) {
  return share ? fmt::format("{:>9.3f}", *share) : fmt::format("{:>9}", "n/a");
}

nlohmann::json ToJson(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace

void SelfScoreOptions::Visit(OptionVisitor& v) {
  v("line_deg", line_deg, "How far a floor or ceiling line may be off, degrees.", {0.0, 90.0});
  v("depth_share", depth_share, "How far a wall may be off, as a share of its distance.",
    {0.0, 1.0});
  v("corner_deg", corner_deg, "How far an upright line may be off, degrees.", {0.0, 90.0});
}

PredictionFigures ScorePrediction(const Floorplan& plan, const View& view,
                                  const WallProfile& profile, const Rigid3& home_from_world,
                                  const SelfScoreOptions& options) {
  PredictionFigures figures;
  figures.picture = view.picture;
  const int num_columns = profile.num_columns();
  const std::optional<Prediction> prediction = Predict(plan, view, home_from_world, num_columns);
  if (!prediction) return figures;
  const double camera_z = (home_from_world * view.world_from_cam.translation).z();
  const double floor_m = camera_z - profile.floor_z, ceiling_m = profile.ceiling_z - camera_z;
  std::vector<uint8_t> is_judged(static_cast<size_t>(num_columns));
  double num_judged = 0, floor_hits = 0, ceiling_hits = 0, depth_hits = 0;
  for (size_t c = 0; c < is_judged.size(); ++c) {
    const PredictedColumn& predicted = prediction->columns[c];
    is_judged[c] = predicted.wall != nullptr && profile.is_seen[c] != 0;
    if (is_judged[c] == 0) continue;
    const double shown_m = profile.wall_m[c];
    const auto is_line_hit = [&](double predicted_height_m, double shown_height_m) {
      return std::abs(std::atan2(predicted_height_m, predicted.wall_m) -
                      std::atan2(shown_height_m, shown_m)) <= DegToRad(options.line_deg);
    };
    ++num_judged;
    floor_hits += is_line_hit(prediction->floor_m, floor_m);
    ceiling_hits += is_line_hit(prediction->ceiling_m, ceiling_m);
    depth_hits += std::abs(predicted.wall_m - shown_m) <= options.depth_share * shown_m;
  }
  if (num_judged == 0) return figures;
  figures.floor_line = floor_hits / num_judged;
  figures.ceiling_line = ceiling_hits / num_judged;
  figures.depth = depth_hits / num_judged;
  const std::vector<uint8_t> is_line_judged = LineColumns(is_judged);
  figures.vertical_lines =
      LineF1(PredictedLines(*prediction, is_line_judged), ShownLines(profile, is_line_judged),
             options.corner_deg / 360 * num_columns, num_columns);
  figures.score = ScoreOf(figures);
  return figures;
}

SelfReport ScorePredictions(const Scene& scene, const Structure& structure,
                            std::span<const std::optional<Floorplan>> plans,
                            const SelfScoreOptions& options) {
  ENFILADE_CHECK(plans.size() == scene.views.size());
  ENFILADE_CHECK(structure.profiles.size() == scene.views.size());
  SelfReport report;
  std::vector<double> scores;
  for (size_t i = 0; i < plans.size(); ++i) {
    PredictionFigures figures;
    figures.picture = scene.views[i].picture;
    if (plans[i]) {
      figures = ScorePrediction(*plans[i], scene.views[i], structure.profiles[i],
                                structure.home_from_world, options);
    }
    if (figures.score) scores.push_back(*figures.score);
    report.panoramas.push_back(std::move(figures));
  }
  report.num_predicted = static_cast<int>(scores.size());
  report.score = Median(scores);
  return report;
}

std::string FormatSelfReport(const SelfReport& report) {
  std::vector<const PredictionFigures*> worst_first;
  for (const PredictionFigures& panorama : report.panoramas) worst_first.push_back(&panorama);
  // Those that nothing was predicted for come last.
  std::stable_sort(worst_first.begin(), worst_first.end(), [](const auto* a, const auto* b) {
    return a->score.value_or(kInfinity) < b->score.value_or(kInfinity);
  });
  size_t width = 8;
  for (const auto* panorama : worst_first) width = std::max(width, panorama->picture.size());
  std::string table =
      fmt::format("{:<{}}    score    floor  ceiling  upright    depth\n", "panorama", width);
  for (const auto* panorama : worst_first) {
    table += fmt::format("{:<{}}{}{}{}{}{}\n", panorama->picture, width, Cell(panorama->score),
                         Cell(panorama->floor_line), Cell(panorama->ceiling_line),
                         Cell(panorama->vertical_lines), Cell(panorama->depth));
  }
  table += fmt::format("self_score {}, median over {} of {} panoramas\n", Cell(report.score),
                       report.num_predicted, report.panoramas.size());
  return table;
}

nlohmann::json SelfReportToJson(const SelfReport& report) {
  nlohmann::json json = nlohmann::json::array();
  for (const PredictionFigures& panorama : report.panoramas) {
    json.push_back({{"picture", panorama.picture},
                    {"score", ToJson(panorama.score)},
                    {"floor_line", ToJson(panorama.floor_line)},
                    {"ceiling_line", ToJson(panorama.ceiling_line)},
                    {"vertical_lines", ToJson(panorama.vertical_lines)},
                    {"depth", ToJson(panorama.depth)}});
  }
  return json;
}

}  // namespace enfilade
