// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace enfilade {

/// A folder that sfm accepts, in milliseconds: `num_pictures` panoramas of 128 x 64 pixels of a
/// plain striped box, 1 m apart, and poses.csv.
void WriteSmallInput(const std::filesystem::path& folder, int num_pictures = 3);

}  // namespace enfilade
