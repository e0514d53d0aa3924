// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/optim/loop_search.h"

#include <algorithm>
#include <cstdlib>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

// Sums stay far from the end of uint32_t: a move adds less than 2^26.
constexpr uint32_t kMaxDistance = uint32_t{1} << 31;
constexpr int kMaxTurnCost = 1 << 25;

}  // namespace

LoopSearch::LoopSearch(const GridLoopProblem& problem)
    : box_(problem), num_vertices_(box_.num_vertices()) {
  ENFILADE_CHECK(problem.turn_cost >= 1 && problem.turn_cost <= kMaxTurnCost);
  turn_cost_ = static_cast<uint32_t>(problem.turn_cost);
  max_move_cost_ = box_.max_step() + turn_cost_;
}

LoopSearch::Parts LoopSearch::Split(State state) const {
  int vertex = static_cast<int>(state >> 2), level = 0;
  for (; vertex >= num_vertices_; vertex -= num_vertices_) ++level;
  return {level, vertex, static_cast<int>(state & 3)};
}

int LoopSearch::SeamOf(State state, int level) const {
  const State first = MakeState(level, box_.seam_top(), kNorth);
  const bool is_seam = state >= first && state - first < 4 * static_cast<State>(box_.num_seams()) &&
                       (state & 3) == static_cast<State>(kNorth);
  return is_seam ? static_cast<int>((state - first) / 4) : -1;
}

std::optional<int64_t> LoopSearch::Prepare(int max_level) {
  max_level_ = max_level;
  upper_bound_ = kMaxDistance;
  const size_t num_states =
      static_cast<size_t>(std::max(max_level, 1) + 1) * static_cast<size_t>(num_vertices_) * 4;
  ENFILADE_CHECK(num_states < kUnreached);
  to_end_.assign(num_states, kUnreached);
  from_start_.assign(num_states, kUnreached);
  buckets_.assign(max_move_cost_ + 1, {});

  for (int seam = 0; seam < box_.num_seams(); ++seam) {
    to_end_[EndOf(seam)] = 0;
    buckets_[0].push_back(EndOf(seam));
  }
  // Dial's algorithm: bucket d mod n holds states whose distance was d when they were put there.
  std::optional<int64_t> least;
  size_t num_idle = 0;
  for (uint32_t distance = 0; distance <= upper_bound_ && num_idle < buckets_.size(); ++distance) {
    std::vector<State>& bucket = buckets_[distance % buckets_.size()];
    num_idle = bucket.empty() ? num_idle + 1 : 0;
    for (size_t i = 0; i < bucket.size(); ++i) {  // grows while steps cost nothing
      const State state = bucket[i];
      if (to_end_[state] != distance) continue;
      ++num_settled_;
      if (const int seam = SeamOf(state, 0); seam >= 0) {
        if (!least) least = distance;
        BoundByClosing(seam, distance);
      }
      RelaxBackward(state, distance);
    }
    bucket.clear();
  }
  return least;
}

void LoopSearch::RelaxBackward(State state, uint32_t distance) {
  const auto [level, vertex, heading] = Split(state);
  const int from = vertex - box_.offset(heading);
  const uint16_t step = box_.Step(from, heading);
  if (step == kBlockedStep) return;
  const int from_level = level - box_.LevelChange(from, heading);
  if (from_level < 0 || from_level > max_level_) return;
  const uint32_t straight = distance + step;
  if (straight + turn_cost_ >= kMaxDistance) return;
  const auto relax = [&](int from_heading, uint32_t cost) {
    const State previous = MakeState(from_level, from, from_heading);
    if (cost >= to_end_[previous]) return;
    to_end_[previous] = cost;
    buckets_[cost % buckets_.size()].push_back(previous);
  };
  relax(heading, straight);
  relax(LeftOf(heading), straight + turn_cost_);
  relax(RightOf(heading), straight + turn_cost_);
}

// Closes the walk that leaves `start_seam` by going along the row north of the ray: an upper bound
// of the optimum. Two turns suffice, at the end seam and where the walk starts again.
void LoopSearch::BoundByClosing(int start_seam, uint32_t distance) {
  if (distance >= upper_bound_) return;
  const int end_seam = EndSeamFrom(start_seam);
  const int64_t row_cost = RowCost(box_.seam_top() + end_seam, start_seam - end_seam);
  const int64_t turns = start_seam == end_seam ? 0 : 2 * int64_t{turn_cost_};
  upper_bound_ = std::min(upper_bound_, int64_t{distance} + row_cost + turns);
}

