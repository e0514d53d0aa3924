// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/colmap_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "src/sfm/colmap_database.h"
#include "src/sfm/wall_matches.h"
#include "tests/sfm/blob_panorama.h"
#include "tests/sfm/sql.h"
#include "tests/support/fake_program.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr Stand kStand{0.2, true};
const Eigen::Matrix3d kCamFromWalls = CamFromWalls(Gravity{});

class FeaturesOfColmap : public testing::Test {
 protected:
  static void SetUpTestSuite() { is_installed_ = FindColmap().has_value(); }
  void SetUp() override {
    if (!is_installed_) GTEST_SKIP() << "the program colmap is not installed";
  }

  View MakeView(uint32_t seed, int rows = 256) {
    const ImageU8 picture = BlobPanorama(rows, seed);
    View view;
    view.picture = std::to_string(seed) + "_" + std::to_string(rows) + ".png";
    view.path = folder_ / view.picture;
    WriteImage(view.path, picture);
    view.sha256 = Sha256OfFile(view.path);
    view.camera = EquirectangularCamera(2 * rows, rows);
    return view;
  }
  std::vector<PanoFeatures> Extract(const std::vector<View>& views, int num_threads = 2) {
    RunContext context(num_threads);
    const std::vector<Eigen::Matrix3d> walls(views.size(), kCamFromWalls);
    return ExtractFeaturesWithColmap(views, walls, kStand, options_, database_, context);
  }
  [[nodiscard]] fs::path LogFile() const { return database_.parent_path() / "database.log"; }
  [[nodiscard]] fs::path ViewFolder() const { return database_.parent_path() / "database_views"; }

  static inline bool is_installed_ = false;
  TempFolder folder_;
  fs::path database_ = folder_ / "my tour (Küche) 'so'" / "database.db";
  FeatureOptions options_;
};

void ExpectSame(const PanoFeatures& a, const PanoFeatures& b) {
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.sizes_rad, b.sizes_rad);
  EXPECT_EQ(a.descriptors.values, b.descriptors.values);
}

double AngleInDeg(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return RadToDeg(std::atan2(a.cross(b).norm(), a.dot(b)));
}

TEST_F(FeaturesOfColmap, AgreeWithThoseOfOpenCv) {
  const View view = MakeView(1, 512);
  const PanoFeatures colmap = Extract({view})[0];
  const PanoFeatures opencv = ExtractFeatures(ReadImageGray(view.path), TrustedPixels(view, kStand),
                                              view.camera, kCamFromWalls, options_);
  ASSERT_GT(opencv.size(), 300);
  EXPECT_NEAR(colmap.size(), opencv.size(), 0.2 * opencv.size());

  constexpr int kNumLargest = 300;
  int num_near = 0, num_of_size = 0;
  for (int i = 0; i < kNumLargest; ++i) {
    const auto idx = static_cast<size_t>(i);
    bool is_near = false, is_of_size = false;
    for (size_t j = 0; j < colmap.rays.size(); ++j) {
      if (AngleInDeg(opencv.rays[idx], colmap.rays[j]) > 0.2) continue;
      is_near = true;
      const double ratio = colmap.sizes_rad[j] / opencv.sizes_rad[idx];
      is_of_size = is_of_size || (ratio > 0.9 && ratio < 1.1);
    }
    num_near += is_near ? 1 : 0;
    num_of_size += is_of_size ? 1 : 0;
  }
  EXPECT_GE(num_near, 0.9 * kNumLargest);
  EXPECT_GE(num_of_size, 0.85 * kNumLargest);

  const std::vector<FeatureMatch> matches =
      MatchDescriptors(opencv.descriptors, colmap.descriptors, {});
  std::vector<double> differences_deg;
  for (const FeatureMatch& match : matches) {
    differences_deg.push_back(AngleInDeg(opencv.rays[static_cast<size_t>(match.a_idx)],
                                         colmap.rays[static_cast<size_t>(match.b_idx)]));
  }
  std::sort(differences_deg.begin(), differences_deg.end());
  ASSERT_GE(matches.size(), 0.8 * opencv.size());
  EXPECT_LT(differences_deg[matches.size() * 95 / 100], 0.5);
  // A tenth of a pixel: both mean the same by the centre of a pixel.
  EXPECT_LT(differences_deg[matches.size() / 2], 0.035);
}

TEST_F(FeaturesOfColmap, AreTheSameForAnyNumberOfThreads) {
  const std::vector<View> views{MakeView(1), MakeView(2), MakeView(3, 200)};
  const std::vector<PanoFeatures> first = Extract(views, 1);
  fs::remove(database_);
  const std::vector<PanoFeatures> second = Extract(views, 2);
  for (const PanoFeatures& features : first) ASSERT_GT(features.size(), 50);
  for (size_t i = 0; i < views.size(); ++i) ExpectSame(first[i], second[i]);
}

