// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_storey.h"

#include <fmt/format.h>

#include <utility>

#include "enfilade/floorplan/vertex_dial.h"
#include "src/floorplan/paper_core.h"
#include "src/floorplan/paper_field.h"
#include "src/floorplan/paper_solve.h"
#include "src/floorplan/territories.h"

namespace enfilade {
namespace {

ImageI TerritoriesOf(const PaperField& field, const std::vector<ImageU8>& cores) {
  ImageF solid(field.frame.rows, field.frame.cols);
  for (int row = 0; row < field.frame.rows; ++row) {
    for (int col = 0; col < field.frame.cols; ++col)
      solid(row, col) = field.IsSeen(row, col) && !field.IsFree(row, col) ? 1 : 0;
  }
  return AssignTerritories(std::move(solid), CoreOfCells(field.frame, cores));
}

void AddCells(const ImageU8& cells, uint16_t value, CoreImage& image) {
  for (size_t i = 0; i < cells.data().size(); ++i) {
    if (cells.data()[i] != 0) image.data()[i] = value;
  }
}

}  // namespace

void AddPaperStorey(const EvidenceGrids& evidence, const StoreyStructure& heights,
                    const std::vector<HeightSample>& samples, const FloorplanOptions& options,
                    RunContext& context, FloorplanReport& report) {
  Storey& storey = report.plan.storeys.back();
  PaperStorey& trace = report.paper.emplace_back();
  trace.core = CoreImage(evidence.frame.rows, evidence.frame.cols);
  const PaperField field = MakePaperField(evidence, options.paper);
  const std::vector<ImageU8> cores = BridgeCores(field, evidence.cameras, SeparateCores(evidence));
  report.num_cores += static_cast<int>(cores.size());
  const ImageI territories = TerritoriesOf(field, cores);
  std::vector<PaperOutline> outlines(cores.size());
  ParallelFor(context, "floorplan", static_cast<int64_t>(cores.size()), [&](int64_t task) {
    const auto k = static_cast<size_t>(task);
    outlines[k] = SolvePaperLoop(field, evidence.cameras, cores[k],
                                 ForeignCells(territories, static_cast<int>(k)), options.margin_m,
                                 options.paper, context);
  });
  for (size_t k = 0; k < outlines.size(); ++k) {
    PaperOutline& outline = outlines[k];
    report.num_settled += outline.num_settled;
    AddCells(outline.core, static_cast<uint16_t>(k + 1), trace.core);
    if (outline.outcome != GridLoopOutcome::kFound) {
      report.reason = fmt::format("core {} has no loop: {}", k,
                                  EnumNames(outline.outcome)[static_cast<size_t>(outline.outcome)]);
      context.log().Warning(report.reason);
      continue;
    }
    ++report.num_loops;
    const OutlineChoice chosen = outline.curve[outline.automatic_idx];
    trace.loops.push_back(std::move(outline.loop));
    Room room = MakeRoom(chosen.polygon, heights, samples);
    if (Area(room.polygon) < options.min_room_m2) continue;
    room.id = static_cast<int>(storey.rooms.size());
    room.curve = std::move(outline.curve);
    TakeOutline(chosen, options.wall_thickness_m, room, storey);
    storey.rooms.push_back(std::move(room));
  }
}

}  // namespace enfilade
