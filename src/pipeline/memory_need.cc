// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/memory_need.h"

#include <fmt/format.h>

#include <algorithm>

#include "enfilade/base/errors.h"
#include "enfilade/pipeline/memory.h"

namespace enfilade {
namespace {

// The libraries.
constexpr double kBase_mb = 90;

double LargestPixels(const Scene& scene) {
  double largest = 0;
  for (const View& view : scene.views) {
    largest = std::max(largest, static_cast<double>(view.camera.width) * view.camera.height);
  }
  return largest;
}

double NumDecoded(const Scene& scene, int num_threads) {
  return std::min(static_cast<double>(num_threads), static_cast<double>(scene.views.size()));
}

}  // namespace

// Measured: 109 MB for three tiny pictures, 145 MB for two of 512 pixels, 211 MB for five of 1024
// and 929 MB for 32 of 2048, all with two threads. Each thread holds a decoded picture as 8 bit and
// float RGB, and each view keeps what was found along its columns.
double LeastMemoryMb(const Scene& scene, int num_threads) {
  constexpr double kView_mb = 20, kFullViewPixels = 2048.0 * 1024.0;
  constexpr double kPixelBytes = 3 * (1 + 4);
  double view_mb = 0;
  for (const View& view : scene.views) {
    const double pixels = static_cast<double>(view.camera.width) * view.camera.height;
    view_mb += kView_mb * std::min(1.0, pixels / kFullViewPixels);
  }
  return kBase_mb + view_mb +
         1e-6 * kPixelBytes * LargestPixels(scene) * NumDecoded(scene, num_threads);
}

// Measured: two pictures of 2048 pixels take 502 MB with one thread and 898 MB with two. Finding
// features, each thread holds a picture and the scale space of a view; then the floors of sixteen
// pictures at a time are held as spectra;
// afterwards each feature has a level ray and a place in the search for tracks, and each picture
// about a thousand rays in the refinement.
double LeastSfmMemoryMb(const Scene& scene, const FeatureOptions& options, int num_threads) {
  if (scene.pose_source != PoseSource::kEstimated) return kBase_mb;
  constexpr double kFeatureBytes = 12 + 4 + 1 + 128 + 3;  // ray, size, view, descriptor, colour
  constexpr double kPlacedFeatureBytes = kFeatureBytes + 24 + 52;
  constexpr double kPixelBytes = 190;
  constexpr double kRefinement_mb = 0.7;
  constexpr double kFloor_mb = 0.16, kFloorSpectrum_mb = 6.3, kSpectraTogether = 16;
  const double num_views = static_cast<double>(scene.views.size());
  const double num_features = num_views * options.max_features;
  const double finding_mb =
      1e-6 * (kFeatureBytes * num_features +
              kPixelBytes * LargestPixels(scene) * NumDecoded(scene, num_threads));
  const double floors_mb = 1e-6 * kFeatureBytes * num_features + kFloor_mb * num_views +
                           kFloorSpectrum_mb * std::min(num_views, kSpectraTogether);
  const double placing_mb = 1e-6 * kPlacedFeatureBytes * num_features + kRefinement_mb * num_views;
  return kBase_mb + std::max({finding_mb, floors_mb, placing_mb});
}

void RequireMemory(double need_mb, const std::string& cure, RunContext& context) {
  if (context.max_memory_mb() > 0 && need_mb > context.max_memory_mb()) {
    throw InvalidInputError(
        "--max-memory",
        fmt::format("{} MB are too few: this run needs at least {:.0f} MB with {} threads",
                    context.max_memory_mb(), need_mb, context.num_threads()),
        cure);
  }
  const double available_mb = AvailableMemoryMb();
  if (available_mb > 0 && need_mb > available_mb) {
    context.log().Warning(
        fmt::format("this run needs at least {:.0f} MB of memory and {:.0f} MB are free", need_mb,
                    available_mb));
  }
}

void RequireMemory(const Scene& scene, RunContext& context) {
  RequireMemory(LeastMemoryMb(scene, context.num_threads()),
                "allow more, or give smaller pictures or fewer --threads", context);
}

}  // namespace enfilade
