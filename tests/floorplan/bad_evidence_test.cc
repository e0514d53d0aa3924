// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// Whatever the evidence is, SolveFloorplan ends with a valid plan or says why there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

// More cases than a test run has time for: ENFILADE_FUZZ_CASES, from ENFILADE_FUZZ_SEED on.
unsigned EnvironmentOr(const char* name, unsigned fallback) {
  const char* text = std::getenv(name);
  return text == nullptr ? fallback : static_cast<unsigned>(std::stoul(text));
}

Structure OneStorey() {
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  return structure;
}

// A plan with σ, checked.
FloorplanReport Solve(const EvidenceGrids& grids, const FloorplanOptions& options,
                      int num_threads = 1) {
  RunContext context(num_threads);
  FloorplanReport report = SolveFloorplan({}, OneStorey(), {grids}, options, context);
  AssignSigmas({}, OneStorey(), {grids}, options, report.plan);
  ExpectValidFloorplan(report.plan);
  EXPECT_EQ(report.outcome == FloorplanOutcome::kFound, report.num_loops > 0);
  if (report.outcome != FloorplanOutcome::kFound) {
    EXPECT_FALSE(report.reason.empty());
  }
  EXPECT_EQ(report.outcome == FloorplanOutcome::kNoCore, report.num_cores == 0);
  return report;
}

// Draws evidence that nothing real would leave.
class EvidenceDrawer {
 public:
  explicit EvidenceDrawer(unsigned seed) : random_(seed) {}

  EvidenceGrids Draw() {
    MakeGrid();
    switch (Below(7)) {
      case 0:
        DrawNoise();
        break;
      case 1:
        DrawBlocks();
        break;
      case 2:
        DrawMaze();
        break;
      case 3:
        DrawContradictions();
        break;
      case 4:
        DrawBlocks();
        std::fill(grids_.wall.data().begin(), grids_.wall.data().end(), 0.0F);
        std::fill(grids_.free.data().begin(), grids_.free.data().end(), 0.0F);
        break;
      default:
        DrawRooms();
        break;
    }
    if (Below(3) == 0) SpoilCells();
    if (Below(4) == 0) DrawCores(1 + Below(4));
    return grids_;
  }

  FloorplanOptions DrawOptions() {
    FloorplanOptions options;
    if (Below(3) > 0) return options;
    options.turn_cost_m = Between(0.001, 1);
    options.margin_m = Between(0.05, 4);
    options.outside_weight = Between(0, 20);
    options.inside_weight = Between(0, 20);
    options.solid_log_odds = Between(0, 2);
    options.min_solid_area_m2 = Between(0, 0.1);
    options.min_solid_length_m = Between(0, 0.5);
    options.max_bridge_m = Between(0, 1);
    options.max_island_cost = Between(0, 20);
    options.min_oblique_m = Between(0, 1);
    options.heading_cost_m = Between(0, 1);
    options.slide_m = Between(0, 1);
    options.min_jog_m = Between(0, 0.5);
    options.min_room_m2 = Between(0, 0.5);
    options.wall_thickness_m = Between(0.01, 0.5);
    options.unseen_gap_m = Between(0, 5);
    options.unseen_hole_m2 = Between(0, 20);
    return options;
  }

 private:
  int Below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  struct Block {
    int row, col, end_row, end_col;
  };
  Block DrawBlock() {
    const int row = Below(grids_.frame.rows), col = Below(grids_.frame.cols);
    return {row, col, std::min(grids_.frame.rows, row + 1 + Below(grids_.frame.rows)),
            std::min(grids_.frame.cols, col + 1 + Below(grids_.frame.cols))};
  }
  template <typename T>
  static void Fill(const Block& block, T value, Image<T>& image) {
    for (int row = block.row; row < block.end_row; ++row) {
      for (int col = block.col; col < block.end_col; ++col) image(row, col) = value;
    }
  }

