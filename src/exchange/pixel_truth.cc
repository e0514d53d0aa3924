// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/pixel_truth.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "enfilade/base/errors.h"
#include "enfilade/exchange/npy.h"
#include "enfilade/image/codec.h"

namespace enfilade {
namespace {

template <typename T>
void Require(const Image<T>& image, int channels, const std::filesystem::path& path) {
  if (image.empty() || image.cols() != 2 * image.rows() || image.channels() != channels) {
    throw InvalidInputError(path.native(),
                            "is no panorama of " + std::to_string(channels) +
                                " value(s) a pixel, twice as wide as high",
                            "make the truth anew");
  }
}

}  // namespace

ImageU8 ReadTruthLabels(const std::filesystem::path& path) {
  ImageU8 labels = ReadImageGray(path);
  Require(labels, 1, path);
  const auto max = static_cast<uint8_t>(SurfaceLabel::kCeiling);
  if (*std::max_element(labels.data().begin(), labels.data().end()) > max) {
    throw InvalidInputError(path.native(), "holds labels above 3", "make the truth anew");
  }
  return labels;
}

ImageF ReadTruthDepth(const std::filesystem::path& path) {
  ImageF depth = ReadNpy<float>(path);
  Require(depth, 1, path);
  if (!std::all_of(depth.data().begin(), depth.data().end(),
                   [](float d) { return std::isfinite(d) && d >= 0; })) {
    throw InvalidInputError(path.native(), "holds depths that are negative or not finite",
                            "make the truth anew");
  }
  return depth;
}

Image<int8_t> ReadTruthNormals(const std::filesystem::path& path) {
  Image<int8_t> normals = ReadNpy<int8_t>(path);
  Require(normals, 3, path);
  return normals;
}

}  // namespace enfilade
