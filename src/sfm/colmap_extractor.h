// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// One run of `colmap feature_extractor`.
struct ColmapExtractorRun {
  std::filesystem::path program;
  std::filesystem::path database;  ///< is made where it is missing
  std::filesystem::path log;       ///< made anew
  std::filesystem::path views;     ///< folder of the pictures; their list is written here too
  Camera camera;                   ///< pinhole, of all pictures; entered once into the database
  std::set<std::string> pictures;  ///< file names
  double min_contrast = 0.02;      ///< as in FeatureOptions
};

/// The arguments of COLMAP that decide which features it finds in a view of `camera`, and how it
/// describes them.
[[nodiscard]] std::vector<std::string> ColmapSiftArguments(const Camera& camera,
                                                           double min_contrast);

/// Runs COLMAP and checks that the database then has the features of all pictures. Reports progress
/// from its log. Throws DependencyError when it fails or leaves pictures out, StoppedError after
/// killing it, and as ColmapDatabase does.
void RunColmapExtractor(const ColmapExtractorRun& run, RunContext& context);

}  // namespace enfilade
