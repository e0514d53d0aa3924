// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <set>
#include <string>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/render.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"
#include "enfilade/synthetic/write_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kStep_m = 0.8 / 10, kTurn_rad = kPi / 2 / 10;  // in a frame

Home Walk(int seed) {
  HomeOptions options;
  options.seed = seed;
  options.preset = HomePreset::kWalk;
  return MakeHome(options);
}

// Distance to the nearest wall of the camera's storey or piece of furniture on its floor.
double ClearanceOf(const PlanSegments& segments, const HomeCamera& camera) {
  const Eigen::Vector2d p = camera.home_from_cam.translation.head<2>();
  double nearest_m = 1e9;
  for (const auto* kind : {&segments.walls, &segments.obstacles}) {
    for (const PlanSegment& s : *kind)
      nearest_m = std::min(nearest_m, DistanceToSegment(p, s.a, s.b));
  }
  return nearest_m;
}

TEST(FilmWalk, MovesAndTurnsSmoothlyPastAllCamerasOver20Seeds) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Home walk = Walk(seed), film = FilmWalk(walk, 10);
    const PlanSegments segments = MakePlanSegments(walk);
    ASSERT_GT(film.cameras.size(), 3 * walk.cameras.size());
    std::set<int> rooms;
    for (size_t i = 0; i < film.cameras.size(); ++i) {
      const Rigid3& pose = film.cameras[i].home_from_cam;
      rooms.insert(film.cameras[i].room_id);
      EXPECT_GT(ClearanceOf(segments, film.cameras[i]), 0.15);
      EXPECT_NEAR(pose.rotation(2, 1), -1, 1e-12);  // upright
      if (i == 0) continue;
      const Rigid3& before = film.cameras[i - 1].home_from_cam;
      EXPECT_LE((pose.translation - before.translation).norm(), kStep_m + 1e-3);
      const double cosine = pose.rotation.col(2).dot(before.rotation.col(2));
      EXPECT_LE(std::acos(std::min(1.0, cosine)), kTurn_rad + 1e-3);
    }
    EXPECT_EQ(rooms.size(), walk.rooms.size());
    for (const HomeCamera& camera : walk.cameras) {
      double nearest_m = 1e9;
      for (const HomeCamera& frame : film.cameras) {
        const Vector3d apart = frame.home_from_cam.translation - camera.home_from_cam.translation;
        nearest_m = std::min(nearest_m, apart.norm());
      }
      EXPECT_LT(nearest_m, 0.2);
    }
  }
}

TEST(FilmWalk, FramesAreEvenInTime) {
  const Home walk =
      TextHome("room 0,0 9,0 9,3 0,3 | camera 1,1.5 | camera 1.8,1.5 | camera 2.6,1.5");
  Home straight = walk;
  for (HomeCamera& camera : straight.cameras)
    camera.home_from_cam.rotation = walk.cameras[0].home_from_cam.rotation;
  for (const double frames_per_second : {5.0, 10.0, 30.0}) {
    const Home film = FilmWalk(straight, frames_per_second);
    // 1.6 m at 0.8 m/s, both ends included.
    EXPECT_NEAR(static_cast<double>(film.cameras.size()), 2 * frames_per_second + 1, 1);
    for (size_t i = 1; i < film.cameras.size(); ++i) {
      const Vector3d step =
          film.cameras[i].home_from_cam.translation - film.cameras[i - 1].home_from_cam.translation;
      EXPECT_NEAR(step.norm(), 0.8 / frames_per_second, 1e-6);
    }
  }
}

TEST(FilmWalk, RefusesCamerasThatFollowNoPath) {
  EXPECT_THROW((void)FilmWalk(TextHome("room 0,0 4,0 4,3 0,3 | camera 1,1"), 10),
               InvalidInputError);
  EXPECT_THROW(
      (void)FilmWalk(TextHome("room 0,0 4,0 4,3 0,3 | camera 1,1 | camera 1.5,1 | camera 3,2"), 10),
      InvalidInputError);
}

TEST(FilmWalk, RefusesCamerasThatLean) {
  HomeOptions options;
  options.preset = HomePreset::kWalk;
  options.tilt_deg = 3;
  EXPECT_THROW((void)FilmWalk(MakeHome(options), 10), InvalidInputError);
}

class Video : public testing::Test {
 protected:
  static Home Corner() {
    return TextHome(
        "room 0,0 4,0 4,3 0,3 | box 3,1 3.5,2 | camera 1,0.8 | camera 1.5,0.8 | camera 2,0.9 | "
        "camera 2.2,1.4");
  }
  static WriteHomeOptions Quick() {
    WriteHomeOptions options;
    options.kind = PictureKind::kVideo;
    options.width = 128;
    options.frames_per_second = 4;
    options.render.samples_per_pixel = 1;
    options.render.gather_rays = 16;
    options.render.bounces = 1;
    options.render.light_cell_m = 0.2;
    return options;
  }
  static double MeanDifference(const cv::Mat& bgr, const ImageU8& rgb) {
    cv::Mat frame;
    cv::cvtColor(bgr, frame, cv::COLOR_BGR2RGB);
    double sum = 0;
    for (size_t i = 0; i < rgb.data().size(); ++i)
      sum += std::abs(static_cast<double>(frame.data[i]) - rgb.data()[i]);
    return sum / static_cast<double>(rgb.data().size());
  }
};

