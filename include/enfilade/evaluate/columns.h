// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// How well the wall profile of one panorama agrees with the truth; medians and shares are over its
/// judged columns.
struct PanoramaFigures {
  std::string picture;
  int num_columns = 0;                     ///< judged ones
  std::optional<double> error_median_deg;  ///< of the floor line; none without a camera height
  std::optional<double> relative_error_median;
  std::optional<double> error_median_m;
  std::optional<double> within_5pct, within_10pct;  ///< shares, 0–1
  std::optional<double> iou;              ///< polygon of the profile against the visible layout
  std::optional<double> ceiling_error_m;  ///< |height found − height of the true room it stands in|
  int view_idx = 0;                       ///< into the scene
};

/// The same over the panoramas: medians of their figures, and the mean IoU.
struct ColumnFigures {
  std::vector<PanoramaFigures> panoramas;  ///< in the order of the profiles
  std::optional<double> error_median_deg, relative_error_median, error_median_m;
  std::optional<double> within_5pct, within_10pct;
  std::optional<double> iou_median, iou_mean;
  std::optional<double> ceiling_error_median_m;
};

struct ColumnOptions {
  /// A door or opening may lie this far behind the layout and still take its columns out: it is
  /// annotated by hand, on the layout or a little off it.
  double opening_reach_m = 0.15;

  void Visit(OptionVisitor& v);
};

/// Judges the structural wall distance r̂ of each image column against the ray into the visible
/// layout of its panorama.
///
/// `truth_idx` gives the truth view of each scene view, −1 for none (MatchPictures). Judged are
/// panoramas with truth, taken inside their layout, and in them the columns that the picture covers
/// and that run through no door or opening. The floor line's error is |atan(h/r̂) − atan(h/r)| with
/// the true camera height h. Columns are compared in the frame of the camera, so that an error of
/// the pose does not count. The camera's place is the truth's where it is known. A column
/// without a positive finite distance counts as one outside every bound.
[[nodiscard]] ColumnFigures EvaluateColumns(const Scene& scene, const Structure& structure,
                                            const GroundTruth& truth,
                                            std::span<const int> truth_idx,
                                            const ColumnOptions& options = {});

/// The structure that a faultless search for walls would have found: each column has the distance
/// from where the camera truly stands to the first true wall as its certain wall, with no obstacle
/// before it. What later stages make of this is the most that better wall profiles can bring. Doors
/// are shut, but for those that the camera stands in (0.5 m); wide openings are open. Headings and
/// heights stay as they were found.
///
/// `truth_idx` and frames as for EvaluateColumns. Panoramas without truth, and columns without a
/// wall, count as not seen.
[[nodiscard]] Structure WithTrueProfiles(const Scene& scene, const Structure& structure,
                                         const GroundTruth& truth, std::span<const int> truth_idx);

/// A row of the ablation table: which cues were on and what they reached.
struct AblationRow {
  std::string cues;
  ColumnFigures figures;
};

/// The table of the ablation as aligned text, one row a set of cues.
[[nodiscard]] std::string FormatAblation(std::span<const AblationRow> rows);

}  // namespace enfilade