int LoopSearch::EndSeamFrom(int start_seam) const {
  State state = StartOf(start_seam);
  while (SeamOf(state, 1) < 0) {
    const auto [level, vertex, heading] = Split(state);
    State next = state;
    for (const int turn : {heading, LeftOf(heading), RightOf(heading)}) {
      const uint16_t step = box_.Step(vertex, turn);
      const int next_level = level + box_.LevelChange(vertex, turn);
      if (step == kBlockedStep || next_level < 0 || next_level > std::max(max_level_, 1)) continue;
      const State candidate = MakeState(next_level, vertex + box_.offset(turn), turn);
      const uint32_t cost = step + (turn == heading ? 0 : turn_cost_);
      if (to_end_[candidate] != kUnreached && to_end_[candidate] + cost == to_end_[state]) {
        next = candidate;
        break;
      }
    }
    ENFILADE_CHECK(next != state);
    state = next;
  }
  return SeamOf(state, 1);
}

// Cost of |num_steps| steps from `vertex` along its row, east when positive.
int64_t LoopSearch::RowCost(int vertex, int num_steps) const {
  int64_t cost = 0;
  const int heading = num_steps > 0 ? 0 : 2;
  for (int i = 0; i < std::abs(num_steps); ++i) {
    const uint16_t step = box_.Step(vertex + i * box_.offset(heading), heading);
    if (step == kBlockedStep) return kMaxDistance;
    cost += step;
  }
  return cost;
}

std::optional<SeamPath> LoopSearch::Find(SeamInterval interval, int64_t max_cost) {
  ResetForward();
  for (int seam = interval.first; seam <= interval.last; ++seam) {
    PushForward(StartOf(seam), 0, max_cost);
  }
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const State state = queued_[~static_cast<uint32_t>(heap_.back())];
    const uint32_t bound = static_cast<uint32_t>(heap_.back() >> 32);
    heap_.pop_back();
    if (from_start_[state] + to_end_[state] != bound) continue;  // reached more cheaply since
    ++num_settled_;
    const int seam = SeamOf(state, 1);
    if (seam >= interval.first && seam <= interval.last) return TraceBack(seam);
    RelaxForward(state, max_cost);
  }
  return std::nullopt;
}

void LoopSearch::RelaxForward(State state, int64_t max_cost) {
  const auto [level, vertex, heading] = Split(state);
  if (level > max_level_) return;
  const uint32_t so_far = from_start_[state];
  for (const int turn : {heading, LeftOf(heading), RightOf(heading)}) {
    const uint16_t step = box_.Step(vertex, turn);
    if (step == kBlockedStep) continue;
    const int next_level = level + box_.LevelChange(vertex, turn);
    if (next_level < 0 || next_level > std::max(max_level_, 1)) continue;
    PushForward(MakeState(next_level, vertex + box_.offset(turn), turn),
                so_far + step + (turn == heading ? 0 : turn_cost_), max_cost);
  }
}

void LoopSearch::PushForward(State state, uint32_t cost, int64_t max_cost) {
  const uint32_t rest = to_end_[state];
  if (rest == kUnreached || cost >= from_start_[state] || int64_t{cost} + rest > max_cost) return;
  if (from_start_[state] == kUnreached) touched_.push_back(state);
  from_start_[state] = cost;
  // Least bound first; among equals the latest, which follows one optimal walk to its end.
  heap_.push_back(uint64_t{cost + rest} << 32 | ~static_cast<uint32_t>(queued_.size()));
  queued_.push_back(state);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

void LoopSearch::ResetForward() {
  for (const State state : touched_) from_start_[state] = kUnreached;
  touched_.clear();
  queued_.clear();
  heap_.clear();
}

SeamPath LoopSearch::TraceBack(int end_seam) const {
  SeamPath path;
  path.end_seam = end_seam;
  State state = EndOf(end_seam);
  path.cost = from_start_[state];
  while (from_start_[state] > 0 || SeamOf(state, 0) < 0) {
    const State previous = Predecessor(state);
    if (((previous ^ state) & 3) != 0)
      path.corners.push_back(box_.GridVertexOf(Split(previous).vertex));
    state = previous;
  }
  path.start_seam = SeamOf(state, 0);
  std::reverse(path.corners.begin(), path.corners.end());
  return path;
}

LoopSearch::State LoopSearch::Predecessor(State state) const {
  const auto [level, vertex, heading] = Split(state);
  const int from = vertex - box_.offset(heading);
  const uint32_t step = box_.Step(from, heading);
  const int from_level = level - box_.LevelChange(from, heading);
  for (const int turn : {heading, LeftOf(heading), RightOf(heading)}) {
    const State previous = MakeState(from_level, from, turn);
    const uint32_t cost = step + (turn == heading ? 0 : turn_cost_);
    if (from_start_[previous] != kUnreached && from_start_[previous] + cost == from_start_[state])
      return previous;
  }
  FailCheck(__FILE__, __LINE__, "every reached state has a predecessor");
}

}  // namespace enfilade
