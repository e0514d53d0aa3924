// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/enfilade/judge.h"
#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/baselines/orientation_map.h"
#include "enfilade/baselines/plane_cut.h"
#include "enfilade/baselines/poisson_surface.h"
#include "enfilade/baselines/polygonal_surface.h"
#include "enfilade/baselines/volume_cut.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// What each method of a comparison may use, and the rivals' own options. `cut.lambda` is the
/// lowest of three.
struct CompareOptions {
  double max_seconds = 600;
  int max_memory_mb = 4096;
  EvidenceMode cut_evidence = EvidenceMode::kCounts;
  PlaneCutOptions cut;
  VolumeCutOptions volume_cut;
  PoissonOptions poisson;
  PolygonalOptions polygonal;
  OrientationMapOptions orientation;
  int view_width = 640;

  void Visit(OptionVisitor& v) {
    v("max_seconds", max_seconds, "Time after which a method is given up, with reading its input.",
      {0.001, 1e6});
    v("max_memory_mb", max_memory_mb, "Resident memory above which a method is given up.",
      {64, 1 << 30});
    v("cut_evidence", cut_evidence,
      "Grids that the cut in the plane is given; counts are those of the paper.");
    v("cut", cut, "The graph cut in the plane.");
    v("volume_cut", volume_cut, "The graph cut in three dimensions.");
    v("poisson", poisson, "The Poisson surface.");
    v("polygonal", polygonal, "The polygonal surface.");
    v("orientation", orientation, "Orientation maps.");
    v("view_width", view_width, "Columns of the page's pictures of models.", {64, 4096});
  }
};

/// The same as the command line names it: --compare.max_seconds.
struct CompareCommandOptions {
  CompareOptions compare;

  void Visit(OptionVisitor& v) { v("compare", compare, "The methods that are compared."); }
};

/// What a contender makes of a run's wall profiles and points.
struct ContenderResult {
  std::string reason;  ///< why there is nothing, one line; empty when there is something
  Floorplan plan;
  std::optional<BuildingModel> surface;  ///< none: the plan raised
};

/// A method of the comparison.
struct Contender {
  std::string name;        ///< of its folder
  std::string title;       ///< for people
  nlohmann::json options;  ///< all that determine its result
  bool needs_pictures = false;
  std::function<ContenderResult(const Results& results, RunContext& context)> run;
};

/// The methods, in the order in which they are shown: the full solver, the paper's, the cut in the
/// plane at λ, 4λ and 16λ, as the paper compares them, the cut in three dimensions, the Poisson and
/// the polygonal surface. The first two, and the evidence of the plans, with the options of the
/// run.
[[nodiscard]] std::vector<Contender> ContendersOf(const Manifest& manifest,
                                                  const CompareOptions& options);

}  // namespace enfilade
