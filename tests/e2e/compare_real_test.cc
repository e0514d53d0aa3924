// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The methods beside each other on the real tour.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "tests/e2e/program.h"
#include "tests/support/real_data.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(CompareReal, TheFullSolverHasASmallAreaErrorAndThePageIsMade) {
  ENFILADE_REQUIRE_REAL_DATA("zind_sample_tour/000");
  const fs::path tour = RealDataFolder() / "zind_sample_tour/000";
  const TempFolder folder;
  const fs::path output = folder / "out";
  ASSERT_EQ(RunProgram({"sfm", tour, "-o", output}).exit_code, 0);
  // Coarse, to be fast, and with label maps, so that compare need not make them.
  const ProgramResult structure =
      RunProgram({"structure", output, "--structure.max_width", "1024", "--structure.num_columns",
                  "256", "--structure.mode", "joint", "--structure.classify.width", "512",
                  "--structure.classify.superpixels.count", "1000"});
  ASSERT_EQ(structure.exit_code, 0) << structure.err;
  ASSERT_EQ(RunProgram({"evidence", output, "--evidence.grid.cell_m", "0.1"}).exit_code, 0);
  const ProgramResult compared =
      RunProgram({"compare", output, "--truth", tour, "--compare.view_width", "160",
                  "--compare.orientation.width", "256", "--compare.volume_cut.voxel_m", "0.1",
                  "--compare.poisson.spacing_m", "0.3", "--compare.polygonal.max_planes", "8",
                  "--compare.max_seconds", "20"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const Json comparison = ReadJsonFile(output / "compare/comparison.json");
  const Json& methods = comparison.at("methods");
  EXPECT_EQ(methods.size(), 8u);
  const auto full = std::find_if(methods.begin(), methods.end(),
                                 [](const Json& method) { return method.at("name") == "full"; });
  ASSERT_NE(full, methods.end());
  ASSERT_EQ(full->at("outcome"), "found") << full->at("reason");
  EXPECT_LT(full->at("figures").at("area_error_gross").get<double>(), 0.06);
  const std::string page = ReadFile(output / "compare/comparison.html");
  EXPECT_THAT(page, HasSubstr("full solver"));
  EXPECT_THAT(page, HasSubstr("orientation map"));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_LT(page.size(), 15'000'000u);
}

}  // namespace
}  // namespace enfilade
