// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/core.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "enfilade/evidence/accumulate.h"
#include "tests/evidence/plan_samples.h"

namespace enfilade {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Grids drawn as text, one character a 10 cm block: '#' is free and supported, 'f' free and seen
// from afar, 'W' carries wall evidence, digits are cameras on free cells; the first line is the
// highest y.
EvidenceGrids GridsFromText(const std::vector<std::string>& lines) {
  constexpr int kCellsPerBlock = 4;
  EvidenceGrids grids;
  grids.frame.rows = static_cast<int>(lines.size()) * kCellsPerBlock;
  grids.frame.cols = static_cast<int>(lines[0].size()) * kCellsPerBlock;
  grids.wall = ImageF(grids.frame.rows, grids.frame.cols, 1, -2);
  grids.free = ImageF(grids.frame.rows, grids.frame.cols);
  grids.support = ImageU8(grids.frame.rows, grids.frame.cols);
  for (int r = 0; r < grids.frame.rows; ++r) {
    for (int c = 0; c < grids.frame.cols; ++c) {
      const char block = lines[lines.size() - 1 - r / kCellsPerBlock][c / kCellsPerBlock];
      if (block == 'W') grids.wall(r, c) = 4;
      if (block == '.' || block == 'W') continue;
      grids.free(r, c) = 4;
      grids.support(r, c) = block == 'f' ? kSupportFar : kSupportNear;
      if (block != '#' && block != 'f' && r % kCellsPerBlock == 2 && c % kCellsPerBlock == 2) {
        grids.cameras.push_back({block - '0', grids.frame.Center(r, c)});
      }
    }
  }
  std::sort(
      grids.cameras.begin(), grids.cameras.end(),
      [](const EvidenceCamera& a, const EvidenceCamera& b) { return a.view_idx < b.view_idx; });
  return grids;
}

CoreReport Core(const EvidenceGrids& grids, const CoreOptions& options = {}) {
  RunContext context(1);
  return FindCore(grids, options, context);
}

// The core at the centre of a block: column and line of the drawing, line 0 on top.
int CoreAt(const EvidenceGrids& grids, const CoreReport& report, int block_col, int line) {
  return report.core(grids.frame.rows - 4 * line - 2, 4 * block_col + 2);
}

TEST(FindCore, ComponentsAreNumberedByTheirFirstCamera) {
  const EvidenceGrids grids = GridsFromText({"......................",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             ".###2####...####1###..",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             "......................"});
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 2);
  EXPECT_EQ(CoreAt(grids, report, 4, 4), 2);
  EXPECT_EQ(CoreAt(grids, report, 16, 4), 1);
  EXPECT_THAT(report.views_without_core, IsEmpty());
  EXPECT_EQ(report.num_necks_cut, 0);
}

TEST(FindCore, GardenBehindANarrowNeckIsCut) {
  const EvidenceGrids grids = GridsFromText({"......................",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             ".####################.",  //
                                             ".###1################.",  //
                                             ".####################.",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             "......................"});
  CoreReport report = Core(grids);  // the neck is 0.3 m wide
  EXPECT_EQ(report.num_cores, 1);
  EXPECT_EQ(CoreAt(grids, report, 4, 4), 1);
  EXPECT_EQ(CoreAt(grids, report, 16, 4), 0);
  EXPECT_EQ(report.num_necks_cut, 1);
  EXPECT_GT(report.dropped_m2, 0.5);
  CoreOptions options;
  options.min_neck_m = 0.2;
  EXPECT_EQ(CoreAt(grids, Core(grids, options), 16, 4), 1);
}

TEST(FindCore, ANeckWithCamerasOnBothSidesIsPassed) {
  const EvidenceGrids grids = GridsFromText({"......................",  //
                                             ".########...########..",  //
                                             ".#2######...########..",  //
                                             ".####################.",  //
                                             ".####################.",  //
                                             ".####################.",  //
                                             ".########...########..",  //
                                             ".########...#####5##..",  //
                                             "......................"});
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 1);
  EXPECT_EQ(CoreAt(grids, report, 16, 4), 1);
}

