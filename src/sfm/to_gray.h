// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/imgproc.hpp>

#include "enfilade/image/image.h"

namespace enfilade {

/// The brightness of a picture of one or three channels (RGB).
[[nodiscard]] inline ImageU8 ToGray(const ImageU8& picture) {
  if (picture.channels() == 1) return picture;
  ImageU8 gray(picture.rows(), picture.cols());
  const cv::Mat rgb(picture.rows(), picture.cols(), CV_8UC3,
                    const_cast<uint8_t*>(picture.data().data()));
  cv::Mat target(gray.rows(), gray.cols(), CV_8U, gray.data().data());
  cv::cvtColor(rgb, target, cv::COLOR_RGB2GRAY);
  return gray;
}

}  // namespace enfilade
