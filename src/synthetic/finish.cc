// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/finish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "enfilade/geometry/angles.h"
#include "src/synthetic/random.h"

namespace enfilade {
namespace {

using Eigen::Vector3f;

// A number in [0, 1) for a cell of an endless grid.
float CellValue(uint64_t seed, int64_t i, int64_t j) {
  const uint64_t bits =
      ScatterBits(seed ^ ScatterBits(static_cast<uint64_t>(i) * 0x8DA6B343u ^
                                     (static_cast<uint64_t>(j) * 0xD8163841u << 20)));
  return static_cast<float>(bits >> 40) * 0x1.0p-24f;
}

// The values at the corners of a cell of the grid.
struct alignas(32) NoiseCell {
  uint64_t seed = 0;
  int32_t i = std::numeric_limits<int32_t>::min(), j = 0;  // none yet
  float low[2] = {0, 0}, high[2] = {0, 0};
};

// Neighbouring rays ask for the same cells, and most of the time would go into their values: each
// thread remembers some.
const NoiseCell& CellAt(uint64_t seed, int32_t i, int32_t j) {
  constexpr size_t kNumRemembered = 256;
  thread_local std::array<NoiseCell, kNumRemembered> remembered;
  const uint64_t slot = seed + 3 * static_cast<uint64_t>(i) + 37 * static_cast<uint64_t>(j);
  NoiseCell& cell = remembered[slot % kNumRemembered];
  if (cell.seed != seed || cell.i != i || cell.j != j) {
    cell = {seed,
            i,
            j,
            {CellValue(seed, i, j), CellValue(seed, i + 1, j)},
            {CellValue(seed, i, j + 1), CellValue(seed, i + 1, j + 1)}};
  }
  return cell;
}

// Value noise in [−1, 1] with cells of size one, smooth; |x|, |y| < 2³¹.
float Noise(uint64_t seed, float x, float y) {
  auto i = static_cast<int32_t>(x), j = static_cast<int32_t>(y);
  i -= x < static_cast<float>(i) ? 1 : 0;  // the floor
  j -= y < static_cast<float>(j) ? 1 : 0;
  const NoiseCell& cell = CellAt(seed, i, j);
  float a = x - static_cast<float>(i), b = y - static_cast<float>(j);
  a = a * a * (3 - 2 * a);
  b = b * b * (3 - 2 * b);
  const float low = (1 - a) * cell.low[0] + a * cell.low[1];
  const float high = (1 - a) * cell.high[0] + a * cell.high[1];
  return 2 * ((1 - b) * low + b * high) - 1;
}

float Plaster(uint64_t seed, float u, float v) {
  return 1 + 0.006f * Noise(seed, u / 0.35f, v / 0.35f) +
         0.006f * Noise(seed + 1, u / 0.06f, v / 0.06f) +
         0.006f * Noise(seed + 2, u / 0.012f, v / 0.012f);
}

// On real walls pictures show about twice what plaster does.
float OrangePeel(uint64_t seed, float u, float v) {
  return 1 + 0.008f * Noise(seed, u / 0.35f, v / 0.35f) +
         0.013f * Noise(seed + 1, u / 0.06f, v / 0.06f) +
         0.013f * Noise(seed + 2, u / 0.016f, v / 0.016f);
}

float Carpet(uint64_t seed, float u, float v) {
  return 1 + 0.05f * Noise(seed, u / 0.4f, v / 0.4f) +
         0.08f * Noise(seed + 1, u / 0.035f, v / 0.035f) +
         0.14f * Noise(seed + 2, u / 0.009f, v / 0.009f);
}

float Grain(uint64_t seed, float along, float across) {
  return 1 + 0.10f * Noise(seed, along / 0.5f, across / 0.018f) +
         0.07f * Noise(seed + 1, along / 0.16f, across / 0.006f);
}

float Planks(uint64_t seed, float u, float v) {
  constexpr float kWidth_m = 0.14f, kLength_m = 1.3f, kGap_m = 0.0025f;
  const float row = std::floor(v / kWidth_m);
  const float shifted = u + kLength_m * CellValue(seed, static_cast<int64_t>(row), 7);
  const float piece = std::floor(shifted / kLength_m);
  const float across = v - row * kWidth_m, along = shifted - piece * kLength_m;
  if (std::min(across, kWidth_m - across) < kGap_m || std::min(along, kLength_m - along) < kGap_m)
    return 0.60f;
  const float shade = CellValue(seed + 1, static_cast<int64_t>(row), static_cast<int64_t>(piece));
  const uint64_t own = seed + 13 * static_cast<uint64_t>(static_cast<int64_t>(row) * 64 +
                                                         static_cast<int64_t>(piece));
  return (0.84f + 0.32f * shade) * Grain(own, along, across);
}

float Tiles(uint64_t seed, float u, float v) {
  constexpr float kSize_m = 0.33f, kGrout_m = 0.003f;
  const float i = std::floor(u / kSize_m), j = std::floor(v / kSize_m);
  const float a = u - i * kSize_m, b = v - j * kSize_m;
  if (std::min(std::min(a, kSize_m - a), std::min(b, kSize_m - b)) < kGrout_m) return 0.75f;
  const float shade = CellValue(seed, static_cast<int64_t>(i), static_cast<int64_t>(j));
  return (0.96f + 0.08f * shade) * (1 + 0.03f * Noise(seed + 1, u / 0.09f, v / 0.05f));
}

}  // namespace

Vector3f ReflectanceAt(const Surface& surface, float u, float v) {
  float pattern = 1;
  switch (surface.finish) {
    case Finish::kPaint:
      pattern = Plaster(surface.seed, u, v);
      break;
    case Finish::kOrangePeel:
      pattern = OrangePeel(surface.seed, u, v);
      break;
    case Finish::kCarpet:
      pattern = Carpet(surface.seed, u, v);
      break;
    case Finish::kPlanks:
      pattern = Planks(surface.seed, u, v);
      break;
    case Finish::kTiles:
      pattern = Tiles(surface.seed, u, v);
      break;
    case Finish::kWood:
      // Grain runs along the longer side.
      pattern = surface.extent.x() > surface.extent.y() ? Grain(surface.seed, u, v)
                                                        : Grain(surface.seed, v, u);
      break;
    case Finish::kFabric:
      pattern = 1 + 0.07f * Noise(surface.seed, u / 0.01f, v / 0.01f);
      break;
    case Finish::kPlain:
    case Finish::kMirror:
      break;
  }
  return pattern * surface.rgb;
}

Vector3f SkyRadiance(const Vector3f& direction) {
  const auto azimuth =
      static_cast<float>(std::atan2(direction.y(), direction.x()) / kPi);  // wraps at ±1
  const float elevation = std::asin(std::clamp(direction.z(), -1.0f, 1.0f));
  const float treetops =
      0.06f + 0.03f * Noise(5, 24 * azimuth, 0) + 0.02f * Noise(6, 110 * azimuth, 0);
  if (elevation > treetops) {
    const float height = std::clamp(elevation / 1.2f, 0.0f, 1.0f);
    return (1 - height) * Vector3f(1.75f, 1.8f, 1.85f) + height * Vector3f(1.1f, 1.3f, 1.6f);
  }
  if (elevation > -0.03f) {
    return (1 + 0.35f * Noise(7, 260 * azimuth, 60 * elevation)) * Vector3f(0.17f, 0.22f, 0.12f);
  }
  return (1 + 0.12f * Noise(8, 90 * azimuth, 25 * elevation)) * Vector3f(0.38f, 0.40f, 0.31f);
}

}  // namespace enfilade
