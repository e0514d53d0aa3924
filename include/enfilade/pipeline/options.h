// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/options.h"
#include "enfilade/evidence/accumulate.h"
#include "enfilade/evidence/core.h"
#include "enfilade/exchange/plan_svg.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/model/texture.h"
#include "enfilade/pipeline/cloud.h"
#include "enfilade/sfm/place_panoramas.h"
#include "enfilade/structure/analyze.h"

namespace enfilade {

struct SfmOptions {
  SceneReadOptions reading;
  PlaceOptions placing;

  void Visit(OptionVisitor& v) {
    reading.Visit(v);
    placing.Visit(v);
  }
};

struct EvidenceOptions {
  AccumulateOptions grid;
  CoreOptions core;

  void Visit(OptionVisitor& v) {
    v("grid", grid, "Grids of wall and free-space evidence.");
    v("core", core, "Core free space.");
  }
};

struct ExportOptions {
  PlanSvgOptions svg;

  void Visit(OptionVisitor& v) { v("svg", svg, "The drawn plan."); }
};

/// The options of every stage, in flow order, under the stages' names: what --config files hold,
/// what --STAGE.NAME on the command line sets, and what the reference page lists.
struct PipelineOptions {
  SfmOptions sfm;
  CloudOptions points;
  StructureOptions structure;
  EvidenceOptions evidence;
  FloorplanOptions floorplan;
  TextureOptions model;
  ExportOptions exporting;

  void Visit(OptionVisitor& v) {
    v("sfm", sfm, "Pictures and poses.");
    v("points", points, "A dense cloud of points.");
    v("structure", structure, "Directions, heights and wall profiles.");
    v("evidence", evidence, "Grids and core free space.");
    v("floorplan", floorplan, "Rooms and walls.");
    v("model", model, "Textures.");
    v("export", exporting, "Drawings.");
  }
};

}  // namespace enfilade
