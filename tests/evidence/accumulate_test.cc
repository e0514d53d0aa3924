// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/accumulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "enfilade/base/errors.h"
#include "tests/evidence/plan_samples.h"

namespace enfilade {
namespace {

// Two rooms, a 12 cm wall with a door of 0.9 m between them.
constexpr std::string_view kTwoRooms =
    "0,0 4,0 4,1.5 4.12,1.5 4.12,0 8,0 8,4 4.12,4 4.12,2.4 4,2.4 4,4 0,4";

EvidenceGrids Accumulate(const WallSampleSet& samples, const AccumulateOptions& options = {},
                         int num_threads = 2) {
  RunContext context(num_threads);
  return AccumulateEvidence(samples, {}, options, context).grids;
}

// The sign of `free` against the plan, leaving out `band_m` round the walls.
double ShareRight(const EvidenceGrids& grids, const Ring2& ring, double band_m) {
  int right = 0, total = 0;
  for (int r = 0; r < grids.frame.rows; ++r) {
    for (int c = 0; c < grids.frame.cols; ++c) {
      const Eigen::Vector2d p = grids.frame.Center(r, c);
      double to_wall = 1e9;
      for (size_t i = 0; i < ring.size(); ++i) {
        to_wall = std::min(to_wall, DistanceToSegment(p, ring[i], ring[(i + 1) % ring.size()]));
      }
      if (to_wall < band_m) continue;
      ++total;
      right += (grids.free(r, c) > 0.5) == Contains(ring, p);
    }
  }
  return static_cast<double>(right) / total;
}

TEST(AccumulateEvidence, FreeSpaceIsTheRooms) {
  const PlanToSample plan = PlanFromText(kTwoRooms, {{1.5, 2}, {6, 2.2}});
  const EvidenceGrids grids = Accumulate(SamplesOf(plan));
  EXPECT_GT(ShareRight(grids, plan.rings[0], 0.05), 0.995);
  EXPECT_GT(At(grids, grids.free, 4.06, 2), 2);          // in the door
  EXPECT_LT(At(grids, grids.free, 4.06, 0.7), -1);       // in the wall
  EXPECT_NEAR(At(grids, grids.free, -0.4, 2), 0, 0.01);  // far behind: unknown
  EXPECT_GT(At(grids, grids.wall, 0.0, 1.2), 2);
  EXPECT_LT(At(grids, grids.wall, 2.0, 2), -1);
}

TEST(AccumulateEvidence, WallRidgeLiesOnTheWall) {
  const PlanToSample plan = PlanFromText("0,0 5,0 5,4 0,4", {{1.5, 1.5}, {3.2, 2.6}});
  const EvidenceGrids grids = Accumulate(SamplesOf(plan));
  for (double y = 0.5; y < 3.5; y += 0.1) {
    const int row = grids.frame.Row(y);
    double weighted = 0, sum = 0;
    for (int c = grids.frame.Col(4.7); c <= grids.frame.Col(5.3); ++c) {
      const double w = std::max(0.0f, grids.wall(row, c));
      weighted += w * grids.frame.Center(row, c).x();
      sum += w;
    }
    EXPECT_NEAR(weighted / sum, 5, 0.03) << y;
  }
}

TEST(AccumulateEvidence, OneViewDoesNotOverrideTwo) {
  // View 0 sees through the wall x = 4 (a window); the others see the wall.
  PlanToSample plan = PlanFromText("0,0 4,0 4,4 0,4", {{2, 2}, {1, 1}, {1, 3}});
  const Ring2 garden = ParseRing("-1,-1 8,-1 8,5 -1,5");
  plan.distance = [&, rings = plan.rings](int v, const Eigen::Vector2d& d) {
    const double wall = RayDistance(rings[0], plan.cameras[v], d);
    const Eigen::Vector2d hit = plan.cameras[v] + wall * d;
    const bool through = v == 0 && hit.x() > 3.99 && std::abs(hit.y() - 2) < 0.5;
    return through ? RayDistance(garden, plan.cameras[v], d) : wall;
  };
  AccumulateOptions options;
  options.consistency_rounds = 0;
  const EvidenceGrids first = Accumulate(SamplesOf(plan), options);
  EXPECT_LT(At(first, first.free, 4.06, 2), 0);  // blocked, two against one
  EXPECT_GT(At(first, first.wall, 4.0, 2), 0);
  EXPECT_GT(At(first, first.free, 6, 2), 1);               // the garden: nobody else says anything,
  EXPECT_EQ(At(first, first.support, 6, 2), kSupportFar);  // but nobody else supports it
  const EvidenceGrids grids = Accumulate(SamplesOf(plan));
  EXPECT_LT(At(grids, grids.free, 4.06, 2), -0.3);  // the view lost its say behind the wall
  EXPECT_LT(At(grids, grids.free, 6, 2), 0.5 * At(first, first.free, 6, 2));
  EXPECT_NEAR(At(grids, grids.free, 3, 2), At(first, first.free, 3, 2), 0.05);
}

// What one room sees through a door that nobody contradicts stays.
TEST(AccumulateEvidence, FreeSpaceThroughAnOpenDoorIsKept) {
  const PlanToSample plan = PlanFromText(kTwoRooms, {{1.5, 2}, {2.5, 1.2}});
  AccumulateOptions options;
  options.consistency_rounds = 0;
  const EvidenceGrids before = Accumulate(SamplesOf(plan), options);
  const EvidenceGrids after = Accumulate(SamplesOf(plan));
  EXPECT_GT(At(before, before.free, 5, 1.97), 1);
  EXPECT_NEAR(At(after, after.free, 5, 1.97), At(before, before.free, 5, 1.97), 0.05);
}

// A door that was open while a panorama was taken in it and closed for the others.
TEST(AccumulateEvidence, ACameraInADoorwaySeesThroughTheClosedDoor) {
  PlanToSample plan = PlanFromText(kTwoRooms, {{4.06, 1.95}, {2, 2}, {3, 1}});
  const Ring2 closed = ParseRing("0,0 4,0 4,4 0,4");
  plan.distance = [&, rings = plan.rings](int v, const Eigen::Vector2d& d) {
    return RayDistance(v == 0 ? rings[0] : closed, plan.cameras[v], d);
  };
  const EvidenceGrids grids = Accumulate(SamplesOf(plan));
  EXPECT_GT(At(grids, grids.free, 5.5, 2), 1);
  EXPECT_TRUE(At(grids, grids.support, 5.5, 2) & kSupportNear);
}

TEST(AccumulateEvidence, NearViewsCountMore) {
  const PlanToSample near = PlanFromText("0,0 10,0 10,3 0,3", {{8.5, 1.5}});
  const PlanToSample far = PlanFromText("0,0 10,0 10,3 0,3", {{1.5, 1.5}});
  const EvidenceGrids a = Accumulate(SamplesOf(near)), b = Accumulate(SamplesOf(far));
  EXPECT_GT(At(a, a.free, 9, 1.5), 1.5 * At(b, b.free, 9, 1.5));
  EXPECT_GT(At(a, a.wall, 10, 1.5), 1.5 * At(b, b.wall, 10, 1.5));
}

TEST(AccumulateEvidence, BlockedWeighsAsMuchAsFree) {
  AccumulateOptions options;
  // A wall as sharp as it is one metre away.
  options.position_sigma_m = 0.01;
  options.angle_sigma_deg = 0.05;
  const EvidenceGrids grids =
      Accumulate(SamplesOf(PlanFromText("-2,-2 2,-2 2,2 -2,2", {{0, 0}})), options);
  EXPECT_NEAR(At(grids, grids.free, 1.85, 0.01), -At(grids, grids.free, 2.06, 0.01), 0.3);
}

TEST(AccumulateEvidence, ColumnsCountAsFarAsTheyAreBelieved) {
  WallSampleSet samples = SamplesOf(PlanFromText("-2,-2 2,-2 2,2 -2,2", {{0, 0}}));
  const auto at_confidence = [&](double confidence) {
    for (WallSample& sample : samples.samples) sample.confidence = confidence;
    return Accumulate(samples);
  };
  const EvidenceGrids full = at_confidence(1), half = at_confidence(0.5), none = at_confidence(0);
  for (const double x : {1.55, 2.0}) {
    EXPECT_EQ(At(none, none.free, x, 0.01), 0) << x;
    EXPECT_EQ(At(none, none.wall, x, 0.01), 0) << x;
  }
  EXPECT_EQ(At(none, none.support, 1.55, 0.01), 0);
  EXPECT_GT(At(half, half.free, 1.55, 0.01), 0.5);
  EXPECT_LT(At(half, half.free, 1.55, 0.01), 0.7 * At(full, full.free, 1.55, 0.01));
}

// Columns that tell nothing cut no wedge into the room where its camera stands.
TEST(AccumulateEvidence, RoundACameraIsRoom) {
  WallSampleSet samples = SamplesOf(PlanFromText("-2,-2 2,-2 2,2 -2,2", {{0, 0}}));
  for (WallSample& sample : samples.samples) sample.confidence = 0;
  const EvidenceGrids grids = Accumulate(samples);
  EXPECT_GT(At(grids, grids.free, 0.35, 0.01), 2);
  EXPECT_TRUE(At(grids, grids.support, 0.35, 0.01) & kSupportNear);
  float before = At(grids, grids.free, 0.35, 0.01);
  for (const double x : {0.6, 0.9, 1.2, 1.45}) {
    const float here = At(grids, grids.free, x, 0.01);
    EXPECT_LT(here, before) << x;
    EXPECT_GT(here, 0) << x;
    before = here;
  }
}

TEST(AccumulateEvidence, OneViewIsBounded) {
  AccumulateOptions options;
  options.max_view_log_odds = 1.5;
  const EvidenceGrids grids =
      Accumulate(SamplesOf(PlanFromText("-1,-1 1,-1 1,1 -1,1", {{0, 0}})), options);
  for (const ImageF* image : {&grids.free, &grids.wall}) {
    EXPECT_LE(*std::max_element(image->data().begin(), image->data().end()), 1.5);
    EXPECT_GE(*std::min_element(image->data().begin(), image->data().end()), -1.5);
  }
}

TEST(AccumulateEvidence, SupportTellsNearFarAndTwoDirections) {
  PlanToSample plan = PlanFromText("0,0 9,0 9,3 0,3", {{1, 1.5}});
  EvidenceGrids grids = Accumulate(SamplesOf(plan));
  EXPECT_EQ(At(grids, grids.support, 2, 1.5), kSupportNear);
  EXPECT_EQ(At(grids, grids.support, 6, 1.5), kSupportFar);
  plan.cameras.push_back({1.5, 1.5});  // looks at x = 6 from the same direction
  grids = Accumulate(SamplesOf(plan));
  EXPECT_EQ(At(grids, grids.support, 6, 1.5), kSupportFar);
  plan.cameras.push_back({8.8, 1.5});
  grids = Accumulate(SamplesOf(plan));
  EXPECT_EQ(At(grids, grids.support, 6, 1.5), kSupportTwoDirections | kSupportFar);
}

TEST(AccumulateEvidence, FloorBehindAnObstacleIsNotNear) {
  WallSampleSet samples = SamplesOf(PlanFromText("0,0 4,0 4,4 0,4", {{2, 2}}));
  for (WallSample& s : samples.samples) s.obstacle_m = std::min(s.obstacle_m, 1.0);
  const EvidenceGrids grids = Accumulate(samples);
  EXPECT_EQ(At(grids, grids.support, 2.9, 2), kSupportNear);
  EXPECT_EQ(At(grids, grids.support, 3.2, 2), 0);
  EXPECT_GT(At(grids, grids.free, 3.2, 2), 1);  // free up to the structural wall all the same
}

TEST(AccumulateEvidence, TranslationByWholeCellsMovesTheGrid) {
  const Eigen::Vector2d shift(12.5, -3.25);
  PlanToSample plan = PlanFromText(kTwoRooms, {{1.5, 2}, {6, 2.2}});
  const EvidenceGrids before = Accumulate(SamplesOf(plan));
  for (Ring2& ring : plan.rings) {
    for (Eigen::Vector2d& p : ring) p += shift;
  }
  for (Eigen::Vector2d& camera : plan.cameras) camera += shift;
  const EvidenceGrids after = Accumulate(SamplesOf(plan));
  ASSERT_EQ(after.frame.rows, before.frame.rows);
  ASSERT_EQ(after.frame.cols, before.frame.cols);
  EXPECT_LT((after.frame.origin - before.frame.origin - shift).norm(), 1e-9);
  // Within rounding: a cell that a door jamb's ray just grazes may go either way.
  int num_different = 0;
  for (size_t i = 0; i < before.free.data().size(); ++i) {
    num_different += std::abs(after.free.data()[i] - before.free.data()[i]) > 0.05;
    num_different += std::abs(after.wall.data()[i] - before.wall.data()[i]) > 0.05;
  }
  EXPECT_LT(num_different, 10);
}

TEST(AccumulateEvidence, OrderOfSamplesAndNamesOfViewsChangeNothing) {
  const PlanToSample plan =
      PlanFromText(kTwoRooms, {{1.5, 2}, {6, 2.2}, {3, 3.3}, {7, 0.6}, {1, 0.5}});
  const WallSampleSet samples = SamplesOf(plan);
  const EvidenceGrids expected = Accumulate(samples);
  WallSampleSet shuffled = samples;
  std::shuffle(shuffled.samples.begin(), shuffled.samples.end(), std::mt19937(5));
  const int new_name[] = {3, 0, 4, 1, 2};
  for (WallSample& s : shuffled.samples) s.view_idx = new_name[s.view_idx];
  const EvidenceGrids grids = Accumulate(shuffled);
  EXPECT_EQ(grids.free.data(), expected.free.data());
  EXPECT_EQ(grids.wall.data(), expected.wall.data());
  EXPECT_EQ(grids.support.data(), expected.support.data());
}

TEST(AccumulateEvidence, DuplicatesShareOneVote) {
  PlanToSample plan = PlanFromText(kTwoRooms, {{1.5, 2}, {6, 2.2}});
  const EvidenceGrids once = Accumulate(SamplesOf(plan));
  plan.cameras = {{1.5, 2}, {1.5, 2}, {1.5, 2}, {6, 2.2}};
  const EvidenceGrids thrice = Accumulate(SamplesOf(plan));
  for (size_t i = 0; i < once.free.data().size(); ++i) {
    ASSERT_NEAR(thrice.free.data()[i], once.free.data()[i], 0.01);
    ASSERT_NEAR(thrice.wall.data()[i], once.wall.data()[i], 0.01);
  }
}

TEST(AccumulateEvidence, SameBytesForAnyNumberOfThreads) {
  const WallSampleSet samples = SamplesOf(PlanFromText(kTwoRooms, {{1.5, 2}, {6, 2.2}, {3, 3}}));
  const EvidenceGrids one = Accumulate(samples, {}, 1), three = Accumulate(samples, {}, 3);
  EXPECT_EQ(one.free.data(), three.free.data());
  EXPECT_EQ(one.wall.data(), three.wall.data());
  EXPECT_EQ(one.support.data(), three.support.data());
}

TEST(AccumulateEvidence, CountsAreRaysAndPoints) {
  AccumulateOptions options;
  options.mode = EvidenceMode::kCounts;
  options.cell_m = 0.1;
  PlanToSample plan = PlanFromText("0,0 4,0 4,4 0,4", {{2.03, 2.04}});
  plan.num_columns = 200;  // less than a cell apart at the walls
  const EvidenceGrids grids = Accumulate(SamplesOf(plan), options);
  EXPECT_EQ(grids.mode, EvidenceMode::kCounts);
  EXPECT_EQ(At(grids, grids.free, 2.03, 2.04), 200);  // every ray starts here
  float points = 0, ring = 0;
  for (float w : grids.wall.data()) points += w;
  EXPECT_EQ(points, 200);
  // Rays cross a ring of cells round the camera at least once each.
  for (int k = -5; k <= 5; ++k) {
    ring +=
        At(grids, grids.free, 2.55, 2.05 + 0.1 * k) + At(grids, grids.free, 1.55, 2.05 + 0.1 * k);
    if (std::abs(k) < 5)
      ring +=
          At(grids, grids.free, 2.05 + 0.1 * k, 2.55) + At(grids, grids.free, 2.05 + 0.1 * k, 1.55);
  }
  EXPECT_GE(ring, 200);
  EXPECT_EQ(At(grids, grids.free, 4.25, 2), 0);
}

TEST(AccumulateEvidence, CountsLeaveNoGapsFarFromTheCamera) {
  AccumulateOptions options;
  options.mode = EvidenceMode::kCounts;
  PlanToSample plan = PlanFromText("0,0 10,0 10,4 0,4", {{1.01, 2.02}});
  plan.num_columns = 512;  // 11 cm apart at the far wall
  const EvidenceGrids grids = Accumulate(SamplesOf(plan), options);
  for (double y = 0.3; y < 3.7; y += options.cell_m) {
    EXPECT_GE(At(grids, grids.wall, 9.99, y) + At(grids, grids.wall, 10.01, y), 1) << y;
    EXPECT_GE(At(grids, grids.free, 9.8, y), 1) << y;
    EXPECT_EQ(At(grids, grids.free, 10.1, y), 0) << y;
  }
}

TEST(AccumulateEvidence, PointsAddTheirEvidence) {
  const WallSampleSet samples = SamplesOf(PlanFromText("0,0 4,0 4,4 0,4", {{2, 2}}));
  EvidencePoints points;
  points.camera_positions = {{2, 2, 1.4}};
  points.ceiling_z = 2.5;
  ScenePoint point;
  point.position = {3.5125, 2.0125, 1.2};
  point.normal = {-1, 0, 0};
  point.view_idx = {0};
  points.points.assign(5, point);
  RunContext context(1);
  const EvidenceReport with = AccumulateEvidence(samples, points, {}, context);
  const EvidenceReport without = AccumulateEvidence(samples, {}, {}, context);
  EXPECT_EQ(with.num_wall_points, 5);
  EXPECT_GT(At(with.grids, with.grids.wall, 3.5125, 2.0125),
            At(without.grids, without.grids.wall, 3.5125, 2.0125) + 1);
  EXPECT_GT(At(with.grids, with.grids.free, 3, 2.0125),
            At(without.grids, without.grids.free, 3, 2.0125));
}

TEST(AccumulateEvidence, NoSamplesIsAnAnswer) {
  RunContext context(1);
  const EvidenceReport report = AccumulateEvidence({}, {}, {}, context);
  EXPECT_EQ(report.outcome, EvidenceOutcome::kNoSamples);
  EXPECT_THAT(report.reason, testing::Not(testing::IsEmpty()));
}

TEST(AccumulateEvidence, RefusesAbsurdExtents) {
  PlanToSample plan = PlanFromText("0,0 4,0 4,4 0,4", {{2, 2}, {5000, 2}});
  const WallSampleSet samples = SamplesOf(plan);
  RunContext context(1);
  EXPECT_THROW((void)AccumulateEvidence(samples, {}, {}, context), InvalidInputError);
  RunContext small(1, 0, 1);
  EXPECT_THROW(
      (void)AccumulateEvidence(SamplesOf(PlanFromText("0,0 4,0 4,4 0,4", {{2, 2}})), {}, {}, small),
      InvalidInputError);
}

}  // namespace
}  // namespace enfilade
