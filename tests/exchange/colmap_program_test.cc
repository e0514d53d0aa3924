// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// What the installed program `colmap` makes of the models that we write.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "enfilade/base/file.h"
#include "enfilade/exchange/colmap_writer.h"
#include "src/exchange/pose_file.h"
#include "tests/exchange/box_scene.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;

constexpr size_t kNumSlots = 10;

double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.transpose() * b)).angle();
}

class ColmapProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("colmap help > /dev/null 2>&1") != 0) {
      GTEST_SKIP() << "the program colmap is absent; install it to run this test";
    }
  }

  // What the program prints; fails the test when it ends with an error.
  std::string Run(const std::string& arguments) {
    const fs::path log = temp / "log.txt";
    const std::string command =
        "cd '" + temp.path().native() + "' && colmap " + arguments + " > log.txt 2>&1";
    const int status = std::system(command.c_str());
    std::string output = ReadFile(log);
    EXPECT_EQ(status, 0) << command << "\n" << output;
    return output;
  }

  PoseFile ReadModel(const char* folder) { return ReadColmapModel(temp / folder); }

  // Every view lies to the first of its rig as it was written.
  static void ExpectRigidRigs(const PoseFile& model, const PoseFile& written) {
    ASSERT_EQ(model.pictures.size(), written.pictures.size());
    for (size_t i = 0; i < model.pictures.size(); ++i) {
      const Rigid3& ref = model.pictures[i - i % kNumSlots].world_from_cam;
      const Rigid3& written_ref = written.pictures[i - i % kNumSlots].world_from_cam;
      const Rigid3 in_ref = ref.Inverse() * model.pictures[i].world_from_cam;
      const Rigid3 written_in_ref = written_ref.Inverse() * written.pictures[i].world_from_cam;
      EXPECT_LT(in_ref.translation.norm(), 1e-9);
      EXPECT_LT(AngleBetween(in_ref.rotation, written_in_ref.rotation), 1e-9);
    }
  }

  TempFolder temp;
};

// Images come in the order of the program's hash table.
PoseFile InOrderOfNames(PoseFile poses, const PoseFile& order) {
  PoseFile sorted = poses;
  std::vector<int> new_idx(poses.pictures.size());
  for (size_t i = 0; i < poses.pictures.size(); ++i) {
    size_t k = 0;
    while (order.pictures.at(k).name != poses.pictures[i].name) ++k;
    new_idx[i] = static_cast<int>(k);
    sorted.pictures[k] = poses.pictures[i];
  }
  for (ScenePoint& point : sorted.points) {
    for (int& i : point.view_idx) i = new_idx[static_cast<size_t>(i)];
  }
  return sorted;
}

// Of the distances between panoramas, in metres, after the best scale, which pictures do not tell.
double LargestDistanceError(const PoseFile& model, const Scene& truth) {
  std::vector<Eigen::Vector2d> distances;  // in the model, true
  for (size_t a = 0; a < truth.views.size(); ++a) {
    for (size_t b = a + 1; b < truth.views.size(); ++b) {
      const Vector3d in_model = model.pictures[a * kNumSlots].world_from_cam.translation -
                                model.pictures[b * kNumSlots].world_from_cam.translation;
      const Vector3d is_true =
          truth.views[a].world_from_cam.translation - truth.views[b].world_from_cam.translation;
      distances.emplace_back(in_model.norm(), is_true.norm());
    }
  }
  double product = 0, square = 0, largest = 0;
  for (const Eigen::Vector2d& d : distances) {
    product += d[0] * d[1];
    square += d[0] * d[0];
  }
  for (const Eigen::Vector2d& d : distances) {
    largest = std::max(largest, std::abs(d[0] * product / square - d[1]));
  }
  return largest;
}

TEST_F(ColmapProgramTest, AnalyzerCountsWhatWasWritten) {
  for (const ColmapEncoding encoding : {ColmapEncoding::kText, ColmapEncoding::kBinary}) {
    WriteColmapModel(temp / "model", MakeBoxScene({.pixel_sigma = 1}), ColmapForm::kPinholeRig,
                     encoding);
    const std::string output = Run("model_analyzer --path model");
    EXPECT_NE(output.find("Cameras: 10\n"), std::string::npos) << output;
    EXPECT_NE(output.find("Registered images: 60\n"), std::string::npos) << output;
    EXPECT_NE(output.find("Points: 300\n"), std::string::npos) << output;
    EXPECT_NE(output.find("Observations: 1800\n"), std::string::npos) << output;
    EXPECT_NE(output.find("Mean track length: 6.0"), std::string::npos) << output;
  }
}

