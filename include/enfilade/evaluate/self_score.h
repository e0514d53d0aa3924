// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

struct SelfScoreOptions {
  double line_deg = 1.0;
  double depth_share = 0.05;
  double corner_deg = 2.0;

  void Visit(OptionVisitor& v);
};

/// How well a plan that was made without a panorama predicts what the panorama shows: shares, 0–1,
/// none of them when the plan predicts nothing there.
struct PredictionFigures {
  std::string picture;
  std::optional<double> floor_line;      ///< columns whose floor line lies where it was predicted
  std::optional<double> ceiling_line;    ///< the same for the ceiling line
  std::optional<double> vertical_lines;  ///< F1 of the upright lines between walls
  std::optional<double> depth;           ///< columns whose wall is as far away as predicted
  std::optional<double> score;           ///< mean of the four
};

/// Compares the wall profile of a panorama with `plan`, which was made without it.
///
/// The plan is cast from the place of the camera: the walls of the room that the camera stands in,
/// and its floor and ceiling. Floor and ceiling lines may be off by line_deg, the distance of the
/// wall by depth_share of itself; corners and edges at which one wall hides another by corner_deg
/// of azimuth. What is left out: columns that the picture does not cover, and those in which the
/// plan predicts no wall, because it only supposes one there (WallSeen::kInferred) or has a door or
/// opening. `profile` and `home_from_world` are the run's own; the frame of the plan may differ.
///
/// Predicts nothing when the camera stands in no room of the plan.
[[nodiscard]] PredictionFigures ScorePrediction(const Floorplan& plan, const View& view,
                                                const WallProfile& profile,
                                                const Rigid3& home_from_world,
                                                const SelfScoreOptions& options = {});

/// What the panoramas of a home say to the plans made without them.
struct SelfReport {
  std::vector<PredictionFigures> panoramas;  ///< in the order of the views
  std::optional<double> score;               ///< median over those that were predicted
  int num_predicted = 0;
};

/// `plans` has one entry a view of the scene: the plan made without it, none when there can be
/// none. `structure` is that of the whole run.
[[nodiscard]] SelfReport ScorePredictions(const Scene& scene, const Structure& structure,
                                          std::span<const std::optional<Floorplan>> plans,
                                          const SelfScoreOptions& options = {});

/// A table for the terminal, the panoramas that agree least with the plan first.
[[nodiscard]] std::string FormatSelfReport(const SelfReport& report);

/// One object a panorama, null where there is no figure.
[[nodiscard]] nlohmann::json SelfReportToJson(const SelfReport& report);

}  // namespace enfilade
