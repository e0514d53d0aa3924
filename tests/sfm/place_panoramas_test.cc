// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/place_panoramas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/write_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

// A made home, its panoramas on disk and what is to be found.
class PlacePanoramasTest : public testing::Test {
 protected:
  void Make(double tilt_deg) {
    HomeOptions options;
    options.seed = 5;
    options.preset = HomePreset::kRoom;
    options.tilt_deg = tilt_deg;
    home = MakeHome(options);
    WriteHomeOptions writing;
    writing.width = 1024;
    WriteHome(temp.path(), home, writing, context);
  }

  // The pictures without poses, in the order of the home's cameras.
  Scene Pictures() const {
    Scene scene;
    for (const HomeCamera& camera : home.cameras) {
      View view;
      view.picture = camera.picture;
      view.path = temp.path() / "panos" / camera.picture;
      view.sha256 = Sha256OfFile(view.path);
      const ImageSize size = ReadImageSize(view.path);
      view.camera = EquirectangularCamera(size.width, size.height);
      scene.views.push_back(view);
    }
    scene.camera_height_m = HeightOfCameras();
    return scene;
  }

  double HeightOfCameras() const {
    double sum = 0;
    for (const HomeCamera& camera : home.cameras) {
      sum += camera.home_from_cam.translation.z() - home.RoomById(camera.room_id).floor_z;
    }
    return sum / static_cast<double>(home.cameras.size());
  }

  // Writes a picture anew, its rows and columns in reverse order where asked for.
  void Flip(int camera_idx, bool flip_rows, bool flip_cols) const {
    const fs::path path =
        temp.path() / "panos" / home.cameras[static_cast<size_t>(camera_idx)].picture;
    const ImageU8 picture = ReadImageRgb(path);
    const int rows = picture.rows(), cols = picture.cols();
    ImageU8 flipped(rows, cols, 3);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < cols; ++c) {
        for (int k = 0; k < 3; ++k) {
          flipped(r, c, k) = picture(flip_rows ? rows - 1 - r : r, flip_cols ? cols - 1 - c : c, k);
        }
      }
    }
    WriteImage(path, flipped);
  }

  double TrueDistance() const {
    return (home.WorldFromCamera(0).translation - home.WorldFromCamera(1).translation).norm();
  }
  static double FoundDistance(const Scene& scene) {
    return (scene.views[0].world_from_cam.translation - scene.views[1].world_from_cam.translation)
        .norm();
  }

  // OpenCV's features, so that the test is the same where COLMAP is installed.
  PlaceReport Place(Scene& scene, RunContext& with, const std::string& known_distance = "") const {
    PlaceOptions options;
    options.features.source = FeatureSource::kOpenCv;
    options.scale.known_distance = known_distance;
    return PlacePanoramas(options, {temp.path() / "sfm", program, {}}, with, scene);
  }

  double WorstTilt_deg(const Scene& scene) const {
    double worst = 0;
    for (size_t i = 0; i < scene.views.size(); ++i) {
      const Eigen::Vector3d up = scene.views[i].world_from_cam.rotation.row(2);
      const Eigen::Vector3d true_up = home.WorldFromCamera(static_cast<int>(i)).rotation.row(2);
      worst = std::max(worst, RadToDeg(std::atan2(up.cross(true_up).norm(), up.dot(true_up))));
    }
    return worst;
  }

  fs::path KeptFile(const View& view) const {
    return temp.path() / "sfm" / "features" / (view.sha256.substr(0, 16) + ".bin");
  }

  TempFolder temp;
  std::string program = "1";
  Home home;
  RunContext context{2};
};

TEST_F(PlacePanoramasTest, PlacesTheCamerasOfARoom) {
  Make(0);
  ASSERT_EQ(home.cameras.size(), 2U);
  Scene scene = Pictures();
  const PlaceReport report = Place(scene, context);
  ASSERT_EQ(scene.views[1].component_idx, 0);
  // Few features lie on this floor, and some on baseboards: the scale of two pictures is that good.
  EXPECT_NEAR(FoundDistance(scene), TrueDistance(), 0.12 * TrueDistance());
  EXPECT_LT(WorstTilt_deg(scene), 0.1);
  EXPECT_GE(scene.points.size(), 40U);
  for (const ScenePoint& point : scene.points) {
    ASSERT_EQ(point.pixels.size(), point.view_idx.size());
    for (size_t k = 0; k < point.pixels.size(); ++k) {
      const View& view = scene.views[static_cast<size_t>(point.view_idx[k])];
      const Eigen::Vector3d to_point = view.world_from_cam.Inverse() * point.position;
      const Eigen::Vector3d ray = view.camera.RayFromPixel(point.pixels[k].cast<double>());
      EXPECT_LT(ray.cross(to_point.normalized()).norm(), 0.01);
    }
  }
}

