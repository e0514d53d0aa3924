// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/openings.h"
#include "enfilade/floorplan/paper.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

enum class FloorplanMode {
  kFull,   ///< rooms with inner walls, from log-odds
  kPaper,  ///< one outline from raw counts, as Cabral & Furukawa (2014) published it
};
[[nodiscard]] std::span<const std::string_view> EnumNames(FloorplanMode);

/// How the outlines are drawn. All costs are in metres of unseen wall.
struct FloorplanOptions {
  FloorplanMode mode = FloorplanMode::kFull;
  int vertices = 0;  ///< corners of all rooms together, for DrawPlan; 0: as many as pay

  double turn_cost_m = 0.25;
  double margin_m = 2.5;
  double seen_wall_log_odds = 2;
  double free_depth_m = 0.5;
  double outside_weight = 8;
  double inside_weight = 8;

  double wall_share = 0.5;
  double solid_log_odds = 0.5;
  double min_solid_area_m2 = 0.01;
  double min_solid_length_m = 0.15;
  double max_bridge_m = 0.15;
  double max_island_cost = 0.5;

  double min_oblique_m = 0.5;
  double heading_cost_m = 0.25;

  double slide_m = 0.15;
  double min_jog_m = 0.08;
  double min_room_m2 = 0.25;
  double wall_thickness_m = 0.12;

  double max_neck_m = 2.5;
  double unseen_gap_m = 1.6;
  double unseen_hole_m2 = 4;

  OpeningOptions openings = {};  ///< where rooms are cut; for FindOpenings

  PaperOptions paper = {};

  void Visit(OptionVisitor& v);
};

enum class FloorplanOutcome { kFound, kNoCore, kNoLoop, kNoSuchNumber };
[[nodiscard]] std::span<const std::string_view> EnumNames(FloorplanOutcome);

struct FloorplanReport {
  FloorplanOutcome outcome = FloorplanOutcome::kNoCore;
  std::string reason;       ///< one line; empty when every core got its loop
  int num_cores = 0;        ///< in all storeys
  int num_loops = 0;        ///< outer loops found
  int num_inner_loops = 0;  ///< holes: pillars and free-standing walls
  int num_inner_walls = 0;  ///< walls that run into a room from its outline
  int num_slid_segments = 0;
  int num_moved = 0;      ///< walls that were likely furniture's, put onto the line of others
  int num_joined = 0;     ///< rooms joined across walls that nobody saw
  int num_leaks = 0;      ///< windows, glass doors and mirrors beyond which something was left out
  int num_mirrors = 0;    ///< of them
  double leaks_m2 = 0;    ///< what was left out there
  int num_set_apart = 0;  ///< rooms that were seen only through their doors
  double unseen_m2 = 0;   ///< space between rooms that was taken in though nobody saw it
  int64_t num_settled = 0;         ///< states that the loop solver visited
  Floorplan plan;                  ///< empty storeys where nothing was found
  std::vector<PaperStorey> paper;  ///< FloorplanMode::kPaper: how the plan came about, by storey
  /// What the pictures showed of the walls, for FindOpenings; none where none was looked at.
  std::shared_ptr<FacadeStore> facades;
};

/// Draws the rooms of every storey: for each core component the cheapest Manhattan loop round it.
///
/// A step of the loop costs its length where no wall is seen, more where free space lies outside or
/// solid wall inside, and every corner costs turn_cost_m. Solid wall that the loop encloses is cut
/// out: as a bay of the outline where it hangs together with the outside, else as a hole with its
/// own loop. Runs of the loop beside walls that run along neither axis are redrawn straight where a
/// straight face is seen. Then every segment slides along its normal to the wall evidence. Cores
/// get disjoint territories, so rooms do not overlap. Rooms are cut at walls with doors that the
/// views' pictures show (view.path; views without one are passed over). A wall that is likely the
/// front of furniture moves back onto the line of a wall beside it.
///
/// FloorplanMode::kPaper draws what the paper does, from raw counts: one loop round all cores that
/// cameras see each other through, a cell of it costs where it has too few wall points, and a
/// second path through anchors undoes the first one's shrinkage. Its rooms have a curve.
///
/// `evidence` has one entry a storey of `structure`, in log-odds or, for the paper, raw counts.
/// Guarantees: rings are simple, orientations
/// those of Polygon2, rooms of a storey are disjoint, walls are the edges of the rooms in ring
/// order with the room on their left; no openings (FindOpenings), σ (AssignSigmas) or curves
/// (FindRoomCurves). A storey without core has no rooms.
///
/// After Cabral & Furukawa, "Piecewise Planar and Compact Floorplan Reconstruction from Images"
/// (CVPR 2014); what differs is in docs/algorithms/floorplan.md.
[[nodiscard]] FloorplanReport SolveFloorplan(const Scene& scene, const Structure& structure,
                                             const std::vector<EvidenceGrids>& evidence,
                                             const FloorplanOptions& options, RunContext& context);

}  // namespace enfilade
