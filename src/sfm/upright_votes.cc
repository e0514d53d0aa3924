// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/upright_votes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/image.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kNumYaws = 360;
constexpr int kNumDirections = 180;
constexpr size_t kNumCandidates = 60;
// Level part of the normal of a match's plane from which its vote counts fully, and below which the
// direction that it allows is too vague to be one.
constexpr double kFullVote = 0.15;
constexpr double kLeastVote = 0.02;
// Maxima this near to a better one are the same.
constexpr int kNear = 3;

// The level direction from a to b that a match allows when b is turned already; zero for none.
Vector2d AllowedDirection(const Vector3d& a, const Vector3d& b, double* vote) {
  const Vector3d normal = a.cross(b);
  const double level = std::hypot(normal.x(), normal.y());
  *vote = std::min(1.0, level / kFullVote);
  if (level < kLeastVote) return Vector2d::Zero();
  const Vector3d direction(normal.y() / level, -normal.x() / level, 0);
  // The point lies in front of b where direction × b looks along the normal, and in front of a
  // where a × direction looks against it.
  const double in_front_b = direction.cross(b).dot(normal);
  const double in_front_a = -a.cross(direction).dot(normal);
  if (in_front_a > 0 && in_front_b > 0) return direction.head<2>();
  if (in_front_a < 0 && in_front_b < 0) return -direction.head<2>();
  return Vector2d::Zero();
}

int Wrap(int i, int size) { return ((i % size) + size) % size; }

// Sums over 3 × 3 bins, round in both directions.
ImageF Smooth(const ImageF& votes) {
  ImageF smooth(votes.rows(), votes.cols());
  for (int r = 0; r < votes.rows(); ++r) {
    for (int c = 0; c < votes.cols(); ++c) {
      float sum = 0;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          sum += votes(Wrap(r + dr, votes.rows()), Wrap(c + dc, votes.cols()));
        }
      }
      smooth(r, c) = sum;
    }
  }
  return smooth;
}

}  // namespace

std::vector<TwoViewGeometry> VoteUpright(std::span<const UprightVote> matches,
                                         const YawRange& yaws) {
  ImageF votes(kNumYaws, kNumDirections);
  for (int yaw_idx = 0; yaw_idx < kNumYaws; ++yaw_idx) {
    const double yaw = 2 * kPi * yaw_idx / kNumYaws;
    if (std::abs(WrapPi(yaw - yaws.center_rad)) > yaws.reach_rad) continue;
    const double cosine = std::cos(yaw), sine = std::sin(yaw);
    for (const auto& [a, b, weight] : matches) {
      const Vector3d turned(cosine * b.x() - sine * b.y(), sine * b.x() + cosine * b.y(), b.z());
      double vote = 0;
      const Vector2d direction = AllowedDirection(a, turned, &vote);
      if (direction.isZero()) continue;
      const double azimuth = std::atan2(direction.y(), direction.x());
      const int bin =
          Wrap(static_cast<int>(std::floor(azimuth / (2 * kPi) * kNumDirections)), kNumDirections);
      votes(yaw_idx, bin) += static_cast<float>(weight * vote);
    }
  }
  const ImageF smooth = Smooth(votes);

  struct Peak {
    float height;
    int yaw_idx, direction_idx;
  };
  std::vector<Peak> peaks;
  for (int r = 0; r < kNumYaws; ++r) {
    for (int c = 0; c < kNumDirections; ++c) {
      if (smooth(r, c) > 0) peaks.push_back({smooth(r, c), r, c});
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& x, const Peak& y) { return x.height > y.height; });
  const auto is_near = [](int i, int j, int size) {
    const int apart = std::abs(i - j);
    return std::min(apart, size - apart) <= kNear;
  };
  std::vector<Peak> chosen;
  for (const Peak& peak : peaks) {
    const bool is_taken = std::any_of(chosen.begin(), chosen.end(), [&](const Peak& other) {
      return is_near(peak.yaw_idx, other.yaw_idx, kNumYaws) &&
             is_near(peak.direction_idx, other.direction_idx, kNumDirections);
    });
    if (is_taken) continue;
    chosen.push_back(peak);
    if (chosen.size() == kNumCandidates) break;
  }
  std::vector<TwoViewGeometry> candidates;
  for (const Peak& peak : chosen) {
    const double yaw = 2 * kPi * peak.yaw_idx / kNumYaws;
    const double azimuth = 2 * kPi * (peak.direction_idx + 0.5) / kNumDirections;
    candidates.push_back({Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix(),
                          {std::cos(azimuth), std::sin(azimuth), 0}});
  }
  return candidates;
}

}  // namespace enfilade
