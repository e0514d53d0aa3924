// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "src/exchange/plan_labels.h"

namespace enfilade {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kScales[] = {50, 75, 100, 150, 200, 250, 300, 400, 500, 750, 1000};
constexpr double kMaxMaps_mm = 175;  // height of all rows, where the panels' least heights allow
constexpr double kGap_mm = 3;
constexpr double kMinMap_mm = 20;    // width and height
constexpr double kAround_m = 0.8;    // free space round the cameras
constexpr double kPointReach_m = 4;  // points farther from all cameras do not widen a panel
constexpr double kPointQuantile = 0.02;
constexpr double kInner_mm = kMapWidth_mm - 2 * (kSheetMargin_mm + kGap_mm);
constexpr double kListRow_mm = 5;
constexpr double kListDot_mm = 4;  // from a dot's centre to the end of the one before, or to text
constexpr double kHeadingSize_mm = 2.8, kDetailsSize_mm = 2.2, kLabelSize_mm = 2.2;

// Between the quantiles of the values.
std::pair<double, double> Spread(std::vector<double> values) {
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return {values[static_cast<size_t>(last * kPointQuantile)],
          values[static_cast<size_t>(last * (1 - kPointQuantile))]};
}

// What the panel of a component shows: the cameras, and most of the points where they are near.
AlignedBox2d ExtentOf(const ConnectionFacts& facts, int component) {
  AlignedBox2d cameras;
  for (const int view : facts.components[static_cast<size_t>(component)].views) {
    cameras.extend(Vector2d(facts.views[static_cast<size_t>(view)].position_m.head<2>()));
  }
  const Vector2d around = Vector2d::Constant(kAround_m), reach = Vector2d::Constant(kPointReach_m);
  const AlignedBox2d near(cameras.min() - reach, cameras.max() + reach);
  AlignedBox2d extent(cameras.min() - around, cameras.max() + around);
  std::vector<double> x, y;
  for (const PointFact& point : facts.points) {
    if (point.component != component || !near.contains(point.position_m)) continue;
    x.push_back(point.position_m.x());
    y.push_back(point.position_m.y());
  }
  if (x.empty()) return extent;
  const auto [x_min, x_max] = Spread(std::move(x));
  const auto [y_min, y_max] = Spread(std::move(y));
  extent.extend(Vector2d(x_min, y_min));
  return extent.extend(Vector2d(x_max, y_max));
}

struct Cell {
  MapPanel panel;
  AlignedBox2d extent_m;
};

std::vector<Cell> MapCells(const ConnectionFacts& facts) {
  std::vector<Cell> cells;
  for (size_t i = 0; i < facts.components.size(); ++i) {
    const ComponentFact& component = facts.components[i];
    if (component.views.size() < 2) continue;
    Cell cell;
    cell.panel.component = static_cast<int>(i);
    cell.panel.heading = fmt::format("Component {}", component.idx);
    cell.panel.details =
        fmt::format("{} within {:.1f} × {:.1f} m", Counted(component.views.size(), "picture"),
                    component.extent_m.x(), component.extent_m.y());
    cell.extent_m = ExtentOf(facts, static_cast<int>(i));
    cells.push_back(std::move(cell));
  }
  return cells;
}

Vector2d LeastSize(const Cell& cell, double mm_per_m) {
  const double lettering = std::max(TextWidth(cell.panel.heading, kHeadingSize_mm),
                                    TextWidth(cell.panel.details, kDetailsSize_mm));
  const Vector2d map = mm_per_m * cell.extent_m.sizes();
  return Vector2d(std::max({map.x(), lettering, kMinMap_mm}), std::max(map.y(), kMinMap_mm)) +
         Vector2d(2 * kPanelPadding_mm, 2 * kPanelPadding_mm + kPanelHeading_mm);
}

// Fills the boxes of the panels row by row from `corner` on, `width` wide, the width left over
// shared by a row's panels. Returns the height of all with a gap below each row, infinite when a
// panel is too wide.
double PlaceInRows(double mm_per_m, const Vector2d& corner, double width, std::span<Cell> cells) {
  double top = corner.y();
  for (size_t begin = 0; begin < cells.size();) {
    size_t end = begin;
    double used = -kGap_mm, height = 0;
    for (; end < cells.size(); ++end) {
      const Vector2d size = LeastSize(cells[end], mm_per_m);
      if (used + kGap_mm + size.x() > width) break;
      used += kGap_mm + size.x();
      height = std::max(height, size.y());
    }
    if (end == begin) return std::numeric_limits<double>::infinity();
    const double extra = (width - used) / static_cast<double>(end - begin);
    double left = corner.x();
    for (; begin < end; ++begin) {
      const double own = LeastSize(cells[begin], mm_per_m).x() + extra;
      cells[begin].panel.box_mm = {Vector2d(left, top), Vector2d(left + own, top + height)};
      left += own + kGap_mm;
    }
    top += height + kGap_mm;
  }
  return top - corner.y();
}

// As above with the first panel on the left and the rows of the others to the right of it.
double PlaceBesideFirst(double mm_per_m, std::span<Cell> cells) {
  const Vector2d first = LeastSize(cells.front(), mm_per_m);
  const double left = first.x() + kGap_mm;
  const double others = PlaceInRows(mm_per_m, {left, 0}, kInner_mm - left, cells.subspan(1));
  const double height = std::max(first.y() + kGap_mm, others);
  cells.front().panel.box_mm = {Vector2d(0, 0), Vector2d(first.x(), height - kGap_mm)};
  // The last row reaches as far down as the first panel.
  const double bottom = cells.back().panel.box_mm.max().y();
  for (Cell& cell : cells.subspan(1)) {
    if (cell.panel.box_mm.max().y() == bottom) cell.panel.box_mm.max().y() = height - kGap_mm;
  }
  return height;
}

// Returns the height of all panels, each with a gap below.
double PlaceCells(double mm_per_m, std::span<Cell> cells) {
  const double rows = PlaceInRows(mm_per_m, {0, 0}, kInner_mm, cells);
  if (cells.size() < 3) return rows;
  const double beside = PlaceBesideFirst(mm_per_m, cells);
  return beside < rows ? beside : PlaceInRows(mm_per_m, {0, 0}, kInner_mm, cells);
}

double ChooseScale(std::span<Cell> cells) {
  const double most = std::max(kMaxMaps_mm, PlaceCells(0, cells));
  const auto fits = [&](double denominator) {
    return PlaceCells(1000 / denominator, cells) <= most;
  };
  const auto chosen = std::ranges::find_if(kScales, fits);
  if (chosen != std::end(kScales)) return *chosen;
  double denominator = 2 * kScales[std::size(kScales) - 1];
  while (!fits(denominator)) denominator *= 2;
  return denominator;
}

// Puts the middle of the extent into the middle of the panel's map.
void CenterMap(double mm_per_m, Cell& cell) {
  const AlignedBox2d& box = cell.panel.box_mm;
  const Vector2d middle_mm(box.center().x(), box.center().y() + 0.5 * kPanelHeading_mm);
  const Vector2d middle_m = cell.extent_m.center();
  cell.panel.frame = {mm_per_m, middle_mm + mm_per_m * Vector2d(-middle_m.x(), middle_m.y())};
}

// The list of pictures without ties, as columns of dots with names. Returns its height.
double PlaceSingles(const ConnectionFacts& facts, double top, MapSheet& sheet) {
  std::vector<int> singles;
  double column_mm = 0;
  for (const ComponentFact& component : facts.components) {
    if (component.views.size() > 1) continue;
    singles.push_back(component.views.front());
    const std::string name = ListName(facts.views[static_cast<size_t>(singles.back())]);
    column_mm = std::max(column_mm, TextWidth(name, kLabelSize_mm) + 2 * kListDot_mm);
  }
  if (singles.empty()) return 0;
  const double free_mm = kInner_mm - 2 * kPanelPadding_mm;
  const size_t num_columns = static_cast<size_t>(std::max(1.0, std::floor(free_mm / column_mm)));
  const size_t num_rows = (singles.size() + num_columns - 1) / num_columns;
  const double left = kSheetMargin_mm + kGap_mm;
  for (size_t i = 0; i < singles.size(); ++i) {
    const size_t col = i / num_rows, row = i % num_rows;
    const Vector2d cell(static_cast<double>(col) * column_mm,
                        (static_cast<double>(row) + 0.5) * kListRow_mm);
    sheet.cameras_mm[static_cast<size_t>(singles[i])] =
        Vector2d(left + kPanelPadding_mm + 1, top + kPanelPadding_mm + kPanelHeading_mm) + cell;
  }
  const double height =
      static_cast<double>(num_rows) * kListRow_mm + kPanelHeading_mm + 2 * kPanelPadding_mm;
  MapPanel list;
  list.heading = "Not connected";
  list.details = Counted(singles.size(), "picture") + " tied to no other, so without a place";
  list.box_mm = {Vector2d(left, top), Vector2d(left + kInner_mm, top + height)};
  sheet.panels.push_back(std::move(list));
  return height + kGap_mm;
}

// From the median distance to the nearest camera on the sheet.
double SymbolScale(std::span<const Vector2d> cameras_mm) {
  constexpr double kRoomy_mm = 9, kLeast = 0.35;
  std::vector<double> nearest;
  for (size_t i = 0; i < cameras_mm.size(); ++i) {
    nearest.push_back(kRoomy_mm);
    for (size_t k = 0; k < cameras_mm.size(); ++k) {
      if (k != i) nearest[i] = std::min(nearest[i], (cameras_mm[k] - cameras_mm[i]).norm());
    }
  }
  if (nearest.empty()) return 1;
  std::ranges::sort(nearest);
  return std::max(kLeast, nearest[nearest.size() / 2] / kRoomy_mm);
}

}  // namespace

