// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "enfilade/base/check.h"
#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/boolean.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Whoever stands so near a door looks through it.
constexpr double kInDoorway_m = 0.5;

// Where a column of a profile really looked: the camera in the truth's world and the horizontal
// unit direction of each column there. The column is carried over in the camera's frame.
struct TrueColumns {
  Vector2d origin;
  std::vector<Vector2d> directions;
};

TrueColumns PlaceColumns(const View& view, const TruthView& truth, const Structure& structure,
                         int num_columns) {
  const Rigid3 truth_from_cam = truth.world_from_cam.value_or(view.world_from_cam);
  const Eigen::Matrix3d truth_from_home = truth_from_cam.rotation *
                                          view.world_from_cam.rotation.transpose() *
                                          structure.home_from_world.rotation.transpose();
  TrueColumns columns{truth_from_cam.translation.head<2>(), {}};
  columns.directions.reserve(static_cast<size_t>(num_columns));
  for (int column = 0; column < num_columns; ++column) {
    const double azimuth = AzimuthOfColumn(column, num_columns);
    const Vector3d in_truth = truth_from_home * Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
    columns.directions.emplace_back(in_truth.head<2>().normalized());
  }
  return columns;
}

// Distance to the first door or opening along a ray.
double OpeningDistance(const TruthView& truth, const Vector2d& origin, const Vector2d& direction) {
  double nearest = kInfinity;
  for (const auto* list : {&truth.doors, &truth.openings}) {
    for (const std::array<Vector2d, 2>& ends : *list) {
      // A ring of two vertices is the segment there and back.
      nearest = std::min(nearest, RayDistance({ends[0], ends[1]}, origin, direction));
    }
  }
  return nearest;
}

struct ColumnErrors {
  std::vector<double> deg, relative, metres;
};

ColumnErrors CompareColumns(const WallProfile& profile, const TruthView& truth,
                            const TrueColumns& columns, double opening_reach_m) {
  ColumnErrors errors;
  for (int c = 0; c < profile.num_columns(); ++c) {
    const size_t i = static_cast<size_t>(c);
    if (!profile.is_seen.empty() && profile.is_seen[i] == 0) continue;
    const double r = RayDistance(truth.visible_layout, columns.origin, columns.directions[i]);
    if (!std::isfinite(r) || r <= 0) continue;
    if (OpeningDistance(truth, columns.origin, columns.directions[i]) <= r + opening_reach_m)
      continue;
    const double found = profile.wall_m[i];
    const bool is_found = std::isfinite(found) && found > 0;
    const double h = truth.camera_height_m;
    errors.deg.push_back(
        RadToDeg(std::abs((is_found ? std::atan(h / found) : 0) - std::atan(h / r))));
    errors.metres.push_back(is_found ? std::abs(found - r) : kInfinity);
    errors.relative.push_back(errors.metres.back() / r);
  }
  return errors;
}

std::optional<double> ShareWithin(const std::vector<double>& errors, double bound) {
  if (errors.empty()) return std::nullopt;
  const auto hits =
      std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= bound; });
  return static_cast<double>(hits) / static_cast<double>(errors.size());
}

// None unless the profile goes all round: a part of a circle encloses nothing to compare.
std::optional<double> ProfileIou(const WallProfile& profile, const TruthView& truth,
                                 const TrueColumns& columns) {
  Ring2 ring;
  for (size_t i = 0; i < columns.directions.size(); ++i) {
    if (!profile.is_seen.empty() && profile.is_seen[i] == 0) return std::nullopt;
    const double found = profile.wall_m[i];
    if (!std::isfinite(found)) return std::nullopt;
    ring.push_back(columns.origin + found * columns.directions[i]);
  }
  return AreaIou({{ring, {}}}, {{truth.visible_layout, {}}});
}

std::optional<double> CeilingError(const WallProfile& profile, const GroundTruth& truth,
                                   const Vector2d& origin) {
  for (const TruthRoom& room : truth.rooms) {
    if (!room.floor_z || !room.ceiling_z) continue;
    if (std::any_of(room.region.begin(), room.region.end(),
                    [&](const Polygon2& part) { return Contains(part, origin); })) {
      return std::abs((profile.ceiling_z - profile.floor_z) - (*room.ceiling_z - *room.floor_z));
    }
  }
  return std::nullopt;
}

