// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/plan_sheet.h"

#include <algorithm>
#include <optional>
#include <span>

namespace enfilade {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

struct Paper {
  const char* format;
  double width_mm, height_mm;
};
constexpr Paper kPapers[] = {
    {"A4", 297, 210}, {"A4", 210, 297}, {"A3", 420, 297}, {"A3", 297, 420}};
constexpr int kScales[] = {50, 100, 200, 500, 1000};
constexpr double kMinTitleWidth_mm = 180;

enum class Arrangement { kRow, kColumn };

// Space of one storey with its dimensions.
Vector2d CellSize(const AlignedBox2d& extent_m, double mm_per_m) {
  return mm_per_m * extent_m.sizes() + Vector2d::Constant(kDimensionSpace_mm + kStoreyGap_mm);
}

Vector2d ArrangedSize(std::span<const AlignedBox2d> extents_m, double mm_per_m,
                      Arrangement arrangement) {
  const int along = arrangement == Arrangement::kRow ? 0 : 1;
  Vector2d size(0, 0);
  for (const AlignedBox2d& extent : extents_m) {
    const Vector2d cell = CellSize(extent, mm_per_m);
    size[along] += cell[along];
    size[1 - along] = std::max(size[1 - along], cell[1 - along]);
  }
  return size;
}

// Centres the arrangement on the sheet and finds every storey's frame; storeys of a column go from
// the bottom up, as in the building.
void PlaceStoreys(std::span<const AlignedBox2d> extents_m, Arrangement arrangement,
                  PlanSheet& sheet) {
  const double mm_per_m = 1000.0 / sheet.scale_denominator;
  const Vector2d free(sheet.width_mm - 2 * kSheetMargin_mm,
                      sheet.height_mm - 2 * kSheetMargin_mm - kTitleBlock_mm);
  const Vector2d size = ArrangedSize(extents_m, mm_per_m, arrangement);
  const Vector2d begin = Vector2d::Constant(kSheetMargin_mm) + 0.5 * (free - size);
  double used_mm = 0;
  for (const AlignedBox2d& extent : extents_m) {
    const Vector2d cell = CellSize(extent, mm_per_m);
    // Lower left corner of the cell on the sheet.
    Vector2d corner(begin.x() + 0.5 * (size.x() - cell.x()), begin.y() + size.y() - used_mm);
    used_mm += cell.y();
    if (arrangement == Arrangement::kRow) {
      used_mm -= cell.y();
      corner = {begin.x() + used_mm, begin.y() + 0.5 * (size.y() + cell.y())};
      used_mm += cell.x();
    }
    const Vector2d drawing = corner + Vector2d(kDimensionSpace_mm, -kDimensionSpace_mm);
    sheet.frames.push_back(
        {mm_per_m, drawing + mm_per_m * Vector2d(-extent.min().x(), extent.min().y())});
  }
}

std::optional<PlanSheet> TryPaper(std::span<const AlignedBox2d> extents_m, const Paper& paper,
                                  int scale_denominator) {
  PlanSheet sheet{paper.format, scale_denominator, paper.width_mm, paper.height_mm, {}};
  for (const Arrangement arrangement : {Arrangement::kRow, Arrangement::kColumn}) {
    const Vector2d size = ArrangedSize(extents_m, 1000.0 / scale_denominator, arrangement);
    if (size.x() > paper.width_mm - 2 * kSheetMargin_mm ||
        size.y() > paper.height_mm - 2 * kSheetMargin_mm - kTitleBlock_mm) {
      continue;
    }
    PlaceStoreys(extents_m, arrangement, sheet);
    return sheet;
  }
  return std::nullopt;
}

}  // namespace

PlanSheet LayOutSheet(const std::vector<AlignedBox2d>& extents_m) {
  for (const int scale_denominator : kScales) {
    for (const Paper& paper : kPapers) {
      if (auto sheet = TryPaper(extents_m, paper, scale_denominator)) return *sheet;
    }
  }
  const int scale_denominator = kScales[std::size(kScales) - 1];
  const Vector2d size = ArrangedSize(extents_m, 1000.0 / scale_denominator, Arrangement::kRow);
  PlanSheet sheet{"custom",
                  scale_denominator,
                  std::max(kMinTitleWidth_mm, size.x()) + 2 * kSheetMargin_mm,
                  size.y() + 2 * kSheetMargin_mm + kTitleBlock_mm,
                  {}};
  PlaceStoreys(extents_m, Arrangement::kRow, sheet);
  return sheet;
}

}  // namespace enfilade
