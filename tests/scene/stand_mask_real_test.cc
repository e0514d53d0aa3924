// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "enfilade/image/codec.h"
#include "enfilade/scene/stand_mask.h"
#include "tests/support/real_data.h"

namespace enfilade {
namespace {

// Every `step`-th panorama of a folder, by name.
std::vector<ImageU8> ReadPanoramas(const std::filesystem::path& folder, size_t step) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry);
  std::sort(paths.begin(), paths.end());
  std::vector<ImageU8> panoramas;
  for (size_t i = 0; i < paths.size(); i += step) panoramas.push_back(ReadImageRgb(paths[i]));
  return panoramas;
}

TEST(FindStandReal, SampleTour) {
  // Seen by eye: the stand's plate fills the lowest 6 to 8.5 % of the rows (it is wavy), the knobs
  // of its legs reach 10 to 11 %.
  ENFILADE_REQUIRE_REAL_DATA("zind_sample_tour/000/panos");
  const auto folder = RealDataFolder() / "zind_sample_tour/000/panos";
  for (const size_t step : {size_t{2}, size_t{4}, size_t{8}}) {
    const Stand stand = FindStand(ReadPanoramas(folder, step), {});
    EXPECT_TRUE(stand.is_measured) << step;
    EXPECT_GT(stand.masked_share, 0.085) << step;
    EXPECT_LT(stand.masked_share, 0.12) << step;
  }
}

TEST(FindStandReal, RenderedRoomsWithoutStand) {
  ENFILADE_REQUIRE_REAL_DATA("pano3dlayout/bathroom2/images");
  for (const char* room : {"bathroom2", "bedroom1"}) {
    const auto folder = RealDataFolder() / "pano3dlayout" / room / "images";
    EXPECT_FALSE(FindStand(ReadPanoramas(folder, 1), {}).is_measured) << room;
  }
}

TEST(FindStandReal, GlowRoundTheNadir) {
  // The renderer of this room left a bright spot under every camera: not the floor either.
  ENFILADE_REQUIRE_REAL_DATA("pano3dlayout/kitchen1/images");
  const Stand stand =
      FindStand(ReadPanoramas(RealDataFolder() / "pano3dlayout/kitchen1/images", 1), {});
  EXPECT_TRUE(stand.is_measured);
  EXPECT_LT(stand.masked_share, 0.14);
}

}  // namespace
}  // namespace enfilade
