// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "enfilade/scene/types.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/odd_pictures.h"

namespace enfilade {

/// Each adds what there is to say of pictures to `warnings`, as whole sentences with the pictures'
/// names; nothing where all is well.

void WarnOfUpsideDown(std::span<const View> views, std::span<const OddTie> upside_down,
                      std::vector<std::string>& warnings);
void WarnOfMirrored(std::span<const View> views, std::span<const OddTie> mirrored,
                    std::vector<std::string>& warnings);
void WarnOfCopies(std::span<const View> views, std::span<const OddTie> copies,
                  std::vector<std::string>& warnings);

/// Panoramas that nothing ties to others, and into how many groups the others fall.
void WarnOfUntied(std::span<const View> views, std::span<const int> component_idx,
                  std::vector<std::string>& warnings);

/// Pictures whose lines (at least 8) say another vertical than their metadata, by more than 2°.
void WarnOfToldVerticals(std::span<const View> views, std::span<const Gravity> gravity,
                         std::vector<std::string>& warnings);

}  // namespace enfilade