TEST_F(PlacePanoramasTest, FindsTheTiltOfCameras) {
  Make(5);
  Scene scene = Pictures();
  static_cast<void>(Place(scene, context));
  EXPECT_LT(WorstTilt_deg(scene), 0.2);
}

TEST_F(PlacePanoramasTest, TurnsOverWhatStandsUpsideDown) {
  Make(2);
  Flip(1, true, true);
  Scene scene = Pictures();
  const PlaceReport report = Place(scene, context);
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr(home.cameras[1].picture +
                                                                    " stands upside down beside " +
                                                                    home.cameras[0].picture)));
  ASSERT_EQ(scene.views[1].component_idx, 0);
  EXPECT_NEAR(FoundDistance(scene), TrueDistance(), 0.12 * TrueDistance());
  const Eigen::Vector3d up = scene.views[1].world_from_cam.rotation.row(2);
  const Eigen::Vector3d true_up = home.WorldFromCamera(1).rotation.row(2);
  EXPECT_LT(RadToDeg(up.cross(Eigen::Vector3d(-1, -1, 1).cwiseProduct(true_up)).norm()), 0.2);
  EXPECT_GT(up.y(), 0.99);
}

TEST_F(PlacePanoramasTest, NamesWhatIsMirrored) {
  Make(0);
  Flip(1, false, true);
  Scene scene = Pictures();
  const PlaceReport report = Place(scene, context);
  EXPECT_THAT(report.warnings,
              testing::Contains(testing::HasSubstr(home.cameras[1].picture + " is mirrored")));
  EXPECT_EQ(scene.views[1].component_idx, 1);
}

TEST_F(PlacePanoramasTest, TakesAKnownDistance) {
  Make(0);
  Scene scene = Pictures();
  scene.camera_height_m.reset();
  const std::string pictures = home.cameras[0].picture + "," + home.cameras[1].picture;
  static_cast<void>(Place(scene, context, pictures + ",3.25"));
  EXPECT_NEAR(FoundDistance(scene), 3.25, 0.001);
  EXPECT_EQ(scene.scale_source, ScaleSource::kKnownDistance);
  Flip(1, false, true);
  Scene untied = Pictures();
  EXPECT_THROW(static_cast<void>(Place(untied, context, pictures + ",3.25")), InvalidInputError);
}

TEST_F(PlacePanoramasTest, IsTheSameForAnyNumberOfThreads) {
  Make(0);
  RunContext one(1);
  Scene with_two = Pictures(), with_one = Pictures();
  static_cast<void>(Place(with_two, context));
  static_cast<void>(Place(with_one, one));
  for (size_t i = 0; i < with_one.views.size(); ++i) {
    EXPECT_EQ(with_one.views[i].world_from_cam.Matrix(), with_two.views[i].world_from_cam.Matrix());
  }
  ASSERT_EQ(with_one.points.size(), with_two.points.size());
  for (size_t i = 0; i < with_one.points.size(); ++i) {
    EXPECT_EQ(with_one.points[i].position, with_two.points[i].position);
  }
}

TEST_F(PlacePanoramasTest, PutsASinglePictureAtTheCameraHeight) {
  Make(0);
  Scene scene = Pictures();
  scene.views.resize(1);
  static_cast<void>(Place(scene, context));
  EXPECT_NEAR(scene.views[0].world_from_cam.translation.z(), HeightOfCameras(), 1e-9);
  EXPECT_EQ(scene.views[0].component_idx, 0);
}

// What an earlier run saw of a picture is used; what is damaged or of another program is not.
TEST_F(PlacePanoramasTest, GoesOnWhereItWasStopped) {
  Make(0);
  Scene first = Pictures();
  static_cast<void>(Place(first, context));
  const fs::path whole = KeptFile(first.views[0]), damaged = KeptFile(first.views[1]);
  const std::string bytes_of_whole = ReadFile(whole), bytes_of_damaged = ReadFile(damaged);
  const fs::file_time_type time = fs::last_write_time(whole);
  WriteFileAtomic(damaged, bytes_of_damaged.substr(0, bytes_of_damaged.size() / 2));
  Scene again = Pictures();
  static_cast<void>(Place(again, context));
  EXPECT_EQ(fs::last_write_time(whole), time);
  EXPECT_EQ(ReadFile(damaged), bytes_of_damaged);
  for (size_t i = 0; i < first.views.size(); ++i) {
    EXPECT_EQ(again.views[i].world_from_cam.Matrix(), first.views[i].world_from_cam.Matrix());
  }
  program = "2";
  static_cast<void>(Place(again, context));
  EXPECT_NE(ReadFile(whole), bytes_of_whole);
}

}  // namespace
}  // namespace enfilade