TEST_F(FeaturesOfColmap, FollowTheirPanoramas) {
  const View a = MakeView(1), b = MakeView(2, 200);
  const std::vector<PanoFeatures> one_way = Extract({a, b, a});
  const std::vector<PanoFeatures> other_way = Extract({b, a});
  ExpectSame(one_way[0], one_way[2]);
  ExpectSame(one_way[0], other_way[1]);
  ExpectSame(one_way[1], other_way[0]);
}

TEST_F(FeaturesOfColmap, KeepOutOfStandAndMask) {
  View view = MakeView(1);
  const auto pixels = [&] {
    const PanoFeatures features = Extract({view})[0];
    std::vector<Eigen::Vector2d> found;
    for (const Eigen::Vector3f& ray : features.rays) {
      found.push_back(*view.camera.PixelFromRay(ray.cast<double>()));
    }
    return found;
  };
  const std::vector<Eigen::Vector2d> above_stand = pixels();
  ASSERT_FALSE(above_stand.empty());
  EXPECT_TRUE(std::all_of(above_stand.begin(), above_stand.end(), [&](const auto& pixel) {
    return pixel.y() < kStand.NumTrustedRows(view.camera.height) + 1e-3;
  }));

  ImageU8 mask(view.camera.height, view.camera.width, 1, 255);
  for (int r = 0; r < mask.rows(); ++r) std::fill_n(mask.row(r), 250, uint8_t{0});
  view.mask_path = folder_ / "mask.png";
  WriteImage(view.mask_path, mask);
  const std::vector<Eigen::Vector2d> right_half = pixels();
  ASSERT_FALSE(right_half.empty());
  EXPECT_TRUE(std::all_of(right_half.begin(), right_half.end(),
                          [](const auto& pixel) { return pixel.x() > 250 - 1e-3; }));
}

TEST_F(FeaturesOfColmap, OfPlainWallsAreNone) {
  View view = MakeView(1);
  WriteImage(view.path, ImageU8(256, 512, 1, 90));
  view.sha256 = Sha256OfFile(view.path);
  EXPECT_EQ(Extract({view})[0].size(), 0);
  const std::string log = ReadFile(LogFile());
  EXPECT_EQ(Extract({view})[0].size(), 0);
  EXPECT_EQ(ReadFile(LogFile()), log);
}

TEST_F(FeaturesOfColmap, AreNotExtractedTwice) {
  const View a = MakeView(1), b = MakeView(2);
  const std::vector<PanoFeatures> first = Extract({a});
  EXPECT_THAT(ReadFile(LogFile()), testing::HasSubstr("Processed file [6/6]"));
  WriteFileAtomic(LogFile(), "untouched");
  options_.colmap_program = "/absent/colmap";  // nobody asks for it
  ExpectSame(Extract({a})[0], first[0]);
  EXPECT_EQ(ReadFile(LogFile()), "untouched");

  // What is new is added, with the camera that is there.
  options_.colmap_program.clear();
  ExpectSame(Extract({a, b})[0], first[0]);
  EXPECT_THAT(ReadFile(LogFile()), testing::HasSubstr("Processed file [6/6]"));
  EXPECT_EQ(ColmapDatabase(database_).PicturesWithFeatures().size(), 12U);
  EXPECT_EQ(RunSql(database_, "SELECT count(*) FROM cameras"), 1);
}

TEST_F(FeaturesOfColmap, OfOtherSettingsOrPicturesAreNotBelieved) {
  View view = MakeView(1);
  const PanoFeatures first = Extract({view})[0];
  options_.min_contrast = 0.04;
  const PanoFeatures strong = Extract({view})[0];
  EXPECT_LT(strong.size(), first.size());
  WriteImage(view.path, BlobPanorama(256, 2));
  view.sha256 = Sha256OfFile(view.path);
  EXPECT_NE(Extract({view})[0].rays, strong.rays);
  // Both settings and both pictures lie side by side.
  EXPECT_EQ(ColmapDatabase(database_).PicturesWithFeatures().size(), 18U);
}

TEST_F(FeaturesOfColmap, OfARunThatBrokeOffAreUsed) {
  const std::vector<View> views{MakeView(1), MakeView(2)};
  const std::vector<PanoFeatures> expected = Extract(views);
  fs::remove(database_);
  // Does the first three pictures of the list and dies.
  options_.colmap_program = FakeProgram(folder_ / "colmap", R"(
list=$(printf '%s\n' "$@" | sed -n 's/^--image_list_path=//p')
head -n 3 "$list" > "$list.short" && mv "$list.short" "$list"
colmap "$@"
kill -9 $$)");
  EXPECT_THROW((void)Extract(views), DependencyError);
  EXPECT_FALSE(fs::exists(ViewFolder()));
  options_.colmap_program.clear();
  const std::vector<PanoFeatures> resumed = Extract(views);
  EXPECT_THAT(ReadFile(LogFile()), testing::HasSubstr("Processed file [9/9]"));
  for (size_t i = 0; i < views.size(); ++i) ExpectSame(resumed[i], expected[i]);
}