// All mass of a column's distribution at a distance: in the two bins about it, so that it is also
// their mean in bins.
void PutMassAt(double distance_m, const std::vector<double>& bin_m, float* probability) {
  std::fill_n(probability, bin_m.size(), 0.0F);
  const auto above = std::upper_bound(bin_m.begin(), bin_m.end(), distance_m);
  if (above == bin_m.begin() || above == bin_m.end()) {
    probability[above == bin_m.begin() ? 0 : bin_m.size() - 1] = 1;
    return;
  }
  const auto next = static_cast<size_t>(above - bin_m.begin());
  const double share = (distance_m - bin_m[next - 1]) / (bin_m[next] - bin_m[next - 1]);
  probability[next - 1] = static_cast<float>(1 - share);
  probability[next] = static_cast<float>(share);
}

// What bounds the sight on a storey: walls, and doors where they leave a hole in both faces.
struct Sight {
  std::vector<Segment2> walls;
  std::vector<Segment2> doors;                    // as annotated
  std::vector<std::vector<Segment2>> door_faces;  // of each
};

Sight SightOnStorey(const GroundTruth& truth, int storey_idx) {
  constexpr double kOnOutline_m = 1e-6;
  std::vector<Segment2> outlines;
  for (const TruthRoom& room : truth.rooms) {
    if (room.storey_idx != storey_idx) continue;
    const std::vector<Segment2> edges = OutlineOf(room.region);
    outlines.insert(outlines.end(), edges.begin(), edges.end());
  }
  Sight sight{{}, truth.doors, {}};
  for (const Segment2& wall : truth.walls) {
    const Vector2d middle = 0.5 * (wall[0] + wall[1]);
    if (std::any_of(outlines.begin(), outlines.end(), [&](const Segment2& edge) {
          return DistanceToSegment(middle, edge[0], edge[1]) < kOnOutline_m;
        }))
      sight.walls.push_back(wall);
  }
  for (const Segment2& door : sight.doors) sight.door_faces.push_back(PartsBehind(door, outlines));
  return sight;
}

void SetTrueWalls(const TrueColumns& columns, const Sight& sight, const std::vector<double>& bin_m,
                  WallProfile& profile) {
  std::vector<Segment2> walls = sight.walls;
  for (size_t i = 0; i < sight.doors.size(); ++i) {
    if (DistanceToSegment(columns.origin, sight.doors[i][0], sight.doors[i][1]) <= kInDoorway_m)
      continue;
    walls.insert(walls.end(), sight.door_faces[i].begin(), sight.door_faces[i].end());
  }
  for (int c = 0; c < profile.num_columns(); ++c) {
    const auto i = static_cast<size_t>(c);
    double r = kInfinity;
    for (const Segment2& wall : walls)
      r = std::min(r, RayDistance({wall[0], wall[1]}, columns.origin, columns.directions[i]));
    if (!std::isfinite(r) || r <= 0) {
      profile.is_seen[i] = 0;
      continue;
    }
    profile.wall_m[i] = profile.obstacle_m[i] = static_cast<float>(r);
    profile.confidence[i] = 1;
    PutMassAt(r, bin_m, profile.wall_probability.row(c));
  }
}

PanoramaFigures EvaluatePanorama(const View& view, const WallProfile& profile,
                                 const Structure& structure, const TruthView& truth_view,
                                 const GroundTruth& truth, const ColumnOptions& options) {
  const TrueColumns columns = PlaceColumns(view, truth_view, structure, profile.num_columns());
  const ColumnErrors errors = CompareColumns(profile, truth_view, columns, options.opening_reach_m);
  PanoramaFigures figures;
  figures.picture = view.picture;
  figures.view_idx = profile.view_idx;
  figures.num_columns = static_cast<int>(errors.metres.size());
  if (truth_view.camera_height_m > 0) figures.error_median_deg = Median(errors.deg);
  figures.relative_error_median = Median(errors.relative);
  figures.error_median_m = Median(errors.metres);
  figures.within_5pct = ShareWithin(errors.relative, 0.05);
  figures.within_10pct = ShareWithin(errors.relative, 0.10);
  figures.iou = ProfileIou(profile, truth_view, columns);
  figures.ceiling_error_m = CeilingError(profile, truth, columns.origin);
  return figures;
}

std::vector<double> Collect(const std::vector<PanoramaFigures>& panoramas,
                            std::optional<double> PanoramaFigures::*figure) {
  std::vector<double> values;
  for (const PanoramaFigures& panorama : panoramas) {
    if (panorama.*figure) values.push_back(*(panorama.*figure));
  }
  return values;
}

