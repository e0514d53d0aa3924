// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/gravity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/pose_errors.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::IsEmpty;

const Vector3d kExpectedUp(0, -1, 0);

// Camera frame from a level frame with x right, y forward, z up, for a camera that leans.
Matrix3d CamFromLevel(double tilt_rad, double axis_azimuth_rad) {
  Matrix3d cam_from_level;
  cam_from_level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Vector3d axis(std::cos(axis_azimuth_rad), std::sin(axis_azimuth_rad), 0);
  return cam_from_level * Eigen::AngleAxisd(tilt_rad, axis).toRotationMatrix();
}

// Lines seen by one camera, in its level frame (camera at the origin, camera heights).
class MadeLines {
 public:
  MadeLines(const Matrix3d& cam_from_level, double noise_rad, uint32_t seed)
      : cam_from_level_(cam_from_level), noise_rad_(noise_rad), random_(seed) {}

  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  void Add(const Vector3d& from, const Vector3d& to) { segments.push_back({Seen(from), Seen(to)}); }
  // Door frames and corners all round.
  void AddVerticals(int count) {
    for (int i = 0; i < count; ++i) AddVerticalAt(Between(-kPi, kPi));
  }
  void AddVerticalAt(double azimuth_rad) {
    const double distance = Between(1, 3);
    const Vector3d foot(distance * std::cos(azimuth_rad), distance * std::sin(azimuth_rad), 0);
    const double low = Between(-0.9, -0.3);
    Add(foot + low * Vector3d::UnitZ(), foot + (low + Between(0.5, 1.4)) * Vector3d::UnitZ());
  }
  // Rafters, handrails and pictures that hang askew: 3° to 30° off the vertical.
  void AddSlanted(int count) {
    for (int i = 0; i < count; ++i) {
      const double azimuth = Between(-kPi, kPi), lean = DegToRad(Between(3, 30));
      const double around = Between(-kPi, kPi);
      const Vector3d foot(2 * std::cos(azimuth), 2 * std::sin(azimuth), -0.5);
      Add(foot, foot + Vector3d(std::sin(lean) * std::cos(around),
                                std::sin(lean) * std::sin(around), std::cos(lean)));
    }
  }
  void AddHorizontal(int count) {
    for (int i = 0; i < count; ++i) {
      const double azimuth = Between(-kPi, kPi), around = Between(-kPi, kPi);
      const Vector3d middle(2 * std::cos(azimuth), 2 * std::sin(azimuth), Between(-1, 0.7));
      Add(middle, middle + Vector3d(std::cos(around), std::sin(around), 0));
    }
  }
  std::vector<LineSegment> segments;

 private:
  Vector3d Seen(const Vector3d& point) {
    std::normal_distribution<double> normal(0, noise_rad_);
    const Vector3d noise = noise_rad_ > 0
                               ? Vector3d(normal(random_), normal(random_), normal(random_))
                               : Vector3d::Zero();
    return (cam_from_level_ * (point.normalized() + noise)).normalized();
  }

  Matrix3d cam_from_level_;
  double noise_rad_;
  std::mt19937 random_;
};

double ErrorOf_deg(const Gravity& gravity, const Matrix3d& cam_from_level) {
  return RadToDeg(AngleBetween(gravity.up_in_cam, cam_from_level.col(2)));
}

// The expected direction pulls a little; the header allows some thousandths of a degree.
TEST(FindGravity, IsExactWithoutNoise) {
  for (const double tilt_deg : {0.0, 1.0, 5.0, 10.0}) {
    for (int axis = 0; axis < 8; ++axis) {
      const Matrix3d cam_from_level = CamFromLevel(DegToRad(tilt_deg), axis * kPi / 4);
      MadeLines lines(cam_from_level, 0, 1);
      lines.AddVerticals(12);
      const Gravity gravity = FindGravity(lines.segments, kExpectedUp);
      EXPECT_LT(ErrorOf_deg(gravity, cam_from_level), 0.005) << tilt_deg << "° about axis " << axis;
      EXPECT_EQ(gravity.num_lines, 12);
      EXPECT_NEAR(gravity.up_in_cam.norm(), 1, 1e-12);
    }
  }
}