TEST_F(FeaturesOfColmap, CountNoMoreThanAsked) {
  const View view = MakeView(1);
  const PanoFeatures all = Extract({view})[0];
  options_.max_features = 50;
  const PanoFeatures largest = Extract({view})[0];
  ASSERT_EQ(largest.size(), 50);
  EXPECT_TRUE(std::equal(largest.rays.begin(), largest.rays.end(), all.rays.begin()));
}

TEST_F(FeaturesOfColmap, LeaveTheirViewsOnRequest) {
  const View view = MakeView(1);
  (void)Extract({view});
  EXPECT_FALSE(fs::exists(ViewFolder()));
  fs::remove(database_);
  options_.keep_colmap_views = true;
  (void)Extract({view});
  for (const std::string& name : ColmapDatabase(database_).PicturesWithFeatures()) {
    EXPECT_TRUE(fs::exists(ViewFolder() / name)) << name;
  }
}

class SeenProgress : public ProgressSink {
 public:
  void Report(std::string_view what, int64_t done, int64_t total, double /*seconds*/) override {
    if (what == "find features") seen.emplace_back(done, total);
  }
  std::vector<std::pair<int64_t, int64_t>> seen;
};

TEST_F(FeaturesOfColmap, ReportTheirProgress) {
  RunContext context(1);
  const auto progress = std::make_shared<SeenProgress>();
  context.set_progress_sink(progress);
  (void)ExtractFeaturesWithColmap(std::vector<View>{MakeView(1)}, std::vector{kCamFromWalls},
                                  kStand, options_, database_, context);
  ASSERT_FALSE(progress->seen.empty());
  EXPECT_EQ(progress->seen.back(), std::make_pair(int64_t{6}, int64_t{6}));
  EXPECT_TRUE(std::is_sorted(progress->seen.begin(), progress->seen.end()));
}

TEST_F(FeaturesOfColmap, OfBrokenPicturesAreRefused) {
  View view = MakeView(1);
  view.camera = EquirectangularCamera(2048, 1024);
  EXPECT_THROW((void)Extract({view}), InvalidInputError);
  view = MakeView(1);
  WriteFileAtomic(view.path, "no picture");
  EXPECT_THROW((void)Extract({view}), InvalidInputError);
  fs::remove(view.path);
  EXPECT_THROW((void)Extract({view}), IoError);
}

TEST_F(FeaturesOfColmap, OfBrokenDatabasesAreRefused) {
  const View view = MakeView(1);
  const PanoFeatures expected = Extract({view})[0];
  ASSERT_GT(expected.size(), 100);
  const std::string whole = ReadFile(database_);
  WriteFileAtomic(database_, std::string_view(whole).substr(0, whole.size() / 2));
  EXPECT_THROW((void)Extract({view}), InvalidInputError);
  WriteFileAtomic(database_, "no database at all, but more than a hundred bytes of other words: " +
                                 std::string(1000, 'x'));
  EXPECT_THROW((void)Extract({view}), InvalidInputError);
  // What a run leaves that was killed at once is none: it is filled.
  WriteFileAtomic(database_, "");
  ExpectSame(Extract({view})[0], expected);
}

TEST(FeaturesWithoutColmap, WantTheProgramWhereNothingIsKnown) {
  const TempFolder folder;
  View view;
  view.sha256 = std::string(64, '0');
  view.camera = EquirectangularCamera(1024, 512);
  FeatureOptions options;
  options.colmap_program = folder / "colmap";
  RunContext context;
  EXPECT_THROW((void)ExtractFeaturesWithColmap(std::vector<View>{view}, std::vector{kCamFromWalls},
                                               kStand, options, folder / "database.db", context),
               DependencyError);
  EXPECT_FALSE(fs::exists(folder / "database.db"));
}

TEST(FeaturesWithoutColmap, SourceIsColmapWhereItRuns) {
  const TempFolder folder;
  FeatureOptions options;
  options.source = FeatureSource::kAuto;
  options.colmap_program = folder / "colmap";
  EXPECT_EQ(ChooseFeatureSource(options), FeatureSource::kOpenCv);
  (void)FakeProgram(folder / "colmap", "exit 1");
  EXPECT_EQ(FindColmap(options.colmap_program), folder / "colmap");
  EXPECT_EQ(ChooseFeatureSource(options), FeatureSource::kColmap);
  WriteFileAtomic(folder / "colmap", "#!/bin/sh\nexit 1\n");
  EXPECT_EQ(FindColmap(options.colmap_program), std::nullopt);  // not executable
  fs::permissions(folder / "colmap", fs::perms::owner_all);
  EXPECT_EQ(FindColmap(options.colmap_program), std::nullopt);  // `help` fails
  options.source = FeatureSource::kColmap;
  EXPECT_EQ(ChooseFeatureSource(options), FeatureSource::kColmap);
  EXPECT_EQ(FindColmap("no-such-program-360"), std::nullopt);
}

}  // namespace
}  // namespace enfilade
