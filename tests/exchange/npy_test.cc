// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/npy.h"

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

TEST(ReadNpy, IsTheInverseOfWriteNpy) {
  const TempFolder folder;
  Image<float> depth(3, 5);
  Image<int8_t> normals(2, 4, 3);
  for (size_t i = 0; i < depth.data().size(); ++i) depth.data()[i] = 0.3f * static_cast<float>(i);
  for (size_t i = 0; i < normals.data().size(); ++i) {
    normals.data()[i] = static_cast<int8_t>(static_cast<int>(i) * 11 - 127);
  }
  WriteNpy(folder / "depth.npy", depth);
  WriteNpy(folder / "normals.npy", normals);
  const auto depth_back = ReadNpy<float>(folder / "depth.npy");
  EXPECT_EQ(depth_back.rows(), 3);
  EXPECT_EQ(depth_back.cols(), 5);
  EXPECT_TRUE(depth_back.data() == depth.data());
  const auto normals_back = ReadNpy<int8_t>(folder / "normals.npy");
  EXPECT_EQ(normals_back.channels(), 3);
  EXPECT_TRUE(normals_back.data() == normals.data());
}

TEST(ReadNpy, ReadsWhatNumPyItselfWrites) {
  const TempFolder folder;
  // numpy.save of version 1.24, whose header ends with ", }" and many blanks.
  std::string bytes("\x93NUMPY\x01\x00\x76\x00", 10);
  bytes += "{'descr': '<i2', 'fortran_order': False, 'shape': (1, 2), }";
  bytes.append(127 - bytes.size(), ' ');
  bytes += std::string("\n\x01\x00\xff\xff", 5);
  WriteFileAtomic(folder / "a.npy", bytes);
  const auto image = ReadNpy<int16_t>(folder / "a.npy");
  EXPECT_EQ(image(0, 0), 1);
  EXPECT_EQ(image(0, 1), -1);
}

TEST(ReadNpy, RefusesWhatIsBroken) {
  const TempFolder folder;
  const auto path = folder / "a.npy";
  WriteNpy(path, Image<float>(4, 8));
  const std::string whole = ReadFile(path);
  const auto refuses = [&](const std::string& bytes) {
    WriteFileAtomic(path, bytes);
    EXPECT_THROW((void)ReadNpy<float>(path), InvalidInputError);
  };
  refuses("");
  refuses(whole.substr(0, 9));
  refuses(whole.substr(0, 40));
  refuses(whole.substr(0, whole.size() - 1));
  refuses(whole + "x");
  const auto replaced = [&](const std::string& from, const std::string& to) {
    return std::string(whole).replace(whole.find(from), from.size(), to);
  };
  refuses(replaced("False", "True "));
  refuses(replaced("(4, 8)", "(9, 8)"));
  refuses(replaced("(4, 8)", "(4, x)"));
  refuses(replaced("<f4", ">f4"));
  refuses(replaced("NUMPY", "NUMPX"));
  WriteFileAtomic(path, whole);
  EXPECT_THROW((void)ReadNpy<int8_t>(path), InvalidInputError);
  EXPECT_THROW((void)ReadNpy<float>(folder / "none.npy"), IoError);
}

}  // namespace
}  // namespace enfilade
