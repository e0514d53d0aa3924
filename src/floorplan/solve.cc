// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "enfilade/floorplan/wall_witness.h"
#include "enfilade/geometry/boolean.h"
#include "src/floorplan/box_index.h"
#include "src/floorplan/doubtful_walls.h"
#include "src/floorplan/facade_store.h"
#include "src/floorplan/join_rooms.h"
#include "src/floorplan/leaks.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/oblique.h"
#include "src/floorplan/outline.h"
#include "src/floorplan/paper_storey.h"
#include "src/floorplan/rooms.h"
#include "src/floorplan/slide.h"
#include "src/floorplan/sound_polygon.h"
#include "src/floorplan/split_rooms.h"
#include "src/floorplan/territories.h"
#include "src/floorplan/unseen_space.h"
#include "src/floorplan/wall_thickness.h"

namespace enfilade {
namespace {

constexpr double kCollinear_m = 1e-6;
constexpr int kMaxMoves = 3;

ImageI TerritoriesOf(const LoopField& field, const ImageI& core_of_cell) {
  ImageF solid(field.frame.rows, field.frame.cols);
  for (size_t i = 0; i < solid.data().size(); ++i) {
    solid.data()[i] = std::max({-field.freeness.data()[i], field.faceness.data()[i], 0.0F});
  }
  return AssignTerritories(std::move(solid), core_of_cell);
}

Polygon2 ToPolygon(const LoopField& field, const GridOutline& outline) {
  MultiPolygon2 region = {{RingInMetres(field.frame, outline.outer), {}}};
  for (const auto& island : outline.islands) {
    region = Difference(region, {{RingInMetres(field.frame, island), {}}});
  }
  return LargestRoom(region, 1e-9);
}

/// What remains of each polygon, its rings apart, without the larger ones; in the given order.
void RemoveOverlaps(std::vector<Polygon2>& polygons) {
  std::vector<size_t> order(polygons.size());
  std::vector<Box2> boxes;
  for (size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
    if (!polygons[i].holes.empty()) polygons[i] = WithRingsApart(polygons[i], kCollinear_m);
    boxes.push_back(BoxOf(polygons[i].outer));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return Area(polygons[a]) > Area(polygons[b]); });
  std::vector<size_t> rank(order.size());
  for (size_t r = 0; r < order.size(); ++r) rank[order[r]] = r;
  const BoxIndex index(boxes);
  for (const size_t i : order) {
    std::vector<size_t> before = index.Touching(boxes[i]);
    std::erase_if(before,
                  [&](size_t j) { return rank[j] >= rank[i] || polygons[j].outer.empty(); });
    std::sort(before.begin(), before.end(), [&](size_t a, size_t b) { return rank[a] < rank[b]; });
    MultiPolygon2 taken;
    for (const size_t j : before) taken.push_back(polygons[j]);
    if (Area(Intersection({polygons[i]}, taken)) > kMaxOverlap_m2) {
      polygons[i] = LargestRoom(Difference({polygons[i]}, taken), kCollinear_m);
    }
  }
}

class Solver {
 public:
  Solver(const Scene& scene, const Structure& structure, const FloorplanOptions& options,
         RunContext& context, FloorplanReport& report)
      : scene_(scene),
        structure_(structure),
        options_(options),
        context_(context),
        report_(report) {}

  void AddStorey(const EvidenceGrids& evidence, const StoreyStructure& heights,
                 const std::vector<HeightSample>& samples) {
    Storey& storey = report_.plan.storeys.emplace_back();
    storey.id = static_cast<int>(report_.plan.storeys.size()) - 1;
    storey.floor_z = heights.floor_z;
    if (options_.mode == FloorplanMode::kPaper) {
      AddPaperStorey(evidence, heights, samples, options_, context_, report_);
      return;
    }
    const CoreMap cores = MapCores(evidence);
    report_.num_cores += static_cast<int>(cores.windows.size());
    if (cores.windows.empty()) return;
    const LoopField field = MakeLoopField(evidence, options_);
    std::vector<Polygon2> polygons = DrawPolygons(field, cores);
    RemoveOverlaps(polygons);
    std::erase_if(polygons,
                  [&](const Polygon2& polygon) { return Area(polygon) < options_.min_room_m2; });
    const size_t num_entered = polygons.size();
    LeaveOutLeaks(field, evidence.cameras, polygons);
    TakeIn(field, polygons);
    SetRooms(field, polygons, heights, samples, storey);
    // Cuts leave walls that nobody saw: what is to be joined is found before and joined after.
    const MultiPolygon2 gaps = FindUnseenWalls(field, options_.slide_m, num_entered, polygons);
    std::vector<Polygon2> parts =
        SplitRoomsAtDoors(scene_, report_.plan.home_from_world, field, storey, storey.id,
                          options_.wall_thickness_m, options_.openings, *report_.facades, context_);
    const bool is_cut = parts.size() != polygons.size();
    const int num_joined = JoinAcross(gaps, parts);
    report_.num_joined += num_joined;
    if (is_cut || num_joined > 0) SetRooms(field, parts, heights, samples, storey);
    MoveWalls(evidence, field, heights, samples, storey);
  }

