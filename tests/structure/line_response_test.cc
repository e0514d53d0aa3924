// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/line_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 512, kRows = 256, kColumns = 128;
constexpr std::array kAllFamilies = {0, 1, 2, 3, 4};
const Vector3d kCamera(1.6, 1.3, 1.4);

LineResponse Respond(const LevelPanorama& panorama) {
  return ComputeLineResponse(panorama, kColumns, kAllFamilies, {});
}

// Index of the row whose pixels see a line at `height_m` above the camera at a distance.
double RowOfLine(double height_m, double distance_m) {
  return kRows * (0.5 - std::atan(height_m / distance_m) / kPi) - 0.5;
}

// Columns at least 12° away from the corners of the room and whose wall is not seen too flat.
std::vector<int> ColumnsOnWalls(const ColumnTruth& truth) {
  std::vector<int> columns;
  for (int c = 0; c < kColumns; ++c) {
    bool is_inner = true;
    for (int d = -4; d <= 4; ++d) {
      is_inner &= truth.family[static_cast<size_t>((c + d + kColumns) % kColumns)] ==
                  truth.family[static_cast<size_t>(c)];
    }
    if (is_inner) columns.push_back(c);
  }
  return columns;
}

struct LineFigures {
  double mean = 0;          // response at the line
  double off = 0;           // mean of the median response of each column
  int worst_row_error = 0;  // of the strongest row within ± 6 rows
};

// The response to the line at `height_m`, read in the wall's family (or in the other axis family).
LineFigures Measure(const LineResponse& response, const ColumnTruth& truth, double height_m,
                    bool in_other_family = false) {
  LineFigures figures;
  const std::vector<int> columns = ColumnsOnWalls(truth);
  for (const int c : columns) {
    const size_t i = static_cast<size_t>(c);
    const int family = in_other_family ? 1 - truth.family[i] : truth.family[i];
    const ImageU8& picture = response.family[static_cast<size_t>(family)];
    const int row = static_cast<int>(std::lround(RowOfLine(height_m, truth.wall_m[i])));
    int best = row;
    for (int r = row - 6; r <= row + 6; ++r) {
      if (picture(r, c) > picture(best, c)) best = r;
    }
    std::vector<uint8_t> all;
    for (int r = kRows / 8; r < kRows * 7 / 8; ++r) all.push_back(picture(r, c));
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                     all.end());
    figures.off += all[all.size() / 2] / 255.0 / static_cast<double>(columns.size());
    figures.mean += std::max({picture(row - 1, c), picture(row, c), picture(row + 1, c)}) / 255.0 /
                    static_cast<double>(columns.size());
    figures.worst_row_error = std::max(figures.worst_row_error, std::abs(best - row));
  }
  return figures;
}

TEST(ComputeLineResponse, PeaksOnFloorAndCeilingLine) {
  const BoxRoom room;
  const ColumnTruth truth = TruthOfColumns(room, kCamera.head<2>(), kColumns);
  const LineResponse response = Respond(DrawPanorama(room, kCamera, kWidth, 2.0));
  for (const double z : {room.floor_z, room.ceiling_z}) {
    const LineFigures figures = Measure(response, truth, z - kCamera.z());
    EXPECT_GT(figures.mean, 0.7) << z;
    EXPECT_LT(figures.off, 0.05) << z;
    EXPECT_LE(figures.worst_row_error, 1) << z;
  }
}

TEST(ComputeLineResponse, TheWallsOwnFamilyRespondsMost) {
  const BoxRoom room;
  // Seen obliquely lines of both families differ most.
  const Vector3d camera(0.8, 0.7, 1.4);
  const ColumnTruth truth = TruthOfColumns(room, camera.head<2>(), kColumns);
  const LineResponse response = Respond(DrawPanorama(room, camera, kWidth, 2.0));
  const LineFigures own = Measure(response, truth, -camera.z());
  const LineFigures other = Measure(response, truth, -camera.z(), true);
  EXPECT_GT(own.mean, other.mean + 0.2);
}

TEST(ComputeLineResponse, TwoGreyLevelsAreSeenInNoise) {
  BoxRoom room;
  room.wall_grey = 220;
  room.wall_shading = 0;
  room.ceiling_grey = 222;
  const ColumnTruth truth = TruthOfColumns(room, kCamera.head<2>(), kColumns);
  const LineResponse response = Respond(DrawPanorama(room, kCamera, kWidth, 1.0));
  const LineFigures figures = Measure(response, truth, room.ceiling_z - kCamera.z());
  EXPECT_GT(figures.mean, 0.3);
  EXPECT_GT(figures.mean, 4 * figures.off);
}

TEST(ComputeLineResponse, NoiseAloneRespondsLittle) {
  BoxRoom room;
  room.floor_grey = room.ceiling_grey = room.wall_grey = 180;
  room.wall_shading = 0;
  const LineResponse response = Respond(DrawPanorama(room, kCamera, kWidth, 3.0));
  for (const ImageU8& picture : response.family) {
    double sum = 0;
    for (const uint8_t value : picture.data()) sum += value / 255.0;
    EXPECT_LT(sum / static_cast<double>(picture.data().size()), 0.12);
  }
}

