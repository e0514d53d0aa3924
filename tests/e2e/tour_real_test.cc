// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The real tour through the program: what annotators added to it must not matter.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "enfilade/base/json.h"
#include "tests/e2e/program.h"
#include "tests/support/real_data.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// The tour with nothing but positions, yaws, camera heights and scale: all panoramas in one group,
// under new names in another order, without any annotation.
void StripTour(const fs::path& source, const fs::path& target) {
  const Json tour = ReadJsonFile(source / "zind_data.json");
  Json stripped = {{"scale_meters_per_coordinate", tour.at("scale_meters_per_coordinate")}};
  fs::create_directories(target / "panos");
  int number = 1000;
  for (const auto& [floor, rooms] : tour.at("merger").items()) {
    for (const Json& room : rooms) {
      for (const Json& part : room) {
        for (const Json& pano : part) {
          const std::string name = "panos/" + std::to_string(--number) + ".jpg";
          fs::copy_file(source / pano.at("image_path").get<std::string>(), target / name);
          stripped["merger"][floor]["all"]["all"][name] = {
              {"image_path", name},
              {"camera_height", pano.at("camera_height")},
              {"floor_plan_transformation", pano.at("floor_plan_transformation")}};
        }
      }
    }
  }
  WriteJsonFile(target / "zind_data.json", stripped);
}

// The plan without the names of the pictures.
Json PlanOf(const fs::path& tour, const fs::path& output) {
  // Coarse, to be fast: what matters is that both are the same.
  const ProgramResult result =
      RunProgram({"run", tour, "-o", output, "--structure.max_width", "512",
                  "--structure.num_columns", "256", "--model.texels_per_m", "10"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  Json plan = ReadJsonFile(output / "floorplan.json");
  for (Json& camera : plan.at("cameras")) camera.erase("picture");
  return plan;
}

TEST(TourReal, StrippedFlattenedAndRenamedGivesTheSamePlan) {
  ENFILADE_REQUIRE_REAL_DATA("zind_sample_tour/000");
  const fs::path source = RealDataFolder() / "zind_sample_tour/000";
  const TempFolder folder;
  StripTour(source, folder / "tour");
  const Json plan = PlanOf(source, folder / "whole");
  EXPECT_GE(plan.at("storeys").at(0).at("rooms").size(), 5u);
  EXPECT_TRUE(PlanOf(folder / "tour", folder / "stripped") == plan);
}

}  // namespace
}  // namespace enfilade
