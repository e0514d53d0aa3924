// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/component_heading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr double kMinNormal = 0.25;  // level and vertical part of a plane's normal
constexpr int kNumBins = 180;        // of half a degree
constexpr double kBin_rad = kPi / 2 / kNumBins;
constexpr int kReach = 4;
constexpr double kNear_rad = DegToRad(2);
constexpr double kMinShare = 0.25;
constexpr int kIterations = 5;

}  // namespace

std::vector<LevelLine> LevelLines(std::span<const LineSegment> segments,
                                  const Eigen::Matrix3d& world_from_cam) {
  std::vector<LevelLine> lines;
  for (const LineSegment& segment : segments) {
    const Eigen::Vector3d normal = world_from_cam * segment.Normal();
    const double level = std::hypot(normal.x(), normal.y());
    if (level < kMinNormal || std::abs(normal.z()) < kMinNormal) continue;
    lines.push_back({std::atan2(-normal.x(), normal.y()), level * segment.Length_rad()});
  }
  return lines;
}

std::optional<double> FindHeading(std::span<const LevelLine> lines) {
  std::array<double, kNumBins> votes{};
  for (const LevelLine& line : lines) {
    const int bin = static_cast<int>((WrapQuarter(line.azimuth_rad) + kPi / 4) / kBin_rad);
    for (int k = -kReach; k <= kReach; ++k) {
      votes[static_cast<size_t>((bin + k + kNumBins) % kNumBins)] +=
          line.weight * (kReach + 1 - std::abs(k));
    }
  }
  const auto peak = std::max_element(votes.begin(), votes.end());
  if (*peak <= 0) return std::nullopt;
  double heading = -kPi / 4 + (static_cast<double>(peak - votes.begin()) + 0.5) * kBin_rad;
  for (int i = 0; i < kIterations; ++i) {
    double weight = 0, sum = 0;
    for (const LevelLine& line : lines) {
      const double apart = WrapQuarter(line.azimuth_rad - heading);
      if (std::abs(apart) > kNear_rad) continue;
      weight += line.weight;
      sum += line.weight * apart;
    }
    if (weight > 0) heading += sum / weight;
  }
  double near = 0, all = 0;
  for (const LevelLine& line : lines) {
    all += line.weight;
    if (std::abs(WrapQuarter(line.azimuth_rad - heading)) <= kNear_rad) near += line.weight;
  }
  if (near < kMinShare * all) return std::nullopt;
  return WrapQuarter(heading);
}

}  // namespace enfilade
