// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/door_frames.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "enfilade/floorplan/joined_rooms.h"
#include "src/floorplan/edge_sums.h"

namespace enfilade {
namespace {

constexpr double kLowestHead_m = 1.86, kHighestHead_m = 2.4;
constexpr double kBelowCeiling_m = 0.06;
// Less wall than this is not seen above a door: it may be a cupboard up to the ceiling.
constexpr double kMinAbove_m = 0.14;
constexpr double kMinWidth_m = 0.5, kMaxWidth_m = 2.4, kUsualWidth_m = 0.85;
// From casing to casing an opening looks wider than it is.
constexpr double kMinWideWidth_m = kRoomJoiningOpening_m + 0.14, kMaxWideWidth_m = 3.2;
// Jambs are looked at in two parts, so that a window's or a picture's sides are none.
constexpr double kJambFrom_m = 0.12, kJambMiddle_m = 0.65, kCasing_m = 0.08;
constexpr double kAboveFrom_m = 0.1;
constexpr double kBaseboardFrom_m = 0.02, kBaseboardTo_m = 0.17;
constexpr float kMinJamb = 0.06F, kMinHead = 0.04F;
constexpr size_t kMaxFrames = 4;
constexpr double kMinScoreOfHead = 1;
constexpr double kHeadSigma_m = 0.04;

// Upright edges of one column below and above a head.
struct Jamb {
  float low = 0, high = 0, above = 0;
  [[nodiscard]] float Strength() const {
    return 0.5F * std::min(low, high) + 0.25F * (low + high) - 0.7F * above;
  }
};

Jamb JambOf(const DoorFrame& frame, int side) {
  return {frame.low_jambs[side], frame.high_jambs[side], frame.above[side]};
}

class FrameFinder {
 public:
  using Score = std::function<double(const DoorFrame&)>;

  FrameFinder(const Facade& facade, double min_width_m, double max_width_m, Score score)
      : facade_(facade),
        sums_(facade),
        min_width_m_(min_width_m),
        max_width_m_(max_width_m),
        score_(std::move(score)),
        ceiling_m_(facade.rows() * facade.step_m()) {}

  [[nodiscard]] std::vector<DoorFrame> Find() {
    const double highest_m = std::min(kHighestHead_m, ceiling_m_ - kMinAbove_m);
    for (double head_m = kLowestHead_m; head_m < highest_m; head_m += facade_.step_m())
      AddFramesWithHead(head_m);
    std::stable_sort(frames_.begin(), frames_.end(),
                     [](const DoorFrame& a, const DoorFrame& b) { return a.score > b.score; });
    std::vector<DoorFrame> best;
    for (const DoorFrame& frame : frames_) {
      const bool overlaps = std::any_of(best.begin(), best.end(), [&](const DoorFrame& other) {
        return frame.begin_m < other.end_m && other.begin_m < frame.end_m;
      });
      if (!overlaps) best.push_back(frame);
      if (best.size() == kMaxFrames) break;
    }
    return best;
  }

 private:
  [[nodiscard]] Jamb JambAt(int col, double head_m) const {
    const int above = sums_.RowAt(head_m + kAboveFrom_m);
    const int top = sums_.RowAt(ceiling_m_ - kBelowCeiling_m);
    return {sums_.Upright(col, sums_.RowAt(kJambFrom_m), sums_.RowAt(kJambMiddle_m)),
            sums_.Upright(col, sums_.RowAt(kJambMiddle_m), sums_.RowAt(head_m - kCasing_m)),
            sums_.Upright(col, above, top)};
  }

  void AddFramesWithHead(double head_m) {
    std::vector<Jamb> jambs;
    for (int col = 0; col < facade_.cols(); ++col) jambs.push_back(JambAt(col, head_m));
    std::vector<int> peaks;
    for (int col = 1; col + 1 < facade_.cols(); ++col) {
      const float strength = jambs[static_cast<size_t>(col)].Strength();
      if (strength > kMinJamb && strength >= jambs[static_cast<size_t>(col - 1)].Strength() &&
          strength >= jambs[static_cast<size_t>(col + 1)].Strength()) {
        peaks.push_back(col);
      }
    }
    for (size_t i = 0; i < peaks.size(); ++i) {
      for (size_t j = i + 1; j < peaks.size(); ++j) {
        const double width_m = (peaks[j] - peaks[i]) * facade_.step_m();
        if (width_m > max_width_m_) break;
        if (width_m < min_width_m_) continue;
        AddFrame(peaks[i], jambs[static_cast<size_t>(peaks[i])], peaks[j],
                 jambs[static_cast<size_t>(peaks[j])], head_m);
      }
    }
  }

