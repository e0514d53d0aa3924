// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/structured3d.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "enfilade/geometry/angles.h"
#include "src/evaluate/point_matching.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
constexpr int kSize_px = 256;
constexpr double kMargin = 0.1;
constexpr int kErosion_px = 5;
constexpr double kMinIou = 0.5;
constexpr double kCornerReach_px = 10;
constexpr double kAngleReach_deg = 5;
constexpr int kUnmatched = -1;

using PixelRing = std::vector<cv::Point>;

struct PixelRoom {
  PixelRing ring;
  cv::Mat mask;  // 0 or 1
};

struct Extent {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d max = -min;
};

Extent PaddedExtent(const JudgedPlan& plan) {
  Extent extent;
  for (const JudgedRoom& room : plan.rooms) {
    for (const Polygon2& part : room.region) {
      for (const Vector2d& p : part.outer) {
        extent.min = extent.min.cwiseMin(p);
        extent.max = extent.max.cwiseMax(p);
      }
    }
  }
  const Vector2d size = extent.max - extent.min;
  extent.min -= kMargin * size;
  extent.max += kMargin * size;
  return extent;
}

const Ring2& LargestRing(const JudgedRoom& room) {
  return std::max_element(room.region.begin(), room.region.end(),
                          [](const Polygon2& a, const Polygon2& b) { return Area(a) < Area(b); })
      ->outer;
}

// Counter-clockwise in x right, y up; corners that fall on one pixel are one.
PixelRing ToPixels(Ring2 ring, const Extent& extent) {
  if (SignedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
  PixelRing pixels;
  for (const Vector2d& p : ring) {
    const Vector2d scaled = ((p - extent.min).cwiseQuotient(extent.max - extent.min) * kSize_px)
                                .cwiseMax(0.0)
                                .cwiseMin(kSize_px - 1.0);
    const cv::Point pixel(static_cast<int>(std::lround(scaled.x())),
                          static_cast<int>(std::lround(scaled.y())));
    if (pixels.empty() || pixels.back() != pixel) pixels.push_back(pixel);
  }
  if (pixels.size() > 1 && pixels.front() == pixels.back()) pixels.pop_back();
  return pixels;
}

std::vector<PixelRoom> Rasterize(const JudgedPlan& plan, const Extent& extent) {
  std::vector<PixelRoom> rooms;
  for (const JudgedRoom& room : plan.rooms) {
    if (room.region.empty()) continue;
    PixelRoom raster{ToPixels(LargestRing(room), extent),
                     cv::Mat::zeros(kSize_px, kSize_px, CV_8U)};
    cv::fillPoly(raster.mask, std::vector<PixelRing>{raster.ring}, cv::Scalar(1));
    rooms.push_back(std::move(raster));
  }
  return rooms;
}

double MaskIou(const cv::Mat& a, const cv::Mat& b) {
  // One more in the union, as the users of the protocol have it against empty masks.
  return cv::countNonZero(a & b) / (cv::countNonZero(a | b) + 1.0);
}

// For each result room the index of the true room that takes it.
std::vector<int> TakeRooms(const std::vector<PixelRoom>& result,
                           const std::vector<PixelRoom>& truth) {
  std::vector<size_t> order(truth.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return cv::countNonZero(truth[a].mask) > cv::countNonZero(truth[b].mask);
  });
  std::vector<int> taken_by(result.size(), kUnmatched);
  for (const size_t t : order) {
    double best_iou = kMinIou;
    int best = kUnmatched;
    for (size_t r = 0; r < result.size(); ++r) {
      const double iou = MaskIou(result[r].mask, truth[t].mask);
      if (iou > best_iou) {
        best_iou = iou;
        best = static_cast<int>(r);
      }
    }
    if (best != kUnmatched && taken_by[static_cast<size_t>(best)] == kUnmatched) {
      taken_by[static_cast<size_t>(best)] = static_cast<int>(t);
    }
  }
  return taken_by;
}

void DropOverlapping(const std::vector<PixelRoom>& rooms, std::vector<int>& taken_by) {
  const cv::Mat kernel = cv::Mat::ones(kErosion_px, kErosion_px, CV_8U);
  std::vector<cv::Mat> eroded(rooms.size());
  for (size_t i = 0; i < rooms.size(); ++i) cv::erode(rooms[i].mask, eroded[i], kernel);
  for (size_t i = 0; i < rooms.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (cv::countNonZero(eroded[i] & eroded[j]) == 0) continue;
      taken_by[i] = kUnmatched;
      taken_by[j] = kUnmatched;
    }
  }
}

double Distance(const cv::Point& a, const cv::Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// How far the counter-clockwise ring turns left at its i-th corner.
double Turn_deg(const PixelRing& ring, size_t i) {
  const cv::Point in = ring[i] - ring[(i + ring.size() - 1) % ring.size()];
  const cv::Point out = ring[(i + 1) % ring.size()] - ring[i];
  return RadToDeg(WrapPi(std::atan2(out.y, out.x) - std::atan2(in.y, in.x)));
}

struct CornerHits {
  int corners = 0;
  int angles = 0;
};

CornerHits CompareCorners(const PixelRing& result, const PixelRing& truth) {
  std::vector<bool> is_corner(result.size(), false), is_angle(result.size(), false);
  for (size_t t = 0; t < truth.size(); ++t) {
    const auto nearest =
        std::min_element(result.begin(), result.end(), [&](const cv::Point& a, const cv::Point& b) {
          return Distance(a, truth[t]) < Distance(b, truth[t]);
        });
    if (Distance(*nearest, truth[t]) > kCornerReach_px) continue;
    const size_t r = static_cast<size_t>(nearest - result.begin());
    is_corner[r] = true;
    is_angle[r] = std::abs(Turn_deg(result, r) - Turn_deg(truth, t)) <= kAngleReach_deg;
  }
  return {static_cast<int>(std::count(is_corner.begin(), is_corner.end(), true)),
          static_cast<int>(std::count(is_angle.begin(), is_angle.end(), true))};
}

size_t CountCorners(const std::vector<PixelRoom>& rooms) {
  size_t count = 0;
  for (const PixelRoom& room : rooms) count += room.ring.size();
  return count;
}

}  // namespace

Structured3dFigures EvaluateStructured3d(const JudgedPlan& result, const JudgedPlan& truth) {
  if (result.rooms.empty() || truth.rooms.empty()) return {};
  const Extent extent = PaddedExtent(truth);
  const std::vector<PixelRoom> rooms = Rasterize(result, extent);
  const std::vector<PixelRoom> truth_rooms = Rasterize(truth, extent);
  std::vector<int> taken_by = TakeRooms(rooms, truth_rooms);
  DropOverlapping(rooms, taken_by);
  int room_hits = 0, corner_hits = 0, angle_hits = 0;
  for (size_t r = 0; r < rooms.size(); ++r) {
    if (taken_by[r] == kUnmatched) continue;
    const CornerHits hits =
        CompareCorners(rooms[r].ring, truth_rooms[static_cast<size_t>(taken_by[r])].ring);
    ++room_hits;
    corner_hits += hits.corners;
    angle_hits += hits.angles;
  }
  const size_t corners = CountCorners(rooms), truth_corners = CountCorners(truth_rooms);
  return {F1(room_hits, rooms.size(), truth_rooms.size()), F1(corner_hits, corners, truth_corners),
          F1(angle_hits, corners, truth_corners)};
}

}  // namespace enfilade
