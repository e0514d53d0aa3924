// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/paper_field.h"

namespace enfilade {

/// A vertex that is passed in one direction.
struct GridPass {
  GridVertex vertex;
  GridHeading heading = GridHeading::kEast;
};

/// Cheapest Manhattan ways between two passes with the core on their left, as a guess of what a leg
/// of the second path costs.
class LegSolver {
 public:
  LegSolver(const PaperField& field, const ImageU8& core, const ImageU8& foreign);

  /// Steps and corners of the cheapest way within the box of both ends grown by 1 m; a large number
  /// when there is none.
  [[nodiscard]] int64_t Cost(const GridPass& from, const GridPass& to) const;

 private:
  const PaperField& field_;
  GridLoopProblem problem_;
};

}  // namespace enfilade