std::string ListName(const ViewFact& view) {
  constexpr double kMaxName_mm = 90;
  return TextWidth(view.picture, kLabelSize_mm) > kMaxName_mm ? view.name : view.picture;
}

MapSheet LayOutMap(const ConnectionFacts& facts) {
  MapSheet sheet;
  std::vector<Cell> cells = MapCells(facts);
  sheet.scale_denominator = ChooseScale(cells);
  const double mm_per_m = 1000 / sheet.scale_denominator;
  const double maps_mm = PlaceCells(mm_per_m, cells);
  const Vector2d corner = Vector2d::Constant(kSheetMargin_mm + kGap_mm);
  sheet.cameras_mm.resize(facts.views.size(), corner);
  std::vector<Vector2d> placed;
  for (Cell& cell : cells) {
    cell.panel.box_mm.translate(corner);
    CenterMap(mm_per_m, cell);
    const auto component = static_cast<size_t>(cell.panel.component);
    for (const int view : facts.components[component].views) {
      const Vector2d position_m = facts.views[static_cast<size_t>(view)].position_m.head<2>();
      placed.push_back(cell.panel.frame * position_m);
      sheet.cameras_mm[static_cast<size_t>(view)] = placed.back();
    }
    sheet.panels.push_back(cell.panel);
  }
  sheet.symbol_scale = SymbolScale(placed);
  const double list_mm = PlaceSingles(facts, corner.y() + maps_mm, sheet);
  sheet.height_mm = corner.y() + maps_mm + list_mm + kMapTitleBlock_mm + kSheetMargin_mm;
  return sheet;
}

}  // namespace enfilade