TEST_F(Video, AReaderGetsBackTheRenderedFrames) {
  const TempFolder folder;
  RunContext context;
  const Home home = Corner(), film = FilmWalk(home, 4);
  WriteHome(folder.path(), home, Quick(), context);
  cv::VideoCapture video((folder / "video.avi").native(), cv::CAP_OPENCV_MJPEG);
  ASSERT_TRUE(video.isOpened());
  EXPECT_EQ(static_cast<size_t>(video.get(cv::CAP_PROP_FRAME_COUNT)), film.cameras.size());
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 128);
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_HEIGHT), 64);
  EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 4, 1e-6);
  const HomeRenderer renderer(film, Quick().render, context);
  int num_frames = 0;
  for (cv::Mat frame; video.read(frame); ++num_frames) {
    ASSERT_TRUE(frame.isContinuous());
    const RenderedPanorama rendered = renderer.Render(num_frames, {128, 64}, context);
    EXPECT_LT(MeanDifference(frame, rendered.rgb), 2.5) << num_frames;  // JPEG of quality 92
  }
  EXPECT_EQ(static_cast<size_t>(num_frames), film.cameras.size());
}

// Players that know more containers than the reader above.
TEST_F(Video, FfmpegReadsIt) {
  const TempFolder folder;
  RunContext context;
  WriteHome(folder.path(), Corner(), Quick(), context);
  cv::VideoCapture video((folder / "video.avi").native(), cv::CAP_FFMPEG);
  if (!video.isOpened()) GTEST_SKIP() << "OpenCV has no FFmpeg here";
  size_t num_frames = 0;
  for (cv::Mat frame; video.read(frame);) ++num_frames;
  EXPECT_EQ(num_frames, FilmWalk(Corner(), 4).cameras.size());
  EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 4, 1e-6);
}

TEST_F(Video, PosesAndTruthAreThoseOfTheFrames) {
  const TempFolder folder;
  RunContext context;
  const Home film = FilmWalk(Corner(), 4);
  WriteHome(folder.path(), Corner(), Quick(), context);
  EXPECT_FALSE(fs::exists(folder / "transforms.json"));
  EXPECT_FALSE(fs::exists(folder / "panos"));
  const std::string csv = ReadFile(folder / "truth/frames.csv");
  EXPECT_TRUE(csv.starts_with("file,x,y,z,qw,qx,qy,qz,time_s\nframe_000000.jpg,"));
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), film.cameras.size() + 1);
  const std::string video = ReadFile(folder / "video.avi");
  const Floorplan truth = ReadFloorplanJson(folder / "truth/floorplan.json");
  ASSERT_EQ(truth.cameras.size(), film.cameras.size());
  size_t begin = 0;
  for (size_t i = 0; i < film.cameras.size(); ++i) {
    EXPECT_NEAR((truth.cameras[i].world_from_cam.translation -
                 film.WorldFromCamera(static_cast<int>(i)).translation)
                    .norm(),
                0, 1e-5);
    // The frame stands in the file as the JPEG whose hash the truth gives.
    begin = video.find("00dc", begin) + 8;
    const auto byte = [&](size_t k) { return static_cast<uint8_t>(video[begin - 4 + k]); };
    const size_t size = byte(0) | byte(1) << 8 | byte(2) << 16 | static_cast<size_t>(byte(3)) << 24;
    EXPECT_EQ(Sha256(video.substr(begin, size)), truth.cameras[i].sha256);
    begin += size;
  }
}

TEST_F(Video, SameBytesForTwoThreads) {
  const TempFolder a, b;
  RunContext one(1), two(2);
  WriteHome(a.path(), Corner(), Quick(), one);
  WriteHome(b.path(), Corner(), Quick(), two);
  for (const char* name : {"video.avi", "truth/frames.csv", "truth/floorplan.json"}) {
    EXPECT_TRUE(ReadFile(a / name) == ReadFile(b / name)) << name;
  }
}

TEST_F(Video, ReplacesPanoramasAndTheOtherWayRound) {
  const TempFolder folder;
  RunContext context;
  WriteHomeOptions panoramas = Quick();
  panoramas.kind = PictureKind::kEquirectangular;
  WriteHome(folder.path(), Corner(), panoramas, context);
  WriteHome(folder.path(), Corner(), Quick(), context);
  EXPECT_FALSE(fs::exists(folder / "transforms.json"));
  EXPECT_FALSE(fs::exists(folder / "panos/pano_000.jpg"));
  WriteHome(folder.path(), Corner(), panoramas, context);
  EXPECT_TRUE(fs::exists(folder / "panos/pano_000.jpg"));
  EXPECT_FALSE(fs::exists(folder / "video.avi"));
  EXPECT_FALSE(fs::exists(folder / "truth/frames.csv"));
}

TEST_F(Video, NothingIsWrittenOfAHomeThatIsNoWalk) {
  const TempFolder folder;
  RunContext context;
  EXPECT_THROW(WriteHome(folder / "home", TextHome("room 0,0 4,0 4,3 0,3"), Quick(), context),
               InvalidInputError);
  EXPECT_FALSE(fs::exists(folder / "home"));
}

}  // namespace
}  // namespace enfilade