// A figure times `factor` with `digits` digits, right-aligned to `width`; "n/a" when there is none.
std::string Cell(const std::optional<double>& value, double factor, int digits, int width) {
  return value ? fmt::format("{:>{}.{}f}", *value * factor, width, digits)
               : fmt::format("{:>{}}", "n/a", width);
}

}  // namespace

void ColumnOptions::Visit(OptionVisitor& v) {
  v("opening_reach_m", opening_reach_m,
    "How far behind the layout a door or opening may lie and still take its columns out.",
    {0.0, 2.0});
}

ColumnFigures EvaluateColumns(const Scene& scene, const Structure& structure,
                              const GroundTruth& truth, std::span<const int> truth_idx,
                              const ColumnOptions& options) {
  ENFILADE_CHECK(truth_idx.size() == scene.views.size());
  ColumnFigures figures;
  for (const WallProfile& profile : structure.profiles) {
    const size_t view_idx = static_cast<size_t>(profile.view_idx);
    ENFILADE_CHECK(view_idx < scene.views.size());
    if (truth_idx[view_idx] < 0) continue;
    const TruthView& truth_view = truth.views[static_cast<size_t>(truth_idx[view_idx])];
    if (!truth_view.is_inside || truth_view.visible_layout.size() < 3) continue;
    figures.panoramas.push_back(
        EvaluatePanorama(scene.views[view_idx], profile, structure, truth_view, truth, options));
  }
  const auto median_of = [&](std::optional<double> PanoramaFigures::*figure) {
    return Median(Collect(figures.panoramas, figure));
  };
  figures.error_median_deg = median_of(&PanoramaFigures::error_median_deg);
  figures.relative_error_median = median_of(&PanoramaFigures::relative_error_median);
  figures.error_median_m = median_of(&PanoramaFigures::error_median_m);
  figures.within_5pct = median_of(&PanoramaFigures::within_5pct);
  figures.within_10pct = median_of(&PanoramaFigures::within_10pct);
  figures.iou_median = median_of(&PanoramaFigures::iou);
  figures.iou_mean = Mean(Collect(figures.panoramas, &PanoramaFigures::iou));
  figures.ceiling_error_median_m = median_of(&PanoramaFigures::ceiling_error_m);
  return figures;
}

Structure WithTrueProfiles(const Scene& scene, const Structure& structure, const GroundTruth& truth,
                           std::span<const int> truth_idx) {
  ENFILADE_CHECK(truth_idx.size() == scene.views.size());
  Structure result = structure;
  std::map<int, Sight> sight_on_storey;
  for (WallProfile& profile : result.profiles) {
    const auto view_idx = static_cast<size_t>(profile.view_idx);
    const int idx = truth_idx[view_idx];
    if (idx < 0) {
      std::fill(profile.is_seen.begin(), profile.is_seen.end(), uint8_t{0});
      continue;
    }
    const TruthView& truth_view = truth.views[static_cast<size_t>(idx)];
    auto sight = sight_on_storey.find(truth_view.storey_idx);
    if (sight == sight_on_storey.end()) {
      sight = sight_on_storey
                  .emplace(truth_view.storey_idx, SightOnStorey(truth, truth_view.storey_idx))
                  .first;
    }
    SetTrueWalls(PlaceColumns(scene.views[view_idx], truth_view, structure, profile.num_columns()),
                 sight->second, structure.bin_m, profile);
  }
  return result;
}

std::string FormatAblation(std::span<const AblationRow> rows) {
  size_t width = 4;
  for (const AblationRow& row : rows) width = std::max(width, row.cues.size());
  std::string table = fmt::format(
      "{:<{}}  error °  relative %     cm  in 5 %  in 10 %  IoU median   mean\n", "cues", width);
  for (const AblationRow& row : rows) {
    const ColumnFigures& f = row.figures;
    table += fmt::format(
        "{:<{}}  {}  {}  {}  {}  {}  {}  {}\n", row.cues, width, Cell(f.error_median_deg, 1, 2, 7),
        Cell(f.relative_error_median, 100, 1, 10), Cell(f.error_median_m, 100, 1, 5),
        Cell(f.within_5pct, 100, 0, 6), Cell(f.within_10pct, 100, 0, 7),
        Cell(f.iou_median, 1, 3, 10), Cell(f.iou_mean, 1, 3, 5));
  }
  return table;
}

}  // namespace enfilade
