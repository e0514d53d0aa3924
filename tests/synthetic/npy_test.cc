// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/npy.h"

#include <gtest/gtest.h>

#include <cstring>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

TEST(WriteNpy, BytesAreThoseOfTheFormat) {
  const TempFolder folder;
  Image<float> image(2, 3, 1, 0.0f);
  image(1, 2) = 2.5f;
  WriteNpy(folder / "a.npy", image);
  const std::string bytes = ReadFile(folder / "a.npy");
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const size_t header = static_cast<uint8_t>(bytes[8]) + 256u * static_cast<uint8_t>(bytes[9]);
  EXPECT_EQ((10 + header) % 64, 0u);
  EXPECT_EQ(bytes[9 + header], '\n');
  EXPECT_NE(bytes.find("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }"),
            std::string::npos);
  ASSERT_EQ(bytes.size(), 10 + header + 6 * sizeof(float));
  float last = 0;
  std::memcpy(&last, bytes.data() + bytes.size() - sizeof(float), sizeof(float));
  EXPECT_EQ(last, 2.5f);
}

TEST(WriteNpy, ChannelsAreTheThirdAxis) {
  const TempFolder folder;
  WriteNpy(folder / "a.npy", Image<int8_t>(4, 5, 3));
  const std::string bytes = ReadFile(folder / "a.npy");
  EXPECT_NE(bytes.find("'|i1', 'fortran_order': False, 'shape': (4, 5, 3)"), std::string::npos);
}

}  // namespace
}  // namespace enfilade