TEST(FindCore, ANeckWithACameraInItIsPassed) {
  const EvidenceGrids grids = GridsFromText({"......................",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             ".####################.",  //
                                             ".#########3##########.",  //
                                             ".####################.",  //
                                             ".########...########..",  //
                                             ".########...########..",  //
                                             "......................"});
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 1);
  EXPECT_EQ(CoreAt(grids, report, 4, 4), 1);
  EXPECT_EQ(CoreAt(grids, report, 16, 4), 1);
}

TEST(FindCore, ABodyThatTwoCamerasLookAcrossIsKept) {
  // Three rooms in a row with necks of 0.3 m; only the outer ones hold cameras, which see each
  // other.
  const std::vector<std::string> drawing = {
      "..............................",  //
      ".########...######...########.",  //
      ".########...######...########.",  //
      ".############################.",  //
      ".###1####################2###.",  //
      ".############################.",  //
      ".########...######...########.",  //
      ".########...######...########.",  //
      ".############################.", ".############################.",
      ".############################.", ".########...######...########.",
      ".########...######...########.", ".............................."};
  EvidenceGrids grids = GridsFromText(drawing);
  EXPECT_EQ(Core(grids).num_cores, 1);
  // Turned aside so that they no longer see each other: the middle belongs to nobody.
  grids.cameras[1].position.y() -= 0.8;
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 2);
  EXPECT_EQ(CoreAt(grids, report, 14, 4), 0);
}

TEST(FindCore, FurnitureIsFilledAndPillarsAreNot) {
  const EvidenceGrids grids = GridsFromText({"......................",  //
                                             ".####################.",  //
                                             ".####################.",  //
                                             ".####################.",  //
                                             ".####..########WW####.",  //
                                             ".####..########WW####.",  //
                                             ".####################.",  //
                                             ".##########1#########.",  //
                                             ".####################.",  //
                                             "......................"});
  const CoreReport report = Core(grids);
  EXPECT_EQ(CoreAt(grids, report, 5, 4), 1);
  EXPECT_EQ(CoreAt(grids, report, 15, 4), 0);
}

TEST(FindCore, LargeHolesStay) {
  const EvidenceGrids grids = GridsFromText({"......................",  //
                                             ".####################.",  //
                                             ".####################.",  //
                                             ".####################.",  //
                                             ".####........########.",  //
                                             ".####........########.",  //
                                             ".####........########.",  //
                                             ".####........########.",  //
                                             ".####........########.",  //
                                             ".####........########.",  //
                                             ".####........########.",  //
                                             ".####################.",  //
                                             ".##########1#########.",  //
                                             ".####################.",  //
                                             "......................"});
  EXPECT_EQ(CoreAt(grids, Core(grids), 9, 7), 0);
}

TEST(FindCore, CamerasOutsideAreReported) {
  EvidenceGrids grids = GridsFromText({".............",  //
                                       ".########....",  //
                                       ".########....",  //
                                       ".###0####....",  //
                                       ".########....",  //
                                       ".########....",  //
                                       "............."});
  grids.cameras.push_back({7, {1.2, 0.2}});
  EXPECT_THAT(Core(grids).views_without_core, ElementsAre(7));
}

TEST(FindCore, EmptyGridsHaveNoCore) {
  EvidenceGrids grids = GridsFromText({"....", "....", "...."});
  grids.cameras.push_back({0, {0.2, 0.2}});
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 0);
  EXPECT_THAT(report.views_without_core, ElementsAre(0));
}

TEST(FindCore, UnsupportedSpaceIsNotCore) {
  EvidenceGrids grids = GridsFromText({"......................",  //
                                       ".####################.",  //
                                       ".####################.",  //
                                       ".####################.",  //
                                       ".###1################.",  //
                                       ".####################.",  //
                                       ".####################.",  //
                                       "......................"});
  for (int r = 0; r < grids.frame.rows; ++r) {
    for (int c = 40; c < grids.frame.cols; ++c) grids.support(r, c) = 0;
  }
  const CoreReport report = Core(grids);
  EXPECT_EQ(CoreAt(grids, report, 8, 4), 1);
  EXPECT_EQ(CoreAt(grids, report, 12, 4), 0);
}

