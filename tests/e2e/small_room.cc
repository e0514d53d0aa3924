// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/e2e/small_room.h"

#include "enfilade/base/run_context.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/write_home.h"

namespace enfilade {

void WriteSmallRoom(const std::filesystem::path& folder, bool has_points, bool has_pixel_truth) {
  RunContext context;
  const Home room = TextHome(
      "room 0,0 4,0 4,3 0,3 | window 1,0 2,0 | camera 1,1 | camera 3,1.1 | camera 2.2,2.1");
  WriteHomeOptions quick;
  quick.width = 256;
  quick.has_points = has_points;
  quick.has_pixel_truth = has_pixel_truth;
  quick.render.samples_per_pixel = 1;
  quick.render.gather_rays = 16;
  quick.render.light_cell_m = 0.2;
  WriteHome(folder, room, quick, context);
}

}  // namespace enfilade
