// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/resize.h"

#include <opencv2/imgproc.hpp>

#include "enfilade/base/check.h"

namespace enfilade {

ImageU8 ReduceImage(const ImageU8& image, int rows, int cols) {
  ENFILADE_CHECK(!image.empty() && rows > 0 && cols > 0);
  const cv::Mat source(image.rows(), image.cols(), CV_8UC(image.channels()),
                       const_cast<uint8_t*>(image.data().data()));
  ImageU8 reduced(rows, cols, image.channels());
  cv::Mat target(rows, cols, source.type(), reduced.data().data());
  cv::resize(source, target, target.size(), 0, 0, cv::INTER_AREA);
  return reduced;
}

}  // namespace enfilade
