// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// What a panorama becomes in a COLMAP model.
enum class ColmapForm {
  kEquirectangular,  ///< one image of camera model EQUIRECTANGULAR, for COLMAP 4.1 and later
  kPinholeRig,       ///< a rig of virtual pinhole images, for any version and what builds on it
};

enum class ColmapEncoding { kText, kBinary };

/// Writes a scene as a COLMAP model: cameras, images and points3D, .txt or .bin, each atomically,
/// in the world of the scene, metres, z up. Replaces a model that is there: the files of the other
/// encoding, and rigs, frames and rig_config.json that are not written anew, are removed, as
/// readers would mix them with the new ones.
///
/// kEquirectangular: one camera for every size and set of intrinsics, one image a view, called as
/// its path below the folder that all pictures have in common: what COLMAP's image_path is. Views
/// without a path are called `picture`. The names must be distinct (std::logic_error).
///
/// kPinholeRig: a panorama is ten square pinhole images of 90°: view_0 … view_7 all round, each 45°
/// to the right of the one before and the first along the panorama's forward axis, view_8 up and
/// view_9 down. Their names are "view_0/" … and the picture's stem with ".jpg", with white space
/// as "_" and a number where two would be the same. All have the resolution of the widest panorama
/// at their centre. Cameras 1 … 10 are the views'. Pinhole pictures stay as they are, as
/// "photos/" and their name. `rig_config.json` describes the rig to rig_bundle_adjuster (as of
/// COLMAP 3.8) and rig_configurator (3.12 and later); it is not written where there is no panorama.
///
/// Points keep colour and track. An observation becomes a 2D point of one image: of a rig of the
/// view whose axis is nearest, so that none counts twice. Where the scene does not know a point's
/// pixels, they are its projections, and its reprojection error is −1; pinhole pictures that would
/// not show it are left out of its track.
///
/// Reading such a model back gives the same poses to 1e-12 (rotations) and, but for rigs, the same
/// pixels. Throws IoError. A name with white space cannot stand in text, where COLMAP cuts it:
/// kEquirectangular with kText throws InvalidInputError then, before anything is written. `pixels`
/// must be empty or as many as `view_idx`, which must name views of the scene (std::logic_error).
void WriteColmapModel(const std::filesystem::path& folder, const Scene& scene, ColmapForm form,
                      ColmapEncoding encoding);

/// Renders the images of the rig model into `folder` under the names that WriteColmapModel gives
/// them, as JPEG (quality 92), and copies the pinhole pictures, each atomically: what COLMAP's
/// image_path is.
///
/// Parallel over views; each thread holds one panorama. The same bytes for any number of threads.
/// Throws IoError, InvalidInputError for a picture that is none or not of its camera's size, and
/// StoppedError. Cost: ten views of (width / π)² pixels a panorama.
void RenderRigPictures(const std::filesystem::path& folder, const Scene& scene,
                       RunContext& context);

}  // namespace enfilade
