// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace enfilade {
namespace {

constexpr size_t kMaxSingles = 12;

std::tuple<bool, int, int> Promise(const PairFact& pair) {
  return {!IsContradiction(pair), pair.num_inliers, pair.num_matches};
}

// For every component the refused pair that most likely ties it to another one; null where no pair
// has anything in common.
std::vector<const PairFact*> MostPromising(const ConnectionFacts& facts) {
  std::vector<const PairFact*> best(facts.components.size(), nullptr);
  for (const PairFact& pair : facts.pairs) {
    if (pair.is_within) continue;
    for (const int view : {pair.a, pair.b}) {
      const auto component = static_cast<size_t>(facts.views[static_cast<size_t>(view)].component);
      if (best[component] == nullptr || Promise(pair) > Promise(*best[component])) {
        best[component] = &pair;
      }
    }
  }
  return best;
}

std::string Advice(const ConnectionFacts& facts, size_t component_idx, const PairFact* best) {
  const ComponentFact& component = facts.components[component_idx];
  const auto picture = [&](int view) { return facts.views[static_cast<size_t>(view)].picture; };
  const bool is_single = component.views.size() == 1;
  const std::string subject = is_single ? picture(component.views.front())
                                        : fmt::format("Component {} ({})", component.idx,
                                                      Counted(component.views.size(), "picture"));
  if (best == nullptr) {
    return subject +
           " has nothing in common with the others. If it belongs to the same home, take more "
           "pictures on the way to it, one in every doorway.";
  }
  const bool is_a =
      facts.views[static_cast<size_t>(best->a)].component == static_cast<int>(component_idx);
  const int own = is_a ? best->a : best->b, other = is_a ? best->b : best->a;
  return fmt::format(
      "{} is not tied to the others. {} has most in common with {} ({}, {} of them agree): take "
      "one more picture between the two, best in the doorway.",
      subject, is_single ? "It" : "Its picture " + picture(own), picture(other),
      Counted(static_cast<size_t>(best->num_matches), "match", "matches"), best->num_inliers);
}

}  // namespace

std::string ReasonFor(const PairFact& pair) {
  switch (pair.verdict) {
    case PairVerdict::kAccepted:
      return "Both see the same things from different places.";
    case PairVerdict::kSamePlace:
      return "Taken from nearly one place: tells the turn, not the distance.";
    case PairVerdict::kFewMatches:
      return "Too little in common.";
    case PairVerdict::kChance:
      return "What agrees may agree by chance.";
    case PairVerdict::kAgainstTriplets:
      return "Its turn contradicts what other pairs agree on: most likely two places that look "
             "alike.";
    case PairVerdict::kAgainstPositions:
      return "Its direction contradicts where other pairs place the two: most likely two places "
             "that look alike.";
  }
  return {};
}

std::string CureFor(const PairFact& pair) {
  if (pair.is_within) return "Nothing to do: other pairs place both.";
  if (IsContradiction(pair)) {
    return "If both do see the same room: one more picture between them.";
  }
  return "If they are neighbours: one more picture in the doorway between them.";
}

std::vector<std::string> WhatToDo(const ConnectionFacts& facts) {
  std::vector<size_t> order(facts.components.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto size_of = [&](size_t i) { return facts.components[i].views.size(); };
  std::ranges::stable_sort(order, std::ranges::greater{}, size_of);
  const std::vector<const PairFact*> best = MostPromising(facts);
  std::vector<std::string> advice;
  size_t num_singles = 0;
  for (size_t k = 1; k < order.size(); ++k) {
    if (size_of(order[k]) == 1 && ++num_singles > kMaxSingles) continue;
    advice.push_back(Advice(facts, order[k], best[order[k]]));
  }
  if (num_singles > kMaxSingles) {
    advice.push_back(Counted(num_singles - kMaxSingles, "more picture") +
                     " tied to nothing: see the table of pictures.");
  }
  return advice;
}

}  // namespace enfilade