  void MakeGrid() {
    grids_.frame.rows = 1 + Below(70);
    grids_.frame.cols = 1 + Below(70);
    grids_.frame.cell_m = std::array{0.025, 0.05, 0.1, 0.3}[static_cast<size_t>(Below(4))];
    grids_.frame.origin = {Between(-100, 100), Between(-100, 100)};
    grids_.wall = ImageF(grids_.frame.rows, grids_.frame.cols);
    grids_.free = ImageF(grids_.frame.rows, grids_.frame.cols);
    grids_.core = CoreImage(grids_.frame.rows, grids_.frame.cols);
  }

  // Anywhere: at the border, over walls, in pieces, touching each other, numbered with gaps.
  void DrawCores(int count) {
    grids_.num_cores = count + Below(2);
    for (int k = 0; k < count; ++k)
      Fill(DrawBlock(), static_cast<uint16_t>(1 + Below(count + 1)), grids_.core);
  }

  void DrawNoise() {
    const double amplitude = std::pow(10.0, Between(-1, 2));
    for (ImageF* image : {&grids_.wall, &grids_.free}) {
      for (float& value : image->data()) value = static_cast<float>(Between(-amplitude, amplitude));
    }
    DrawCores(1 + Below(5));
  }

  void DrawBlocks() {
    const int count = 1 + Below(20);
    for (int i = 0; i < count; ++i)
      Fill(DrawBlock(), static_cast<float>(Between(-5, 5)),
           Below(2) == 0 ? grids_.wall : grids_.free);
    DrawCores(1 + Below(5));
  }

  // Corridors one cell wide, all core, between walls one cell thick.
  void DrawMaze() {
    for (float& value : grids_.free.data()) value = -3;
    int row = Below(grids_.frame.rows), col = Below(grids_.frame.cols);
    const int num_steps = 20 + Below(400);
    for (int i = 0; i < num_steps; ++i) {
      const int heading = Below(4), length = 1 + Below(6);
      for (int k = 0; k < length; ++k) {
        grids_.core(row, col) = 1;
        grids_.free(row, col) = 3;
        row = std::clamp(row + (heading == 0) - (heading == 1), 0, grids_.frame.rows - 1);
        col = std::clamp(col + (heading == 2) - (heading == 3), 0, grids_.frame.cols - 1);
      }
    }
    for (int r = 0; r < grids_.frame.rows; ++r) {
      for (int c = 0; c < grids_.frame.cols; ++c) grids_.wall(r, c) = -grids_.free(r, c);
    }
    grids_.num_cores = 1;
  }

  void DrawContradictions() {
    const auto sure = static_cast<float>(std::pow(10.0, Between(0, 30)));
    for (float& value : grids_.wall.data()) value = sure;
    for (float& value : grids_.free.data()) value = Below(2) == 0 ? sure : -sure;
    DrawCores(1 + Below(3));
  }

  // Rooms that may overlap, with what was seen of them forgotten here and there.
  void DrawRooms() {
    MultiPolygon2 rooms;
    const int count = 1 + Below(5);
    for (int i = 0; i < count; ++i) {
      const double x = Between(0, 4), y = Between(0, 4);
      rooms.push_back(Box(x, y, x + Between(0.4, 3), y + Between(0.4, 3)));
      if (Below(4) == 0) {
        const Eigen::Vector2d corner = rooms.back().outer[2];
        rooms.back().outer[2] = corner - Eigen::Vector2d(0.2, 0.15);
        rooms.back().outer.insert(rooms.back().outer.begin() + 2, corner - Eigen::Vector2d(0, 0.3));
      }
    }
    grids_ = DrawEvidence(rooms, {.cell_m = Below(2) == 0 ? 0.05 : 0.08,
                                  .margin_m = Below(2) == 0 ? 0.5 : 0,
                                  .face_blur_m = Between(0, 0.06),
                                  .noise = Between(0, 3),
                                  .core_distance_m = Between(0, 0.3),
                                  .seed = static_cast<uint32_t>(random_())});
    const int num_spots = Below(6);
    for (int i = 0; i < num_spots; ++i) {
      const Block block = DrawBlock();
      if (Below(2) == 0) Fill(block, static_cast<float>(Between(-8, 8)), grids_.wall);
      if (Below(2) == 0) Fill(block, static_cast<float>(Between(-8, 8)), grids_.free);
      if (Below(3) == 0) Fill(block, uint16_t{0}, grids_.core);
    }
  }

