// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/floor_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "src/sfm/wall_matches.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2i;
using Complex = std::complex<float>;

constexpr int kReach = FloorPicture::kReach;
// Places up to 319 pixels apart are told from their like on the other side.
constexpr int kPeriod = 720;
constexpr double kSquarePixels = FloorPicture::kPixelsPerHeight * FloorPicture::kPixelsPerHeight;
constexpr double kMinOverlap = 0.667;  // square camera heights
constexpr int kOtherPlace_px = 15;
// What separates the best place of two floors from the next best is larger by chance by this with
// probability 0.1: of 1267 wrong places of 22 made homes and a real one 0.052 was reached by a
// tenth, 0.103 by a hundredth and 0.141 by a thousandth; the largest was 0.149.
constexpr double kLikenessPerDigit = 0.05;
// Like rooms have furniture and fittings in common, which agree with 20 digits and more, but no
// floors that lie on each other at one place only: against digits of features those of floors are
// worth this.
constexpr double kWorth = 3;
// Two rooms may have the same rug.
constexpr double kMaxDigits = 100;
constexpr int64_t kBlock = 8;

int Wrapped(int index) { return (index % kPeriod + kPeriod) % kPeriod; }

using Periodic = std::vector<float>;  // kPeriod², the middle at 0, row by row

size_t At(int row, int col) {
  return static_cast<size_t>(Wrapped(row)) * kPeriod + static_cast<size_t>(Wrapped(col));
}

cv::Mat Transformed(Periodic& values) {
  const cv::Mat input(kPeriod, kPeriod, CV_32F, values.data());
  cv::Mat spectrum;
  cv::dft(input, spectrum, cv::DFT_COMPLEX_OUTPUT);
  return spectrum;
}

Periodic TransformedBack(const cv::Mat& spectrum) {
  Periodic values(static_cast<size_t>(kPeriod) * kPeriod);
  cv::Mat output(kPeriod, kPeriod, CV_32F, values.data());
  cv::dft(spectrum, output, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return values;
}

Periodic ShownArea() {
  Periodic shown(static_cast<size_t>(kPeriod) * kPeriod, 0.0F);
  for (int r = -kReach; r <= kReach; ++r) {
    for (int c = -kReach; c <= kReach; ++c) {
      if (FloorPicture::IsShown(r + kReach, c + kReach)) shown[At(r, c)] = 1;
    }
  }
  return shown;
}

// The sum over u of x(u + step)·y(turned u) for all steps.
Periodic Correlate(const cv::Mat& x, const cv::Mat& y, int turn) {
  cv::Mat product(kPeriod, kPeriod, CV_32FC2);
  for (int r = 0; r < kPeriod; ++r) {
    const Complex* x_row = x.ptr<Complex>(r);
    Complex* out = product.ptr<Complex>(r);
    for (int c = 0; c < kPeriod; ++c) {
      const Vector2i from = Unturned(Vector2i(c, r), turn);
      out[c] = x_row[c] * std::conj(y.ptr<Complex>(Wrapped(from.y()))[Wrapped(from.x())]);
    }
  }
  return TransformedBack(product);
}

// A floor as it is compared with many.
struct FloorToPlace {
  cv::Mat spectrum;
  // 1 / √(sum over what a floor laid upon this one at a step shows of the square contrast).
  Periodic inverse_norm;
};

FloorToPlace Prepare(const FloorPicture& floor, const cv::Mat& shown_spectrum) {
  constexpr float kLeast = 1;
  Periodic values(static_cast<size_t>(kPeriod) * kPeriod, 0.0F), squares = values;
  for (int r = -kReach; r <= kReach; ++r) {
    for (int c = -kReach; c <= kReach; ++c) {
      const float value = floor.contrast(r + kReach, c + kReach);
      values[At(r, c)] = value;
      squares[At(r, c)] = value * value;
    }
  }
  FloorToPlace prepared{Transformed(values), Correlate(Transformed(squares), shown_spectrum, 0)};
  for (float& norm : prepared.inverse_norm) norm = 1 / std::sqrt(std::max(kLeast, norm));
  return prepared;
}

struct Peak {
  float likeness = 0;
  Vector2i step{0, 0};
};

Peak HighestPeak(const Periodic& likeness, const std::optional<Vector2i>& without) {
  Peak best;
  for (int r = 0; r < kPeriod; ++r) {
    const float* row = likeness.data() + static_cast<size_t>(r) * kPeriod;
    const bool is_near_row = without && std::abs(Wrapped(r - without->y() + kPeriod / 2) -
                                                 kPeriod / 2) <= kOtherPlace_px;
    for (int c = 0; c < kPeriod; ++c) {
      if (row[c] <= best.likeness) continue;
      if (is_near_row &&
          std::abs(Wrapped(c - without->x() + kPeriod / 2) - kPeriod / 2) <= kOtherPlace_px) {
        continue;
      }
      best = {row[c], {c, r}};
    }
  }
  return best;
}

int Signed(int index) { return index < kPeriod / 2 ? index : index - kPeriod; }

// The root of the area that two floors show at all steps, in camera heights; 0 where it is small.
Periodic RootOverlaps(const cv::Mat& shown_spectrum) {
  Periodic overlap = Correlate(shown_spectrum, shown_spectrum, 0);
  for (float& value : overlap) {
    const double area = value / kSquarePixels;
    value = area < kMinOverlap ? 0.0F : static_cast<float>(std::sqrt(area));
  }
  return overlap;
}

FloorPlace BestPlace(const FloorToPlace& a, const FloorToPlace& b, const Periodic& root_overlap) {
  std::array<Periodic, kNumTurns> likeness;
  std::array<Peak, kNumTurns> peaks;
  for (int turn = 0; turn < kNumTurns; ++turn) {
    Periodic& values = likeness[static_cast<size_t>(turn)];
    values = Correlate(a.spectrum, b.spectrum, turn);
    for (int r = 0; r < kPeriod; ++r) {
      for (int c = 0; c < kPeriod; ++c) {
        const size_t i = static_cast<size_t>(r) * kPeriod + static_cast<size_t>(c);
        const Vector2i back = Unturned(Vector2i(-c, -r), turn);
        values[i] *= a.inverse_norm[i] * b.inverse_norm[At(back.y(), back.x())] * root_overlap[i];
      }
    }
    peaks[static_cast<size_t>(turn)] = HighestPeak(values, std::nullopt);
  }
  size_t best = 0;
  for (size_t turn = 1; turn < peaks.size(); ++turn) {
    if (peaks[turn].likeness > peaks[best].likeness) best = turn;
  }
  float next = HighestPeak(likeness[best], peaks[best].step).likeness;
  for (size_t turn = 0; turn < peaks.size(); ++turn) {
    if (turn != best) next = std::max(next, peaks[turn].likeness);
  }
  const Vector2i step = peaks[best].step;
  return {static_cast<int>(best), Vector2d(Signed(step.x()), Signed(step.y())), 1,
          std::min(kMaxDigits, kWorth * (peaks[best].likeness - next) / kLikenessPerDigit)};
}

}  // namespace

