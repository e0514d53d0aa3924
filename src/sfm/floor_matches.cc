// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/floor_matches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "src/sfm/wall_matches.h"
#include "src/sfm/wall_view.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
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
constexpr double kMinDigits = 3;
constexpr int kSpotSpacing_px = 20, kSpotHalf_px = 8, kSpotReach_px = 4;
constexpr double kMinSpotCorrelation = 0.6;
// Of a spot's square contrast; plain ones have no place.
constexpr double kMinSpotContrast = 0.2 * FloorPicture::kScale * FloorPicture::kScale;
constexpr int64_t kBlock = 8;

struct Cell {
  int row = 0, col = 0;
};

// A turned floor shows at this cell, from the middle, what the floor shows at the result.
Cell Unturned(const Cell& cell, int turn) {
  Cell result = cell;
  for (int t = 0; t < turn; ++t) result = {-result.col, result.row};
  return result;
}

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
      const Cell from = Unturned({r, c}, turn);
      out[c] = x_row[c] * std::conj(y.ptr<Complex>(Wrapped(from.row))[Wrapped(from.col)]);
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
  Cell step;
};

Peak HighestPeak(const Periodic& likeness, const std::optional<Cell>& without) {
  Peak best;
  for (int r = 0; r < kPeriod; ++r) {
    const float* row = likeness.data() + static_cast<size_t>(r) * kPeriod;
    const bool is_near_row = without && std::abs(Wrapped(r - without->row + kPeriod / 2) -
                                                 kPeriod / 2) <= kOtherPlace_px;
    for (int c = 0; c < kPeriod; ++c) {
      if (row[c] <= best.likeness) continue;
      if (is_near_row &&
          std::abs(Wrapped(c - without->col + kPeriod / 2) - kPeriod / 2) <= kOtherPlace_px) {
        continue;
      }
      best = {row[c], {r, c}};
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
        const Cell back = Unturned({-r, -c}, turn);
        values[i] *= a.inverse_norm[i] * b.inverse_norm[At(back.row, back.col)] * root_overlap[i];
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
  const Cell step = peaks[best].step;
  return {static_cast<int>(best), Vector2d(Signed(step.col), Signed(step.row)),
          std::min(kMaxDigits, kWorth * (peaks[best].likeness - next) / kLikenessPerDigit)};
}

// Squares of pixels of two pictures, cut out about spots.
double Correlation(const FloorPicture& a, const Cell& at_a, const FloorPicture& b, const Cell& at_b,
                   int turn) {
  double ab = 0, aa = 0, bb = 0;
  for (int r = -kSpotHalf_px; r <= kSpotHalf_px; ++r) {
    for (int c = -kSpotHalf_px; c <= kSpotHalf_px; ++c) {
      const Cell from = Unturned({at_b.row + r, at_b.col + c}, turn);
      const double x = a.contrast(at_a.row + r + kReach, at_a.col + c + kReach);
      const double y = b.contrast(from.row + kReach, from.col + kReach);
      ab += x * y;
      aa += x * x;
      bb += y * y;
    }
  }
  constexpr double kNumPixels = (2 * kSpotHalf_px + 1) * (2 * kSpotHalf_px + 1);
  if (std::min(aa, bb) < kMinSpotContrast * kNumPixels) return 0;
  return ab / std::sqrt(aa * bb);
}

bool IsAllShown(const Cell& at, int margin_px) {
  const double distance = std::hypot(at.row, at.col);
  return distance - margin_px > FloorPicture::kNearest && distance + margin_px < kReach;
}

// Where between −1 and 1 a parabola through three values has its top.
double Top(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? 0.5 * (before - after) / bend : 0;
}

std::optional<FloorSpot> FindSpot(const FloorPicture& a, const Cell& at_a, const FloorPicture& b,
                                  const Cell& expected, int turn) {
  constexpr int kSide = 2 * kSpotReach_px + 1;
  std::array<std::array<double, kSide>, kSide> values{};
  int best_row = 0, best_col = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const Cell at_b{expected.row + r - kSpotReach_px, expected.col + c - kSpotReach_px};
      double& value = values[static_cast<size_t>(r)][static_cast<size_t>(c)];
      value = Correlation(a, at_a, b, at_b, turn);
      if (value > values[static_cast<size_t>(best_row)][static_cast<size_t>(best_col)]) {
        best_row = r;
        best_col = c;
      }
    }
  }
  const size_t r = static_cast<size_t>(best_row), c = static_cast<size_t>(best_col);
  const bool is_inside = std::clamp(best_row, 1, kSide - 2) == best_row &&
                         std::clamp(best_col, 1, kSide - 2) == best_col;
  if (!is_inside || values[r][c] < kMinSpotCorrelation) return std::nullopt;
  const double row = expected.row + best_row - kSpotReach_px +
                     Top(values[r - 1][c], values[r][c], values[r + 1][c]);
  const double col = expected.col + best_col - kSpotReach_px +
                     Top(values[r][c - 1], values[r][c], values[r][c + 1]);
  FloorSpot spot{Vector2d(at_a.col, at_a.row), Vector2d(col, row)};
  for (int t = 0; t < turn; ++t) spot.b_px = Vector2d(spot.b_px.y(), -spot.b_px.x());
  return spot;
}

