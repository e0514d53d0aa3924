// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ground_truth_reader.h"

#include <system_error>

#include "enfilade/base/errors.h"
#include "src/exchange/truth_sources.h"

namespace enfilade {

GroundTruth ReadGroundTruth(const std::filesystem::path& folder, double camera_height_m) {
  const auto has = [&](const char* name) {
    std::error_code ignored;
    return std::filesystem::exists(folder / name, ignored);
  };
  for (const char* name : {"truth/floorplan.json", "floorplan.json"}) {
    if (has(name)) return ReadFloorplanTruth(folder / name, folder);
  }
  if (has("zind_data.json")) return ReadZindTruth(folder / "zind_data.json", camera_height_m);
  if (has("layout.obj")) return ReadObjTruth(folder / "layout.obj");
  throw InvalidInputError(folder.native(), "holds no truth",
                          "name a folder with truth/floorplan.json, floorplan.json, zind_data.json "
                          "or layout.obj");
}

}  // namespace enfilade
