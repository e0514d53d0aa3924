// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/image/image.h"

namespace enfilade {

/// One level of a pyramid: grey levels, with kBorder_px more pixels on every side, so that windows
/// may hang over the picture's edge.
struct GrayLevel {
  static constexpr int kBorder_px = 16;

  int rows = 0;  ///< of the picture, without the border
  int cols = 0;
  bool wraps_around = false;
  ImageF gray;  ///< (rows + 2 borders) × (cols + 2 borders), 0 to 255
};

/// A picture at falling resolutions, computed once a frame and used for detecting and tracking.
///
/// Level 0 is the picture in grey; each further level halves it after a [1 3 3 1] filter along
/// rows and columns, so that position x of level 0 is x / 2^l at level l. Values are the picture's
/// own (no linearisation); filters act on grey levels, so a gain stays a factor on all levels.
class GrayPyramid {
 public:
  /// `image` is grey (1 channel) or RGB (3 channels) and may be empty. There are `max_levels`
  /// levels or fewer: none has a side of less than 16 pixels, except level 0. With `wraps_around`
  /// columns continue across the left and right edge, and levels end where the width is odd; else
  /// the border repeats the edge. Cost: linear in pixels, in parallel over rows.
  GrayPyramid(const ImageU8& image, int max_levels, bool wraps_around, RunContext& context);

  [[nodiscard]] int rows() const { return levels_.front().rows; }
  [[nodiscard]] int cols() const { return levels_.front().cols; }
  [[nodiscard]] bool wraps_around() const { return wraps_around_; }
  [[nodiscard]] int num_levels() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] const GrayLevel& level(int l) const { return levels_[static_cast<size_t>(l)]; }

 private:
  bool wraps_around_;
  std::vector<GrayLevel> levels_;
};

}  // namespace enfilade