  void AddFrame(int first, const Jamb& left, int last, const Jamb& right, double head_m) {
    DoorFrame frame{.begin_m = (first + 0.5) * facade_.step_m(),
                    .end_m = (last + 0.5) * facade_.step_m(),
                    .head_m = head_m,
                    .low_jambs = {left.low, right.low},
                    .high_jambs = {left.high, right.high},
                    .above = {left.above, right.above}};
    frame.head = sums_.Level(sums_.RowAt(head_m), first + 2, last - 2);
    if (frame.head < kMinHead) return;
    for (int row = sums_.RowAt(kBaseboardFrom_m); row < sums_.RowAt(kBaseboardTo_m); ++row)
      frame.baseboard = std::max(frame.baseboard, sums_.Level(row, first + 2, last - 2));
    frame.score = score_(frame);
    frames_.push_back(frame);
  }

  const Facade& facade_;
  EdgeSums sums_;
  double min_width_m_, max_width_m_;
  Score score_;
  double ceiling_m_;
  std::vector<DoorFrame> frames_;
};

}  // namespace

std::vector<DoorFrame> FindDoorFrames(const Facade& facade, std::optional<double> home_head_m) {
  const auto score = [&](const DoorFrame& frame) {
    const double of_edges = JambOf(frame, 0).Strength() + JambOf(frame, 1).Strength() + frame.head -
                            0.3 * frame.baseboard -
                            0.15 * std::abs(std::log(frame.Width() / kUsualWidth_m));
    if (!home_head_m) return of_edges;
    const double off = (frame.head_m - *home_head_m) / kHeadSigma_m;
    return of_edges + 0.5 * std::exp(-0.5 * off * off);
  };
  return FrameFinder(facade, kMinWidth_m, kMaxWidth_m, score).Find();
}

std::vector<DoorFrame> FindWideFrames(const Facade& facade) {
  return FrameFinder(facade, kMinWideWidth_m, kMaxWideWidth_m, OpeningStrength).Find();
}

bool IsWide(const DoorFrame& frame) { return frame.Width() >= kMinWideWidth_m; }

float OpeningStrength(const DoorFrame& frame) {
  return frame.head + std::min({frame.low_jambs[0], frame.low_jambs[1], frame.high_jambs[0],
                                frame.high_jambs[1]});
}

std::optional<double> HomeHead(std::span<const std::vector<DoorFrame>> frames) {
  constexpr double kBin_m = 0.01;
  const auto num_bins = static_cast<size_t>(std::lround((kHighestHead_m - kLowestHead_m) / kBin_m));
  double most = 0, best_m = 0;
  for (size_t bin = 0; bin <= num_bins; ++bin) {
    const double head_m = kLowestHead_m + static_cast<double>(bin) * kBin_m;
    double weight = 0;
    for (const std::vector<DoorFrame>& of_wall : frames) {
      for (const DoorFrame& frame : of_wall) {
        const double off = (frame.head_m - head_m) / kHeadSigma_m;
        weight += std::max(frame.score - kMinScoreOfHead, 0.0) * std::exp(-0.5 * off * off);
      }
    }
    if (weight <= most) continue;
    most = weight;
    best_m = head_m;
  }
  return most > 0 ? std::optional(best_m) : std::nullopt;
}

// Weights of a logistic regression on walls of made homes (docs/algorithms/openings.md).
double DoorLogOdds(const DoorFrame& frame, double home_head_m, std::optional<double> camera_m) {
  const double low = 0.5 * (frame.low_jambs[0] + frame.low_jambs[1]);
  const double high = 0.5 * (frame.high_jambs[0] + frame.high_jambs[1]);
  const double weakest_low = std::min(frame.low_jambs[0], frame.low_jambs[1]);
  const double weakest_high = std::min(frame.high_jambs[0], frame.high_jambs[1]);
  const double off_head = (frame.head_m - home_head_m) / 0.06;
  const double near_camera = camera_m ? std::exp(-*camera_m * *camera_m / 0.25) : 0;
  return -3.7 + 2.7 * low + 1.9 * high + 1.1 * weakest_low + 1.0 * weakest_high +
         1.35 * frame.head - 0.9 * frame.baseboard -
         2.4 * std::abs(std::log(frame.Width() / kUsualWidth_m)) -
         0.38 * std::min(off_head * off_head, 4.0) + 4.2 * near_camera;
}

}  // namespace enfilade
