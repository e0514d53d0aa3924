// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/loop_field.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "src/floorplan/grid_steps.h"

namespace enfilade {
namespace {

// What is known of the cells of the grid and of so many beyond it on each side, which nothing is
// known of. Columns are worked on side by side, so that the compiler makes vector code of it.
class DepthMeter {
 public:
  DepthMeter(const LoopField& field, int num_cells)
      : num_cells_(num_cells),
        pad_(num_cells + 1),
        cell_m_(static_cast<float>(field.frame.cell_m)),
        freeness_(Padded(field.freeness)),
        faceness_(Padded(field.faceness)) {}

  /// Metres of free space met when walking outwards from each of the cells (row, −1) … (row, cols),
  /// until a wall stops the view.
  void MeasureFree(int row, int heading, std::vector<float>& depth) const {
    std::fill(depth.begin(), depth.end(), 0.0F);
    std::vector<float> passed(depth.size(), 1.0F);
    const size_t count = depth.size();
    for (int k = 0; k < num_cells_; ++k) {
      const float* free = Row(freeness_, row, heading, k);
      const float* face = Row(faceness_, row, heading, k);
      for (size_t i = 0; i < count; ++i) {
        const float reaching = passed[i] > 0.05F ? passed[i] : 0.0F;
        depth[i] += reaching * std::max(free[i], 0.0F);
        passed[i] *= 1 - std::max(std::max(-free[i], 0.0F), face[i]);
      }
    }
    for (float& d : depth) d *= cell_m_;
  }

  /// Metres of solid wall met when walking from those cells into the room.
  void MeasureSolid(int row, int heading, std::vector<float>& depth) const {
    std::fill(depth.begin(), depth.end(), 0.0F);
    const size_t count = depth.size();
    for (int k = 0; k < num_cells_; ++k) {
      const float* free = Row(freeness_, row, heading, k);
      for (size_t i = 0; i < count; ++i) depth[i] += std::max(-free[i], 0.0F);
    }
    for (float& d : depth) d *= cell_m_;
  }

  /// Of the cells (row, −1) …, from row −1 on.
  [[nodiscard]] const float* Faceness(int row) const { return Row(faceness_, row, 0, 0); }

 private:
  [[nodiscard]] ImageF Padded(const ImageF& image) const {
    ImageF padded(image.rows() + 2 * pad_, image.cols() + 2 * pad_);
    for (int row = 0; row < image.rows(); ++row)
      std::copy_n(image.row(row), image.cols(), padded.row(row + pad_) + pad_);
    return padded;
  }

  // From the cell k steps away from (row, −1) on.
  [[nodiscard]] const float* Row(const ImageF& image, int row, int heading, int k) const {
    return image.row(row + pad_ + k * kRowStep[heading]) + pad_ - 1 + k * kColStep[heading];
  }

