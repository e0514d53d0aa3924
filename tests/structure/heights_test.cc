// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "enfilade/structure/line_response.h"
#include "enfilade/structure/types.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

constexpr int kRows = 512, kColumns = 64;
const DistanceBins kBins{0.3, 0.015, 220};

// A panorama in a room, as a perfect line detector and a perfect correlation would see it.
struct PerfectView {
  PerfectView(const BoxRoom& room, const Eigen::Vector3d& camera, bool has_ceiling_line = true)
      : position(camera), truth(TruthOfColumns(room, camera.head<2>(), kColumns)) {
    std::vector<double> heights = {room.floor_z - camera.z()};
    if (room.baseboard_m > 0) heights.push_back(room.floor_z + room.baseboard_m - camera.z());
    if (has_ceiling_line) heights.push_back(room.ceiling_z - camera.z());
    response = PerfectResponse(truth, kRows, heights);
    // A correlation is broad.
    correlation = PerfectScores(truth, kBins, 1.0, 8);
  }

  Eigen::Vector3d position;
  ColumnTruth truth;
  LineResponse response;
  ColumnScores correlation;
};

std::vector<HeightView> ViewsOf(const std::vector<PerfectView>& perfect) {
  std::vector<HeightView> views;
  for (const PerfectView& p : perfect) views.push_back({&p.response, &p.correlation, p.position});
  return views;
}

BoxRoom RoomWith(double floor_z, double ceiling_z, double baseboard_m) {
  BoxRoom room;
  room.floor_z = floor_z;
  room.ceiling_z = ceiling_z;
  room.baseboard_m = baseboard_m;
  return room;
}

FloorEstimate Floor(const std::vector<PerfectView>& views, double prior_camera_m = 0) {
  RunContext context(2);
  return EstimateFloor(ViewsOf(views), prior_camera_m, kBins, {}, {}, context);
}

TEST(EstimateFloor, FindsFloorAndBaseboardWhateverTheCameraHeight) {
  for (const double camera_m : {0.9, 1.45, 1.8}) {
    const BoxRoom room = RoomWith(0.3, 2.8, 0.08);
    const FloorEstimate floor = Floor({PerfectView(room, {1.2, 1.1, 0.3 + camera_m}),
                                       PerfectView(room, {2.9, 1.9, 0.31 + camera_m}, false)});
    EXPECT_NEAR(floor.floor_z, 0.3, 0.02) << camera_m;
    EXPECT_NEAR(floor.baseboard.height_m, 0.08, 0.025) << camera_m;
    EXPECT_GT(floor.contrast, 0.1) << camera_m;
  }
}

TEST(EstimateFloor, WithoutBaseboardASingleLineIsFound) {
  const BoxRoom room = RoomWith(-0.2, 2.2, 0);
  const FloorEstimate floor =
      Floor({PerfectView(room, {1.2, 1.1, 1.2}), PerfectView(room, {2.9, 1.9, 1.2}, false)});
  EXPECT_NEAR(floor.floor_z, -0.2, 0.02);
  EXPECT_EQ(floor.baseboard.height_m, 0);
}

// Views of two lines of given strengths, in 255ths: the floor's and, 8 cm above, the baseboard's.
std::vector<PerfectView> ViewsOfTwoLines(int lower_strength, int upper_strength) {
  const BoxRoom room = RoomWith(0.1, 2.6, 0.08);
  std::vector<PerfectView> views = {PerfectView(room, {1.2, 1.1, 1.5}),
                                    PerfectView(room, {2.9, 1.9, 1.5})};
  for (PerfectView& view : views) {
    const LineResponse lower = PerfectResponse(view.truth, kRows, {0.1 - 1.5});
    const LineResponse upper = PerfectResponse(view.truth, kRows, {0.18 - 1.5});
    for (const size_t f : {0, 1}) {
      for (size_t i = 0; i < lower.family[f].data().size(); ++i) {
        view.response.family[f].data()[i] =
            static_cast<uint8_t>(std::max(lower.family[f].data()[i] * lower_strength / 255,
                                          upper.family[f].data()[i] * upper_strength / 255));
      }
    }
  }
  return views;
}

// Also where the lower line is all but lost in the shadow of the baseboard.
TEST(EstimateFloor, WhicheverEdgeOfABaseboardIsClearerTheFloorIsTheLower) {
  for (const auto& [lower, upper] : {std::pair{51, 255}, {127, 255}, {255, 255}, {255, 127}}) {
    const FloorEstimate floor = Floor(ViewsOfTwoLines(lower, upper));
    EXPECT_NEAR(floor.floor_z, 0.1, 0.025) << lower << " and " << upper;
    EXPECT_NEAR(floor.baseboard.height_m, 0.08, 0.025) << lower << " and " << upper;
    EXPECT_LE(floor.baseboard.share, 0.5);
  }
}

