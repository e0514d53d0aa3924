// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {

/// The floor of a storey that one can stand on: rooms and open doorways, without furniture.
class StandingSpace {
 public:
  /// `home` must outlive it.
  StandingSpace(const Home& home, int storey_idx);

  /// Distance from `p` to the nearest wall or thing; negative where nobody can stand.
  [[nodiscard]] double Clearance(const Eigen::Vector2d& p) const;
  /// The room that `p` is in, or the first room of the doorway; none elsewhere.
  [[nodiscard]] std::optional<int> RoomAt(const Eigen::Vector2d& p) const;

 private:
  static constexpr double kHeadroom_m = 1.9;  // things that hang higher are in nobody's way
  const Home& home_;
  int storey_idx_;
  PlanSegments solid_;
  std::vector<Ring2> holes_;  ///< by opening; empty ones cannot be walked through
  std::vector<Ring2> things_;
};

}  // namespace enfilade
