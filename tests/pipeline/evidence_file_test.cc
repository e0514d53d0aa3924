// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/evidence_file.h"

#include <gmock/gmock.h>

#include <cmath>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/pipeline/damage.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

std::vector<EvidenceGrids> ExampleEvidence() {
  std::mt19937 random(4);
  EvidenceGrids grids;
  grids.frame = {{-1.0 / 3.0, 2.5}, 0.025, 5, 7};
  grids.wall = ImageF(5, 7);
  grids.wall.data() = RandomFloats(35, random);
  grids.free = ImageF(5, 7);
  grids.free.data() = RandomFloats(35, random);
  grids.core = CoreImage(5, 7);
  grids.core(1, 2) = 1;
  grids.core(4, 6) = 2;
  grids.num_cores = 2;
  grids.support = ImageU8(5, 7);
  grids.support(3, 3) = kSupportNear;
  grids.mode = EvidenceMode::kCounts;
  grids.cameras = {{0, {1.0 / 7.0, 2}}, {5, {-1, 0.1}}};
  EvidenceGrids many = grids;  // cores that take two bytes a cell
  many.core(0, 0) = 300;
  many.num_cores = 300;
  return {grids, many};
}

TEST(EvidenceFile, ReadsExactlyWhatItWrites) {
  const TempFolder folder;
  const std::vector<EvidenceGrids> written = ExampleEvidence();
  WriteEvidence(folder.path(), written);
  const std::vector<EvidenceGrids> read = ReadEvidence(folder.path());
  ASSERT_EQ(read.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].frame.origin, written[i].frame.origin);
    EXPECT_EQ(read[i].frame.cell_m, written[i].frame.cell_m);
    EXPECT_EQ(read[i].frame.rows, 5);
    EXPECT_EQ(read[i].frame.cols, 7);
    EXPECT_EQ(read[i].num_cores, written[i].num_cores);
    EXPECT_EQ(read[i].wall.data(), written[i].wall.data());
    EXPECT_EQ(read[i].free.data(), written[i].free.data());
    EXPECT_EQ(read[i].support.data(), written[i].support.data());
    EXPECT_EQ(read[i].core.data(), written[i].core.data());
    EXPECT_EQ(read[i].mode, EvidenceMode::kCounts);
    ASSERT_EQ(read[i].cameras.size(), 2u);
    EXPECT_EQ(read[i].cameras[0].position, written[i].cameras[0].position);
    EXPECT_EQ(read[i].cameras[1].view_idx, 5);
    EXPECT_TRUE(fs::exists(folder / ("storey_" + std::to_string(i) + "_core.png")));
  }
}

TEST(EvidenceFile, HoldsAHomeWithoutEvidence) {
  const TempFolder folder;
  WriteEvidence(folder.path(), {EvidenceGrids{}});
  EXPECT_EQ(ReadEvidence(folder.path()).size(), 1u);
}

TEST(EvidenceFile, RefusesDamage) {
  const TempFolder folder;
  WriteEvidence(folder.path(), ExampleEvidence());
  const auto read = [&] { (void)ReadEvidence(folder.path()); };
  ExpectRefusesDamage(folder / "evidence.json", read);
  ExpectRefusesDamage(folder / "storey_1.bin", read);
}

TEST(EvidenceFile, RefusesContradictions) {
  constexpr size_t kCellAt = 12 + 16, kRowsAt = 12 + 24;
  const double zero = 0, nan = std::nan("");
  const int32_t huge = 1 << 16;
  const auto refuses = [](size_t offset, const void* bytes, size_t size) {
    const TempFolder folder;
    WriteEvidence(folder.path(), ExampleEvidence());
    Poke(folder / "storey_0.bin", offset, bytes, size);
    EXPECT_THROW((void)ReadEvidence(folder.path()), InvalidInputError) << offset;
  };
  refuses(kCellAt, &zero, sizeof zero);
  refuses(kCellAt, &nan, sizeof nan);
  refuses(kRowsAt, &huge, sizeof huge);
  const TempFolder folder;
  WriteEvidence(folder.path(), ExampleEvidence());
  const uint8_t unknown_core = 3;
  Poke(folder / "storey_0.bin", fs::file_size(folder / "storey_0.bin") - 1, &unknown_core, 1);
  EXPECT_THROW((void)ReadEvidence(folder.path()), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