// The upper edge misleads a search that knows how high the camera is, too: to walls too far away.
TEST(EstimateFloor, AKnownCameraKeepsItsHeightOverABaseboard) {
  const FloorEstimate floor = Floor(ViewsOfTwoLines(51, 255), 1.4);
  EXPECT_NEAR(floor.floor_z, 0.1, 0.02);
  EXPECT_NEAR(floor.baseboard.height_m, 0.08, 0.025);
  EXPECT_EQ(floor.baseboard.share, 0.5);  // or the walls would stay there
}

TEST(EstimateFloor, APriorDecidesWhatOneBlankRoomCannot) {
  // Without correlation any floor explains the lines of one panorama.
  const BoxRoom room = RoomWith(0, 2.5, 0.07);
  std::vector<PerfectView> views = {PerfectView(room, {1.2, 1.1, 1.5})};
  views[0].correlation = ColumnScores();
  EXPECT_NEAR(Floor(views, 1.5).floor_z, 0, 0.03);
  EXPECT_NEAR(Floor(views, 1.2).floor_z, 0.3, 0.06);
  // Nobody says: the usual height, 1.5 m.
  for (const double camera_m : {1.1, 1.5, 1.9}) {
    std::vector<PerfectView> unknown = {PerfectView(room, {1.2, 1.1, camera_m})};
    unknown[0].correlation = ColumnScores();
    EXPECT_NEAR(Floor(unknown).floor_z, camera_m - 1.5, 0.12) << camera_m;
  }
}

std::vector<CeilingEstimate> Ceilings(const std::vector<PerfectView>& views,
                                      const std::vector<std::vector<RoomMate>>& room_mates,
                                      double baseboard_m) {
  RunContext context(2);
  return EstimateCeilings(ViewsOf(views), {0, {baseboard_m, 0.5}, 0}, room_mates, nullptr, kBins,
                          {}, {}, context);
}

TEST(EstimateCeilings, RoomsOfDifferentHeightKeepTheirs) {
  const BoxRoom low = RoomWith(0, 2.33, 0.07), high = RoomWith(0, 2.61, 0.07);
  const std::vector<CeilingEstimate> ceilings =
      Ceilings({PerfectView(low, {1.2, 1.1, 1.4}), PerfectView(low, {2.4, 2.0, 1.4}),
                PerfectView(high, {1.7, 0.9, 1.41})},
               {{{1}}, {{0}}, {}}, 0.07);
  EXPECT_NEAR(ceilings[0].ceiling_z, 2.33, 0.03);
  EXPECT_NEAR(ceilings[1].ceiling_z, 2.33, 0.03);
  EXPECT_NEAR(ceilings[2].ceiling_z, 2.61, 0.03);
  for (const CeilingEstimate& ceiling : ceilings) EXPECT_GT(ceiling.weight, 0.95);
}

TEST(EstimateCeilings, APanoramaThatSeesNoneTakesItsRoomsCeiling) {
  const BoxRoom room = RoomWith(0, 2.75, 0.07);
  const std::vector<CeilingEstimate> ceilings =
      Ceilings({PerfectView(room, {1.2, 1.1, 1.4}), PerfectView(room, {2.4, 2.0, 1.4}, false)},
               {{{1}}, {{0}}}, 0.07);
  EXPECT_NEAR(ceilings[1].ceiling_z, 2.75, 0.03);
}

// Three panoramas of the next room are seen through its door.
TEST(EstimateCeilings, APanoramaKeepsItsCeilingAgainstThoseOfTheNextRoom) {
  const BoxRoom low = RoomWith(0, 2.33, 0.07), high = RoomWith(0, 2.61, 0.07);
  const std::vector<CeilingEstimate> ceilings =
      Ceilings({PerfectView(high, {1.7, 0.9, 1.4}), PerfectView(low, {1.2, 1.1, 1.4}),
                PerfectView(low, {2.4, 2.0, 1.4}), PerfectView(low, {2.0, 1.2, 1.4})},
               {{{1, 0.1}, {2, 0.1}, {3, 0.1}},
                {{0, 0.1}, {2}, {3}},
                {{0, 0.1}, {1}, {3}},
                {{0, 0.1}, {1}, {2}}},
               0.07);
  EXPECT_NEAR(ceilings[0].ceiling_z, 2.61, 0.03);
  EXPECT_NEAR(ceilings[1].ceiling_z, 2.33, 0.03);
}

