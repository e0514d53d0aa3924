// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace enfilade {

/// A made home of one room with a window and three panoramas of 256 x 128 pixels, quickly rendered,
/// on request with the clouds of WriteClouds and with the truth about its pixels.
void WriteSmallRoom(const std::filesystem::path& folder, bool has_points = false,
                    bool has_pixel_truth = false);

}  // namespace enfilade
