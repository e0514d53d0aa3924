// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/assemble.h"

#include "enfilade/base/check.h"
#include "enfilade/floorplan/vertex_dial.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/paper_field.h"
#include "src/floorplan/paper_walls.h"
#include "src/floorplan/rooms.h"
#include "src/floorplan/wall_thickness.h"

namespace enfilade {
namespace {

// Walls as raw counts show them.
void AddCountedRooms(const EvidenceGrids& evidence, const MultiPolygon2& polygons,
                     const StoreyStructure& heights, const std::vector<HeightSample>& samples,
                     const FloorplanOptions& options, Storey& storey) {
  const PaperField field = MakePaperField(evidence, options.paper);
  for (const Polygon2& polygon : polygons) {
    Room room = MakeRoom(polygon, heights, samples);
    room.id = static_cast<int>(storey.rooms.size());
    TakeOutline(MeasureOutline(field, polygon, 0), options.wall_thickness_m, room, storey);
    storey.rooms.push_back(room);
  }
}

}  // namespace

Floorplan AssembleFloorplan(const Scene& scene, const Structure& structure,
                            const std::vector<EvidenceGrids>& evidence,
                            const std::vector<MultiPolygon2>& rooms,
                            const FloorplanOptions& options) {
  ENFILADE_CHECK(rooms.size() == structure.storeys.size() && evidence.size() == rooms.size());
  Floorplan plan;
  plan.home_from_world = structure.home_from_world;
  plan.cameras = PlanCameras(scene);
  for (size_t i = 0; i < rooms.size(); ++i) {
    Storey& storey = plan.storeys.emplace_back();
    storey.id = static_cast<int>(i);
    storey.floor_z = structure.storeys[i].floor_z;
    const std::vector<HeightSample> samples = HeightSamples(scene, structure, static_cast<int>(i));
    if (evidence[i].mode == EvidenceMode::kCounts) {
      AddCountedRooms(evidence[i], rooms[i], structure.storeys[i], samples, options, storey);
    } else {
      const LoopField field = NormaliseEvidence(evidence[i], options);
      for (const Polygon2& polygon : rooms[i])
        AddRoom(field, polygon, structure.storeys[i], samples, options, storey);
    }
    MeasureThickness(options.openings.max_wall_m, storey);
  }
  return plan;
}

}  // namespace enfilade
