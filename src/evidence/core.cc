// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/core.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/disjoint_sets.h"
#include "enfilade/evidence/ray_traversal.h"
#include "enfilade/image/distance_transform.h"
#include "regions.h"

namespace enfilade {
namespace {

constexpr int kMaxCores = 65535;
// A wall that ends free space has its face no farther behind: twice the error of one pixel at 8 m.
constexpr double kFaceReach_m = 0.3;

struct Thresholds {
  float min_free;
  float max_wall;
};

Thresholds ThresholdsOf(EvidenceMode mode, const CoreOptions& options) {
  if (mode == EvidenceMode::kCounts) {
    return {static_cast<float>(options.min_free_rays), static_cast<float>(options.min_wall_points)};
  }
  return {static_cast<float>(options.min_free_log_odds),
          static_cast<float>(options.max_wall_log_odds)};
}

// Free cells without wall that have one of the reasons `support`, clear of the border.
ImageU8 CandidateCells(const EvidenceGrids& grids, const Thresholds& thresholds, uint8_t support) {
  ImageU8 mask(grids.frame.rows, grids.frame.cols);
  for (int r = 1; r + 1 < mask.rows(); ++r) {
    for (int c = 1; c + 1 < mask.cols(); ++c) {
      mask(r, c) = (grids.support(r, c) & support) != 0 &&
                   grids.free(r, c) >= thresholds.min_free &&
                   grids.wall(r, c) < thresholds.max_wall;
    }
  }
  return mask;
}

// Calls visit(row, col, distance_m) for the cell of `position` and those with centres within
// `radius_m` of it.
template <typename Visit>
void ForEachCellWithin(const GridFrame& frame, const Eigen::Vector2d& position, double radius_m,
                       Visit&& visit) {
  const int row = frame.Row(position.y()), col = frame.Col(position.x());
  const int reach = static_cast<int>(std::ceil(radius_m / frame.cell_m));
  for (int r = row - reach; r <= row + reach; ++r) {
    for (int c = col - reach; c <= col + reach; ++c) {
      if (!frame.IsInside(r, c)) continue;
      const double distance_m = r == row && c == col ? 0 : (frame.Center(r, c) - position).norm();
      if (distance_m <= radius_m) visit(r, c, distance_m);
    }
  }
}

// The label at the camera, or of the nearest labelled cell within `snap_m`; 0 when there is none.
int LabelAtCamera(const ImageI& label, const GridFrame& frame, const Eigen::Vector2d& position,
                  double snap_m) {
  int nearest = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  ForEachCellWithin(frame, position, snap_m, [&](int r, int c, double distance_m) {
    if (label(r, c) == 0 || distance_m >= nearest_m) return;
    nearest = label(r, c);
    nearest_m = distance_m;
  });
  return nearest;
}

std::vector<int> LabelsAtCameras(const ImageI& label, const EvidenceGrids& grids, double snap_m) {
  std::vector<int> labels;
  for (const EvidenceCamera& camera : grids.cameras) {
    labels.push_back(LabelAtCamera(label, grids.frame, camera.position, snap_m));
  }
  return labels;
}

// Bodies are the parts of the mask that narrow necks join: what is left of it after an erosion by
// half a neck, grown back. Parts that are narrow throughout are a body of their own.
Components SplitAtNecks(const ImageU8& mask, double neck_px) {
  const Components eroded = LabelComponents(ErodeByDisc(mask, 0.5 * neck_px), Connectivity::kFour);
  Components bodies{GrowLabels(eroded.label, mask), {0}};
  ImageU8 rest(mask.rows(), mask.cols());
  for (size_t i = 0; i < rest.data().size(); ++i) {
    rest.data()[i] = mask.data()[i] != 0 && bodies.label.data()[i] == 0;
  }
  const Components narrow = LabelComponents(rest, Connectivity::kFour);
  bodies.num_cells.resize(static_cast<size_t>(eroded.count() + narrow.count()) + 1);
  for (size_t i = 0; i < rest.data().size(); ++i) {
    if (rest.data()[i] != 0) bodies.label.data()[i] = eroded.count() + narrow.label.data()[i];
    if (mask.data()[i] != 0) ++bodies.num_cells[bodies.label.data()[i]];
  }
  return bodies;
}

// Calls visit(a, b) for every pair of 4-neighbours with different non-zero labels.
template <typename Visit>
void ForEachContact(const ImageI& label, Visit&& visit) {
  for (int r = 0; r < label.rows(); ++r) {
    for (int c = 0; c < label.cols(); ++c) {
      const int a = label(r, c);
      if (a == 0) continue;
      const int right = c + 1 < label.cols() ? label(r, c + 1) : 0;
      const int above = r + 1 < label.rows() ? label(r + 1, c) : 0;
      if (right != 0 && right != a) visit(a, right);
      if (above != 0 && above != a) visit(a, above);
    }
  }
}

// Joins the bodies along the straight line between two cameras when all of it is free.
void JoinAlongSightLine(const ImageI& body, const GridFrame& frame, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b, DisjointSets& sets) {
  std::vector<int> passed;
  bool is_free = true;
  TraverseCells(frame, a, b, [&](int row, int col) {
    const int label = body(row, col);
    is_free = label != 0;
    if (is_free && (passed.empty() || passed.back() != label)) passed.push_back(label);
    return is_free;
  });
  if (!is_free) return;
  for (size_t i = 1; i < passed.size(); ++i) sets.Join(passed[0], passed[i]);
}

// A neck is passed when cameras stand on both sides of it, one camera stands in it, or two cameras
// see each other through it.
DisjointSets JoinPassedNecks(const ImageI& body, int num_bodies, const EvidenceGrids& grids,
                             double snap_m) {
  DisjointSets sets(num_bodies + 1);
  std::vector<bool> has_camera(static_cast<size_t>(num_bodies) + 1);
  for (const EvidenceCamera& camera : grids.cameras) {
    int here = 0;
    ForEachCellWithin(grids.frame, camera.position, snap_m, [&](int r, int c, double) {
      const int label = body(r, c);
      if (label == 0) return;
      if (here != 0) sets.Join(here, label);
      here = label;
      has_camera[static_cast<size_t>(label)] = true;
    });
  }
  ForEachContact(body, [&](int a, int b) {
    if (has_camera[a] && has_camera[b]) sets.Join(a, b);
  });
  for (size_t i = 0; i < grids.cameras.size(); ++i) {
    for (size_t j = i + 1; j < grids.cameras.size(); ++j) {
      JoinAlongSightLine(body, grids.frame, grids.cameras[i].position, grids.cameras[j].position,
                         sets);
    }
  }
  return sets;
}

int CountCutNecks(const ImageI& body, DisjointSets& sets) {
  std::set<std::pair<int, int>> cut;
  ForEachContact(body, [&](int a, int b) {
    if (sets.Find(a) != sets.Find(b)) cut.insert(std::minmax(a, b));
  });
  return static_cast<int>(cut.size());
}

// Numbers regions that hold a camera 1, 2, … by their first camera and drops the others. `label`
// may be any labelling; returns the number of regions kept.
int KeepRegionsWithCamera(const EvidenceGrids& grids, double snap_m, ImageI& label) {
  const int max_label =
      label.empty() ? 0 : *std::max_element(label.data().begin(), label.data().end());
  std::vector<int> number(static_cast<size_t>(max_label) + 1);
  int count = 0;
  for (int at_camera : LabelsAtCameras(label, grids, snap_m)) {
    if (at_camera == 0 || number[at_camera] != 0 || count == kMaxCores) continue;
    number[at_camera] = ++count;
  }
  for (int& l : label.data()) l = number[l];
  return count;
}

// The border of a part of the free space, in sides of cells.
struct PartBorder {
  int wall = 0;                 // a wall was seen behind them
  int open = 0;                 // nothing was
  std::map<int, int> mouth_to;  // a region lies behind them: which one

