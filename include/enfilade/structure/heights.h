// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/structure/column_scores.h"
#include "enfilade/structure/plane_viterbi.h"
#include "enfilade/structure/room_mates.h"

namespace enfilade {

struct HeightOptions {
  double min_camera_m = 0.6;
  double max_camera_m = 2.2;
  double camera_prior_sigma_m = 0.03;
  double typical_camera_m = 1.5;
  double typical_camera_sigma_m = 0.25;
  double min_room_m = 2.15;
  double max_room_m = 4.2;
  double step_m = 0.02;
  double max_baseboard_m = 0.14;
  double max_cornice_m = 0.12;
  double typical_room_m = 2.5;
  double typical_room_sigma_m = 0.2;
  double home_weight = 0.5;
  double level_contrast = 0.2;

  void Visit(OptionVisitor& v) {
    v("min_camera_m", min_camera_m, "Lowest camera above the floor, metres.", {0.1, 5.0});
    v("max_camera_m", max_camera_m, "Highest camera above the floor, metres.", {0.2, 10.0});
    v("camera_prior_sigma_m", camera_prior_sigma_m,
      "Standard deviation of a camera height that files or the user give, metres.", {0.001, 1.0});
    v("typical_camera_m", typical_camera_m,
      "Usual height of a camera above the floor, for homes that do not say, metres.", {0.2, 10.0});
    v("typical_camera_sigma_m", typical_camera_sigma_m,
      "Standard deviation of cameras' heights about it, metres.", {0.01, 10.0});
    v("min_room_m", min_room_m, "Lowest ceiling above the floor, metres.", {1.0, 10.0});
    v("max_room_m", max_room_m, "Highest ceiling above the floor, metres.", {1.5, 20.0});
    v("step_m", step_m, "Step of the coarse search for heights, metres.", {0.005, 0.5});
    v("max_baseboard_m", max_baseboard_m, "Tallest baseboard, metres; 0 looks for none.",
      {0.0, 0.5});
    v("max_cornice_m", max_cornice_m, "Tallest cornice, metres; 0 looks for none.", {0.0, 0.5});
    v("typical_room_m", typical_room_m, "Usual height of a room, metres.", {1.5, 20.0});
    v("typical_room_sigma_m", typical_room_sigma_m,
      "Standard deviation of the rooms' heights about it, metres.", {0.01, 10.0});
    v("home_weight", home_weight, "Weight of the home's ceilings in the choice of a room's.",
      {0.0, 10.0});
    v("level_contrast", level_contrast,
      "Gain in mean response at which a level ceiling is certain.", {0.001, 1.0});
  }
};

/// What the search for heights needs of one panorama.
struct HeightView {
  const LineResponse* response = nullptr;     ///< at few columns: the search is coarse in azimuth
  const ColumnScores* correlation = nullptr;  ///< weighed; may be empty
  Eigen::Vector3d position{0, 0, 0};          ///< of the camera
  bool use_floor = true;
};

struct FloorEstimate {
  double floor_z = 0;
  Baseboard baseboard;  ///< of no height when a single line explains the pictures better
  double contrast = 0;  ///< score at the optimum above the median candidate, mean response
};

/// The floor of one storey, common to its panoramas: the height at which floor lines, correlation
/// and the panoramas among each other agree best, summed over the best wall paths of all of them: a
/// wrong height moves every wall away from its own camera. The line that wins may be either edge of
/// a baseboard: where there is one, its height and the floor's are sought together.
/// `prior_camera_m` 0 means unknown: then the usual height counts, a little, and decides where one
/// panorama alone has no scale.
[[nodiscard]] FloorEstimate EstimateFloor(std::span<const HeightView> views, double prior_camera_m,
                                          const DistanceBins& bins,
                                          const PlaneViterbiOptions& viterbi,
                                          const HeightOptions& options, RunContext& context);

struct CeilingEstimate {
  double ceiling_z = 0;
  /// Where the clearest line about the ceiling would lie on the walls: the ceiling's, or an edge of
  /// a cornice.
  double line_z = 0;
  double cornice_m = 0;  ///< height of the moulding between wall and ceiling, 0 for none
  double weight = 1;     ///< 0–1: how clearly the ceiling is one level plane
};

/// The ceiling over each panorama. Score curves over the height are pooled with those of the
/// panoramas in the same room (FindRoomMates) and of the whole home, and with what
/// rooms usually measure: one panorama alone errs by up to half a metre in a closet, and takes the
/// tops of cabinets for a ceiling. A mate counts against no height by more than a bound, as it may
/// stand in the next room after all. Things may stand before walls (`obstacle`; null: nothing
/// does), or the ceiling would be sought where it meets the front of the furniture. The line that
/// wins may be either edge of a cornice: both are then sought together.
[[nodiscard]] std::vector<CeilingEstimate> EstimateCeilings(
    std::span<const HeightView> views, const FloorEstimate& floor,
    const std::vector<std::vector<RoomMate>>& room_mates, const ObstacleOptions* obstacle,
    const DistanceBins& bins, const PlaneViterbiOptions& viterbi, const HeightOptions& options,
    RunContext& context);

}  // namespace enfilade
