// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// Walls that run along neither axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/boolean.h"
#include "src/floorplan/edge_cost.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

FloorplanReport Solve(const EvidenceGrids& grids, const FloorplanOptions& options = {}) {
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  RunContext context(2);
  FloorplanReport report = SolveFloorplan({}, structure, {grids}, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

/// Faces as sharp as positions of panoramas allow.
EvidenceGrids Draw(const MultiPolygon2& free) { return DrawEvidence(free, {.face_blur_m = 0.025}); }

MultiPolygon2 Region(const FloorplanReport& report) {
  MultiPolygon2 region;
  for (const Room& room : report.plan.storeys[0].rooms) region.push_back(room.polygon);
  return region;
}

double AngleToAxes(const Wall& wall) {
  return std::abs(WrapQuarter(std::atan2(wall.b.y() - wall.a.y(), wall.b.x() - wall.a.x())));
}

int NumOblique(const FloorplanReport& report) {
  const std::vector<Wall>& walls = report.plan.storeys[0].walls;
  return static_cast<int>(std::count_if(walls.begin(), walls.end(),
                                        [](const Wall& wall) { return AngleToAxes(wall) > 1e-6; }));
}

double WrongArea(const MultiPolygon2& region, const MultiPolygon2& truth) {
  return Area(Difference(region, truth)) + Area(Difference(truth, region));
}

double FarthestCorner(const Ring2& truth, const Ring2& found) {
  double farthest = 0;
  for (const Vector2d& corner : truth) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2d& p : found) nearest = std::min(nearest, (p - corner).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

/// Expects one room with these corners, each within the tolerance, and no others.
void ExpectCorners(const FloorplanReport& report, const Ring2& truth, double tolerance_m) {
  ASSERT_EQ(report.plan.storeys[0].rooms.size(), 1u);
  const Ring2& found = report.plan.storeys[0].rooms[0].polygon.outer;
  EXPECT_EQ(found.size(), truth.size()) << RingToText(found);
  EXPECT_LT(FarthestCorner(truth, found), tolerance_m) << RingToText(found);
}

Ring2 Turned(const Ring2& ring, double angle_deg) {
  const double c = std::cos(DegToRad(angle_deg)), s = std::sin(DegToRad(angle_deg));
  Ring2 turned;
  for (const Vector2d& p : ring) turned.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  return turned;
}

/// A room, 5 m × 4 m, whose north wall bends outwards: an arc of a circle, 2.8 m wide and `depth_m`
/// deep.
Ring2 RoomWithBow(double depth_m) {
  constexpr int kPieces = 40;
  const double radius_m = 0.5 * (1.4 * 1.4 / depth_m + depth_m),
               half_rad = std::asin(1.4 / radius_m);
  Ring2 ring = ParseRing("0,0 5,0 5,4");
  for (int i = 0; i <= kPieces; ++i) {
    const double turn = half_rad * (1 - 2.0 * i / kPieces);
    ring.emplace_back(2.5 + radius_m * std::sin(turn),
                      4 + depth_m - radius_m + radius_m * std::cos(turn));
  }
  ring.emplace_back(0, 4);
  return ring;
}

TEST(ObliqueWalls, ACornerCutOffAt45Degrees) {
  const Ring2 truth = ParseRing("0,0 5,0 5,3.2 4.2,4 0,4");
  ExpectCorners(Solve(Draw({{truth, {}}})), truth, 0.02);
}

TEST(ObliqueWalls, ABayOfThreeWalls) {
  const Ring2 truth = ParseRing("0,0 5,0 5,4 3.7,4 3.1,4.6 1.9,4.6 1.3,4 0,4");
  const FloorplanReport report = Solve(Draw({{truth, {}}}));
  ExpectCorners(report, truth, 0.02);
  for (const Wall& wall : report.plan.storeys[0].walls) {
    EXPECT_EQ(wall.seen, WallSeen::kSeen);
    // Two headings, to the bit as close as sines are: 0° and 45°.
    EXPECT_LT(std::min(AngleToAxes(wall), std::abs(AngleToAxes(wall) - kPi / 4)), 1e-9);
  }
}

TEST(ObliqueWalls, ABayWithSidesOf58Degrees) {
  const Ring2 truth = ParseRing("0,0 5,0 5,4 3.53,4 3.1,4.7 1.9,4.7 1.47,4 0,4");
  ExpectCorners(Solve(Draw({{truth, {}}})), truth, 0.05);
}

TEST(ObliqueWalls, AFreeWallOf20Degrees) {
  const Ring2 truth = ParseRing("0,0 5,0 5,3 0,4.82");
  ExpectCorners(Solve(Draw({{truth, {}}})), truth, 0.03);
}

TEST(ObliqueWalls, AFlatWallOf7Degrees) {
  const Ring2 truth = ParseRing("0,0 5,0 5,3 0,3.61");
  ExpectCorners(Solve(Draw({{truth, {}}})), truth, 0.05);
}

TEST(ObliqueWalls, NoiseAndBlurMoveThemByLittle) {
  const Ring2 truth = ParseRing("0.007,0 5.01,0 5.01,4 3.7,4 3.1,4.6 1.9,4.6 1.3,4 0.007,4");
  for (uint32_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    ExpectCorners(
        Solve(DrawEvidence({{truth, {}}}, {.face_blur_m = 0.04, .noise = 1, .seed = seed})), truth,
        0.04);
  }
}

TEST(ObliqueWalls, ARoundWallIsAPolyline) {
  for (const double depth_m : {0.5, 0.8}) {
    SCOPED_TRACE(depth_m);
    const Ring2 truth = RoomWithBow(depth_m);
    const FloorplanReport report = Solve(Draw({{truth, {}}}));
    EXPECT_GE(NumOblique(report), 2);
    EXPECT_LE(report.plan.storeys[0].walls.size(), 14u);
    EXPECT_LT(WrongArea(Region(report), {{truth, {}}}), 0.02 * Perimeter(truth));
    for (const Vector2d& p : report.plan.storeys[0].rooms[0].polygon.outer)
      EXPECT_LT(DistanceToRing(truth, p), 0.08) << p.transpose();
  }
}

TEST(ObliqueWalls, ARoomThatStandsAcrossTheAxes) {
  const Ring2 truth = Turned(ParseRing("0,0 4,0 4,3 0,3"), 30);
  ExpectCorners(Solve(Draw({{truth, {}}})), truth, 0.05);
}

TEST(ObliqueWalls, RoomsOnBothSidesOfAnObliqueWallStayApart) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,3 0,4.3"), {}},
                               {ParseRing("0,4.42 5,3.12 5,7 0,7"), {}}};
  const FloorplanReport report = Solve(Draw(truth));
  EXPECT_EQ(report.plan.storeys[0].walls.size(), 8u);
  EXPECT_LT(WrongArea(Region(report), truth), 0.3);
}

TEST(ObliqueWalls, AManhattanHomeStaysAsItIsToTheBit) {
  const MultiPolygon2 homes[] = {
      {{ParseRing("0,0 6,0 6,3 3.5,3 3.5,5 0,5"), {}}},
      {{ParseRing("0,0 4,0 4,0.15 5,0.15 5,4 3,4 3,6.5 0.5,6.5 0.5,4 0,4"), {}}},
      {{ParseRing("0,0 2.5,0 2.5,2 2.6,2 2.6,0 5,0 5,4 0,4"), {}}, Box(5.1, 0, 7, 4)}};
  for (const MultiPolygon2& home : homes) {
    for (uint32_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(seed);
      const EvidenceGrids grids = DrawEvidence(
          home, {.face_blur_m = 0.02 + 0.01 * seed, .noise = 0.5 * seed, .seed = seed});
      const MultiPolygon2 found = Region(Solve(grids));
      const MultiPolygon2 manhattan = Region(Solve(grids, {.min_oblique_m = 0}));
      ASSERT_EQ(found.size(), manhattan.size());
      for (size_t i = 0; i < found.size(); ++i) EXPECT_EQ(RingsOf(found[i]), RingsOf(manhattan[i]));
    }
  }
}

TEST(ObliqueWalls, CanBeLeftOut) {
  const EvidenceGrids grids = Draw({{ParseRing("0,0 5,0 5,3.2 4.2,4 0,4"), {}}});
  EXPECT_EQ(NumOblique(Solve(grids)), 1);
  EXPECT_EQ(NumOblique(Solve(grids, {.min_oblique_m = 0})), 0);
  EXPECT_EQ(NumOblique(Solve(grids, {.min_oblique_m = 2})), 0);
}

TEST(EdgeCost, IsThatOfTheLoopAlongTheAxes) {
  const FloorplanOptions options;
  const LoopField field = MakeLoopField(
      DrawEvidence({{ParseRing("0,0 3,0 3,1.2 1.2,2 0,2"), {}}}, {.face_blur_m = 0.05, .noise = 1}),
      options);
  GridLoopProblem layout;
  layout.rows = field.frame.rows;
  layout.cols = field.frame.cols;
  const auto corner = [&](int row, int col) -> Vector2d {
    return field.frame.origin + field.frame.cell_m * Vector2d(col, row);
  };
  const double tolerance = 1 / kCostPerMetre;  // costs of steps are rounded
  for (int row = 25; row < layout.rows - 25; row += 7) {
    for (int col = 25; col < layout.cols - 25; col += 7) {
      const auto step = [&](GridHeading heading) {
        return field.step_cost[layout.StepIndex(row, col, heading)] / kCostPerMetre;
      };
      const Vector2d p = corner(row, col);
      EXPECT_NEAR(EdgeCost(field, options, p, corner(row, col + 1)), step(GridHeading::kEast),
                  tolerance);
      EXPECT_NEAR(EdgeCost(field, options, p, corner(row + 1, col)), step(GridHeading::kNorth),
                  tolerance);
      EXPECT_NEAR(EdgeCost(field, options, p, corner(row, col - 1)), step(GridHeading::kWest),
                  tolerance);
      EXPECT_NEAR(EdgeCost(field, options, p, corner(row - 1, col)), step(GridHeading::kSouth),
                  tolerance);
    }
  }
}

}  // namespace
}  // namespace enfilade