// A room whose far end one panorama alone sees.
const std::vector<std::string> kFarEnd = {"WWWWWWWWWWWWWWWWWWWWWWWW",  //
                                          "W##########ffffffffffffW",  //
                                          "W##########ffffffffffffW",  //
                                          "W##########ffffffffffffW",  //
                                          "W###1######ffffffffffffW",  //
                                          "W##########ffffffffffffW",  //
                                          "W##########ffffffffffffW",  //
                                          "W##########ffffffffffffW",  //
                                          "WWWWWWWWWWWWWWWWWWWWWWWW"};

TEST(FindCore, AFarPartWithinWallsIsTakenIn) {
  const EvidenceGrids grids = GridsFromText(kFarEnd);
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 1);
  EXPECT_EQ(CoreAt(grids, report, 4, 4), 1);
  EXPECT_EQ(CoreAt(grids, report, 20, 4), 1);
  EXPECT_NEAR(report.far_m2, 1.2 * 0.7, 0.02);
}

TEST(FindCore, AFarPartWithoutWallsIsNot) {
  std::vector<std::string> drawing = kFarEnd;
  for (std::string& line : drawing) {
    for (size_t i = 12; i < line.size(); ++i) {
      if (line[i] == 'W') line[i] = '.';
    }
  }
  CoreReport report = Core(GridsFromText(drawing));
  EXPECT_EQ(CoreAt(GridsFromText(drawing), report, 20, 4), 0);
  EXPECT_EQ(report.far_m2, 0);
  // However short it is: its border is never shorter than its mouth.
  for (std::string& line : drawing) std::fill(line.begin() + 14, line.end(), '.');
  EXPECT_EQ(Core(GridsFromText(drawing)).far_m2, 0);
  // A wall at its end and one along it outweigh one open side.
  drawing = kFarEnd;
  std::fill(drawing.back().begin() + 12, drawing.back().end(), '.');
  EXPECT_GT(Core(GridsFromText(drawing)).far_m2, 0.8);
}

TEST(FindCore, AFarPartBehindANarrowMouthIsNot) {
  std::vector<std::string> drawing = kFarEnd;
  for (size_t i = 1; i < drawing.size() - 1; ++i) {
    if (i < 3 || i > 5) drawing[i][11] = 'W';  // leaves 0.3 m
  }
  EXPECT_EQ(Core(GridsFromText(drawing)).far_m2, 0);
  CoreOptions options;
  options.min_neck_m = 0.2;
  EXPECT_GT(Core(GridsFromText(drawing), options).far_m2, 0.7);
}

TEST(FindCore, AFarPartJoinsNoTwoCores) {
  const EvidenceGrids grids = GridsFromText({"WWWWWWWWWWWWWWWWWWWWWWWWW",  //
                                             "W##########fffff########W",  //
                                             "W##########fffff########W",  //
                                             "W##########fffff########W",  //
                                             "W###1######fffff####0###W",  //
                                             "W##########fffff########W",  //
                                             "W##########fffffWWWWWWWWW",  //
                                             "W##########fffffW........",  //
                                             "WWWWWWWWWWWWWWWWW........"});
  const CoreReport report = Core(grids);
  EXPECT_EQ(report.num_cores, 2);
  EXPECT_EQ(CoreAt(grids, report, 4, 4), 2);
  EXPECT_EQ(CoreAt(grids, report, 13, 4), 2);  // that to which it opens more widely
  EXPECT_EQ(CoreAt(grids, report, 20, 4), 1);
}

TEST(FindCore, RawCountsTakeInNoFarPart) {
  EvidenceGrids grids = GridsFromText(kFarEnd);
  grids.mode = EvidenceMode::kCounts;
  const CoreReport report = Core(grids);
  EXPECT_EQ(CoreAt(grids, report, 4, 4), 1);
  EXPECT_EQ(CoreAt(grids, report, 20, 4), 0);
}

