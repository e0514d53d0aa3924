// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/rooms.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/synthetic/rectangle.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinRoom_m = 2.1;
constexpr double kMinArm_m = 1.7;

struct LayoutParts {
  std::vector<Rectangle> rectangles;  ///< may be divided further
  std::vector<Ring2> finished;
};

bool SplitInTwo(LayoutParts& parts, size_t idx, double thickness_m, Random& random) {
  const Rectangle whole = parts.rectangles[idx];
  const int axis = whole.Size().x() > whole.Size().y() ? 0 : 1;
  const double usable_m = whole.Size()[axis] - thickness_m;
  const double cut_m = std::round(usable_m * random.Uniform(0.38, 0.62) * 1000) / 1000;
  if (std::min(cut_m, usable_m - cut_m) < kMinRoom_m) return false;
  Rectangle low = whole, high = whole;
  low.max[axis] = whole.min[axis] + cut_m;
  high.min[axis] = low.max[axis] + thickness_m;
  parts.rectangles[idx] = low;
  parts.rectangles.push_back(high);
  return true;
}

bool CutCorner(LayoutParts& parts, size_t idx, double thickness_m, Random& random) {
  const Rectangle whole = parts.rectangles[idx];
  Vector2d size;
  for (int axis : {0, 1}) {
    const double max_m =
        std::min(0.6 * whole.Size()[axis], whole.Size()[axis] - thickness_m - kMinArm_m);
    if (max_m < kMinRoom_m) return false;
    size[axis] = random.Millimetres(kMinRoom_m, max_m);
  }
  const Vector2d inner = whole.min + size + Vector2d(thickness_m, thickness_m);
  Ring2 corner = RingOf({whole.min, whole.min + size});
  Ring2 rest = {{inner.x(), whole.min.y()},     {whole.max.x(), whole.min.y()}, whole.max,
                {whole.min.x(), whole.max.y()}, {whole.min.x(), inner.y()},     inner};
  for (int axis : {0, 1}) {
    if (!random.Chance(0.5)) continue;
    Mirror(corner, whole, axis);
    Mirror(rest, whole, axis);
  }
  parts.finished.push_back(std::move(rest));
  parts.finished.push_back(std::move(corner));
  parts.rectangles.erase(parts.rectangles.begin() + static_cast<std::ptrdiff_t>(idx));
  return true;
}

std::optional<size_t> LargestRectangle(const LayoutParts& parts) {
  if (parts.rectangles.empty()) return std::nullopt;
  const auto it =
      std::max_element(parts.rectangles.begin(), parts.rectangles.end(),
                       [](const Rectangle& a, const Rectangle& b) { return a.Area() < b.Area(); });
  return static_cast<size_t>(it - parts.rectangles.begin());
}

// One room alone: now and then with a corner missing.
Ring2 SingleRoom(const Rectangle& whole, double thickness_m, Random& random) {
  LayoutParts parts{{whole}, {}};
  if (random.Chance(0.4) && CutCorner(parts, 0, thickness_m, random)) return parts.finished[0];
  return RingOf(whole);
}

}  // namespace

std::optional<RoomLayout> MakeRoomLayout(int num_rooms, Random& random) {
  RoomLayout layout;
  layout.max_wall_thickness_m = random.Millimetres(0.10, 0.15);
  const Vector2d size = num_rooms == 1
                            ? Vector2d(random.Millimetres(3.2, 6.5), random.Millimetres(2.8, 5.0))
                            : Vector2d(random.Millimetres(2.5, 3.4), random.Millimetres(1.9, 2.6)) *
                                  std::sqrt(3.0 * num_rooms);  // about 20 m² a room
  const Rectangle whole{{0, 0}, size};
  layout.max = size;
  if (num_rooms == 1) {
    layout.rooms = {{SingleRoom(whole, layout.max_wall_thickness_m, random)}};
    return layout;
  }
  LayoutParts parts{{whole}, {}};
  while (static_cast<int>(parts.rectangles.size() + parts.finished.size()) < num_rooms) {
    const std::optional<size_t> idx = LargestRectangle(parts);
    if (!idx) return std::nullopt;
    const bool is_cut =
        random.Chance(0.35) && CutCorner(parts, *idx, layout.max_wall_thickness_m, random);
    if (!is_cut && !SplitInTwo(parts, *idx, layout.max_wall_thickness_m, random)) {
      return std::nullopt;
    }
  }
  for (const Ring2& ring : parts.finished) layout.rooms.push_back({ring});
  for (const Rectangle& rectangle : parts.rectangles) layout.rooms.push_back({RingOf(rectangle)});
  return layout;
}

}  // namespace enfilade
