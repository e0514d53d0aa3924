// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/window_frames.h"

#include <algorithm>

#include "src/floorplan/edge_sums.h"

namespace enfilade {
namespace {

constexpr double kLowestSill_m = 0.25, kHighestSill_m = 1.6;
constexpr double kLowestHead_m = 1.3, kBelowCeiling_m = 0.08;
constexpr double kMinSize_m = 0.5, kMaxWidth_m = 3.5;
constexpr double kBeyond_m = 0.3;  // how far beyond a side its line must not go on
constexpr float kMinSide = 0.12F;
constexpr float kMinBrighter = 20;  // grey levels

// Mean brightness over rectangles of cells.
class BrightnessSums {
 public:
  explicit BrightnessSums(const Facade& facade) : sums_(facade.rows() + 1, facade.cols() + 1) {
    for (int r = 0; r < facade.rows(); ++r) {
      double row = 0;
      for (int c = 0; c < facade.cols(); ++c) {
        row += facade.brightness()(r, c);
        sums_(r + 1, c + 1) = sums_(r, c + 1) + row;
      }
    }
  }
  [[nodiscard]] float Mean(int r0, int r1, int c0, int c1) const {
    c0 = std::clamp(c0, 0, sums_.cols() - 1);
    c1 = std::clamp(c1, 0, sums_.cols() - 1);
    if (r1 <= r0 || c1 <= c0) return -1;
    const double sum = sums_(r1, c1) - sums_(r0, c1) - sums_(r1, c0) + sums_(r0, c0);
    return static_cast<float>(sum / ((r1 - r0) * (c1 - c0)));
  }

 private:
  Image<double> sums_;
};

class WindowFinder {
 public:
  WindowFinder(const Facade& facade, float min_strength)
      : facade_(facade), edges_(facade), brightness_(facade), min_strength_(min_strength) {}

  [[nodiscard]] std::vector<WindowFrame> Find() {
    const double ceiling_m = facade_.rows() * facade_.step_m();
    const int last_head = edges_.RowAt(ceiling_m - kBelowCeiling_m);
    const std::vector<float> clearest = ClearestOfRows();
    for (int sill = edges_.RowAt(kLowestSill_m); sill < edges_.RowAt(kHighestSill_m); ++sill) {
      const int first_head = std::max(edges_.RowAt(kLowestHead_m), sill + edges_.RowAt(kMinSize_m));
      for (int head = first_head; head < last_head; ++head) {
        const float most =
            2 + clearest[static_cast<size_t>(sill)] + clearest[static_cast<size_t>(head)];
        if (most >= min_strength_) AddFrames(sill, head);
      }
    }
    std::stable_sort(
        frames_.begin(), frames_.end(),
        [](const WindowFrame& a, const WindowFrame& b) { return a.strength > b.strength; });
    std::vector<WindowFrame> kept;
    for (const WindowFrame& frame : frames_) {
      const bool overlaps = std::any_of(kept.begin(), kept.end(), [&](const WindowFrame& other) {
        return frame.begin_m < other.end_m && other.begin_m < frame.end_m;
      });
      if (!overlaps) kept.push_back(frame);
    }
    return kept;
  }

 private:
  // For each row the clearest level edge as long as the narrowest window: no wider one is clearer.
  [[nodiscard]] std::vector<float> ClearestOfRows() const {
    const int length = edges_.RowAt(kMinSize_m) - 4;
    std::vector<float> clearest(static_cast<size_t>(facade_.rows()), 0.0F);
    for (int row = 0; row < facade_.rows(); ++row) {
      float& most = clearest[static_cast<size_t>(row)];
      for (int col = 0; col + length <= facade_.cols(); ++col)
        most = std::max(most, edges_.Level(row, col, col + length));
    }
    return clearest;
  }

  [[nodiscard]] float Side(int col, int sill, int head) const {
    const int beyond = edges_.RowAt(kBeyond_m);
    const float below = edges_.Upright(col, std::max(sill - beyond, 0), sill - 2);
    const float above = edges_.Upright(col, head + 3, std::min(head + beyond, facade_.rows()));
    return edges_.Upright(col, sill, head) - 0.5F * std::max(below, above);
  }

  void AddFrames(int sill, int head) {
    std::vector<float> sides(static_cast<size_t>(facade_.cols()));
    for (int col = 0; col < facade_.cols(); ++col)
      sides[static_cast<size_t>(col)] = Side(col, sill, head);
    std::vector<int> peaks;
    for (int col = 1; col + 1 < facade_.cols(); ++col) {
      const auto i = static_cast<size_t>(col);
      if (sides[i] > kMinSide && sides[i] >= sides[i - 1] && sides[i] >= sides[i + 1])
        peaks.push_back(col);
    }
    for (size_t i = 0; i < peaks.size(); ++i) {
      for (size_t j = i + 1; j < peaks.size(); ++j) {
        const double width_m = (peaks[j] - peaks[i]) * facade_.step_m();
        if (width_m > kMaxWidth_m) break;
        if (width_m < kMinSize_m) continue;
        const float strength = sides[static_cast<size_t>(peaks[i])] +
                               sides[static_cast<size_t>(peaks[j])] +
                               edges_.Level(sill, peaks[i] + 2, peaks[j] - 2) +
                               edges_.Level(head, peaks[i] + 2, peaks[j] - 2);
        if (strength >= min_strength_) AddFrame(peaks[i], peaks[j], sill, head, strength);
      }
    }
  }

  void AddFrame(int first, int last, int sill, int head, float strength) {
    const int beside = edges_.RowAt(kBeyond_m), casing = edges_.RowAt(0.1);
    const float inside = brightness_.Mean(sill, head, first, last);
    const float outside = std::max(brightness_.Mean(sill, head, first - beside, first - casing),
                                   brightness_.Mean(sill, head, last + casing, last + beside));
    if (outside < 0 || inside - outside < kMinBrighter) return;
    frames_.push_back({(first + 0.5) * facade_.step_m(), (last + 0.5) * facade_.step_m(),
                       sill * facade_.step_m(), (head + 0.5) * facade_.step_m(), strength,
                       inside - outside});
  }

  const Facade& facade_;
  EdgeSums edges_;
  BrightnessSums brightness_;
  float min_strength_;
  std::vector<WindowFrame> frames_;
};

}  // namespace

std::vector<WindowFrame> FindWindowFrames(const Facade& facade, float min_strength) {
  return WindowFinder(facade, min_strength).Find();
}

}  // namespace enfilade
