// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/model/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/sampling.h"
#include "enfilade/model/extrude.h"
#include "tests/support/plan_fixtures.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kWidth_px = 800, kHeight_px = 400;
constexpr const char* kRectangle = "0,0 4,0 4,3 0,3";
constexpr const char* kLShape = "0,0 5,0 5,2 2,2 2,4 0,4";

// The truth: every point of space has a colour, so that every texel's colour is known.
Vector3d ColourAt(const Vector3d& p) {
  return {128 + 60 * std::sin(2.1 * p.x() + 0.7 * p.z()),
          128 + 60 * std::sin(1.7 * p.y() - 1.1 * p.z()),
          128 + 60 * std::cos(1.3 * p.x() + 1.9 * p.y())};
}

// What a camera at `eye` sees of the room in a direction of the home frame.
Vector3d FirstHit(const Room& room, const Vector3d& eye, const Vector3d& direction) {
  const double horizontal = direction.head<2>().norm();
  double distance = std::numeric_limits<double>::infinity();
  if (horizontal > 1e-12) {
    const Vector2d heading = direction.head<2>() / horizontal;
    distance = RayDistance(room.polygon.outer, eye.head<2>(), heading) / horizontal;
    for (const Ring2& hole : room.polygon.holes) {
      distance = std::min(distance, RayDistance(hole, eye.head<2>(), heading) / horizontal);
    }
  }
  const double level = direction.z() > 0 ? room.ceiling_z : room.floor_z;
  if (direction.z() != 0) distance = std::min(distance, (level - eye.z()) / direction.z());
  return eye + distance * direction;
}

// A camera that looks along +y of the home frame, turned by `yaw_rad`.
Rigid3 UprightPose(const Vector3d& eye, double yaw_rad) {
  Eigen::Matrix3d axes;  // columns: camera right, down, forward
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return {RotationZ(yaw_rad) * axes, eye};
}

// A room, its pictures on disk and the scene that tells of them.
struct PaintedRoom {
  TempFolder folder;
  Floorplan plan;
  Scene scene;

  PaintedRoom(const Room& room, const std::vector<Vector3d>& eyes,
              const std::function<Vector3d(size_t view, const Vector2d& pixel,
                                           const Vector3d& colour)>& distort = {}) {
    plan = MakePlan({room});
    // The world differs from the home frame, as with real poses.
    plan.home_from_world = {RotationZ(0.3), Vector3d(0.5, -1, 0.2)};
    for (size_t v = 0; v < eyes.size(); ++v) {
      View view;
      view.picture = "view" + std::to_string(v) + ".png";
      view.path = folder / view.picture;
      view.camera = EquirectangularCamera(kWidth_px, kHeight_px);
      const Rigid3 home_from_cam = UprightPose(eyes[v], 1.1 * static_cast<double>(v));
      view.world_from_cam = plan.home_from_world.Inverse() * home_from_cam;
      ImageU8 picture(kHeight_px, kWidth_px, 3);
      for (int r = 0; r < kHeight_px; ++r) {
        for (int c = 0; c < kWidth_px; ++c) {
          const Vector2d pixel(c + 0.5, r + 0.5);
          const Vector3d ray = home_from_cam.rotation * view.camera.RayFromPixel(pixel);
          Vector3d colour = ColourAt(FirstHit(room, eyes[v], ray));
          if (distort) colour = distort(v, pixel, colour);
          for (int k = 0; k < 3; ++k) {
            picture(r, c, k) = static_cast<uint8_t>(std::clamp(colour[k] + 0.5, 0.0, 255.0));
          }
        }
      }
      WriteImage(view.path, picture);
      scene.views.push_back(view);
    }
  }

  [[nodiscard]] TextureResult Run(const TextureOptions& options, int num_threads = 2) const {
    RunContext context(num_threads);
    return TextureModel(scene, plan, ExtrudeFloorplan(plan), options, context);
  }
};

TextureOptions SmallOptions() { return {.texels_per_m = 50, .atlas_px = 512}; }

struct SurfaceSample {
  Vector3d point;
  Vector3d colour;
};

