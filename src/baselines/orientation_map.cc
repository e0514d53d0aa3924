// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/orientation_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/scene/surface_label.h"
#include "enfilade/structure/level_panorama.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Closer to a vanishing point a line has no direction of its own.
constexpr double kNearVanishing = 0.1;

// 1 + the axis whose vanishing point an edge with this gradient points to; 0 for none or several.
uint8_t AxisOfEdge(const LevelPixels& sphere, int row, int col, double to_right, double to_bottom,
                   double max_sine) {
  const Vector3d p = sphere.Direction(row, col);
  const double level = std::hypot(p.x(), p.y());
  if (level < 1e-6) return 0;
  const Vector3d east(-p.y() / level, p.x() / level, 0);
  const Vector3d up = p.cross(east);
  // Columns are narrower on the sphere than rows by cos(elevation).
  const Vector3d gradient = (to_right / level) * east - to_bottom * up;
  const double size = gradient.norm();
  if (size <= 0) return 0;
  uint8_t found = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d along = Vector3d::Unit(axis) - p[axis] * p;
    if (along.norm() < kNearVanishing) continue;
    if (std::abs(gradient.dot(along)) > max_sine * size * along.norm()) continue;
    if (found != 0) return 0;
    found = static_cast<uint8_t>(1 + axis);
  }
  return found;
}

// Takes out connected lines (8 neighbours, round the azimuth) shorter than the bound.
void DropShortLines(const LevelPixels& sphere, double min_length_rad, ImageU8& lines) {
  ImageU8 done(sphere.rows, sphere.cols);
  std::vector<std::pair<int, int>> line;
  for (int r0 = 0; r0 < sphere.rows; ++r0) {
    for (int c0 = 0; c0 < sphere.cols; ++c0) {
      if (lines(r0, c0) == 0 || done(r0, c0) != 0) continue;
      done(r0, c0) = 1;
      line.assign(1, {r0, c0});
      for (size_t i = 0; i < line.size(); ++i) {
        const auto [r, c] = line[i];
        for (int row = std::max(0, r - 1); row <= std::min(sphere.rows - 1, r + 1); ++row) {
          for (int k = -1; k <= 1; ++k) {
            const int col = (c + k + sphere.cols) % sphere.cols;
            if (done(row, col) != 0 || lines(row, col) != lines(r0, c0)) continue;
            done(row, col) = 1;
            line.emplace_back(row, col);
          }
        }
      }
      // The farthest from the first pixel, and the farthest from that.
      Vector3d end = sphere.Direction(r0, c0);
      double least = 1;
      for (int round = 0; round < 2; ++round) {
        const Vector3d from = end;
        least = 1;
        for (const auto& [r, c] : line) {
          const Vector3d to = sphere.Direction(r, c);
          if (from.dot(to) >= least) continue;
          least = from.dot(to);
          end = to;
        }
      }
      if (std::acos(std::clamp(least, -1.0, 1.0)) >= min_length_rad) continue;
      for (const auto& [r, c] : line) lines(r, c) = 0;
    }
  }
}

ImageU8 FindLines(const LevelPixels& sphere, const ImageU8& rgb,
                  const OrientationMapOptions& options) {
  const cv::Mat colour(rgb.rows(), rgb.cols(), CV_8UC3, const_cast<uint8_t*>(rgb.data().data()));
  cv::Mat gray, right, bottom, edges;
  cv::cvtColor(colour, gray, cv::COLOR_RGB2GRAY);
  if (gray.cols != sphere.cols)
    cv::resize(gray, gray, cv::Size(sphere.cols, sphere.rows), 0, 0, cv::INTER_AREA);
  // Beyond the seam the picture goes on.
  const int margin = 8;
  cv::Mat wide;
  cv::hconcat(std::vector<cv::Mat>{gray.colRange(gray.cols - margin, gray.cols), gray,
                                   gray.colRange(0, margin)},
              wide);
  cv::GaussianBlur(wide, wide, cv::Size(), 1);
  cv::Sobel(wide, right, CV_16S, 1, 0);
  cv::Sobel(wide, bottom, CV_16S, 0, 1);
  cv::Canny(right, bottom, edges, options.weak_edge, options.strong_edge, true);
  const double max_sine = std::sin(DegToRad(options.max_angle_deg));
  ImageU8 lines(sphere.rows, sphere.cols);
  for (int r = 0; r < sphere.rows; ++r) {
    for (int c = 0; c < sphere.cols; ++c) {
      if (edges.at<uint8_t>(r, c + margin) == 0) continue;
      lines(r, c) = AxisOfEdge(sphere, r, c, right.at<int16_t>(r, c + margin),
                               bottom.at<int16_t>(r, c + margin), max_sine);
    }
  }
  DropShortLines(sphere, DegToRad(options.min_length_deg), lines);
  return lines;
}

