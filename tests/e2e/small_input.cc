// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/e2e/small_input.h"

#include <cmath>
#include <string>

#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"

namespace enfilade {
namespace {

constexpr int kWidth = 128, kHeight = 64;

// Dark floor, light walls with stripes, white ceiling; `shade` makes each picture another one.
ImageU8 StripedBox(int shade) {
  ImageU8 picture(kHeight, kWidth, 3);
  for (int row = 0; row < kHeight; ++row) {
    for (int col = 0; col < kWidth; ++col) {
      const int band = row < 22 ? 230 : row < 45 ? 150 + 30 * (col / 8 % 2) : 70;
      for (int channel = 0; channel < 3; ++channel) {
        picture(row, col, channel) = static_cast<uint8_t>(band + shade);
      }
    }
  }
  return picture;
}

}  // namespace

void WriteSmallInput(const std::filesystem::path& folder, int num_pictures) {
  std::string poses = "file,x,y,z,qw,qx,qy,qz\n";
  for (int i = 0; i < num_pictures; ++i) {
    const std::string name = "p" + std::to_string(i) + ".png";
    WriteFileAtomic(folder / name, EncodeImage(StripedBox(i), ".png"));
    // Upright, looking along +y: x right, y down, z forward.
    poses += name + "," + std::to_string(i) + ",0,1.5,0.70710678,-0.70710678,0,0\n";
  }
  WriteFileAtomic(folder / "poses.csv", poses);
}

}  // namespace enfilade
