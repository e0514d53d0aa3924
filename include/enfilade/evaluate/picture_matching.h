// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// What identifies a picture: the hash of its bytes (empty when unknown) and its name.
struct PictureKey {
  std::string picture;
  std::string sha256;
};

[[nodiscard]] std::vector<PictureKey> PictureKeys(const Scene& scene);
[[nodiscard]] std::vector<PictureKey> PictureKeys(const Floorplan& floorplan);
[[nodiscard]] std::vector<PictureKey> PictureKeys(const GroundTruth& truth);

/// For each result picture the index of its truth picture, −1 where there is none. One to one:
/// first by hash, then, among what is left, by file name (folders are ignored). Where several
/// pictures share a hash or a name they pair up in order.
[[nodiscard]] std::vector<int> MatchPictures(std::span<const PictureKey> result,
                                             std::span<const PictureKey> truth);

}  // namespace enfilade
