// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "enfilade/base/hash.h"
#include "enfilade/image/codec.h"
#include "enfilade/sfm/place_panoramas.h"
#include "tests/sfm/pose_errors.h"
#include "tests/sfm/rendered_film.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

// The first metre of a walk at 10 frames a second, each frame 3 % brighter than the one before up
// to the middle and darker from there.
class PlaceFilmTest : public testing::Test {
 protected:
  static constexpr int kNumFrames = 12, kEvery = 3;

  static double TrueExposure(int frame) {
    return std::pow(1.03, std::min(frame, kNumFrames - 1 - frame));
  }

  void SetUp() override {
    film = RenderFilm(5, kEvery * (kNumFrames - 1) + 1, CameraModel::kEquirectangular);
    for (int f = 0; f < kNumFrames; ++f) {
      View view;
      // Names without leading zeros: the order is that of the numbers.
      view.picture = fmt::format("frame_{}.png", f);
      view.path = temp.path() / view.picture;
      WriteImage(view.path, TimesGain(film.frames[static_cast<size_t>(kEvery * f)].rgb,
                                      0.8 * TrueExposure(f)));
      view.sha256 = Sha256OfFile(view.path);
      view.camera = film.camera;
      scene.views.push_back(view);
    }
    // A scene's order says nothing about the film's.
    std::reverse(scene.views.begin(), scene.views.end());
  }

  int FrameOf(const View& view) const { return std::stoi(view.picture.substr(6)); }

  TempFolder temp;
  RenderedFilm film;
  Scene scene;
  RunContext context{2};
};

TEST_F(PlaceFilmTest, PlacesKeyframesAndTellsTheirExposure) {
  PlaceOptions options;
  options.is_ordered = true;
  options.follow.keyframes.min_parallax_deg = 2;
  options.features.source = FeatureSource::kOpenCv;
  const PlaceReport report =
      PlacePanoramas(options, {temp.path() / "sfm", "test", {}}, context, scene);
  ASSERT_GE(scene.views.size(), 3U);
  ASSERT_LT(scene.views.size(), static_cast<size_t>(kNumFrames));
  ASSERT_EQ(report.exposures.size(), scene.views.size());
  std::vector<Rigid3> found, truth;
  double found_m = 0, true_m = 0;
  for (size_t i = 0; i < scene.views.size(); ++i) {
    const View& view = scene.views[i];
    const int frame = FrameOf(view);
    EXPECT_EQ(view.component_idx, 0) << view.picture;
    EXPECT_NEAR(report.exposures[i], TrueExposure(frame) / TrueExposure(0), 0.02) << view.picture;
    found.push_back(view.world_from_cam);
    truth.push_back(film.frames[static_cast<size_t>(kEvery * frame)].home_from_cam);
    found_m += (found.back().translation - found.front().translation).norm();
    true_m += (truth.back().translation - truth.front().translation).norm();
  }
  // One short stretch tells the scale badly; the shape of the way is what tracks tell.
  for (Rigid3& pose : found) pose.translation *= true_m / found_m;
  const double level = truth[0].translation.z() - found[0].translation.z();
  for (Rigid3& pose : found) pose.translation.z() += level;
  const PoseErrors errors = ComparePoses(found, truth);
  EXPECT_LT(errors.position, 0.02);
  EXPECT_LT(errors.rotation_rad, 0.005);
}

}  // namespace
}  // namespace enfilade