Eigen::Vector3f RayOfSpot(const Vector2d& at_px, const Gravity& gravity) {
  const Vector2d at = at_px / FloorPicture::kPixelsPerHeight;
  return (CamFromWalls(gravity) * WallViewFrame(kFloorWallView) * Vector3d(at.x(), at.y(), 1))
      .normalized()
      .cast<float>();
}

FloorMatch MakeMatch(const ViewPair& pair, const FloorPlace& place, const Gravity& gravity_a,
                     const Gravity& gravity_b) {
  const Vector2d step = place.step_px / FloorPicture::kPixelsPerHeight;
  const Vector3d in_walls = WallViewFrame(kFloorWallView) * Vector3d(step.x(), step.y(), 0);
  const Vector3d level = RotationZ(*gravity_a.heading_rad) * in_walls;
  return {pair.a_idx,
          pair.b_idx,
          WrapPi(*gravity_a.heading_rad - *gravity_b.heading_rad - place.turn * kPi / 2),
          level.head<2>(),
          place.digits,
          {}};
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
  for (const auto& [block, members] : blocks) {
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

std::vector<FloorSpot> FindFloorSpots(const FloorPicture& a, const FloorPicture& b,
                                      const FloorPlace& place) {
  std::vector<FloorSpot> spots;
  const int step_row = static_cast<int>(std::lround(place.step_px.y()));
  const int step_col = static_cast<int>(std::lround(place.step_px.x()));
  for (int r = -kReach; r <= kReach; r += kSpotSpacing_px) {
    for (int c = -kReach; c <= kReach; c += kSpotSpacing_px) {
      const Cell at_a{r, c}, at_b{r - step_row, c - step_col};
      constexpr int kMargin = 2 * kSpotHalf_px;
      if (!IsAllShown(at_a, kMargin) || !IsAllShown(at_b, kMargin + kSpotReach_px)) continue;
      const std::optional<FloorSpot> spot = FindSpot(a, at_a, b, at_b, place.turn);
      if (spot) spots.push_back(*spot);
    }
  }
  return spots;
}

std::vector<FloorMatch> MatchFloors(std::span<const FloorPicture> floors,
                                    std::span<const ViewPair> pairs,
                                    std::span<const Gravity> gravity, RunContext& context,
                                    std::vector<PanoFeatures>& features) {
  ENFILADE_CHECK(floors.size() == features.size() && gravity.size() == features.size());
  const std::vector<FloorPlace> places = PlaceFloors(floors, pairs, context);
  std::vector<FloorMatch> matches;
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (places[k].digits < kMinDigits) continue;
    const size_t a = static_cast<size_t>(pairs[k].a_idx), b = static_cast<size_t>(pairs[k].b_idx);
    FloorMatch match = MakeMatch(pairs[k], places[k], gravity[a], gravity[b]);
    for (const FloorSpot& spot : FindFloorSpots(floors[a], floors[b], places[k])) {
      match.spots.push_back({features[a].size(), features[b].size()});
      features[a].rays.push_back(RayOfSpot(spot.a_px, gravity[a]));
      features[b].rays.push_back(RayOfSpot(spot.b_px, gravity[b]));
    }
    matches.push_back(std::move(match));
  }
  return matches;
}

}  // namespace enfilade
