// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/memory_need.h"

#include <fmt/format.h>

#include <algorithm>

#include "enfilade/base/errors.h"
#include "enfilade/pipeline/memory.h"

namespace enfilade {

// Measured: 109 MB for three tiny pictures, 145 MB for two of 512 pixels, 211 MB for five of 1024
// and 929 MB for 32 of 2048, all with two threads. The libraries take the base, each thread holds a
// decoded picture as 8 bit and float RGB, and each view keeps what was found along its columns.
double LeastMemoryMb(const Scene& scene, int num_threads) {
  constexpr double kBase_mb = 90, kView_mb = 20, kFullViewPixels = 2048.0 * 1024.0;
  constexpr double kPixelBytes = 3 * (1 + 4);
  double largest_pixels = 0, view_mb = 0;
  for (const View& view : scene.views) {
    const double pixels = static_cast<double>(view.camera.width) * view.camera.height;
    largest_pixels = std::max(largest_pixels, pixels);
    view_mb += kView_mb * std::min(1.0, pixels / kFullViewPixels);
  }
  const double num_decoded =
      std::min(static_cast<double>(num_threads), static_cast<double>(scene.views.size()));
  return kBase_mb + view_mb + 1e-6 * kPixelBytes * largest_pixels * num_decoded;
}

void RequireMemory(const Scene& scene, RunContext& context) {
  const double need_mb = LeastMemoryMb(scene, context.num_threads());
  if (context.max_memory_mb() > 0 && need_mb > context.max_memory_mb()) {
    throw InvalidInputError(
        "--max-memory",
        fmt::format("{} MB are too few: this run needs at least {:.0f} MB with {} threads",
                    context.max_memory_mb(), need_mb, context.num_threads()),
        "allow more, or give smaller pictures or fewer --threads");
  }
  const double available_mb = AvailableMemoryMb();
  if (available_mb > 0 && need_mb > available_mb) {
    context.log().Warning(
        fmt::format("this run needs at least {:.0f} MB of memory and {:.0f} MB are free", need_mb,
                    available_mb));
  }
}

}  // namespace enfilade
