// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/options.h"
#include "enfilade/image/image.h"

namespace enfilade {

struct OrientationMapOptions {
  int width = 1024;
  double weak_edge = 20;
  double strong_edge = 50;
  double max_angle_deg = 10;
  double min_length_deg = 3;

  void Visit(OptionVisitor& v) {
    v("width", width, "Width to which larger panoramas are reduced, pixels.", {64, 8192});
    v("weak_edge", weak_edge, "Lower threshold of Canny's edges.", {0, 1000});
    v("strong_edge", strong_edge, "Upper threshold.", {0, 1000});
    v("max_angle_deg", max_angle_deg, "Farthest that a line may point beside an axis, degrees.",
      {0.1, 45});
    v("min_length_deg", min_length_deg, "Shorter lines do not count, degrees.", {0, 90});
  }
};

struct OrientationMap {
  ImageU8 lines;        ///< rows × cols: 1, 2, 3 on lines along x, y, z; else 0
  ImageU8 orientation;  ///< rows × cols: 1, 2, 3 on surfaces across x, y, z; 0 undefined
  ImageU8 labels;       ///< rows × cols of SurfaceLabel; kOther where undefined
};

/// The orientation map of Lee, Hebert and Kanade (*Geometric Reasoning for Single Image Structure
/// Recovery*, CVPR 2009, section 4) on the sphere: the labels that the 2014 paper compares its own
/// with. `rgb` is a level panorama (level_panorama.h), rows × 2·rows × 3, whose axes are those of
/// the walls.
///
/// Edges (Canny) whose direction is within max_angle_deg of one axis's vanishing point, and of no
/// other, form lines. A line along axis i is swept towards and away from the vanishing point of
/// another axis j until it meets one along the third axis k: what it passes may be a surface across
/// k. A pixel that is passed by lines along i towards j and by lines along j towards i is across k,
/// if this is true for one k only. Surfaces across z are ceiling above the horizon and floor below,
/// all others wall. On the sphere sweeping runs along the meridians about j; every meridian
/// is walked once in both directions, so that the cost is linear in pixels.
[[nodiscard]] OrientationMap MapOrientations(const ImageU8& rgb,
                                             const OrientationMapOptions& options);

}  // namespace enfilade
