// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/label_tint.h"

#include <array>

namespace enfilade {
namespace {

// By SurfaceLabel.
constexpr std::array<std::array<int, 3>, 4> kTints = {
    {{0, 0, 0}, {60, 200, 60}, {200, 60, 60}, {60, 60, 220}}};

}  // namespace

ImageU8 TintByLabels(const ImageU8& picture, const ImageU8& labels) {
  const int rows = labels.rows(), cols = labels.cols();
  ImageU8 tinted(rows, cols, 3);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const uint8_t label = labels(r, c);
      for (int i = 0; i < 3; ++i) {
        const int colour = picture(r * picture.rows() / rows, c * picture.cols() / cols, i);
        const int tint = kTints.at(label).at(static_cast<size_t>(i));
        tinted(r, c, i) = static_cast<uint8_t>(label == 0 ? colour : (colour + tint) / 2);
      }
    }
  }
  return tinted;
}

}  // namespace enfilade
