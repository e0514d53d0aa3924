// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/exchange/box_scene.h"

#include <Eigen/Geometry>
#include <random>
#include <string>

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int kNumViews = 6;
constexpr int kNumPoints = 300;
const Vector3d kSize(6, 4, 2.5);

// Numbers that are the same with every standard library, which distributions are not.
class Random {
 public:
  double Uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  // Sum of twelve uniform numbers (Irwin-Hall): mean 0, variance 1.
  double Normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += Uniform();
    return sum;
  }
  Vector3d NormalVector(double sigma) {
    const double x = Normal(), y = Normal(), z = Normal();
    return sigma * Vector3d(x, y, z);
  }

 private:
  std::mt19937_64 engine_{7};
};

View MakeView(int i, Random& random) {
  View view;
  view.picture = "pano " + std::to_string(i) + ".jpg";
  view.camera = EquirectangularCamera(2048, 1024);
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Vector3d tilt = random.NormalVector(0.05);
  view.world_from_cam.rotation =
      RotationZ(1.1 * i) * upright * Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).matrix();
  view.world_from_cam.translation = {1 + 4 * random.Uniform(), 1 + 2 * random.Uniform(),
                                     1.2 + 0.4 * random.Uniform()};
  return view;
}

Vector3d PointOnSide(int side, Random& random) {
  Vector3d point(random.Uniform(), random.Uniform(), random.Uniform());
  point[side / 2] = side % 2;
  return point.cwiseProduct(kSize);
}

}  // namespace

Scene MakeBoxScene(const BoxSceneOptions& options) {
  Random random;
  Scene scene;
  for (int i = 0; i < kNumViews; ++i) scene.views.push_back(MakeView(i, random));
  for (int p = 0; p < kNumPoints; ++p) {
    ScenePoint point;
    point.position = PointOnSide(p % 6, random);
    point.rgb = {static_cast<uint8_t>(p % 256), 100, 200};
    for (int i = 0; i < kNumViews; ++i) {
      const View& view = scene.views[static_cast<size_t>(i)];
      const Eigen::Vector2d pixel =
          *view.camera.PixelFromRay(view.world_from_cam.Inverse() * point.position);
      const double dx = options.pixel_sigma * random.Normal();
      const double dy = options.pixel_sigma * random.Normal();
      point.view_idx.push_back(i);
      point.pixels.push_back((pixel + Eigen::Vector2d(dx, dy)).cast<float>());
    }
    scene.points.push_back(point);
  }
  const double sigma_m = options.position_sigma_m;
  for (View& view : scene.views) view.world_from_cam.translation += random.NormalVector(sigma_m);
  for (ScenePoint& point : scene.points) point.position += random.NormalVector(sigma_m);
  return scene;
}

}  // namespace enfilade
