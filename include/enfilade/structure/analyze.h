// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/classify.h"
#include "enfilade/structure/column_scores.h"
#include "enfilade/structure/heading.h"
#include "enfilade/structure/heights.h"
#include "enfilade/structure/line_response.h"
#include "enfilade/structure/plane_viterbi.h"
#include "enfilade/structure/shared_scores.h"
#include "enfilade/structure/strip_correlation.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What finds the walls: lines and correlation; these and the labels of superpixels; or the labels
/// alone, as the source paper does.
enum class StructureMode { kProfile, kJoint, kPaper };
[[nodiscard]] std::span<const std::string_view> EnumNames(StructureMode);

struct StructureOptions {
  StructureMode mode = StructureMode::kProfile;
  int num_columns = 1024;
  int max_width = 2048;
  double max_distance_m = 20.0;
  double stand_elevation_deg = -72.0;
  bool use_floor = true;
  bool use_ceiling = true;
  bool use_correlation = true;
  bool use_shared = true;
  bool use_obstacles = true;
  bool use_diagonals = true;
  bool use_frontal = true;
  double floor_weight = 1.0;
  double ceiling_weight = 1.0;
  double correlation_weight = 1.5;
  double shared_weight = 1.0;
  double label_weight = 3.0;
  double max_label_loss = 0.2;
  double clear_response = 0.4;
  HeadingOptions heading;
  LineResponseOptions line;
  FloorEndOptions floor_end;
  CeilingEndOptions ceiling_end;
  ObstacleOptions obstacle;
  StripCorrelationOptions correlation;
  SharedScoresOptions shared;
  HeightOptions height;
  ClassifyOptions classify;
  PlaneViterbiOptions viterbi;

  void Visit(OptionVisitor& v) {
    v("mode", mode, "What finds walls: lines and correlation, the labels of superpixels, or both.");
    v("num_columns", num_columns, "Columns of a wall profile; a power of two.", {64, 4096});
    v("max_width", max_width, "Width to which larger panoramas are reduced, pixels.", {256, 8192});
    v("max_distance_m", max_distance_m, "Farthest wall, metres.", {2.0, 200.0});
    v("stand_elevation_deg", stand_elevation_deg,
      "Pixels below this elevation belong to the camera's stand, degrees.", {-90.0, -30.0});
    v("use_floor", use_floor, "Use the floor line.");
    v("use_ceiling", use_ceiling, "Use the ceiling line.");
    v("use_correlation", use_correlation, "Use the correlation with other panoramas.");
    v("use_shared", use_shared, "Use the lines that other panoramas see.");
    v("use_obstacles", use_obstacles, "Let something stand before a wall.");
    v("use_diagonals", use_diagonals, "Allow walls at 45 degrees.");
    v("use_frontal", use_frontal, "Allow walls of free direction.");
    v("floor_weight", floor_weight, "Weight of the floor line.", {0.0, 10.0});
    v("ceiling_weight", ceiling_weight, "Weight of the ceiling line.", {0.0, 10.0});
    v("correlation_weight", correlation_weight, "Weight of the correlation.", {0.0, 10.0});
    v("shared_weight", shared_weight, "Weight of the lines that other panoramas see.", {0.0, 10.0});
    v("label_weight", label_weight,
      "Weight of the labels of superpixels, in modes joint and paper, per nat and radian.",
      {0.0, 100.0});
    v("max_label_loss", max_label_loss,
      "Most that labels count against a wall, nats times radians.", {0.0, 10.0});
    v("clear_response", clear_response,
      "Weighed response of its lines from which a wall is believed in full; 0: every wall is.",
      {0.0, 10.0});
    v("heading", heading, "Heading of the walls.");
    v("line", line, "Response to floor and ceiling lines.");
    v("floor_end", floor_end, "Lines on the floor at which it does not end.");
    v("ceiling_end", ceiling_end, "Lines on the ceiling beyond what looks like a wall.");
    v("obstacle", obstacle, "Things that stand before a wall.");
    v("correlation", correlation, "Correlation of wall strips.");
    v("shared", shared, "Lines that other panoramas see.");
    v("height", height, "Heights of floor and ceiling.");
    v("classify", classify, "Classification of superpixels, in modes joint and paper.");
    v("viterbi", viterbi, "Choice of the walls round a panorama.");
  }
};

struct StructureReport {
  Structure structure;
  /// One a view in modes joint and paper, with the maps as the view's camera saw them; else empty.
  std::vector<Classification> classifications;
  std::vector<std::string> warnings;
};

/// Finds directions, heights and wall profiles of the whole home.
///
/// Steps: the heading is pooled over all panoramas (great-circle gradient voting); every panorama
/// is turned into the home frame; line responses and strip correlations are computed; the floor is
/// found per storey, the ceiling per room; a circular Viterbi over the distance explains each
/// panorama's floor line, ceiling line and correlation, first without, then with knowledge of where
/// the other panoramas' walls are. Pictures are decoded twice and not kept.
///
/// Requires at least one view. Throws IoError or InvalidInputError for pictures that cannot be
/// read, InvalidInputError when floor line, ceiling line and correlation are all switched off.
[[nodiscard]] StructureReport AnalyzeStructure(const Scene& scene, const StructureOptions& options,
                                               RunContext& context);

}  // namespace enfilade
