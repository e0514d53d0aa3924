// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "grid_extent.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

// Peak use of accumulation and core extraction: grids, distance transforms and labels.
constexpr double kBytesPerCell = 48;

}  // namespace

GridFrame FrameOfEvidence(const WallSampleSet& samples, const std::vector<EvidenceCamera>& cameras,
                          const AccumulateOptions& options, const RunContext& context) {
  Eigen::AlignedBox2d box;
  for (const EvidenceCamera& camera : cameras) box.extend(camera.position);
  for (const WallSample& sample : samples.samples) {
    if (sample.wall_probability.empty()) continue;
    box.extend(sample.origin +
               std::clamp(sample.wall_m, 0.0, options.max_range_m) * sample.direction);
  }
  // Whole cells: the epsilon keeps a border that lies on a cell's edge from adding one through
  // rounding.
  const auto first_cell = [&](double x) {
    return std::floor((x - options.margin_m) / options.cell_m + 1e-6);
  };
  const auto end_cell = [&](double x) {
    return std::ceil((x + options.margin_m) / options.cell_m - 1e-6);
  };
  const Eigen::Vector2d low(first_cell(box.min().x()), first_cell(box.min().y()));
  const Eigen::Vector2d high(end_cell(box.max().x()), end_cell(box.max().y()));
  const Eigen::Vector2d cells = high - low;

  const double num_cells = cells.x() * cells.y();
  const std::string extent =
      fmt::format("{:.0f} × {:.0f} m need {:.1f} million cells of {} m", cells.x() * options.cell_m,
                  cells.y() * options.cell_m, num_cells * 1e-6, options.cell_m);
  // Written so that a NaN or infinite extent is refused as well.
  if (!(num_cells <= options.max_megacells * 1e6)) {
    throw InvalidInputError(
        "evidence grid", extent,
        "check the unit and the outliers of the poses, or raise cell_m or max_megacells");
  }
  if (context.max_memory_mb() > 0 && num_cells * kBytesPerCell > context.max_memory_mb() * 1e6) {
    throw InvalidInputError("evidence grid", extent + ", more than the memory cap allows",
                            "raise cell_m or the memory cap");
  }
  GridFrame frame;
  frame.origin = low * options.cell_m;
  frame.cell_m = options.cell_m;
  frame.cols = static_cast<int>(cells.x());
  frame.rows = static_cast<int>(cells.y());
  return frame;
}

}  // namespace enfilade