// The whole way from samples.
TEST(FindCore, TheFarLegOfARoomWithOnePanoramaIsCore) {
  const PlanToSample plan = PlanFromText("0,0 3,0 3,5.5 1,5.5 1,3 0,3", {{2, 1.5}});
  RunContext context(2);
  const EvidenceGrids grids = AccumulateEvidence(SamplesOf(plan), {}, {}, context).grids;
  EXPECT_EQ(At(grids, FindCore(grids, {}, context).core, 2, 5.2), 1);
}

TEST(FindCore, WhatOnePanoramaSeesOutOfAWindowIsNot) {
  PlanToSample plan = PlanFromText("0,0 4,0 4,4 0,4", {{2, 2}});
  const Ring2 garden = ParseRing("-1,-1 6.5,-1 6.5,5 -1,5");
  plan.distance = [&, rings = plan.rings](int, const Eigen::Vector2d& d) {
    const double wall = RayDistance(rings[0], {2, 2}, d);
    const Eigen::Vector2d hit = Eigen::Vector2d(2, 2) + wall * d;
    const bool through = hit.x() > 3.99 && std::abs(hit.y() - 2) < 0.6;
    return through ? RayDistance(garden, {2, 2}, d) : wall;
  };
  RunContext context(2);
  const EvidenceGrids grids = AccumulateEvidence(SamplesOf(plan), {}, {}, context).grids;
  EXPECT_GT(At(grids, grids.free, 5.5, 2), 1);
  EXPECT_EQ(At(grids, grids.support, 5.5, 2), kSupportFar);
  const CoreReport report = FindCore(grids, {}, context);
  EXPECT_EQ(At(grids, report.core, 2, 2), 1);
  EXPECT_EQ(At(grids, report.core, 5.5, 2), 0);
}

// The whole way from samples: one of three panoramas sees the garden through a low window.
TEST(FindCore, LeakThroughAWindowStaysOutside) {
  PlanToSample plan = PlanFromText("0,0 5,0 5,4 0,4", {{3.6, 2}, {1, 1}, {1.2, 3}});
  const Ring2 garden = ParseRing("-1,-1 10,-1 10,5 -1,5");
  plan.distance = [&, rings = plan.rings](int v, const Eigen::Vector2d& d) {
    const double wall = RayDistance(rings[0], plan.cameras[v], d);
    const Eigen::Vector2d hit = plan.cameras[v] + wall * d;
    const bool through = v == 0 && hit.x() > 4.99 && std::abs(hit.y() - 2) < 0.6;
    return through ? RayDistance(garden, plan.cameras[v], d) : wall;
  };
  RunContext context(2);
  EvidenceGrids grids = AccumulateEvidence(SamplesOf(plan), {}, {}, context).grids;
  const CoreReport report = FindCore(grids, {}, context);
  EXPECT_EQ(report.num_cores, 1);
  EXPECT_THAT(report.views_without_core, IsEmpty());
  for (int r = 0; r < grids.frame.rows; ++r) {
    for (int c = 0; c < grids.frame.cols; ++c) {
      const Eigen::Vector2d p = grids.frame.Center(r, c);
      EXPECT_TRUE(report.core(r, c) == 0 || Contains(plan.rings[0], p)) << p.transpose();
    }
  }
  EXPECT_EQ(At(grids, report.core, 2, 2), 1);
}

TEST(FindCore, RoomsBehindOpenDoorsAreOneCore) {
  PlanToSample plan = PlanFromText(
      "0,0 4,0 4,1.5 4.12,1.5 4.12,0 8,0 8,4 4.12,4 4.12,2.4 4,2.4 4,4 0,4", {{1.5, 2}, {6, 2.2}});
  plan.num_columns = 2048;  // raw counts thin out with the distance
  for (EvidenceMode mode : {EvidenceMode::kLogOdds, EvidenceMode::kCounts}) {
    AccumulateOptions options;
    options.mode = mode;
    RunContext context(2);
    EvidenceGrids grids = AccumulateEvidence(SamplesOf(plan), {}, options, context).grids;
    const CoreReport report = FindCore(grids, {}, context);
    EXPECT_EQ(report.num_cores, 1);
    EXPECT_EQ(At(grids, report.core, 4.06, 1.95), 1);
    EXPECT_EQ(At(grids, report.core, 4.06, 0.7), 0);
  }
}

}  // namespace
}  // namespace enfilade