// Ends err by 0.05°, so that planes of lines of 10° to 60° err by 0.4° to 0.07°, and 40 of them
// together by some hundredths of a degree.
TEST(FindGravity, StandsNoise) {
  for (uint32_t seed = 1; seed <= 50; ++seed) {
    const Matrix3d cam_from_level = CamFromLevel(DegToRad(seed % 11), 0.7 * seed);
    MadeLines lines(cam_from_level, DegToRad(0.05), seed);
    lines.AddVerticals(40);
    lines.AddHorizontal(50);
    EXPECT_LT(ErrorOf_deg(FindGravity(lines.segments, kExpectedUp), cam_from_level), 0.1)
        << "seed " << seed;
  }
}

// Lines that slant by a few degrees, or by more but towards the camera, are hardly to be told from
// vertical ones that err, so they may pull a little.
TEST(FindGravity, StandsSlantedLines) {
  for (uint32_t seed = 1; seed <= 50; ++seed) {
    const Matrix3d cam_from_level = CamFromLevel(DegToRad(seed % 11), 0.7 * seed);
    MadeLines lines(cam_from_level, DegToRad(0.05), seed);
    lines.AddSlanted(30);
    lines.AddVerticals(40);
    lines.AddHorizontal(50);
    const Gravity gravity = FindGravity(lines.segments, kExpectedUp);
    EXPECT_LT(ErrorOf_deg(gravity, cam_from_level), 0.15) << "seed " << seed;
    EXPECT_LT(ErrorOf_deg(gravity, cam_from_level), 3 * RadToDeg(gravity.sigma_rad));
    EXPECT_LT(RadToDeg(gravity.sigma_rad), 0.5);
  }
}

// The lines fix the vertical across their plane; along it the expected one decides.
TEST(FindGravity, OnePlaneOfLinesLeavesTheRestAsExpected) {
  for (const double tilt_deg : {0.0, 4.0, 8.0}) {
    // Lines ahead and behind, the camera leans sideways and nods.
    const Matrix3d cam_from_level = CamFromLevel(DegToRad(tilt_deg), 0.8);
    MadeLines lines(cam_from_level, 0, 1);
    for (int i = 0; i < 10; ++i) lines.AddVerticalAt(i % 2 == 0 ? kPi / 2 : -kPi / 2);
    const Gravity gravity = FindGravity(lines.segments, kExpectedUp);
    const Vector3d normal = lines.segments.front().Normal();
    const Vector3d nearest = (kExpectedUp - normal * normal.dot(kExpectedUp)).normalized();
    EXPECT_LT(RadToDeg(AngleBetween(gravity.up_in_cam, nearest)), 0.01) << tilt_deg;
  }
}

TEST(FindGravity, FewerThanThreeLinesTellNothing) {
  for (int count = 0; count < 3; ++count) {
    MadeLines lines(CamFromLevel(DegToRad(5), 0), 0, 1);
    lines.AddVerticals(count);
    lines.AddHorizontal(20);
    // Levels seen end on could pass for verticals: keep those that are clearly none.
    std::erase_if(lines.segments, [](const LineSegment& segment) {
      const double off = std::abs(segment.Normal().dot(kExpectedUp));
      return off > std::sin(DegToRad(7)) && off < std::sin(DegToRad(25));
    });
    const Gravity gravity = FindGravity(lines.segments, kExpectedUp);
    EXPECT_EQ(gravity.up_in_cam, kExpectedUp);
    EXPECT_NEAR(RadToDeg(gravity.sigma_rad), 2, 1e-9);
    EXPECT_EQ(gravity.num_lines, 0);
  }
}

TEST(FindGravity, TheOrderAndSenseOfSegmentsDoNotMatter) {
  const Matrix3d cam_from_level = CamFromLevel(DegToRad(3), 1);
  MadeLines lines(cam_from_level, DegToRad(0.1), 7);
  lines.AddVerticals(20);
  lines.AddSlanted(10);
  const Gravity gravity = FindGravity(lines.segments, kExpectedUp);
  std::vector<LineSegment> turned(lines.segments.rbegin(), lines.segments.rend());
  for (LineSegment& segment : turned) std::swap(segment.from, segment.to);
  EXPECT_LT(AngleBetween(FindGravity(turned, kExpectedUp).up_in_cam, gravity.up_in_cam), 1e-9);
}