// Which lines, swept towards and away from an axis, pass each pixel: bit k for lines along axis k.
ImageU8 Sweep(const LevelPixels& sphere, const ImageU8& lines, int axis) {
  // Meridians about the axis, each from its vanishing point to the opposite one.
  const LevelPixels polar{sphere.rows, sphere.cols};
  const Vector3d pole = Vector3d::Unit(axis), first = Vector3d::Unit((axis + 1) % 3),
                 second = Vector3d::Unit((axis + 2) % 3);
  const auto to_home = [&](const Vector3d& p) {
    return Vector3d(p.x() * first + p.y() * second + p.z() * pole);
  };
  ImageU8 along(polar.rows, polar.cols), passed(polar.rows, polar.cols);
  for (int r = 0; r < polar.rows; ++r) {
    for (int c = 0; c < polar.cols; ++c) {
      const auto [row, col] = sphere.At(to_home(polar.Direction(r, c)));
      // Lines are one pixel wide: the pixel above and the one beside count too.
      const uint8_t near[] = {lines(row, col), lines(std::max(0, row - 1), col),
                              lines(row, col > 0 ? col - 1 : sphere.cols - 1)};
      const auto* found =
          std::find_if(std::begin(near), std::end(near), [](uint8_t line) { return line != 0; });
      if (found != std::end(near) && *found != 1 + axis) along(r, c) = *found;
    }
  }
  for (int c = 0; c < polar.cols; ++c) {
    for (const bool is_down : {true, false}) {
      uint8_t last = 0;
      for (int i = 0; i < polar.rows; ++i) {
        const int r = is_down ? i : polar.rows - 1 - i;
        if (along(r, c) != 0) last = along(r, c);
        if (last != 0) passed(r, c) |= static_cast<uint8_t>(1 << (last - 1));
      }
    }
  }
  ImageU8 result(sphere.rows, sphere.cols);
  for (int r = 0; r < sphere.rows; ++r) {
    for (int c = 0; c < sphere.cols; ++c) {
      const Vector3d p = sphere.Direction(r, c);
      const auto [row, col] = polar.At({p.dot(first), p.dot(second), p.dot(pole)});
      result(r, c) = passed(row, col);
    }
  }
  return result;
}

}  // namespace

OrientationMap MapOrientations(const ImageU8& rgb, const OrientationMapOptions& options) {
  ENFILADE_CHECK(rgb.channels() == 3 && rgb.cols() == 2 * rgb.rows() && rgb.rows() >= 8);
  const int cols = std::min(rgb.cols(), options.width / 2 * 2);
  const LevelPixels sphere{cols / 2, cols};
  OrientationMap map{FindLines(sphere, rgb, options), ImageU8(sphere.rows, sphere.cols),
                     ImageU8(sphere.rows, sphere.cols)};
  std::array<ImageU8, 3> passed;
  for (int axis = 0; axis < 3; ++axis)
    passed[static_cast<size_t>(axis)] = Sweep(sphere, map.lines, axis);
  for (int r = 0; r < sphere.rows; ++r) {
    for (int c = 0; c < sphere.cols; ++c) {
      const auto is_passed = [&](int line, int towards) {
        return (passed[static_cast<size_t>(towards)](r, c) >> line & 1) != 0;
      };
      int count = 0;
      for (int across = 0; across < 3; ++across) {
        const int i = (across + 1) % 3, j = (across + 2) % 3;
        if (!is_passed(i, j) || !is_passed(j, i)) continue;
        ++count;
        map.orientation(r, c) = static_cast<uint8_t>(1 + across);
      }
      if (count != 1) map.orientation(r, c) = 0;
      if (map.orientation(r, c) == 0) continue;
      const SurfaceLabel label = map.orientation(r, c) != 3 ? SurfaceLabel::kWall
                                 : 2 * r < sphere.rows      ? SurfaceLabel::kCeiling
                                                            : SurfaceLabel::kFloor;
      map.labels(r, c) = static_cast<uint8_t>(label);
    }
  }
  return map;
}

}  // namespace enfilade
