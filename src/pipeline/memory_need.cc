// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/memory_need.h"

#include <fmt/format.h>

#include <algorithm>

#include "enfilade/base/errors.h"
#include "enfilade/pipeline/memory.h"

namespace enfilade {

// Measured with the program: the libraries and grids of a small home take 150 MB, each thread holds
// one decoded picture twice (8 bit and float RGB), and each view keeps about 2 MB of line responses
// and distributions.
double LeastMemoryMb(const Scene& scene, int num_threads) {
  constexpr double kBase_mb = 150, kView_mb = 2, kPixelBytes = 3 * (1 + 4);
  double largest_pixels = 0;
  for (const View& view : scene.views) {
    largest_pixels = std::max(largest_pixels, static_cast<double>(view.camera.width) *
                                                  static_cast<double>(view.camera.height));
  }
  return kBase_mb + kView_mb * static_cast<double>(scene.views.size()) +
         1e-6 * kPixelBytes * largest_pixels *
             static_cast<double>(
                 std::min<size_t>(static_cast<size_t>(num_threads), scene.views.size()));
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
