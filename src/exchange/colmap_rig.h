// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "enfilade/scene/types.h"

namespace enfilade {

/// A virtual view of every panorama.
struct ColmapRigSlot {
  std::string prefix;  ///< of the names of its images: its folder and "/"
  Eigen::Matrix3d pano_from_view;
};

/// The virtual pinhole cameras that stand for one panorama, all with the same intrinsics.
struct ColmapRig {
  Camera camera;
  std::vector<ColmapRigSlot> slots;

  /// The slot whose axis is nearest to a ray of the panorama. Its picture shows the ray.
  [[nodiscard]] size_t SlotOf(const Eigen::Vector3d& ray_in_pano) const;
};

/// Eight views of 90° all round, each 45° to the right of the one before and the first along the
/// panoramas' forward axis, then one up and one down. As fine as the widest panorama at the centre
/// of the views. Where the scene has points, views that show none are left out, as COLMAP 3.8
/// cannot adjust them. The scene must hold a panorama.
[[nodiscard]] ColmapRig RigFor(const Scene& scene);

/// Names, one a view, that are distinct and hold no white space: of panoramas what follows the
/// prefix of a slot, the stem and ".jpg"; of other pictures "photos/" and the file name.
[[nodiscard]] std::vector<std::string> RigPictureNames(const Scene& scene);

/// Writes the rig for rig_bundle_adjuster (as of COLMAP 3.8) and rig_configurator (3.12 and later)
/// at once; camera k of the model is slot k − 1. Throws IoError.
void WriteRigConfig(const std::filesystem::path& path, const ColmapRig& rig);

}  // namespace enfilade