TEST_F(ColmapProgramTest, ConverterTakesBothEncodingsIntoTheOther) {
  const Scene scene = MakeBoxScene({.pixel_sigma = 1});
  WriteColmapModel(temp / "text", scene, ColmapForm::kPinholeRig, ColmapEncoding::kText);
  WriteColmapModel(temp / "binary", scene, ColmapForm::kPinholeRig, ColmapEncoding::kBinary);
  const PoseFile written = ReadModel("binary");
  for (const auto& [from, type] : {std::pair("text", "BIN"), std::pair("binary", "TXT")}) {
    const std::string to = std::string("to_") + type;
    fs::create_directories(temp / to);
    Run(std::string("model_converter --input_path ") + from + " --output_path " + to +
        " --output_type " + type);
    const PoseFile read = InOrderOfNames(ReadModel(to.c_str()), written);
    ASSERT_EQ(read.pictures.size(), 60U);
    for (size_t i = 0; i < read.pictures.size(); ++i) {
      EXPECT_LT(
          (read.pictures[i].world_from_cam.Matrix() - written.pictures[i].world_from_cam.Matrix())
              .norm(),
          1e-12);
    }
    ASSERT_EQ(read.points.size(), 300U);
    size_t num_found = 0;
    for (const ScenePoint& point : read.points) {
      for (const ScenePoint& other : written.points) {
        if (point.position != other.position) continue;
        ++num_found;
        EXPECT_EQ(point.view_idx, other.view_idx);
        EXPECT_EQ(point.pixels, other.pixels);
      }
    }
    EXPECT_EQ(num_found, 300U);
  }
}

// The program adjusts a scene whose poses and points are off; the rig keeps its views together.
TEST_F(ColmapProgramTest, RigBundleAdjusterRepairsPosesAndKeepsRigsRigid) {
  const Scene truth = MakeBoxScene();
  for (const double pixel_sigma : {0.0, 1.0}) {
    const Scene scene = MakeBoxScene({.pixel_sigma = pixel_sigma, .position_sigma_m = 0.03});
    WriteColmapModel(temp / "model", scene, ColmapForm::kPinholeRig, ColmapEncoding::kBinary);
    const PoseFile written = ReadModel("model");
    fs::create_directories(temp / "adjusted");
    Run("rig_bundle_adjuster --input_path model --output_path adjusted "
        "--rig_config_path model/rig_config.json --estimate_rig_relative_poses 0 "
        "--RigBundleAdjustment.refine_relative_poses 0 "
        "--BundleAdjustment.refine_focal_length 0 --BundleAdjustment.refine_extra_params 0");
    const PoseFile adjusted = InOrderOfNames(ReadModel("adjusted"), written);
    ExpectRigidRigs(adjusted, written);
    // One pixel of noise is 9 mm at 3 m; 300 points make it about 1 mm in a camera's position.
    EXPECT_LT(LargestDistanceError(adjusted, truth), pixel_sigma > 0 ? 0.005 : 1e-6);
    EXPECT_GT(LargestDistanceError(written, truth), 0.02);
  }
}

// As users run it: the program derives the rig from the poses and refines it.
TEST_F(ColmapProgramTest, RigBundleAdjusterRunsWithItsDefaults) {
  const Scene scene = MakeBoxScene({.pixel_sigma = 0.5});
  WriteColmapModel(temp / "model", scene, ColmapForm::kPinholeRig, ColmapEncoding::kText);
  const PoseFile written = ReadModel("model");
  fs::create_directories(temp / "adjusted");
  Run("rig_bundle_adjuster --input_path model --output_path adjusted "
      "--rig_config_path model/rig_config.json");
  const PoseFile adjusted = InOrderOfNames(ReadModel("adjusted"), written);
  // All rigs of a model have the same views, whatever they have become.
  for (size_t i = kNumSlots; i < adjusted.pictures.size(); ++i) {
    const auto in_ref = [&](size_t k) {
      return adjusted.pictures[k - k % kNumSlots].world_from_cam.Inverse() *
             adjusted.pictures[k].world_from_cam;
    };
    const Rigid3 here = in_ref(i), first = in_ref(i % kNumSlots);
    EXPECT_LT((here.translation - first.translation).norm(), 1e-6);
    EXPECT_LT(AngleBetween(here.rotation, first.rotation), 1e-6);
    EXPECT_LT(here.translation.norm(), 0.02);
  }
}

}  // namespace
}  // namespace enfilade
