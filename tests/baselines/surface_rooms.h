// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "enfilade/baselines/surface_points.h"
#include "enfilade/baselines/surface_report.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/synthetic/fixtures.h"
#include "enfilade/synthetic/text_home.h"

namespace enfilade {

/// A home from text (TextHome), what a perfect stage `structure` would find in it and the points
/// that come from it.
struct SurfaceRooms {
  Scene scene;
  Structure structure;
  std::vector<ScenePoint> points;

  explicit SurfaceRooms(std::string_view text, const ProfileNoise& noise = {})
      : scene(FixtureScene(TextHome(text))), structure(FixtureStructure(TextHome(text), noise)) {
    RunContext context(1);
    points = SurfacePoints(scene, structure, context);
  }
};

/// All rooms of the plan.
inline MultiPolygon2 RegionOf(const SurfaceReport& report) {
  MultiPolygon2 region;
  for (const Storey& storey : report.plan.storeys) {
    for (const Room& room : storey.rooms) region.push_back(room.polygon);
  }
  return region;
}

}  // namespace enfilade