TEST(ComputeLineResponse, BorderOfTheUnseenIsNoLine) {
  LevelPanorama panorama{kCamera, ImageU8(kRows, kWidth, 3, 200), ImageU8(kRows, kWidth, 1, 1)};
  for (int r = 180; r < kRows; ++r) {
    for (int c = 0; c < kWidth; ++c) {
      panorama.is_seen(r, c) = 0;
      for (int k = 0; k < 3; ++k) panorama.rgb(r, c, k) = 0;
    }
  }
  const LineResponse response = Respond(panorama);
  for (const ImageU8& picture : response.family) {
    for (int c = 0; c < kColumns; ++c) {
      for (int r = 0; r < kRows; ++r) ASSERT_EQ(picture(r, c), 0) << r << ", " << c;
    }
  }
}

TEST(ComputeLineResponse, AJointBetweenTilesIsNoEdge) {
  // Level rings in noise: a step of 24 grey levels, and a line of one pixel on its brighter side
  // that is as much darker.
  constexpr int kStepRow = 150, kJointRow = 190;
  std::mt19937 random(7);
  LevelPanorama panorama{kCamera, ImageU8(kRows, kWidth, 3, 140), ImageU8(kRows, kWidth, 1, 1)};
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kWidth; ++c) {
      const int grey =
          (r < kStepRow || r == kJointRow ? 140 : 164) + static_cast<int>(random() % 9);
      for (int k = 0; k < 3; ++k) panorama.rgb(r, c, k) = static_cast<uint8_t>(grey);
    }
  }
  const ImageU8 picture = Respond(panorama).family[kFrontalFamily];
  for (int c = 0; c < kColumns; c += 16) {
    EXPECT_GT(std::max(picture(kStepRow - 1, c), picture(kStepRow, c)), 180);
    EXPECT_LT(picture(kJointRow, c), 100);
  }
}

// Where there are many joints, what little of them is left must not count as much as it would on a
// quiet wall.
TEST(ComputeLineResponse, AFloorFullOfJointsIsNotQuiet) {
  constexpr int kFirstRow = 160, kRowsApart = 12;
  std::mt19937 random(7);
  LevelPanorama panorama{kCamera, ImageU8(kRows, kWidth, 3), ImageU8(kRows, kWidth, 1, 1)};
  for (int r = 0; r < kRows; ++r) {
    // Tiles differ by six grey levels from row to row.
    const int tile = (r - kFirstRow) / kRowsApart % 2 == 0 ? 160 : 166;
    const bool is_joint = r >= kFirstRow && (r - kFirstRow) % kRowsApart == 0;
    for (int c = 0; c < kWidth; ++c) {
      const int grey = (r < kFirstRow ? 200
                        : is_joint    ? 120
                                      : tile) +
                       static_cast<int>(random() % 5);
      for (int k = 0; k < 3; ++k) panorama.rgb(r, c, k) = static_cast<uint8_t>(grey);
    }
  }
  const ImageU8 picture = Respond(panorama).family[kFrontalFamily];
  for (int c = 0; c < kColumns; c += 16) {
    int joint = 0;
    for (int r = kFirstRow + 8; r < kRows * 7 / 8; ++r) joint = std::max<int>(joint, picture(r, c));
    int wall = 0;
    for (int r = kFirstRow - 4; r < kFirstRow + 4; ++r) wall = std::max<int>(wall, picture(r, c));
    EXPECT_GT(wall, 1.5 * joint) << c;
  }
}

TEST(ComputeLineResponse, ColourEdgesOfEqualBrightnessCount) {
  BoxRoom room;
  LevelPanorama panorama = DrawPanorama(room, kCamera, kWidth);
  // Floor and the rest equally bright, one reddish, one bluish.
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kWidth; ++c) {
      const bool is_floor = panorama.rgb(r, c, 0) < 130;
      panorama.rgb(r, c, 0) = is_floor ? 160 : 120;
      panorama.rgb(r, c, 1) = is_floor ? 116 : 136;
      panorama.rgb(r, c, 2) = 120;
    }
  }
  const ColumnTruth truth = TruthOfColumns(room, kCamera.head<2>(), kColumns);
  EXPECT_GT(Measure(Respond(panorama), truth, -kCamera.z()).mean, 0.8);
}

TEST(ComputeLineResponse, ComputesTheFamiliesAskedForAlone) {
  const LevelPanorama panorama = DrawPanorama({}, kCamera, 128);
  const std::array families = {1, kFrontalFamily};
  const LineResponse response = ComputeLineResponse(panorama, 64, families, {});
  for (int f = 0; f < kNumFamilies; ++f) {
    const ImageU8& picture = response.family[static_cast<size_t>(f)];
    EXPECT_EQ(picture.empty(), f != 1 && f != kFrontalFamily);
    EXPECT_EQ(picture.cols(), f == 1 || f == kFrontalFamily ? 64 : 0);
  }
}

TEST(WallDirection, FamiliesAreEighthsOfATurnAndFrontalIsAcross) {
  EXPECT_DOUBLE_EQ(WallDirection(0, 0.3), 0);
  EXPECT_DOUBLE_EQ(WallDirection(1, 0.3), kPi / 2);
  EXPECT_DOUBLE_EQ(WallDirection(2, 0.3), kPi / 4);
  EXPECT_DOUBLE_EQ(WallDirection(3, 0.3), 3 * kPi / 4);
  EXPECT_DOUBLE_EQ(WallDirection(kFrontalFamily, 0.3), 0.3 + kPi / 2);
}

}  // namespace
}  // namespace enfilade
