// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/pair_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "enfilade/base/errors.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

// Twelve rooms behind shut doors with four cameras each: nothing ties cameras of different rooms.
constexpr int kRooms = 12, kCamerasPerRoom = 4;

RegistrationScene MakeShutRooms() {
  MadeSceneOptions options;
  options.num_points_per_room = 120;
  options.lone_share = 1;
  return MakeRowOfRooms(options, kRooms, kCamerasPerRoom, false);
}

std::vector<ViewPair> Select(const RegistrationScene& scene, const PairSelectionOptions& options,
                             int num_threads = 1) {
  RunContext context(num_threads);
  return SelectPairs(scene.features, options, {}, context);
}

int NumWithinRooms(const std::vector<ViewPair>& pairs) {
  return static_cast<int>(std::ranges::count_if(pairs, [](const ViewPair& pair) {
    return pair.a_idx / kCamerasPerRoom == pair.b_idx / kCamerasPerRoom;
  }));
}

TEST(SelectPairs, TakesAllOfFew) {
  const RegistrationScene scene = MakeShutRooms();
  const std::vector<ViewPair> pairs = Select(scene, {.all_pairs_up_to = kRooms * kCamerasPerRoom});
  ASSERT_THAT(pairs, SizeIs(48 * 47 / 2));
  EXPECT_TRUE(std::ranges::is_sorted(pairs));
  EXPECT_EQ(pairs.front(), (ViewPair{0, 1}));
  EXPECT_EQ(pairs.back(), (ViewPair{46, 47}));
}

// Of many it takes those of one room, from few of the features.
TEST(SelectPairs, FindsWhoSharesARoom) {
  const RegistrationScene scene = MakeShutRooms();
  const PairSelectionOptions options{
      .all_pairs_up_to = 10, .num_partners = 3, .num_coarse_features = 60};
  const std::vector<ViewPair> pairs = Select(scene, options);
  EXPECT_EQ(NumWithinRooms(pairs), kRooms * kCamerasPerRoom * (kCamerasPerRoom - 1) / 2);
  EXPECT_TRUE(std::ranges::is_sorted(pairs));
  EXPECT_THAT(std::set<ViewPair>(pairs.begin(), pairs.end()), SizeIs(pairs.size()));
  for (const ViewPair& pair : pairs) EXPECT_LT(pair.a_idx, pair.b_idx);
}

TEST(SelectPairs, GrowsWithTheViewsAndNotWithTheirSquare) {
  const RegistrationScene scene = MakeShutRooms();
  for (const int num_partners : {1, 5, 47, 1000}) {
    const std::vector<ViewPair> pairs =
        Select(scene, {.all_pairs_up_to = 10, .num_partners = num_partners});
    EXPECT_LE(pairs.size(), static_cast<size_t>(48 * num_partners));
    EXPECT_GE(pairs.size(), static_cast<size_t>(std::min(48 * num_partners, 48 * 47) / 2));
  }
}

TEST(SelectPairs, AgreesWithCountsByBruteForce) {
  const RegistrationScene scene = MakeShutRooms();
  constexpr int kPartners = 4;
  const std::vector<ViewPair> pairs = Select(
      scene, {.all_pairs_up_to = 2, .num_partners = kPartners, .num_coarse_features = 100000});
  const int n = scene.num_views();
  const auto count = [&](int a, int b) {
    if (a == b) return 0;
    const auto& of_a = scene.features[static_cast<size_t>(std::min(a, b))].descriptors;
    const auto& of_b = scene.features[static_cast<size_t>(std::max(a, b))].descriptors;
    return static_cast<int>(MatchDescriptors(of_a, of_b, {.max_ratio = 0.7}).size());
  };
  std::vector<std::vector<int>> counts(static_cast<size_t>(n));
  std::vector<int> totals;
  for (int a = 0; a < n; ++a) {
    auto& row = counts[static_cast<size_t>(a)];
    for (int b = 0; b < n; ++b) row.push_back(count(a, b));
    totals.push_back(std::accumulate(row.begin(), row.end(), 0));
  }
  std::set<ViewPair> expected;
  for (int a = 0; a < n; ++a) {
    std::vector<std::pair<int, int>> others;  // least excess last, lowest index first
    for (int b = 0; b < n; ++b) {
      const int of_pair = counts[static_cast<size_t>(a)][static_cast<size_t>(b)];
      if (a != b) others.emplace_back(totals[static_cast<size_t>(b)] - (n - 1) * of_pair, b);
    }
    std::ranges::sort(others);
    for (int k = 0; k < kPartners; ++k) {
      const int b = others[static_cast<size_t>(k)].second;
      expected.insert({std::min(a, b), std::max(a, b)});
    }
  }
  EXPECT_EQ(std::set<ViewPair>(pairs.begin(), pairs.end()), expected);
}

TEST(SelectPairs, ViewsWithoutFeatures) {
  RegistrationScene scene = MakeShutRooms();
  scene.features[5] = {};
  const PairSelectionOptions options{.all_pairs_up_to = 2, .num_partners = 3};
  EXPECT_EQ(NumWithinRooms(Select(scene, options)), kRooms * 6);
  for (PanoFeatures& features : scene.features) features = {};
  EXPECT_THAT(Select(scene, options), SizeIs(testing::Le(48U * 3U)));
  scene.features.clear();
  EXPECT_THAT(Select(scene, options), IsEmpty());
}

TEST(SelectPairs, ThreadsChangeNothing) {
  const RegistrationScene scene = MakeShutRooms();
  const PairSelectionOptions options{.all_pairs_up_to = 2, .num_partners = 5};
  EXPECT_EQ(Select(scene, options, 1), Select(scene, options, 3));
}

TEST(SelectPairs, StopsOnRequest) {
  const RegistrationScene scene = MakeShutRooms();
  RunContext context(1);
  context.RequestStop();
  EXPECT_THROW((void)SelectPairs(scene.features, {.all_pairs_up_to = 2}, {}, context),
               StoppedError);
}

}  // namespace
}  // namespace enfilade