  int num_cells_, pad_;
  float cell_m_;
  ImageF freeness_, faceness_;
};

uint16_t ToUnits(double cost_m) {
  return static_cast<uint16_t>(std::clamp(std::lround(cost_m * kCostPerMetre), 0L, 60000L));
}

// Log-odds that are no number say nothing, and none says more than that it is sure.
float Known(float log_odds) {
  constexpr float kSure = 1000;
  return std::isnan(log_odds) ? 0.0F : std::clamp(log_odds, -kSure, kSure);
}

void NormaliseLogOdds(const EvidenceGrids& evidence, const FloorplanOptions& options,
                      LoopField& field) {
  for (size_t i = 0; i < evidence.wall.data().size(); ++i) {
    const float wall = Known(evidence.wall.data()[i]), free = Known(evidence.free.data()[i]);
    field.wall.data()[i] = wall;
    field.freeness.data()[i] = std::tanh(0.5F * free);
    // No face stands where panoramas look through.
    field.faceness.data()[i] =
        std::clamp(wall / static_cast<float>(options.seen_wall_log_odds), 0.0F, 1.0F) *
        (1 - std::max(field.freeness.data()[i], 0.0F));
    field.solidity.data()[i] = static_cast<float>(options.wall_share) * std::max(wall, 0.0F) - free;
  }
}

}  // namespace

LoopField NormaliseEvidence(const EvidenceGrids& evidence, const FloorplanOptions& options) {
  ENFILADE_CHECK(evidence.mode == EvidenceMode::kLogOdds);
  LoopField field;
  field.frame = evidence.frame;
  const int rows = field.frame.rows, cols = field.frame.cols;
  field.wall = ImageF(rows, cols);
  field.freeness = ImageF(rows, cols);
  field.faceness = ImageF(rows, cols);
  field.solidity = ImageF(rows, cols);
  NormaliseLogOdds(evidence, options, field);
  return field;
}

LoopField MakeLoopField(const EvidenceGrids& evidence, const FloorplanOptions& options) {
  LoopField field = NormaliseEvidence(evidence, options);
  const int rows = field.frame.rows, cols = field.frame.cols;
  field.turn_cost = std::max(1, static_cast<int>(std::lround(options.turn_cost_m * kCostPerMetre)));

  GridLoopProblem layout;
  layout.rows = rows;
  layout.cols = cols;
  field.step_cost.assign(layout.StepIndex(rows + 1, 0, GridHeading::kEast), 0);
  const double cell_m = field.frame.cell_m;
  const DepthMeter meter(field,
                         std::max(1, static_cast<int>(std::lround(options.free_depth_m / cell_m))));
  std::vector<float> free(static_cast<size_t>(cols) + 2), solid(free.size());
  for (int heading = 0; heading < 4; ++heading) {
    const auto direction = static_cast<GridHeading>(heading);
    const GridVertex left = LeftCell({0, 0}, direction), right = RightCell({0, 0}, direction);
    for (int row = 0; row <= rows; ++row) {
      meter.MeasureFree(row + right.row, (heading + 3) & 3, free);
      meter.MeasureSolid(row + left.row, (heading + 1) & 3, solid);
      const float* left_face = meter.Faceness(row + left.row) + 1 + left.col;
      const float* right_face = meter.Faceness(row + right.row) + 1 + right.col;
      for (int col = 0; col <= cols; ++col) {
        const float face = std::max(left_face[col], right_face[col]);
        const double rate =
            1 - face + options.outside_weight * free[static_cast<size_t>(col + 1 + right.col)] +
            options.inside_weight * solid[static_cast<size_t>(col + 1 + left.col)];
        field.step_cost[layout.StepIndex(row, col, direction)] = ToUnits(rate * cell_m);
      }
    }
  }
  return field;
}

LoopField Cropped(const LoopField& field, const GridWindow& window) {
  LoopField part;
  part.frame = field.frame;
  part.frame.origin += field.frame.cell_m * Eigen::Vector2d(window.col, window.row);
  part.frame.rows = window.rows;
  part.frame.cols = window.cols;
  part.wall = Cropped(field.wall, window);
  part.freeness = Cropped(field.freeness, window);
  part.faceness = Cropped(field.faceness, window);
  part.solidity = Cropped(field.solidity, window);
  part.turn_cost = field.turn_cost;
  const size_t row_size = 4 * static_cast<size_t>(field.frame.cols + 1);
  const size_t part_size = 4 * static_cast<size_t>(window.cols + 1);
  for (int row = 0; row <= window.rows; ++row) {
    const auto first =
        field.step_cost.begin() +
        static_cast<std::ptrdiff_t>(static_cast<size_t>(window.row + row) * row_size +
                                    4 * static_cast<size_t>(window.col));
    part.step_cost.insert(part.step_cost.end(), first,
                          first + static_cast<std::ptrdiff_t>(part_size));
  }
  return part;
}

std::vector<uint16_t> ReversedStepCosts(const LoopField& field) {
  GridLoopProblem layout;
  layout.rows = field.frame.rows;
  layout.cols = field.frame.cols;
  std::vector<uint16_t> reversed(field.step_cost.size(), kBlockedStep);
  for (int row = 0; row <= layout.rows; ++row) {
    for (int col = 0; col <= layout.cols; ++col) {
      for (int heading = 0; heading < 4; ++heading) {
        const int to_row = row + kRowStep[heading], to_col = col + kColStep[heading];
        if (to_row < 0 || to_col < 0 || to_row > layout.rows || to_col > layout.cols) continue;
        reversed[layout.StepIndex(row, col, static_cast<GridHeading>(heading))] =
            field
                .step_cost[layout.StepIndex(to_row, to_col, static_cast<GridHeading>(heading ^ 2))];
      }
    }
  }
  return reversed;
}

void BlockCells(const ImageU8& cells, GridLoopProblem& problem) {
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      if (cells(row, col) == 0) continue;
      for (int heading = 0; heading < 4; ++heading) {
        // The vertex from which a step with this heading has the cell on its left.
        const auto direction = static_cast<GridHeading>(heading);
        const GridVertex offset = LeftCell({0, 0}, direction);
        problem.step_cost[problem.StepIndex(row - offset.row, col - offset.col, direction)] =
            kBlockedStep;
      }
    }
  }
}

}  // namespace enfilade