// A camera that leans far is found from what its metadata tell; where they tell what the stitcher
// has taken out already, the lines are believed.
TEST(FindGravityOfPicture, TriesWhatIsTold) {
  const Matrix3d leaning = CamFromLevel(DegToRad(25), 0.5);
  MadeLines lines(leaning, DegToRad(0.05), 3);
  lines.AddVerticals(30);
  const Matrix3d nearly = CamFromLevel(DegToRad(23), 0.6);
  const Vector3d told = nearly.col(2);
  EXPECT_LT(ErrorOf_deg(FindGravityOfPicture(lines.segments, told), leaning), 0.1);
  const Matrix3d level = CamFromLevel(DegToRad(0.5), 0.5);
  MadeLines levelled(level, DegToRad(0.05), 3);
  levelled.AddVerticals(30);
  EXPECT_LT(ErrorOf_deg(FindGravityOfPicture(levelled.segments, told), level), 0.1);
  const Gravity untold = FindGravityOfPicture(levelled.segments, std::nullopt);
  EXPECT_EQ(untold.up_in_cam, FindGravity(levelled.segments, kExpectedUp).up_in_cam);
}

TEST(FindGravityOfPicture, WithoutLinesWhatIsToldIsAllThereIs) {
  const Vector3d told = CamFromLevel(DegToRad(7), 1).col(2);
  const Gravity gravity = FindGravityOfPicture({}, told);
  EXPECT_EQ(gravity.up_in_cam, told);
  EXPECT_NEAR(RadToDeg(gravity.sigma_rad), 2, 1e-9);
}

TEST(FindGravityOfPicture, TellsCamerasMountedHeadDown) {
  const Matrix3d over = Vector3d(-1, -1, 1).asDiagonal() * CamFromLevel(DegToRad(2), 1);
  MadeLines lines(over, DegToRad(0.05), 3);
  lines.AddVerticals(30);
  EXPECT_LT(ErrorOf_deg(FindGravityOfPicture(lines.segments, Vector3d(0, 1, 0)), over), 0.1);
  EXPECT_GT(ErrorOf_deg(FindGravityOfPicture(lines.segments, std::nullopt), over), 179.9);
}

TEST(LineSegment, LengthAndNormal) {
  const LineSegment segment{Vector3d::UnitX(), Vector3d(1, 1, 0).normalized()};
  EXPECT_NEAR(segment.Length_rad(), kPi / 4, 1e-12);
  EXPECT_LT((segment.Normal() - Vector3d::UnitZ()).norm(), 1e-12);
}

// The shortest turn upright leaves the picture's centre at azimuth 90° when the camera only nods or
// only leans; when it does both, by an angle t about an axis between, the centre moves by t²/4.
// Half a turn about the viewing direction comes first, so that the centre stays at +y.
TEST(LevelFromCam, TurnsCamerasMountedHeadDown) {
  const Matrix3d cam_from_level = CamFromLevel(DegToRad(3), 0.7);
  const Matrix3d over = Vector3d(-1, -1, 1).asDiagonal() * cam_from_level;
  Gravity upright, turned;
  upright.up_in_cam = cam_from_level.col(2);
  turned.up_in_cam = over.col(2);
  const Matrix3d expected =
      LevelFromCam(upright) * Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix();
  EXPECT_TRUE(LevelFromCam(turned).isApprox(expected, 1e-12));
}

TEST(LevelFromCam, TurnsUpToZAndTheCentreToY) {
  for (const double tilt_deg : {0.0, 2.0, 10.0}) {
    for (int axis = 0; axis < 8; ++axis) {
      const double tilt_rad = DegToRad(tilt_deg);
      Gravity gravity;
      gravity.up_in_cam = CamFromLevel(tilt_rad, axis * kPi / 4).col(2);
      const Matrix3d level_from_cam = LevelFromCam(gravity);
      EXPECT_LT((level_from_cam.transpose() * level_from_cam - Matrix3d::Identity()).norm(), 1e-12);
      EXPECT_NEAR(level_from_cam.determinant(), 1, 1e-12);
      EXPECT_LT((level_from_cam * gravity.up_in_cam - Vector3d::UnitZ()).norm(), 1e-12);
      const Vector3d centre = level_from_cam.col(2);
      const double bound_rad = axis % 2 == 0 ? 1e-9 : 1.01 * tilt_rad * tilt_rad / 4 + 1e-9;
      EXPECT_NEAR(std::atan2(centre.y(), centre.x()), kPi / 2, bound_rad);
    }
  }
}

constexpr int kHeight = 512, kWidth = 2 * kHeight;

