// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/render.h"

namespace enfilade {

/// What is seen from each camera: one panorama, or eight overlapping pinhole views round it; or a
/// film of panoramas along the cameras.
enum class PictureKind { kEquirectangular, kPerspective, kVideo };
[[nodiscard]] std::span<const std::string_view> EnumNames(PictureKind);

struct WriteHomeOptions {
  PictureKind kind = PictureKind::kEquirectangular;
  int width = 1024;
  double frames_per_second = 10;
  int jpeg_quality = 92;
  bool has_pixel_truth = false;
  bool has_points = false;
  RenderOptions render;

  void Visit(OptionVisitor& v) {
    v("kind", kind,
      "equirectangular: panoramas; perspective: eight level views of 90° from each place, a "
      "quarter as wide as its panorama would be; video: one film of panoramas, for the preset "
      "walk.");
    v("width", width,
      "Width of the panoramas in pixels, even, 64 to 16384; their height is half of it. 0: usual "
      "for the preset.",
      {0, 1000000});
    v("frames_per_second", frames_per_second,
      "Of the video, which moves at 0.8 m a second or slower.", {0.5, 60.0});
    v("jpeg_quality", jpeg_quality, "Quality of the pictures.", {1, 100});
    v("has_pixel_truth", has_pixel_truth,
      "Also write depth, normals, labels, rooms and walls per pixel below truth/.");
    v("has_points", has_points,
      "Also write the points that multi-view stereo would find below dense/ and pmvs/; for "
      "panoramas.");
    v("render", render, "How the pictures are made.");
  }
};

/// Renders a home and writes it as a folder that `enfilade run` and `enfilade evaluate` take:
///
///   panos/pano_000.jpg …     the pictures; perspective views are pano_000_0.jpg … pano_000_7.jpg
///   transforms.json          their poses: Nerfstudio form, EQUIRECTANGULAR or PINHOLE, camera to
///                            world, z up, OpenGL camera axes (x right, y up, z backwards)
///   truth/floorplan.json     the true plan (docs/formats.md), with pictures' hashes
///
/// or, for a video, instead of panos/ and transforms.json
///
///   video.avi                motion JPEG (exchange/avi_writer.h), the frames of FilmWalk
///   truth/frames.csv         their true poses in the form of poses.csv, and when they were taken
///
/// and with `has_pixel_truth`, one file a panorama, rows from top to bottom, in NumPy's format:
///
///   truth/depth/*.npy        float32, H × W: metres along the ray, 0 for none
///   truth/normals/*.npy      int8, H × W × 3: 127 times the unit normal, world frame
///   truth/labels/*.png       8 bit: 0 other, 1 floor, 2 wall, 3 ceiling
///   truth/rooms/*.npy        int16, H × W: room id, −1 for none; truth/walls likewise: wall id
///
/// and with `has_points` the files of WriteClouds, with the points of FixturePoints for the home's
/// seed.
///
/// A home that is there is replaced: transforms.json or video.avi goes first and comes last, so a
/// folder that has it is whole. Same home and options, same bytes. Throws InvalidInputError for
/// options out of range, for a video of a home that is no walk or whose cameras lean, for points
/// without panoramas, and for pictures that take more memory than the context's cap (24 bytes a
/// pixel for the colours and as much for the picture and its truth), and IoError.
void WriteHome(const std::filesystem::path& folder, const Home& home,
               const WriteHomeOptions& options, RunContext& context);

}  // namespace enfilade