  void SpoilCells() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::array<float, 4> values = {std::numeric_limits<float>::quiet_NaN(), kInfinity,
                                         -kInfinity, 3e38F};
    const double share = std::pow(Between(0, 1), 3);
    for (ImageF* image : {&grids_.wall, &grids_.free}) {
      for (float& value : image->data()) {
        if (Between(0, 1) < share) value = values[static_cast<size_t>(Below(4))];
      }
    }
  }

  std::mt19937 random_;
  EvidenceGrids grids_;
};

TEST(BadEvidence, EndsWithAValidPlanOrAReason) {
  const unsigned first = EnvironmentOr("ENFILADE_FUZZ_SEED", 1);
  const unsigned count = EnvironmentOr("ENFILADE_FUZZ_CASES", 300);
  for (unsigned seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    EvidenceDrawer drawer(seed);
    const EvidenceGrids grids = drawer.Draw();
    const FloorplanOptions options = drawer.DrawOptions();
    const FloorplanReport report = Solve(grids, options);
    if (seed % 8 != 0) continue;
    const FloorplanReport other = Solve(grids, options, 3);
    ASSERT_EQ(other.plan.storeys[0].walls.size(), report.plan.storeys[0].walls.size());
    for (size_t i = 0; i < report.plan.storeys[0].walls.size(); ++i)
      EXPECT_EQ(other.plan.storeys[0].walls[i].a, report.plan.storeys[0].walls[i].a);
  }
}

TEST(BadEvidence, AnEmptyGridHasNoCore) {
  EXPECT_EQ(Solve({}, {}).outcome, FloorplanOutcome::kNoCore);
}

// 45 × 45 rooms of 2 × 1.6 m, cells of 8 cm.
TEST(BadEvidence, TwoThousandRoomsAreFound) {
  constexpr int kSide = 45;
  EvidenceGrids grids;
  grids.frame = {{0, 0}, 0.08, kSide * 22 + 42, kSide * 27 + 42};
  grids.wall = ImageF(grids.frame.rows, grids.frame.cols);
  grids.free = ImageF(grids.frame.rows, grids.frame.cols);
  grids.core = CoreImage(grids.frame.rows, grids.frame.cols);
  grids.num_cores = kSide * kSide;
  for (int row = 20; row < grids.frame.rows - 20; ++row) {
    for (int col = 20; col < grids.frame.cols - 20; ++col) {
      const int r = (row - 20) % 22, c = (col - 20) % 27;
      const bool is_solid = r < 2 || c < 2;
      grids.free(row, col) = is_solid ? -3 : 3;
      grids.wall(row, col) = r < 3 || r == 21 || c < 3 || c == 26 ? 3 : -1;  // beside faces
      if (r > 4 && c > 4 && r < 19 && c < 24) {
        grids.core(row, col) = static_cast<uint16_t>(1 + (row - 20) / 22 * kSide + (col - 20) / 27);
      }
    }
  }
  const FloorplanReport report = Solve(grids, {}, 2);
  EXPECT_EQ(report.num_loops, kSide * kSide);
  ASSERT_EQ(report.plan.storeys[0].rooms.size(), static_cast<size_t>(kSide * kSide));
  for (const Room& room : report.plan.storeys[0].rooms)
    EXPECT_NEAR(Area(room.polygon), 1.6 * 2, 0.1) << "room " << room.id;
}

}  // namespace
}  // namespace enfilade