// Bars from the nadir to the zenith; true edges at the returned columns.
ImageU8 DrawBars(int channels, std::vector<int>* edges) {
  ImageU8 panorama(kHeight, kWidth, channels, 220);
  // Widths and gaps of their own, one across the border of the picture.
  for (const auto& [from, to] : {std::pair{60, 90},
                                 {170, 185},
                                 {300, 340},
                                 {430, 452},
                                 {560, 600},
                                 {700, 730},
                                 {850, 865},
                                 {1010, 1040}}) {
    for (int x = from; x < to; ++x) {
      for (int y = 0; y < kHeight; ++y) {
        for (int c = 0; c < channels; ++c) panorama(y, x % kWidth, c) = 40;
      }
    }
    edges->push_back(from);
    edges->push_back(to % kWidth);
  }
  return panorama;
}

TEST(FindLineSegments, FindsBothEdgesOfVerticalBars) {
  const Camera camera = EquirectangularCamera(kWidth, kHeight);
  const ImageU8 trusted(kHeight, kWidth, 1, 255);
  for (const int channels : {1, 3}) {
    std::vector<int> edges;
    const ImageU8 panorama = DrawBars(channels, &edges);
    const std::vector<LineSegment> segments = FindLineSegments(panorama, trusted, camera);
    std::vector<double> longest_rad(edges.size(), 0);
    for (const LineSegment& segment : segments) {
      // A pixel is 0.35°, half of one over lines of 30° and more is below 0.3°.
      EXPECT_LT(RadToDeg(std::asin(std::abs(segment.Normal().y()))), 0.3);
      EXPECT_GE(RadToDeg(segment.Length_rad()), 3);
      const Vector3d middle = (segment.from + segment.to).normalized();
      const double x = camera.PixelFromRay(middle)->x();
      double nearest_px = kWidth;
      for (size_t i = 0; i < edges.size(); ++i) {
        const double apart_px = std::abs(std::remainder(x - edges[i], kWidth));
        nearest_px = std::min(nearest_px, apart_px);
        if (apart_px < 1) longest_rad[i] = std::max(longest_rad[i], segment.Length_rad());
      }
      EXPECT_LT(nearest_px, 1) << "at column " << x;
    }
    for (size_t i = 0; i < edges.size(); ++i) {
      EXPECT_GT(RadToDeg(longest_rad[i]), 30) << "edge at column " << edges[i];
    }
    const Gravity gravity = FindGravity(segments, kExpectedUp);
    EXPECT_LT(RadToDeg(AngleBetween(gravity.up_in_cam, kExpectedUp)), 0.1);
  }
}

TEST(FindLineSegments, LeavesOutWhatIsNotTrusted) {
  const Camera camera = EquirectangularCamera(kWidth, kHeight);
  std::vector<int> edges;
  const ImageU8 panorama = DrawBars(1, &edges);
  EXPECT_THAT(FindLineSegments(panorama, ImageU8(kHeight, kWidth, 1, 0), camera), IsEmpty());
  ImageU8 right_half(kHeight, kWidth, 1, 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth / 2; x < kWidth; ++x) right_half(y, x) = 255;
  }
  const std::vector<LineSegment> segments = FindLineSegments(panorama, right_half, camera);
  EXPECT_GE(segments.size(), 7u);
  for (const LineSegment& segment : segments) {
    EXPECT_GT((segment.from + segment.to).x(), 0);  // right of the centre
  }
}

TEST(FindLineSegments, APlainPictureHasNone) {
  const Camera camera = EquirectangularCamera(kWidth, kHeight);
  const ImageU8 plain(kHeight, kWidth, 3, 128), trusted(kHeight, kWidth, 1, 255);
  EXPECT_THAT(FindLineSegments(plain, trusted, camera), IsEmpty());
}

TEST(FindLineSegments, RefusesPicturesOfAnotherSize) {
  const Camera camera = EquirectangularCamera(kWidth, kHeight);
  const ImageU8 panorama(kHeight, kWidth, 3, 128), trusted(kHeight, kWidth, 1, 255);
  const ImageU8 small(kHeight / 2, kWidth / 2, 1, 255);
  EXPECT_THROW((void)FindLineSegments(panorama, small, camera), std::logic_error);
  EXPECT_THROW((void)FindLineSegments(small, trusted, camera), std::logic_error);
}

TEST(FindLineSegments, RefusesPinholeCameras) {
  const ImageU8 picture(64, 128), trusted(64, 128, 1, 255);
  EXPECT_THROW((void)FindLineSegments(picture, trusted, PinholeCamera(128, 64, 60, 60, 64, 32)),
               std::logic_error);
}

}  // namespace
}  // namespace enfilade
