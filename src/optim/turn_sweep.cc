// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/optim/turn_sweep.h"

#include <algorithm>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

constexpr int32_t kNone = TurnSweep::kUnreached;

// One step of all vertices of a row in a vertical heading: g is the row's G, t its T of the layer
// before. Sums need no clamp: t is at most kNone and so is a step.
void StepNorth(const int32_t* __restrict g, const int32_t* __restrict t,
               const int32_t* __restrict step, int32_t* __restrict next_g,
               uint8_t* __restrict next_code, int size) {
  for (int i = 0; i < size; ++i) {
    next_g[i] = std::min(g[i], t[i]) + step[i];
    next_code[i] = static_cast<uint8_t>(g[i] <= t[i]);
  }
}

// The same southwards; with it T of the row becomes that of this layer, as G northwards is known.
void StepSouth(const int32_t* __restrict g, const int32_t* __restrict north, int32_t* __restrict t,
               const int32_t* __restrict step, int32_t* __restrict next_g,
               uint8_t* __restrict next_code, uint8_t* __restrict code, int size) {
  for (int i = 0; i < size; ++i) {
    next_g[i] = std::min(g[i], t[i]) + step[i];
    next_code[i] = static_cast<uint8_t>(next_code[i] | (g[i] <= t[i]) << 1);
    t[i] = std::min(std::min(g[i], north[i]), kNone);
    code[i] = static_cast<uint8_t>(code[i] | (g[i] < north[i]) << 2);
  }
}

}  // namespace

TurnSweep::TurnSweep(const LoopBox& box, const SweepWindow& window, int max_turns)
    : box_(box), window_(window) {
  ENFILADE_CHECK(window.low_row >= 1 && window.high_row + 1 < box.rows());
  ENFILADE_CHECK(window.low_col >= 1 && window.high_col + 1 < box.cols());
  ENFILADE_CHECK(window.low_row <= window.high_row && window.low_col <= window.high_col);
  ENFILADE_CHECK(window.low_level <= window.high_level && max_turns >= 0);
  rows_ = window.high_row - window.low_row + 1;
  cols_ = window.high_col - window.low_col + 1;
  num_levels_ = window.high_level - window.low_level + 1;
  top_row_ = box.seam_top() / box.cols() - window.low_row;
  seam_col_ = std::max(box.seam_top() % box.cols() - window.low_col, 0);
  if (top_row_ < 1 || top_row_ >= rows_ || seam_col_ >= cols_) {  // the window has no seam
    top_row_ = rows_;
    seam_col_ = cols_;
  }
  level_size_ = static_cast<size_t>(rows_) * static_cast<size_t>(cols_);
  layer_size_ = static_cast<size_t>(num_levels_) * level_size_ + static_cast<size_t>(cols_);
  CopySteps(box);
  for (std::vector<int32_t>* values : {&first_, &second_, &best_})
    values->assign(layer_size_, kNone);
  spare_.assign(static_cast<size_t>(cols_), kNone);
  codes_ =
      std::make_unique_for_overwrite<uint8_t[]>(static_cast<size_t>(max_turns + 1) * layer_size_);
}

void TurnSweep::CopySteps(const LoopBox& box) {
  for (int heading = 0; heading < 4; ++heading) {
    step_[heading].resize(level_size_);
    int32_t* out = step_[heading].data();
    for (int row = 0; row < rows_; ++row) {
      const int first = (row + window_.low_row) * box.cols() + window_.low_col;
      for (int col = 0; col < cols_; ++col) {
        const uint16_t cost = box.Step(first + col, heading);
        *out++ = cost == kBlockedStep ? kNone : cost;
      }
    }
  }
}

size_t TurnSweep::Index(int vertex, int level) const {
  const int row = vertex / box_.cols() - window_.low_row,
            col = vertex % box_.cols() - window_.low_col;
  ENFILADE_CHECK(row >= 0 && row < rows_ && col >= 0 && col < cols_);
  if (level > window_.high_level) {
    ENFILADE_CHECK(level == window_.high_level + 1 && row == top_row_ && col >= seam_col_);
    return static_cast<size_t>(num_levels_) * level_size_ + static_cast<size_t>(col);
  }
  ENFILADE_CHECK(level >= window_.low_level);
  return static_cast<size_t>(level - window_.low_level) * level_size_ +
         static_cast<size_t>(row) * static_cast<size_t>(cols_) + static_cast<size_t>(col);
}