// Random points of a face with the colour that its texture gives them there.
std::vector<SurfaceSample> SampleFace(const TextureResult& result, const ModelFace& face) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const ImageU8& texture = result.model.textures.at(static_cast<size_t>(face.texture_idx));
  std::vector<SurfaceSample> samples;
  for (const std::array<int, 3>& t : face.triangles) {
    for (int i = 0; i < 400; ++i) {
      double a = uniform(random), b = uniform(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const auto mix = [&](const auto& values) {
        return ((1 - a - b) * values[t[0]] + a * values[t[1]] + b * values[t[2]]).eval();
      };
      const Vector2d texel = mix(face.uv).cwiseProduct(Vector2d(texture.cols(), texture.rows()));
      SurfaceSample sample{mix(face.vertices), {}};
      for (int k = 0; k < 3; ++k)
        sample.colour[k] = SampleBilinear(texture, texel.x(), texel.y(), k);
      samples.push_back(sample);
    }
  }
  return samples;
}

// Largest deviation from the truth over the channels, for samples that `counts` accepts, sorted.
std::vector<double> Errors(const TextureResult& result,
                           const std::function<bool(const Vector3d&)>& counts) {
  std::vector<double> errors;
  for (const ModelFace& face : result.model.faces) {
    for (const SurfaceSample& sample : SampleFace(result, face)) {
      if (!counts(sample.point)) continue;
      errors.push_back((sample.colour - ColourAt(sample.point)).cwiseAbs().maxCoeff());
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

double Quantile(const std::vector<double>& sorted, double share) {
  return sorted.at(static_cast<size_t>(share * static_cast<double>(sorted.size() - 1)));
}

bool Everywhere(const Vector3d&) { return true; }

TEST(TextureModel, EveryTexelHasTheColourOfItsPoint) {
  const PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}, {3, 2, 1.5}});
  const TextureResult result = painted.Run(SmallOptions());
  EXPECT_GT(result.seen_share, 0.999);
  EXPECT_NEAR(result.texels_per_m, 50, 1e-9);
  // A pixel covers 1–3 cm, over which the colour changes by about 3.
  const std::vector<double> errors = Errors(result, Everywhere);
  EXPECT_LT(Quantile(errors, 0.5), 1.0);
  EXPECT_LT(Quantile(errors, 0.99), 3.0);
  EXPECT_LT(errors.back(), 8.0);
}

TEST(TextureModel, FinePicturesAreAveragedNotAliased) {
  const PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}, {3, 2, 1.5}});
  TextureOptions options = SmallOptions();
  options.texels_per_m = 12;
  EXPECT_LT(Quantile(Errors(painted.Run(options), Everywhere), 0.99), 8.0);
}

TEST(TextureModel, HiddenPartsAreFilledAndSeenPartsAreRight) {
  // The camera in the L's foot sees nothing of the walls behind the corner.
  const Room room = MakeRoom(0, kLShape);
  const PaintedRoom painted(room, {{4, 1, 1.4}});
  const TextureResult result = painted.Run(SmallOptions());
  EXPECT_LT(result.seen_share, 0.85);
  EXPECT_GT(result.seen_share, 0.65);
  const auto is_seen = [](const Vector3d& p) {
    // Hidden is what lies beyond the line of sight past the corner (2, 2); the stand hides the
    // floor below the camera.
    const bool is_hidden = p.x() <= 2 && p.y() > 1 + (4 - p.x()) / 2 - 0.1;
    return !is_hidden && (p.head<2>() - Vector2d(4, 1)).norm() > 0.6;
  };
  EXPECT_LT(Quantile(Errors(result, is_seen), 0.99), 4.0);
  for (const ModelFace& face : result.model.faces) {
    for (const SurfaceSample& sample : SampleFace(result, face)) {
      EXPECT_GT(sample.colour.minCoeff(), 40) << sample.point.transpose();
    }
  }
}

TEST(TextureModel, ColumnsHideWhatIsBehindThem) {
  const Room room = MakeRoom(0, "0,0 6,0 6,4 0,4", {"2.5,1.5 2.5,2.5 3.5,2.5 3.5,1.5"});
  const PaintedRoom painted(room, {{1, 1, 1.4}, {5, 3, 1.4}});
  const TextureResult result = painted.Run(SmallOptions());
  EXPECT_LT(Quantile(Errors(result, Everywhere), 0.98), 5.0);
}

