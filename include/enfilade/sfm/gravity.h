// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// A straight line seen in a panorama: its end points as unit rays in the camera frame.
struct LineSegment {
  Eigen::Vector3d from, to;

  /// Unit normal of the plane through the camera and the line.
  [[nodiscard]] Eigen::Vector3d Normal() const { return from.cross(to).normalized(); }
  [[nodiscard]] double Length_rad() const;
};

/// The straight segments of at least 3° in a panorama's virtual views, found with the line segment
/// detector of von Gioi et al. (2010) in OpenCV, in the order of the views. `trusted` (0 = ignore)
/// is as for ExtractFeatures; both must have the size of `camera` (std::logic_error otherwise).
/// Uses the calling thread.
[[nodiscard]] std::vector<LineSegment> FindLineSegments(const ImageU8& panorama,
                                                        const ImageU8& trusted,
                                                        const Camera& camera);

/// The vertical vanishing point of a panorama: the direction that lies in the planes of as many
/// long segments as possible, near `expected_up` (up to about 10° off).
///
/// Minimises Σ length · ρ(n·up) over the unit vector up, n the planes' normals and ρ Cauchy's loss
/// whose scale shrinks from 6° to 0.2° (graduated non-convexity), so that slanted lines do not
/// pull. The standard deviation comes from the residuals of the lines that agree; with fewer than
/// three of them the answer is `expected_up` with 2°.
[[nodiscard]] Gravity FindGravity(std::span<const LineSegment> segments,
                                  const Eigen::Vector3d& expected_up);

/// The vertical of a picture whose metadata may tell one (`told_up`, unit): lines near the
/// picture's own upward direction and lines near the told one are both tried, and what more lines
/// agree with counts, since stitchers level pictures and leave the tags. Where both find the same
/// lines, the told direction says which end is up; with fewer than three lines it is all there is
/// (2°).
[[nodiscard]] Gravity FindGravityOfPicture(std::span<const LineSegment> segments,
                                           const std::optional<Eigen::Vector3d>& told_up);

/// Rotation to the level frame: z up, the centre of the picture at azimuth 90° (+y). Also for
/// cameras mounted head down.
[[nodiscard]] Eigen::Matrix3d LevelFromCam(const Gravity& gravity);

}  // namespace enfilade