// The tops of cabinets along half of the walls are as clear as a ceiling that shows above
// fewer. What rooms usually measure decides.
TEST(EstimateCeilings, TheTopsOfCabinetsAreNoCeiling) {
  const BoxRoom room = RoomWith(0, 2.6, 0.07);
  PerfectView view(room, {1.7, 1.4, 1.4}, false);
  const LineResponse ceiling = PerfectResponse(view.truth, kRows, {2.6 - 1.4});
  const LineResponse cabinets = PerfectResponse(view.truth, kRows, {2.04 - 1.4});
  for (const size_t f : {0, 1}) {
    for (int r = 0; r < kRows / 2; ++r) {
      for (int c = 0; c < kColumns; ++c) {
        const LineResponse& source = c < kColumns / 2 - 6 ? ceiling : cabinets;
        view.response.family[f](r, c) = source.family[f](r, c);
      }
    }
  }
  EXPECT_NEAR(Ceilings({view}, {{}}, 0.07)[0].ceiling_z, 2.6, 0.03);
}

// Of a moulding in the angle of wall and ceiling the upper edge runs before the wall, the lower one
// below the ceiling. Whichever is clearer, the ceiling is where the upper one runs.
TEST(EstimateCeilings, ACorniceHangsBelowTheCeiling) {
  constexpr double kCornice_m = 0.09, kDepth_m = 0.07;
  const BoxRoom room = RoomWith(0, 2.6, 0.07);
  for (const auto& [lower, upper] : {std::pair{160, 255}, {255, 255}, {255, 160}}) {
    std::vector<PerfectView> views = {PerfectView(room, {1.2, 1.1, 1.4}, false),
                                      PerfectView(room, {2.4, 2.0, 1.4}, false)};
    for (PerfectView& view : views) {
      ColumnTruth before = view.truth;
      for (size_t c = 0; c < before.wall_m.size(); ++c) {
        const double off =
            WallDirection(before.family[c], AzimuthOfColumn(static_cast<int>(c), kColumns)) -
            AzimuthOfColumn(static_cast<int>(c), kColumns);
        before.wall_m[c] -= kDepth_m / std::abs(std::sin(off));
      }
      const LineResponse low = PerfectResponse(view.truth, kRows, {2.6 - kCornice_m - 1.4});
      const LineResponse high = PerfectResponse(before, kRows, {2.6 - 1.4});
      for (const size_t f : {0, 1}) {
        for (size_t i = 0; i < low.family[f].data().size(); ++i) {
          uint8_t& response = view.response.family[f].data()[i];
          response =
              static_cast<uint8_t>(std::max({int{response}, low.family[f].data()[i] * lower / 255,
                                             high.family[f].data()[i] * upper / 255}));
        }
      }
    }
    for (const CeilingEstimate& ceiling : Ceilings(views, {{{1}}, {{0}}}, 0.07)) {
      EXPECT_NEAR(ceiling.ceiling_z, 2.6, 0.025) << lower << " and " << upper;
      EXPECT_NEAR(ceiling.cornice_m, kCornice_m, 0.025) << lower << " and " << upper;
    }
  }
}

TEST(EstimateCeilings, ALineAloneIsNoCornice) {
  const BoxRoom room = RoomWith(0, 2.45, 0.07);
  for (const CeilingEstimate& ceiling :
       Ceilings({PerfectView(room, {1.2, 1.1, 1.4}), PerfectView(room, {2.4, 2.0, 1.4})},
                {{{1}}, {{0}}}, 0.07)) {
    EXPECT_EQ(ceiling.cornice_m, 0);
    EXPECT_EQ(ceiling.ceiling_z, ceiling.line_z);
  }
}

// A wide opening shows so much of the next room that its panoramas pass for mates.
TEST(EstimateCeilings, ManyMatesOfTheNextRoomDoNotOutvoteAClearCeiling) {
  const BoxRoom low = RoomWith(0, 2.33, 0.07), high = RoomWith(0, 2.75, 0.07);
  const std::vector<CeilingEstimate> ceilings =
      Ceilings({PerfectView(high, {1.7, 0.9, 1.4}), PerfectView(low, {1.2, 1.1, 1.4}),
                PerfectView(low, {2.4, 2.0, 1.4}), PerfectView(low, {2.0, 1.2, 1.4})},
               {{{1, 0.8}, {2, 0.9}, {3, 0.7}},
                {{0, 0.8}, {2}, {3}},
                {{0, 0.9}, {1}, {3}},
                {{0, 0.7}, {1}, {2}}},
               0.07);
  EXPECT_NEAR(ceilings[0].ceiling_z, 2.75, 0.03);
  EXPECT_NEAR(ceilings[1].ceiling_z, 2.33, 0.03);
}

TEST(EstimateCeilings, NoLevelCeilingHasNoWeight) {
  const BoxRoom room = RoomWith(0, 2.5, 0.07);
  const std::vector<CeilingEstimate> ceilings =
      Ceilings({PerfectView(room, {1.2, 1.1, 1.4}, false)}, {{}}, 0.07);
  EXPECT_LT(ceilings[0].weight, 0.3);
}

}  // namespace
}  // namespace enfilade