TEST(TextureModel, ExposureIsEqualised) {
  const Vector3d factor(1.25, 1.1, 0.9);
  const auto expose = [&](size_t view, const Vector2d&, const Vector3d& colour) -> Vector3d {
    return view == 0 ? Vector3d(colour.cwiseProduct(factor)) : colour;
  };
  const PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}, {3, 2, 1.5}, {2, 1.5, 1.4}},
                            expose);
  const TextureResult result = painted.Run(SmallOptions());
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(result.gains[1][k] / result.gains[0][k], factor[k], 0.02);
    EXPECT_NEAR(result.gains[1][k] / result.gains[2][k], 1, 0.02);
  }
  TextureOptions options = SmallOptions();
  options.equalise_exposure = false;
  for (const Vector3d& gain : painted.Run(options).gains) EXPECT_EQ(gain, Vector3d::Ones());
}

TEST(TextureModel, StandAndMaskAreNotUsed) {
  const auto paint = [](size_t view, const Vector2d& pixel, const Vector3d& colour) -> Vector3d {
    const bool is_stand = pixel.y() > 0.92 * kHeight_px;
    const bool is_photographer = view == 0 && pixel.x() > 300 && pixel.x() < 360;
    return is_stand || is_photographer ? Vector3d(255, 0, 0) : colour;
  };
  PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}, {3, 2, 1.5}}, paint);
  ImageU8 mask(kHeight_px, kWidth_px, 1, 255);
  for (int r = 0; r < kHeight_px; ++r) {
    for (int c = 298; c < 362; ++c) mask(r, c) = 0;
  }
  WriteImage(painted.folder / "mask.png", mask);
  painted.scene.views[0].mask_path = painted.folder / "mask.png";
  const std::vector<double> errors = Errors(painted.Run(SmallOptions()), Everywhere);
  EXPECT_LT(Quantile(errors, 0.99), 4.0);
  EXPECT_LT(errors.back(), 12.0);
}

TEST(TextureModel, SameBytesForAnyNumberOfThreads) {
  const PaintedRoom painted(MakeRoom(0, kLShape), {{1, 1, 1.4}, {4, 1, 1.5}, {1, 3, 1.4}});
  const TextureResult one = painted.Run(SmallOptions(), 1), three = painted.Run(SmallOptions(), 3);
  ASSERT_EQ(one.model.textures.size(), three.model.textures.size());
  for (size_t i = 0; i < one.model.textures.size(); ++i) {
    EXPECT_EQ(one.model.textures[i].data(), three.model.textures[i].data());
  }
}

TEST(TextureModel, ResolutionFollowsTheBoundOnTexels) {
  const PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}});
  TextureOptions options = SmallOptions();
  options.max_megatexels = 0.02;
  const TextureResult result = painted.Run(options);
  const double area_m2 = 2 * 12 + 14 * 2.4;
  EXPECT_NEAR(result.texels_per_m, std::sqrt(2e4 / area_m2), 0.01);
}

TEST(TextureModel, UnseenRoomsGetTheColourOfLikeSurfaces) {
  PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}, {3, 2, 1.4}});
  painted.plan = [&] {
    Floorplan plan = MakePlan({MakeRoom(0, kRectangle), MakeRoom(1, "5,0 6,0 6,3 5,3")});
    plan.home_from_world = painted.plan.home_from_world;
    return plan;
  }();
  const TextureResult result = painted.Run(SmallOptions());
  for (const ModelFace& face : result.model.faces) {
    if (face.room_id != 1) continue;
    const std::vector<SurfaceSample> samples = SampleFace(result, face);
    for (const SurfaceSample& sample : samples) {
      EXPECT_NEAR((sample.colour - samples[0].colour).norm(), 0, 1e-3);
      EXPECT_GT(sample.colour.minCoeff(), 60);
    }
  }
}

TEST(TextureModel, NoViewsLeaveTheModelWithoutTextures) {
  const PaintedRoom painted(MakeRoom(0, kRectangle), {});
  const TextureResult result = painted.Run(SmallOptions());
  EXPECT_TRUE(result.model.textures.empty());
  EXPECT_TRUE(result.model.faces[0].uv.empty());
}

TEST(TextureModel, BrokenPicturesAreNamed) {
  PaintedRoom painted(MakeRoom(0, kRectangle), {{1, 1, 1.4}});
  WriteImage(painted.scene.views[0].path, ImageU8(16, 32, 3));
  EXPECT_THROW((void)painted.Run(SmallOptions()), InvalidInputError);
  WriteFileAtomic(painted.scene.views[0].path, "no picture");
  EXPECT_THROW((void)painted.Run(SmallOptions()), InvalidInputError);
  std::filesystem::remove(painted.scene.views[0].path);
  EXPECT_THROW((void)painted.Run(SmallOptions()), IoError);
}

}  // namespace
}  // namespace enfilade
