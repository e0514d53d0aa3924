// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"
#include "enfilade/scene/types.h"

namespace enfilade {

struct TextureOptions {
  double texels_per_m = 150;
  int atlas_px = 4096;
  double max_megatexels = 48;
  double tile_m = 0.25;
  double seam_cost = 1.0;
  double stand_row = 0.9;
  bool equalise_exposure = true;

  void Visit(OptionVisitor& v) {
    v("texels_per_m", texels_per_m, "Resolution of the textures.", {1, 2000});
    v("atlas_px", atlas_px, "Width and greatest height of a texture.", {64, 16384});
    v("max_megatexels", max_megatexels,
      "Bound on all textures together; above it their resolution is lowered.", {0.01, 1000});
    v("tile_m", tile_m, "Side of the tiles that choose their picture; seams fade over one tile.",
      {0.02, 2});
    v("seam_cost", seam_cost,
      "Cost of a seam between two tiles, in natural logarithms of picture resolution.", {0, 100});
    v("stand_row", stand_row,
      "Share of a panorama's rows, from the top, that are used: below is the camera's stand.",
      {0.5, 1});
    v("equalise_exposure", equalise_exposure, "Estimate one gain per picture and channel.");
  }
};

struct TextureResult {
  BuildingModel model;      ///< every face with uv and texture_idx
  double seen_share = 0;    ///< of the faces' texels, how many a picture shows; the rest is filled
  double texels_per_m = 0;  ///< after the bound on the number of texels
  /// Factors on R, G, B that were applied to each picture, in the order of the views.
  std::vector<Eigen::Vector3d> gains;
};

/// Textures every face of the model from the panoramas.
///
/// A face gets one rectangular chart that is aligned with its plane (walls upright, floors with +y
/// up, ceilings as seen from below), in an atlas of 8-bit sRGB. It is divided into tiles; each tile
/// takes the picture that shows it without obstruction, nearest and most frontally, at a price for
/// seams between neighbours (Lempitsky and Ivanov, "Seamless mosaicing of image-based texture
/// maps", 2007; the Potts energy is lowered by min-sum belief propagation), and pictures that
/// disagree with the median of the others lose (after Waechter, Moehrle and Goesele, "Let there be
/// color!", 2014). Pictures fade into each other over one tile. A picture's gain is found from the
/// tiles that it shares with others (after Brown and Lowe, 2007). Visibility is a ray cast against
/// the model's faces; rays pass where the plan has a door or an opening, and walls are seen from
/// their room's side only. Where no picture shows a face it is filled smoothly from what is seen
/// around it, else with the mean colour of the like surfaces of the room, then of the home.
///
/// Pictures are read twice, one per thread at a time and then one by one. Memory: about 20 bytes a
/// texel. Same bytes for any number of threads. A scene without views leaves the model as it is.
/// Throws IoError or InvalidInputError for pictures or masks that cannot be used.
[[nodiscard]] TextureResult TextureModel(const Scene& scene, const Floorplan& plan,
                                         BuildingModel model, const TextureOptions& options,
                                         RunContext& context);

}  // namespace enfilade
