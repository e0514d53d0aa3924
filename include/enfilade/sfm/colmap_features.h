// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/stand_mask.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/features.h"

namespace enfilade {

/// The program of COLMAP (Schönberger and Frahm, CVPR 2016): `program` where it holds a slash, else
/// the first of that name on the PATH, `colmap` where it is empty. None when it is absent or does
/// not run: it is started once, with `help`, and given 30 s.
[[nodiscard]] std::optional<std::filesystem::path> FindColmap(const std::string& program = "");

/// kColmap or kOpenCv: options.source where that says one of them; kAuto means kColmap where
/// FindColmap finds it.
[[nodiscard]] FeatureSource ChooseFeatureSource(const FeatureOptions& options);

/// The features of panoramas, as of ExtractFeatures but found by COLMAP's SIFT (on the processor;
/// made with COLMAP 3.8): one a view, in the order of `panoramas`; `pano_from_walls` has one a view
/// too.
///
/// The virtual views that are not in `database` yet are rendered in grey into a folder beside it
/// (`<stem>_views`, removed at the end unless options.keep_colmap_views) and given to
/// `colmap feature_extractor`, which writes the features into `database` and its words into
/// `<stem>.log`. All views of panoramas of one size share one PINHOLE camera. The database stays:
/// COLMAP opens it, and a later call, or one after a run that was killed, lets COLMAP work on
/// nothing twice. What it holds is found by names that are made of the panorama's hash
/// (View::sha256), of its walls' frame and of the settings that decide the features, so what it
/// holds of other pictures or from other settings is never taken for what is wanted.
///
/// The panoramas are equirectangular. Pixels that TrustedPixels(view, stand) holds out have no
/// features. The same result for any number of threads. When the context is asked to stop, COLMAP
/// is killed. Memory: one panorama a thread; disk: 1.5 MB of features a panorama of 2048 × 1024,
/// and 0.75 MB of views while COLMAP works. About four times the work of ExtractFeatures.
///
/// Throws DependencyError when COLMAP is needed and absent, fails or leaves views out;
/// InvalidInputError for pictures or masks that are broken or of the wrong size, and for a
/// database that is broken; IoError when files cannot be read or written; StoppedError.
[[nodiscard]] std::vector<PanoFeatures> ExtractFeaturesWithColmap(
    std::span<const View> panoramas, std::span<const Eigen::Matrix3d> pano_from_walls,
    const Stand& stand, const FeatureOptions& options, const std::filesystem::path& database,
    RunContext& context);

}  // namespace enfilade