 private:
  void SetRooms(const LoopField& field, const std::vector<Polygon2>& polygons,
                const StoreyStructure& heights, const std::vector<HeightSample>& samples,
                Storey& storey) {
    storey.rooms.clear();
    storey.walls.clear();
    for (const Polygon2& polygon : polygons)
      AddRoom(field, polygon, heights, samples, options_, storey);
    MeasureThickness(options_.openings.max_wall_m, storey);
  }

  // A wall that has moved may make others surer.
  void MoveWalls(const EvidenceGrids& evidence, const LoopField& field,
                 const StoreyStructure& heights, const std::vector<HeightSample>& samples,
                 Storey& storey) {
    const int num_before = report_.num_moved;
    for (int round = 0; round < kMaxMoves; ++round) {
      std::vector<Polygon2> polygons;
      for (const Room& room : storey.rooms) polygons.push_back(room.polygon);
      const std::vector<WallSigma> sigmas = FindWallSigmas(
          evidence, storey, FindWallWitnesses(scene_, structure_, storey, storey.id), options_);
      const int num_moved = MoveDoubtfulWalls(field, options_, storey, sigmas, polygons);
      if (num_moved == 0) break;
      report_.num_moved += num_moved;
      SetRooms(field, polygons, heights, samples, storey);
    }
    if (report_.num_moved == num_before) return;
    context_.log().Info(
        fmt::format("{} walls that are likely fronts of furniture are put onto the "
                    "lines of walls beside them",
                    report_.num_moved - num_before));
  }

  // Appends the rooms that nobody entered.
  void LeaveOutLeaks(const LoopField& field, const std::vector<EvidenceCamera>& cameras,
                     std::vector<Polygon2>& polygons) {
    const LeakReport leaks = LeaveLeaks(field, options_, cameras, context_, polygons);
    report_.num_leaks += leaks.num_leaks;
    report_.num_mirrors += leaks.num_mirrors;
    report_.leaks_m2 += leaks.leaks_m2;
    report_.num_set_apart += leaks.num_set_apart;
    if (leaks.num_leaks == 0) return;
    context_.log().Info(
        fmt::format("{:.1f} m² seen through windows or glass doors or in mirrors ({}) are left out",
                    leaks.leaks_m2, leaks.num_leaks));
  }

  void TakeIn(const LoopField& field, std::vector<Polygon2>& polygons) {
    const double unseen_m2 = TakeInUnseenSpace(field, options_, polygons);
    report_.unseen_m2 += unseen_m2;
    if (unseen_m2 > 0) {
      context_.log().Info(fmt::format(
          "{:.1f} m² between rooms, which no picture shows, are in the plan", unseen_m2));
    }
  }

  std::vector<Polygon2> DrawPolygons(const LoopField& field, const CoreMap& cores) {
    const ImageI territories = TerritoriesOf(field, cores.core_of_cell);
    const size_t num_cores = cores.windows.size();
    std::vector<Polygon2> polygons(num_cores);
    std::vector<GridOutline> outlines(num_cores);
    ParallelFor(context_, "floorplan", static_cast<int64_t>(num_cores), [&](int64_t task) {
      const auto k = static_cast<size_t>(task);
      outlines[k] =
          FindOutline(field, cores, territories, static_cast<int>(task), options_, context_);
      if (outlines[k].outcome == GridLoopOutcome::kFound)
        polygons[k] = ToPolygon(field, outlines[k]);
    });
    for (size_t k = 0; k < num_cores; ++k) {
      const GridOutline& outline = outlines[k];
      report_.num_settled += outline.num_settled;
      if (polygons[k].outer.empty()) {
        report_.reason =
            fmt::format("core {} has no loop: {}", k,
                        EnumNames(outline.outcome)[static_cast<size_t>(outline.outcome)]);
        context_.log().Warning(report_.reason);
        continue;
      }
      ++report_.num_loops;
      report_.num_inner_loops += static_cast<int>(polygons[k].holes.size());
      report_.num_inner_walls += outline.num_inner_walls;
    }
    DrawObliqueWalls(field, options_, context_, polygons);
    if (options_.slide_m > 0) {
      report_.num_slid_segments +=
          SlideToEvidence(field, options_.slide_m, options_.min_jog_m, polygons);
    }
    return polygons;
  }