void TurnSweep::StartAtSeams(int first_seam, std::span<const int32_t> costs) {
  first_start_seam_ = first_seam;
  start_costs_ = costs;
  std::fill(best_.begin(), best_.end(), kNone);
  Start(kNorth);
  start_costs_ = {};
}

void TurnSweep::StartAt(int vertex, int level, int heading) {
  std::fill(best_.begin(), best_.end(), kNone);
  best_[Index(vertex, level)] = 0;
  Start(heading);
  KeepOnly(heading);
}

void TurnSweep::Start(int heading) {
  start_heading_ = heading;
  num_turns_ = 0;
  SweepLayer();
}

void TurnSweep::AddTurn() {
  ++num_turns_;
  SweepLayer();
}

void TurnSweep::SweepLayer() {
  num_relaxed_ += 2 * static_cast<int64_t>(layer_size_);
  if (IsHorizontal(num_turns_)) {
    SweepHorizontal();
  } else {
    SweepNorth();
    SweepSouth();
  }
}

// Both headings of a row at once: two chains of dependent minima keep the processor busier.
void TurnSweep::SweepHorizontal() {
  uint8_t* codes = Codes(num_turns_);
  const int last = cols_ - 1;
  for (int level_row = 0; level_row < num_levels_ * rows_; ++level_row) {
    const size_t offset = static_cast<size_t>(level_row) * static_cast<size_t>(cols_);
    const size_t step_offset = static_cast<size_t>(level_row % rows_) * static_cast<size_t>(cols_);
    const int32_t* step_east = step_[kEast].data() + step_offset;
    const int32_t* step_west = step_[kWest].data() + step_offset;
    int32_t *__restrict east = first_.data() + offset, *__restrict west = second_.data() + offset,
            *__restrict t = best_.data() + offset;
    uint8_t* __restrict code = codes + offset;
    int32_t g_east = kNone, g_west = kNone;
    east[0] = west[last] = kNone;
    for (int i = 0; i < last; ++i) {
      const int j = last - i;
      east[i + 1] = g_east = std::min(g_east, t[i]) + step_east[i];
      west[j - 1] = g_west = std::min(g_west, t[j]) + step_west[j];
    }
    code[last] = 0;
    for (int i = 0; i < last; ++i) {
      code[i] = static_cast<uint8_t>((west[i + 1] <= t[i + 1]) << 1 | (west[i] < east[i]) << 2);
    }
    code[last] = static_cast<uint8_t>((west[last] < east[last]) << 2);
    for (int i = 0; i < last; ++i) {
      code[i + 1] = static_cast<uint8_t>(code[i + 1] | (east[i] <= t[i]));
    }
    for (int i = 0; i < cols_; ++i) t[i] = std::min(std::min(east[i], west[i]), kNone);
  }
}

// Upwards through the rows and the levels: at the seams a row's successor is one level higher.
void TurnSweep::SweepNorth() {
  uint8_t* codes = Codes(num_turns_);
  for (int level = 0; level < num_levels_; ++level) {
    const size_t base = static_cast<size_t>(level) * level_size_;
    std::fill_n(first_.begin() + static_cast<ptrdiff_t>(base), cols_, kNone);
    std::fill_n(codes + base, cols_, uint8_t{0});
    if (level == 0 && top_row_ < rows_) {
      const size_t top = static_cast<size_t>(top_row_) * static_cast<size_t>(cols_);
      std::fill_n(codes + top, cols_, uint8_t{0});
      std::fill_n(first_.begin() + static_cast<ptrdiff_t>(top), cols_, kNone);
      std::copy(start_costs_.begin(), start_costs_.end(),
                first_.begin() + static_cast<ptrdiff_t>(top) + seam_col_ + first_start_seam_);
    }
    for (int row = 0; row + 1 < rows_; ++row) {
      const size_t step = static_cast<size_t>(row) * static_cast<size_t>(cols_), at = base + step;
      const bool is_below_ray = row + 1 == top_row_;
      const int num_same = is_below_ray ? seam_col_ : cols_;
      const auto step_row = [&](size_t from, size_t size, size_t to) {
        StepNorth(&first_[at + from], &best_[at + from], &step_[kNorth][step + from], &first_[to],
                  codes + to, static_cast<int>(size));
      };
      step_row(0, static_cast<size_t>(num_same), at + static_cast<size_t>(cols_));
      if (!is_below_ray) continue;
      const size_t seam = static_cast<size_t>(seam_col_), next = at + static_cast<size_t>(cols_);
      const size_t above = level + 1 < num_levels_
                               ? next + level_size_ + seam
                               : static_cast<size_t>(num_levels_) * level_size_ + seam;
      step_row(seam, static_cast<size_t>(cols_) - seam, above);
    }
  }
}