std::vector<FloorPlace> PlaceFloors(std::span<const FloorPicture> floors,
                                    std::span<const ViewPair> pairs, RunContext& context) {
  Periodic shown = ShownArea();
  const cv::Mat shown_spectrum = Transformed(shown);
  const Periodic root_overlap = RootOverlaps(shown_spectrum);
  // Spectra are large: pairs of a few panoramas at a time.
  std::map<std::pair<int64_t, int64_t>, std::vector<size_t>> blocks;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const auto& [a, b] = pairs[k];
    if (floors[static_cast<size_t>(a)].contrast.empty() ||
        floors[static_cast<size_t>(b)].contrast.empty()) {
      continue;
    }
    blocks[{a / kBlock, b / kBlock}].push_back(k);
  }
  std::vector<FloorPlace> places(pairs.size());
  for (const auto& block : blocks) {
    const std::vector<size_t>& members = block.second;
    std::map<int, FloorToPlace> prepared;
    for (const size_t k : members) {
      prepared[pairs[k].a_idx];
      prepared[pairs[k].b_idx];
    }
    std::vector<std::pair<int, FloorToPlace*>> to_prepare;
    for (auto& [view, floor] : prepared) to_prepare.emplace_back(view, &floor);
    ParallelFor(context, "", static_cast<int64_t>(to_prepare.size()), [&](int64_t i) {
      const auto& [view, floor] = to_prepare[static_cast<size_t>(i)];
      *floor = Prepare(floors[static_cast<size_t>(view)], shown_spectrum);
    });
    ParallelFor(context, "match floors", static_cast<int64_t>(members.size()), [&](int64_t i) {
      const size_t k = members[static_cast<size_t>(i)];
      places[k] = BestPlace(prepared.at(pairs[k].a_idx), prepared.at(pairs[k].b_idx), root_overlap);
    });
  }
  return places;
}

}  // namespace enfilade
