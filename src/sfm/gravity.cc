// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/gravity.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/scene/virtual_view.h"
#include "src/sfm/pixel_of_ray.h"
#include "src/sfm/view_ring.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMinLength_rad = DegToRad(3);
// Segments that lean more than this from the expected vertical are no candidates.
constexpr double kMaxLean_rad = DegToRad(20);
constexpr std::array<double, 6> kLossScales_rad = {DegToRad(6),   DegToRad(3),    DegToRad(1.5),
                                                   DegToRad(0.7), DegToRad(0.35), DegToRad(0.2)};
constexpr int kIterationsPerScale = 4;
constexpr double kUnknownSigma_rad = DegToRad(2);
// Lines of one door frame err alike, so the mean of many is not as good as its scatter says.
constexpr double kMinSigma_rad = DegToRad(0.1);
constexpr int kMinLines = 3;
// Weight of the expected direction beside the lengths of the lines: decides where all lines lie in
// one plane, and turns no direction that lines tell by more than some thousandths of a degree.
constexpr double kExpectedWeight_rad = 1e-3;

struct Line {
  Vector3d normal;
  double length_rad;
};

std::vector<Line> NearVertical(std::span<const LineSegment> segments, const Vector3d& up) {
  std::vector<Line> lines;
  for (const LineSegment& segment : segments) {
    const Vector3d normal = segment.Normal();
    const bool is_near = std::abs(normal.dot(up)) < std::sin(kMaxLean_rad);
    if (is_near) lines.push_back({normal, segment.Length_rad()});
  }
  return lines;
}

// Weighted scatter of the normals.
Matrix3d Scatter(std::span<const Line> lines, const Vector3d& up, double scale_rad) {
  Matrix3d scatter = Matrix3d::Zero();
  for (const Line& line : lines) {
    const double residual = line.normal.dot(up) / scale_rad;
    scatter += line.length_rad / (1 + residual * residual) * line.normal * line.normal.transpose();
  }
  return scatter;
}

// The direction most orthogonal to the normals, on the side of `up`.
Vector3d MostOrthogonal(const Matrix3d& scatter, const Vector3d& up) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(scatter);
  const Vector3d direction = solver.eigenvectors().col(0);
  return direction.dot(up) < 0 ? Vector3d(-direction) : direction;
}

}  // namespace

double LineSegment::Length_rad() const { return std::atan2(from.cross(to).norm(), from.dot(to)); }

std::vector<LineSegment> FindLineSegments(const ImageU8& panorama, const ImageU8& trusted,
                                          const Camera& camera) {
  ENFILADE_CHECK(panorama.rows() == camera.height && panorama.cols() == camera.width);
  ENFILADE_CHECK(trusted.rows() == camera.height && trusted.cols() == camera.width);
  const ViewRing ring = MakeViewRing(camera);
  const cv::Ptr<cv::LineSegmentDetector> detector = cv::createLineSegmentDetector();
  std::vector<LineSegment> segments;
  for (size_t k = 0; k < ring.pano_from_view.size(); ++k) {
    const ImageU8 view = RenderVirtualView(panorama, camera, ring.camera, ring.pano_from_view[k]);
    const cv::Mat picture(view.rows(), view.cols(), CV_8UC(view.channels()),
                          const_cast<uint8_t*>(view.data().data()));
    cv::Mat gray = picture;
    if (view.channels() == 3) cv::cvtColor(picture, gray, cv::COLOR_RGB2GRAY);
    std::vector<cv::Vec4f> found;
    detector->detect(gray, found);
    for (const cv::Vec4f& line : found) {
      const auto ray = [&](float x, float y) {
        return Vector3d(ring.pano_from_view[k] * ring.camera.RayFromPixel({x + 0.5, y + 0.5}));
      };
      const LineSegment segment{ray(line[0], line[1]), ray(line[2], line[3])};
      const Vector3d middle = (segment.from + segment.to).normalized();
      if (segment.Length_rad() >= kMinLength_rad && ring.Owns(static_cast<int>(k), middle) &&
          *PixelOfRay(trusted, camera, middle) != 0) {
        segments.push_back(segment);
      }
    }
  }
  return segments;
}

Gravity FindGravity(std::span<const LineSegment> segments, const Vector3d& expected_up) {
  const std::vector<Line> lines = NearVertical(segments, expected_up);
  Gravity gravity;
  gravity.up_in_cam = expected_up;
  gravity.sigma_rad = kUnknownSigma_rad;
  if (lines.size() < kMinLines) return gravity;
  Vector3d up = expected_up;
  const Matrix3d expected = kExpectedWeight_rad * (Matrix3d::Identity() - up * up.transpose());
  for (const double scale_rad : kLossScales_rad) {
    for (int i = 0; i < kIterationsPerScale; ++i) {
      up = MostOrthogonal(Scatter(lines, up, scale_rad) + expected, up);
    }
  }
  const double bound_rad = 2 * kLossScales_rad.back();
  const auto agrees = [&](const Line& line) { return std::abs(line.normal.dot(up)) < bound_rad; };
  const int num_lines = static_cast<int>(std::count_if(lines.begin(), lines.end(), agrees));
  const bool is_near = up.dot(expected_up) > std::cos(kMaxLean_rad);
  if (num_lines < kMinLines || !is_near) return gravity;
  gravity.up_in_cam = up;
  gravity.sigma_rad = std::max(kMinSigma_rad, bound_rad / std::sqrt(num_lines));
  gravity.num_lines = num_lines;
  return gravity;
}

Gravity FindGravityOfPicture(std::span<const LineSegment> segments,
                             const std::optional<Vector3d>& told_up) {
  const Gravity near_picture = FindGravity(segments, {0, -1, 0});
  if (!told_up) return near_picture;
  const Gravity near_told = FindGravity(segments, *told_up);
  return near_told.num_lines >= near_picture.num_lines ? near_told : near_picture;
}

Matrix3d LevelFromCam(const Gravity& gravity) {
  Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  // Head down: half a turn about the viewing direction comes first, as a half-turn about a level
  // axis could be about any.
  if (gravity.up_in_cam.y() > 0) upright.leftCols<2>() *= -1;
  return Eigen::Quaterniond::FromTwoVectors(upright * gravity.up_in_cam, Vector3d::UnitZ()) *
         upright;
}

}  // namespace enfilade
