// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/plane_cut.h"

#include <algorithm>
#include <array>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/floorplan/assemble.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/optim/grid_cut.h"
#include "src/baselines/cell_outline.h"
#include "src/baselines/cut_costs.h"

namespace enfilade {
namespace {

ImageU8 InsideOf(const GridCutReport& cut, const GridFrame& frame) {
  ImageU8 inside(frame.rows, frame.cols);
  std::copy(cut.is_source.begin(), cut.is_source.end(), inside.data().begin());
  return inside;
}

bool HoldsCamera(const CellSet& part, const EvidenceGrids& evidence) {
  return std::any_of(
      evidence.cameras.begin(), evidence.cameras.end(), [&](const EvidenceCamera& camera) {
        const int row = evidence.frame.Row(camera.position.y()),
                  col = evidence.frame.Col(camera.position.x());
        return evidence.frame.IsInside(row, col) &&
               std::binary_search(part.begin(), part.end(), row * evidence.frame.cols + col);
      });
}

Polygon2 PolygonOf(const CellSet& part, const GridFrame& frame) {
  const CellOutline outline = TraceOutline(frame.rows, frame.cols, part);
  Polygon2 polygon{RingInMetres(frame, outline.outer), {}};
  for (const auto& hole : outline.holes) polygon.holes.push_back(RingInMetres(frame, hole));
  return polygon;
}

MultiPolygon2 CutStorey(const EvidenceGrids& evidence, const PlaneCutOptions& options,
                        PlaneCutReport& report) {
  const GridCutReport cut = FindGridCut(MakeCutProblem(evidence, options));
  report.cut_cost += cut.cost;
  report.num_augmentations += cut.num_augmentations;
  ImageU8 inside = InsideOf(cut, evidence.frame);
  JoinCorners(inside);
  FillSmallHoles(CellsOf(options.min_hole_m2, evidence.frame.cell_m), inside);
  MultiPolygon2 rooms;
  for (const CellSet& part : ConnectedCells(inside)) {
    ++report.num_parts;
    if (part.size() < CellsOf(options.min_room_m2, evidence.frame.cell_m) ||
        !HoldsCamera(part, evidence))
      continue;
    rooms.push_back(PolygonOf(part, evidence.frame));
  }
  return rooms;
}

}  // namespace

void PlaneCutOptions::Visit(OptionVisitor& v) {
  v("lambda", lambda, "Price of a side between inside and outside.", {0, 100000});
  v("good_wall_points", good_wall_points,
    "Counts: wall points of a well supported cell; 0: good_wall_share.", {0, 1e6});
  v("good_free_rays", good_free_rays,
    "Counts: rays across a cell that is surely free; 0: good_free_share.", {0, 1e6});
  v("good_wall_share", good_wall_share,
    "Counts: the same as share of the mean number of points in cells with any.", {0.001, 1000});
  v("good_free_share", good_free_share,
    "Counts: the same as share of the mean number of rays across cells with any.", {0.001, 1000});
  v("reference_cell_m", reference_cell_m, "Side of the cells that the numbers above are for.",
    {0.001, 1});
  v("log_odds_scale", log_odds_scale, "Log-odds: cost of one of them.", {0.01, 1000});
  v("min_hole_m2", min_hole_m2, "Smaller holes in a room are filled.", {0, 100});
  v("min_room_m2", min_room_m2, "Smaller rooms are dropped.", {0, 100});
}

std::span<const std::string_view> EnumNames(PlaneCutOutcome) {
  static constexpr std::array<std::string_view, 2> kNames = {"found", "no_room"};
  return kNames;
}

PlaneCutReport CutFloorplan(const Scene& scene, const Structure& structure,
                            const std::vector<EvidenceGrids>& evidence,
                            const PlaneCutOptions& options, RunContext& context) {
  ENFILADE_CHECK(evidence.size() == structure.storeys.size());
  PlaneCutReport report;
  std::vector<MultiPolygon2> rooms;
  for (const EvidenceGrids& storey : evidence) {
    context.CheckStop();
    rooms.push_back(CutStorey(storey, options, report));
    report.num_rooms += static_cast<int>(rooms.back().size());
  }
  report.plan = AssembleFloorplan(scene, structure, evidence, rooms, FloorplanOptions());
  if (report.num_rooms > 0) {
    report.outcome = PlaneCutOutcome::kFound;
  } else {
    report.reason = report.num_parts == 0 ? "the cheapest cut leaves nothing inside"
                                          : "no part inside is large enough and holds a camera";
  }
  return report;
}

}  // namespace enfilade