  [[nodiscard]] int Mouth() const {
    int mouth = 0;
    for (const auto& [region, width] : mouth_to) mouth += width;
    return mouth;
  }

  // The region that it opens to most widely, and how widely.
  [[nodiscard]] std::pair<int, int> WidestMouth() const {
    std::pair<int, int> widest{0, 0};
    for (const auto& [region, width] : mouth_to) {
      if (width > widest.second) widest = {region, width};
    }
    return widest;
  }
};

std::vector<PartBorder> MeasureBorders(const EvidenceGrids& grids, const Thresholds& thresholds,
                                       const ImageI& region, const Components& parts) {
  const int reach = static_cast<int>(std::lround(kFaceReach_m / grids.frame.cell_m));
  std::vector<PartBorder> borders(parts.num_cells.size());
  for (int r = 1; r + 1 < region.rows(); ++r) {
    for (int c = 1; c + 1 < region.cols(); ++c) {
      const int part = parts.label(r, c);
      if (part == 0) continue;
      PartBorder& border = borders[part];
      for (const auto& [dr, dc] : std::span(kNeighbours).first<4>()) {
        if (parts.label(r + dr, c + dc) != 0) continue;
        if (const int beside = region(r + dr, c + dc); beside != 0) {
          ++border.mouth_to[beside];
          continue;
        }
        bool is_wall = false;
        for (int k = 1; k <= reach && !is_wall; ++k) {
          is_wall = grids.frame.IsInside(r + k * dr, c + k * dc) &&
                    grids.wall(r + k * dr, c + k * dc) >= thresholds.max_wall;
        }
        ++(is_wall ? border.wall : border.open);
      }
    }
  }
  return borders;
}

// Takes in what one panorama alone sees beside a region, the far half of a room or the leg of an L,
// but for what it sees out of a window or past a wall that it missed. With the part its open border
// would be a wall that nobody saw, without it the seen walls round it would have no room and its
// mouth would be such a wall: what leaves less unexplained is done. A part joins no two regions: it
// goes to the one that it opens to most widely. Returns the number of cells taken in.
int TakeInFarParts(const EvidenceGrids& grids, const Thresholds& thresholds,
                   const CoreOptions& options, ImageI& region) {
  const double cell_m = grids.frame.cell_m;
  ImageU8 free = OpenByDisc(CandidateCells(grids, thresholds, kStrongSupport | kSupportFar),
                            options.opening_radius_m / cell_m);
  for (size_t i = 0; i < free.data().size(); ++i) {
    if (region.data()[i] != 0) free.data()[i] = 0;
  }
  const Components parts = LabelComponents(free, Connectivity::kFour);
  const std::vector<PartBorder> borders = MeasureBorders(grids, thresholds, region, parts);
  std::vector<int> owner(borders.size());
  int num_cells = 0;
  for (size_t i = 1; i < borders.size(); ++i) {
    const auto [beside, width] = borders[i].WidestMouth();
    if (beside == 0 || width * cell_m < options.min_neck_m) continue;
    if (borders[i].open >= borders[i].wall + borders[i].Mouth()) continue;
    owner[i] = beside;
    num_cells += parts.num_cells[i];
  }
  for (size_t i = 0; i < free.data().size(); ++i) {
    if (free.data()[i] != 0) region.data()[i] = owner[parts.label.data()[i]];
  }
  return num_cells;
}

// Fills holes of a region that are small and show no wall: furniture. A hole belongs to the region
// when every region cell beside it does.
void FillFurniture(const EvidenceGrids& grids, const Thresholds& thresholds, double max_hole_m2,
                   ImageI& region) {
  ImageU8 outside(region.rows(), region.cols());
  for (size_t i = 0; i < outside.data().size(); ++i) outside.data()[i] = region.data()[i] == 0;
  const Components holes = LabelComponents(outside, Connectivity::kEight);
  const auto count = static_cast<size_t>(holes.count()) + 1;
  std::vector<int> owner(count), num_wall_cells(count);
  constexpr int kNoOwner = -1;
  for (int r = 0; r < region.rows(); ++r) {
    for (int c = 0; c < region.cols(); ++c) {
      const auto hole = static_cast<size_t>(holes.label(r, c));
      if (hole == 0) continue;
      num_wall_cells[hole] += grids.wall(r, c) >= thresholds.max_wall;
      if (r == 0 || c == 0 || r + 1 == region.rows() || c + 1 == region.cols()) {
        owner[hole] = kNoOwner;
        continue;
      }
      for (int beside : {region(r - 1, c), region(r + 1, c), region(r, c - 1), region(r, c + 1)}) {
        if (beside != 0)
          owner[hole] = owner[hole] == 0 || owner[hole] == beside ? beside : kNoOwner;
      }
    }
  }
  const double cell_m2 = grids.frame.cell_m * grids.frame.cell_m;
  for (size_t i = 0; i < region.data().size(); ++i) {
    const auto hole = static_cast<size_t>(holes.label.data()[i]);
    // One or two cells are no wall: noise of a single column reaches that far.
    if (hole == 0 || owner[hole] <= 0 || num_wall_cells[hole] > 2) continue;
    if (holes.num_cells[hole] * cell_m2 < max_hole_m2) region.data()[i] = owner[hole];
  }
}

// Erodes every region by itself, so that regions that touch come apart.
void ErodeRegions(double radius_px, ImageI& region) {
  ImageU8 inner(region.rows(), region.cols());
  for (int r = 1; r + 1 < region.rows(); ++r) {
    for (int c = 1; c + 1 < region.cols(); ++c) {
      const int here = region(r, c);
      const auto is_same = [&](int other) { return other == here || other == 0; };
      inner(r, c) = here != 0 && is_same(region(r, c + 1)) && is_same(region(r + 1, c)) &&
                    is_same(region(r, c - 1)) && is_same(region(r - 1, c));
    }
  }
  const ImageU8 eroded = ErodeByDisc(inner, radius_px);
  for (size_t i = 0; i < eroded.data().size(); ++i) {
    if (eroded.data()[i] == 0) region.data()[i] = 0;
  }
}

// 4-connected parts of the regions become the cores.
void NumberCores(const EvidenceGrids& grids, double snap_m, ImageI& region, CoreReport& report) {
  ImageU8 mask(region.rows(), region.cols());
  for (size_t i = 0; i < mask.data().size(); ++i) mask.data()[i] = region.data()[i] != 0;
  region = LabelComponents(mask, Connectivity::kFour).label;
  report.num_cores = KeepRegionsWithCamera(grids, snap_m, region);
  report.core = CoreImage(region.rows(), region.cols());
  for (size_t i = 0; i < region.data().size(); ++i) {
    report.core.data()[i] = static_cast<uint16_t>(region.data()[i]);
  }
  const std::vector<int> labels = LabelsAtCameras(region, grids, snap_m);
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) report.views_without_core.push_back(grids.cameras[i].view_idx);
  }
}

