// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "enfilade/evaluate/evaluate.h"

namespace enfilade {

/// A result brought to the truth's world: poses there, and home frames that lead there. The home
/// frame itself stays, and with it polygons, heights and the model. Nothing is copied where the
/// worlds are the same; points of the scene are left out.
class MovedResult {
 public:
  MovedResult(const EvaluationInput& input, const Rigid3& truth_from_world);
  MovedResult(const MovedResult&) = delete;
  MovedResult& operator=(const MovedResult&) = delete;

  [[nodiscard]] const EvaluationInput& input() const { return input_; }

 private:
  EvaluationInput input_;
  std::optional<Scene> scene_;
  std::optional<Structure> structure_;
  std::optional<Floorplan> floorplan_;
};

}  // namespace enfilade
