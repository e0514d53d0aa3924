// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/structure/classify.h"
#include "enfilade/structure/level_panorama.h"
#include "enfilade/structure/line_response.h"

namespace enfilade {

/// The picture of a panorama as it is classified, at most options.width wide: superpixels, what is
/// seen, and lines along the two axes. Heights, free space and points are left to be filled in.
[[nodiscard]] ClassifyView MakeLabelView(const LevelPanorama& panorama, const LineResponse& lines,
                                         const ClassifyOptions& options);

/// How far core free space reaches from the camera along each of `num_columns` azimuths
/// (AzimuthOfColumn), metres; zero for a camera outside of it.
[[nodiscard]] std::vector<double> ClearDistances(const EvidenceGrids& evidence,
                                                 const Eigen::Vector2d& camera, int num_columns);

}  // namespace enfilade
