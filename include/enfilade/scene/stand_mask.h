// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/types.h"

namespace enfilade {

struct StandOptions {
  double default_share = 0.10;
  double margin_share = 0.02;
  int min_pictures = 3;

  void Visit(OptionVisitor& v) {
    v("default_share", default_share,
      "Share of the rows at the bottom that is ignored when the camera's stand cannot be found.",
      {0.0, 0.5});
    v("margin_share", margin_share,
      "Share of the rows above the stand's body that is ignored as well, for its legs.",
      {0.0, 0.2});
    v("min_pictures", min_pictures, "The stand is looked for in at least so many panoramas.",
      {2.0, 8.0});
  }
};

/// The camera's stand at the bottom of the panoramas of one capture.
struct Stand {
  double masked_share = 0.10;  ///< of the rows, counted from the bottom, that are not trusted
  bool is_measured = false;    ///< false: the default

  /// Rows [0, NumTrustedRows(rows)) show the scene.
  [[nodiscard]] int NumTrustedRows(int rows) const;
};

/// Finds the stand as what stays where it is relative to the camera: rows below −60° elevation in
/// which the brightness gradients agree over the panoramas, while those between −60° and −36° do
/// not. Uniform floors agree on nothing and moving things disagree, so both are no stand.
///
/// `panoramas` are upright equirectangular pictures of one size with at least 64 rows, 1 or 3
/// channels, of one capture; eight spread over the home are enough. Falls back to the default for
/// fewer than options.min_pictures, when nothing agrees and when everything does (pictures from one
/// place). The body's edge is found within three rows of 256. Cost: the pictures' pixels.
[[nodiscard]] Stand FindStand(std::span<const ImageU8> panoramas, const StandOptions& options);

/// The stand of a scene's panoramas: reads at most eight of them, spread evenly over the views that
/// have no mask of their own and the size that most of them have. Throws IoError or
/// InvalidInputError for pictures that cannot be read.
[[nodiscard]] Stand FindStandOfScene(const Scene& scene, const StandOptions& options,
                                     RunContext& context);

/// The pixels of a view that show the scene: view.camera.height × width, 255 = trusted, 0 = not.
/// The user's mask (view.mask_path) overrides the stand; pinhole views without one are trusted
/// everywhere. Throws IoError or InvalidInputError when the mask cannot be read or has another
/// size.
[[nodiscard]] ImageU8 TrustedPixels(const View& view, const Stand& stand);

}  // namespace enfilade