// Downwards through the rows and the levels, and with it the layer's T.
void TurnSweep::SweepSouth() {
  uint8_t* codes = Codes(num_turns_);
  std::vector<uint8_t> spare_codes(static_cast<size_t>(cols_));
  for (int level = num_levels_ - 1; level >= 0; --level) {
    const size_t base = static_cast<size_t>(level) * level_size_;
    const size_t last = base + level_size_ - static_cast<size_t>(cols_);
    std::fill_n(second_.begin() + static_cast<ptrdiff_t>(last), cols_, kNone);
    if (level + 1 == num_levels_ && top_row_ < rows_) {
      const size_t bottom = base + static_cast<size_t>(top_row_ - 1) * static_cast<size_t>(cols_);
      std::fill_n(second_.begin() + static_cast<ptrdiff_t>(bottom), cols_, kNone);
    }
    for (int row = rows_ - 1; row >= 0; --row) {
      const size_t step = static_cast<size_t>(row) * static_cast<size_t>(cols_), at = base + step;
      const bool is_above_ray = row == top_row_;
      const int num_same = is_above_ray ? seam_col_ : cols_;
      const auto step_row = [&](size_t from, size_t size, int32_t* next, uint8_t* next_code) {
        StepSouth(&second_[at + from], &first_[at + from], &best_[at + from],
                  &step_[kSouth][step + from], next, next_code, codes + at + from,
                  static_cast<int>(size));
      };
      const size_t below = at - static_cast<size_t>(cols_), seam = static_cast<size_t>(seam_col_);
      if (row == 0) {
        step_row(0, static_cast<size_t>(cols_), spare_.data(), spare_codes.data());
        continue;
      }
      step_row(0, static_cast<size_t>(num_same), &second_[below], codes + below);
      if (!is_above_ray) continue;
      if (level > 0) {
        step_row(seam, static_cast<size_t>(cols_) - seam, &second_[below - level_size_ + seam],
                 codes + below - level_size_ + seam);
      } else {
        step_row(seam, static_cast<size_t>(cols_) - seam, spare_.data(), spare_codes.data());
      }
    }
  }
}

void TurnSweep::KeepOnly(int heading) {
  const bool is_first = heading == kEast || heading == kNorth;
  const std::vector<int32_t>& kept = is_first ? first_ : second_;
  std::vector<int32_t>& dropped = is_first ? second_ : first_;
  std::fill(dropped.begin(), dropped.end(), kNone);
  uint8_t* codes = Codes(num_turns_);
  for (size_t i = 0; i < layer_size_; ++i) {
    best_[i] = std::min(kept[i], kNone);
    const int straight = codes[i] & ~kSecondIsBest;
    codes[i] = static_cast<uint8_t>(is_first ? straight : straight | kSecondIsBest);
  }
}

int32_t TurnSweep::CostOf(int vertex, int level, int heading) const {
  if (IsHorizontal(num_turns_) != (heading == kEast || heading == kWest)) return kUnreached;
  const bool is_first = heading == kEast || heading == kNorth;
  return std::min((is_first ? first_ : second_)[Index(vertex, level)], kUnreached);
}

TurnSweep::Walk TurnSweep::TraceBack(int vertex, int level, int heading, int num_turns) const {
  Walk walk;
  while (true) {
    const uint8_t code = Codes(num_turns)[Index(vertex, level)];
    const bool is_first = heading == kEast || heading == kNorth;
    vertex -= box_.offset(heading);
    level -= box_.LevelChange(vertex, heading);
    if ((code & (is_first ? kFirstIsStraight : kSecondIsStraight)) != 0) continue;
    if (num_turns == 0) break;
    walk.corners.push_back(vertex);
    const bool is_second = (Codes(--num_turns)[Index(vertex, level)] & kSecondIsBest) != 0;
    heading = IsHorizontal(num_turns) ? (is_second ? kWest : kEast) : (is_second ? kSouth : kNorth);
  }
  walk.start = vertex;
  std::reverse(walk.corners.begin(), walk.corners.end());
  return walk;
}

}  // namespace enfilade