int64_t CountCells(const ImageI& label) {
  return std::count_if(label.data().begin(), label.data().end(), [](int l) { return l != 0; });
}

}  // namespace

void CoreOptions::Visit(OptionVisitor& v) {
  v("min_free_log_odds", min_free_log_odds, "Free-space log-odds from which a cell may be core.",
    {0, 100});
  v("max_wall_log_odds", max_wall_log_odds, "Wall log-odds from which a cell is wall.", {-10, 100});
  v("min_free_rays", min_free_rays, "As min_free_log_odds, for counts.", {1, 1e6});
  v("min_wall_points", min_wall_points, "As max_wall_log_odds, for counts.", {1, 1e6});
  v("opening_radius_m", opening_radius_m,
    "Core is nowhere narrower than twice this before erosion.", {0, 1});
  v("min_neck_m", min_neck_m, "Narrower necks that no panorama passed are cut.", {0, 3});
  v("max_hole_m2", max_hole_m2, "Smaller holes without wall evidence are filled.", {0, 10});
  v("erosion_m", erosion_m, "Room between core and free space for the plan's path.", {0, 0.5});
  v("camera_snap_m", camera_snap_m, "How far from its core a camera may stand.", {0, 2});
}

CoreReport FindCore(const EvidenceGrids& grids, const CoreOptions& options, RunContext& context) {
  ENFILADE_CHECK(grids.wall.rows() == grids.frame.rows && grids.wall.cols() == grids.frame.cols);
  CoreReport report;
  const Thresholds thresholds = ThresholdsOf(grids.mode, options);
  const double cell_m = grids.frame.cell_m;

  const ImageU8 free = OpenByDisc(CandidateCells(grids, thresholds, kStrongSupport),
                                  options.opening_radius_m / cell_m);
  context.CheckStop();
  Components bodies = SplitAtNecks(free, options.min_neck_m / cell_m);
  ImageI& region = bodies.label;
  DisjointSets sets = JoinPassedNecks(region, bodies.count(), grids, options.camera_snap_m);
  report.num_necks_cut = CountCutNecks(region, sets);
  for (int& label : region.data()) label = sets.Find(label);

  const int64_t num_free = CountCells(region);
  KeepRegionsWithCamera(grids, options.camera_snap_m, region);
  report.dropped_m2 = static_cast<double>(num_free - CountCells(region)) * cell_m * cell_m;
  context.CheckStop();
  if (grids.mode == EvidenceMode::kLogOdds) {
    report.far_m2 = TakeInFarParts(grids, thresholds, options, region) * cell_m * cell_m;
    context.CheckStop();
  }
  FillFurniture(grids, thresholds, options.max_hole_m2, region);
  ErodeRegions(options.erosion_m / cell_m, region);
  NumberCores(grids, options.camera_snap_m, region, report);
  return report;
}

}  // namespace enfilade
