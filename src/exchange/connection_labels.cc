// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "src/exchange/plan_labels.h"

namespace enfilade {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kSize_mm = 2.2;
constexpr double kRise_mm = 0.36 * kSize_mm;  // of the middle of small letters and figures
constexpr double kOffset_mm = 1.7;            // from a camera to its name
constexpr double kListOffset_mm = 2.2;
constexpr double kMinShare = 0.5;    // of a panel's names must find a place
constexpr double kMaxCovered = 0.2;  // of a panel, by all its names

// Where a name stands from its camera, best first: right, left, below, above, corners.
constexpr std::array<std::array<double, 2>, 8> kPlaces = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0.8, 0.8}, {0.8, -0.8}, {-0.8, 0.8}, {-0.8, -0.8}}};

struct Name {
  TextLine line;
  AlignedBox2d box;
};

Name NameAt(const std::string& text, const Vector2d& camera, const Vector2d& offset) {
  const double width = TextWidth(text, kSize_mm);
  const double side = offset.x() == 0 ? 0 : std::copysign(1.0, offset.x());
  // Above and below, the letters' own height is added to the offset.
  const Vector2d anchor =
      camera + offset + Vector2d(0, side == 0 ? std::copysign(0.3 * kSize_mm, offset.y()) : 0);
  const char* style = side == 0  ? "map-name name-middle"
                      : side > 0 ? "map-name name-start"
                                 : "map-name name-end";
  const double left = anchor.x() + 0.5 * (side - 1) * width;
  const Vector2d half_height(0, 0.65 * kSize_mm);  // with some air
  return {
      {text, style, anchor + Vector2d(0, kRise_mm), 0},
      {Vector2d(left, anchor.y()) - half_height, Vector2d(left + width, anchor.y()) + half_height}};
}

bool Crosses(const MapSegment& line, const AlignedBox2d& box) {
  const AlignedBox2d around(line.a.cwiseMin(line.b), line.a.cwiseMax(line.b));
  if (!around.intersects(box)) return false;
  const Vector2d along = line.b - line.a;
  const double length = along.norm();
  if (length == 0) return true;
  const Vector2d size = 0.5 * box.sizes();
  return Overlap({0.5 * (line.a + line.b), along / length, 0.5 * length, 0},
                 {box.center(), Vector2d::UnitX(), size.x(), size.y()});
}

class NamePlacer {
 public:
  NamePlacer(const ConnectionFacts& facts, const MapSheet& sheet, std::span<const MapSegment> lines)
      : facts_(facts), sheet_(sheet), lines_(lines) {}

  // None where there is no space.
  std::optional<TextLine> Place(int view, const AlignedBox2d& panel) {
    const Vector2d camera = sheet_.cameras_mm[static_cast<size_t>(view)];
    const double yaw_rad = facts_.views[static_cast<size_t>(view)].yaw_rad;
    const Vector2d forward(std::cos(yaw_rad), -std::sin(yaw_rad));
    std::optional<Name> best;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [x, y] : kPlaces) {
      const Vector2d offset = kOffset_mm * Vector2d(x, y);
      const Name name = NameAt(facts_.views[static_cast<size_t>(view)].name, camera, offset);
      if (!panel.contains(name.box) || !IsFree(view, name.box)) continue;
      const auto crosses = [&](const MapSegment& line) { return Crosses(line, name.box); };
      // A name in front of the camera covers the wedge there.
      const double cost = static_cast<double>(std::ranges::count_if(lines_, crosses)) +
                          std::max(0.0, forward.dot(offset) / kOffset_mm);
      if (cost >= least) continue;
      least = cost;
      best = name;
    }
    if (!best) return std::nullopt;
    taken_.push_back(best->box);
    return best->line;
  }

 private:
  [[nodiscard]] bool IsFree(int view, const AlignedBox2d& box) const {
    for (const AlignedBox2d& other : taken_) {
      if (box.intersects(other)) return false;
    }
    const double radius = sheet_.symbol_scale;
    for (size_t i = 0; i < sheet_.cameras_mm.size(); ++i) {
      const bool is_other = i != static_cast<size_t>(view);
      if (is_other && box.exteriorDistance(sheet_.cameras_mm[i]) < radius) return false;
    }
    return true;
  }

  const ConnectionFacts& facts_;
  const MapSheet& sheet_;
  std::span<const MapSegment> lines_;
  std::vector<AlignedBox2d> taken_;
};

// The names of a panel, none where they would crowd it.
std::vector<TextLine> NamesOf(const ConnectionFacts& facts, const MapPanel& panel,
                              NamePlacer& placer) {
  const std::vector<int>& views = facts.components[static_cast<size_t>(panel.component)].views;
  double area_mm2 = 0;
  for (const int view : views) {
    area_mm2 += kSize_mm * TextWidth(facts.views[static_cast<size_t>(view)].name, kSize_mm);
  }
  if (area_mm2 > kMaxCovered * panel.box_mm.volume()) return {};
  std::vector<TextLine> names;
  for (const int view : views) {
    if (auto name = placer.Place(view, panel.box_mm)) names.push_back(std::move(*name));
  }
  const double share = static_cast<double>(names.size()) / static_cast<double>(views.size());
  return share < kMinShare ? std::vector<TextLine>() : names;
}

}  // namespace

std::vector<TextLine> PlaceNames(const ConnectionFacts& facts, const MapSheet& sheet,
                                 std::span<const MapSegment> lines) {
  NamePlacer placer(facts, sheet, lines);
  std::vector<TextLine> names;
  for (const MapPanel& panel : sheet.panels) {
    if (panel.component < 0) continue;
    for (TextLine& name : NamesOf(facts, panel, placer)) names.push_back(std::move(name));
  }
  for (const ComponentFact& component : facts.components) {
    if (component.views.size() > 1) continue;
    const auto view = static_cast<size_t>(component.views.front());
    names.push_back(
        NameAt(ListName(facts.views[view]), sheet.cameras_mm[view], {kListOffset_mm, 0}).line);
  }
  return names;
}

}  // namespace enfilade