  const Scene& scene_;
  const Structure& structure_;
  const FloorplanOptions& options_;
  RunContext& context_;
  FloorplanReport& report_;
};

}  // namespace

void FloorplanOptions::Visit(OptionVisitor& v) {
  v("mode", mode, "Rooms with inner walls, or one outline as Cabral & Furukawa (2014) draw it.");
  v("vertices", vertices, "Corners of all rooms together; 0: as many as pay.", {0, 1e6});
  v("turn_cost_m", turn_cost_m, "Cost of a corner, in metres of unseen wall.", {0.001, 10});
  v("margin_m", margin_m, "How far from the core walls are looked for.", {0.05, 100});
  v("seen_wall_log_odds", seen_wall_log_odds, "Wall evidence from which a wall counts as seen.",
    {0.01, 100});
  v("free_depth_m", free_depth_m, "How far beside a wall free and solid space count.", {0.01, 5});
  v("outside_weight", outside_weight, "Cost of a square metre of free space left outside.",
    {0, 1000});
  v("inside_weight", inside_weight, "Cost of a square metre of solid wall taken in.", {0, 1000});
  v("wall_share", wall_share, "Weight of faces beside free space when solid wall is looked for.",
    {0, 10});
  v("solid_log_odds", solid_log_odds, "How surely not free a cell of solid wall is.", {0, 100});
  v("min_solid_area_m2", min_solid_area_m2, "Smallest inner wall or pillar.", {0, 100});
  v("min_solid_length_m", min_solid_length_m, "Shortest inner wall or pillar.", {0, 100});
  v("max_bridge_m", max_bridge_m,
    "Free space between an inner wall and the outside that is no gap.", {0, 10});
  v("max_island_cost", max_island_cost, "Largest cost a metre of a loop round an inner wall.",
    {0, 100});
  v("min_oblique_m", min_oblique_m, "Shortest wall that may run along neither axis; 0: none does.",
    {0, 10});
  v("heading_cost_m", heading_cost_m,
    "Cost of a wall's heading off the axes; a quarter of it at 45 degrees.", {0, 10});
  v("slide_m", slide_m, "How far walls may slide to the evidence; 0 leaves them on the grid.",
    {0, 1});
  v("min_jog_m", min_jog_m, "Shorter jogs between two walls are straightened.", {0, 1});
  v("min_room_m2", min_room_m2, "Smaller rooms are dropped.", {0, 100});
  v("wall_thickness_m", wall_thickness_m, "Assumed thickness of walls.", {0.01, 2});
  v("max_neck_m", max_neck_m,
    "What lies beyond windows, glass doors and mirrors up to this wide is left out if it has no "
    "walls; 0: it stays.",
    {0, 10});
  v("unseen_gap_m", unseen_gap_m,
    "Unseen space between walls of rooms up to this far apart lies in the home; 0: none does.",
    {0, 5});
  v("unseen_hole_m2", unseen_hole_m2,
    "Unseen space up to this large lies in it if rooms surround it.", {0, 100});
  v("openings", openings, "Doors, found in the pictures.");
  v("paper", paper, "Mode paper.");
}

std::span<const std::string_view> EnumNames(FloorplanMode) {
  static constexpr std::array<std::string_view, 2> kNames = {"full", "paper"};
  return kNames;
}

std::span<const std::string_view> EnumNames(FloorplanOutcome) {
  static constexpr std::array<std::string_view, 4> kNames = {"found", "no_core", "no_loop",
                                                             "no_such_number"};
  return kNames;
}

FloorplanReport SolveFloorplan(const Scene& scene, const Structure& structure,
                               const std::vector<EvidenceGrids>& evidence,
                               const FloorplanOptions& options, RunContext& context) {
  ENFILADE_CHECK(evidence.size() == structure.storeys.size());
  FloorplanReport report;
  report.plan.home_from_world = structure.home_from_world;
  report.plan.cameras = PlanCameras(scene);
  report.facades = std::make_shared<FacadeStore>(context);
  Solver solver(scene, structure, options, context, report);
  for (size_t i = 0; i < evidence.size(); ++i) {
    solver.AddStorey(evidence[i], structure.storeys[i],
                     HeightSamples(scene, structure, static_cast<int>(i)));
  }
  if (report.num_cores == 0) {
    report.outcome = FloorplanOutcome::kNoCore;
    report.reason = "no free space that surely lies inside was found";
  } else {
    report.outcome = report.num_loops > 0 ? FloorplanOutcome::kFound : FloorplanOutcome::kNoLoop;
  }
  return report;
}

}  // namespace enfilade
