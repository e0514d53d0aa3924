// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/structure/level_panorama.h"

namespace enfilade {

struct HeadingOptions {
  double bin_deg = 0.1;
  double kernel_deg = 0.7;
  double min_gradient = 2.0;

  void Visit(OptionVisitor& v) {
    v("bin_deg", bin_deg, "Width of a bin of the heading histogram, degrees.", {0.01, 1.0});
    v("kernel_deg", kernel_deg, "Standard deviation of its smoothing, degrees.", {0.1, 5.0});
    v("min_gradient", min_gradient,
      "Weakest gradient of the smoothed picture that votes, grey levels per pixel.", {0.5, 100.0});
  }
};

/// Votes for the heading of the home's walls, folded to a quarter turn: bin i stands for the
/// heading −45° + (i + ½)·bin_deg. Histograms of several panoramas in one frame add up.
using HeadingHistogram = std::vector<double>;

/// One panorama's votes (great-circle gradient voting): an edge pixel whose gradient is g spans,
/// with the camera, a plane; the plane's horizontal direction is the direction of the edge's line
/// if that line is horizontal. Vertical edges, edges near the horizon (whose plane says nothing)
/// and unseen pixels do not vote.
[[nodiscard]] HeadingHistogram VoteHeading(const LevelPanorama& panorama,
                                           const HeadingOptions& options);

/// Heading of the strongest peak, in [−π/4, π/4), refined by the weighted circular mean about it.
/// An empty or flat histogram gives 0.
[[nodiscard]] double HeadingOfHistogram(const HeadingHistogram& histogram,
                                        const HeadingOptions& options);

}  // namespace enfilade
