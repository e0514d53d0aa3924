// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// Readers of others are asked in tests/synthetic/film_test.cc.
#include "enfilade/exchange/avi_writer.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

uint32_t NumberAt(const std::string& bytes, size_t at) {
  uint32_t number = 0;
  for (size_t k = 0; k < 4; ++k)
    number |= static_cast<uint32_t>(static_cast<uint8_t>(bytes[at + k])) << (8 * k);
  return number;
}

TEST(AviWriter, IndexAndLengthsLeadToTheFrames) {
  const TempFolder folder;
  const std::vector<std::string> frames = {"odd", "even", "longest"};
  AviWriter writer(folder / "a.avi", {64, 32}, 29.97);
  for (const std::string& frame : frames) writer.AddFrame(frame);
  writer.Finish();
  const std::string bytes = ReadFile(folder / "a.avi");
  EXPECT_EQ(NumberAt(bytes, 4) + 8, bytes.size());
  const size_t main_header = bytes.find("avih") + 8;
  EXPECT_EQ(NumberAt(bytes, main_header), 33367u);  // microseconds a frame
  EXPECT_EQ(NumberAt(bytes, main_header + 16), 3u);
  EXPECT_EQ(NumberAt(bytes, main_header + 28), 7u);  // the longest frame
  const size_t list = bytes.find("movi"), index = bytes.find("idx1");
  ASSERT_NE(index, std::string::npos);
  EXPECT_EQ(NumberAt(bytes, list - 4), index - list);
  EXPECT_EQ(NumberAt(bytes, index + 4), 3u * 16);
  for (size_t i = 0; i < frames.size(); ++i) {
    const size_t entry = index + 8 + 16 * i;
    EXPECT_EQ(bytes.substr(entry, 4), "00dc");
    const size_t chunk = list + NumberAt(bytes, entry + 8), size = NumberAt(bytes, entry + 12);
    EXPECT_EQ(chunk % 2, list % 2);
    EXPECT_EQ(NumberAt(bytes, chunk + 4), size);
    EXPECT_EQ(bytes.substr(chunk + 8, size), frames[i]);
  }
}

TEST(AviWriter, RefusesWhatNoReaderTakes) {
  const TempFolder folder;
  EXPECT_THROW(AviWriter(folder / "none" / "a.avi", {64, 32}, 10), IoError);
  AviWriter writer(folder / "a.avi", {64, 32}, 10);
  writer.AddFrame("frame");
  // Never touched, so it takes no memory.
  constexpr size_t kTwoGb = size_t{1} << 31;
  void* memory =
      ::mmap(nullptr, kTwoGb, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  EXPECT_THROW(writer.AddFrame({static_cast<const char*>(memory), kTwoGb}), InvalidInputError);
  ::munmap(memory, kTwoGb);
}

}  // namespace
}  // namespace enfilade
