// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/plan_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kNameSize_mm = 2.6, kAreaSize_mm = 2.4, kHeightSize_mm = 2.0, kSmallSize_mm = 1.7;
constexpr double kDimensionSize_mm = 1.8;
constexpr double kLineSpacing = 1.35;
constexpr double kTextGap_mm = 0.6;  ///< between a dimension line and its text
constexpr std::array<double, 3> kDimensionOffsets_mm{3.4, 5.8, 8.2};
constexpr double kOverallOffset_mm = 7;
constexpr double kSameLength_m = 0.01;

struct SizedLine {
  std::string text;
  const char* style;
  double size_mm;
};

Vector2d Perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }

TurnedBox BoxOfSegment(const Vector2d& a, const Vector2d& b) {
  const double length = (b - a).norm();
  return {0.5 * (a + b), length > 0 ? Vector2d((b - a) / length) : Vector2d::UnitX(), 0.5 * length,
          0};
}

bool OverlapAlong(const Vector2d& axis, const TurnedBox& a, const TurnedBox& b) {
  const auto reach = [&](const TurnedBox& box) {
    return box.half_width_mm * std::abs(axis.dot(box.axis)) +
           box.half_height_mm * std::abs(axis.dot(Perpendicular(box.axis)));
  };
  return std::abs(axis.dot(a.center - b.center)) <= reach(a) + reach(b);
}

// A room's outline on the sheet.
class PaperRoom {
 public:
  // `avoided` are points on the sheet that a label should not cover, if there is a choice.
  PaperRoom(const Room& room, const PaperFrame& frame, const std::vector<Vector2d>& avoided)
      : avoided_(avoided) {
    AddRing(room.polygon.outer, frame, polygon_.outer);
    for (const Ring2& hole : room.polygon.holes) {
      AddRing(hole, frame, polygon_.holes.emplace_back());
    }
  }

  [[nodiscard]] bool Holds(const TurnedBox& box) const {
    return Contains(polygon_, box.center) &&
           std::none_of(edges_.begin(), edges_.end(),
                        [&](const TurnedBox& edge) { return Overlap(edge, box); });
  }

  // The place for a box of `size`, wider than high or not, with the most space around it: the point
  // with the greatest distance to the outline when the axes are scaled by the box's sides. Of
  // nearly equal ones the one nearest to the middle of the bounding box.
  [[nodiscard]] Vector2d RoomiestPlace(const Vector2d& size) const {
    Eigen::AlignedBox2d bounds;
    for (const Vector2d& p : polygon_.outer) bounds.extend(p);
    const Vector2d scale = size.cwiseInverse();
    Vector2d best = bounds.center();
    double best_value = -std::numeric_limits<double>::infinity();
    constexpr int kSteps = 48;
    for (int i = 1; i < kSteps; ++i) {
      for (int j = 1; j < kSteps; ++j) {
        const Vector2d p = bounds.min() + bounds.sizes().cwiseProduct(Vector2d(i, j) / kSteps);
        if (!Contains(polygon_, p)) continue;
        double distance = std::numeric_limits<double>::infinity();
        for (const TurnedBox& edge : edges_) {
          const Vector2d half = edge.half_width_mm * edge.axis;
          distance =
              std::min(distance, DistanceToSegment(p.cwiseProduct(scale),
                                                   (edge.center - half).cwiseProduct(scale),
                                                   (edge.center + half).cwiseProduct(scale)));
        }
        for (const Vector2d& q : avoided_) {
          distance = std::min(distance, (p - q).cwiseProduct(scale).norm());
        }
        const double off_center = (p - bounds.center()).norm() / bounds.sizes().norm();
        const double value = distance - 0.2 * off_center;
        if (value > best_value + 1e-9) {
          best = p;
          best_value = value;
        }
      }
    }
    return best;
  }

 private:
  void AddRing(const Ring2& ring, const PaperFrame& frame, Ring2& target) {
    for (const Vector2d& p : ring) target.push_back(frame * p);
    for (size_t i = 0; i < target.size(); ++i) {
      edges_.push_back(BoxOfSegment(target[i], target[(i + 1) % target.size()]));
    }
  }

  Polygon2 polygon_;
  std::vector<TurnedBox> edges_;
  std::vector<Vector2d> avoided_;
};

// Space on the sheet that is taken already. Dimension lines may cross each other, as on any
// drawing, but not run into each other, and no line may cross a text.
class TakenSpace {
 public:
  [[nodiscard]] bool IsFreeForText(const TurnedBox& box) const {
    return IsFreeOf(texts_, box) && IsFreeOf(lines_, box);
  }
  [[nodiscard]] bool IsFreeForLine(const TurnedBox& box) const {
    return IsFreeOf(texts_, box) &&
           std::none_of(lines_.begin(), lines_.end(), [&](const TurnedBox& line) {
             return std::abs(line.axis.dot(box.axis)) > 0.9 && Overlap(line, box);
           });
  }
  void TakeForText(const TurnedBox& box) { texts_.push_back(box); }
  void TakeForLine(const TurnedBox& box) { lines_.push_back(box); }

 private:
  [[nodiscard]] static bool IsFreeOf(const std::vector<TurnedBox>& boxes, const TurnedBox& box) {
    return std::none_of(boxes.begin(), boxes.end(),
                        [&](const TurnedBox& other) { return Overlap(other, box); });
  }

  std::vector<TurnedBox> texts_, lines_;
};

std::string AreaText(const Room& room) {
  const double area_m2 = Area(room.polygon);
  if (room.area_sigma_m2 <= 0) return fmt::format("{:.2f} m²", area_m2);
  // As many decimals as the uncertainty has meaning for.
  const int num_decimals = room.area_sigma_m2 >= 0.095 ? 1 : 2;
  return fmt::format("{:.{}f} ± {:.{}f} m²", area_m2, num_decimals, room.area_sigma_m2,
                     num_decimals);
}

// From the fullest lettering to the scantest.
std::vector<std::vector<SizedLine>> LabelVariants(const Room& room) {
  const std::string name = fmt::format("Room {}", room.id), area = AreaText(room);
  const std::string height = fmt::format("h {:.2f} m", room.ceiling_z - room.floor_z);
  return {{{name, "room-name", kNameSize_mm},
           {area, "room-area", kAreaSize_mm},
           {height, "room-height", kHeightSize_mm}},
          {{name, "room-name", kNameSize_mm}, {area, "room-area", kAreaSize_mm}},
          {{name, "room-small", kSmallSize_mm}, {area, "room-small", kSmallSize_mm}},
          {{area, "room-small", kSmallSize_mm}},
          {{fmt::format("{}", room.id), "room-small", kSmallSize_mm}}};
}

Vector2d BlockSize(const std::vector<SizedLine>& lines) {
  Vector2d size(0, 0);
  for (const SizedLine& line : lines) {
    size.x() = std::max(size.x(), TextWidth(line.text, line.size_mm));
    size.y() += kLineSpacing * line.size_mm;
  }
  return size;
}

RoomLabel LabelAt(const Room& room, const std::vector<SizedLine>& lines, const Vector2d& center,
                  bool is_turned) {
  RoomLabel label{room.id, {}};
  const Vector2d down = is_turned ? Vector2d(1, 0) : Vector2d(0, 1);
  double depth = -0.5 * BlockSize(lines).y();
  for (const SizedLine& line : lines) {
    // The baseline lies about a capital's height below the middle of the leading above it.
    const Vector2d anchor = center + (depth + 1.05 * line.size_mm) * down;
    label.lines.push_back({line.text, line.style, anchor, is_turned ? -90.0 : 0.0});
    depth += kLineSpacing * line.size_mm;
  }
  return label;
}

RoomLabel PlaceRoomLabel(const Room& room, const PaperRoom& outline, TakenSpace& taken) {
  const auto variants = LabelVariants(room);
  for (const std::vector<SizedLine>& lines : variants) {
    for (const bool is_turned : {false, true}) {
      const Vector2d size = BlockSize(lines);
      const Vector2d upright = is_turned ? Vector2d(size.y(), size.x()) : size;
      const Vector2d center = outline.RoomiestPlace(upright);
      const TurnedBox box{center, Vector2d::UnitX(), 0.5 * upright.x(), 0.5 * upright.y()};
      if (!outline.Holds(box)) continue;
      taken.TakeForText(box);
      return LabelAt(room, lines, center, is_turned);
    }
  }
  // Not even its number fits: it stands there all the same.
  const Vector2d size = BlockSize(variants.back());
  const Vector2d center = outline.RoomiestPlace(size);
  taken.TakeForText({center, Vector2d::UnitX(), 0.5 * size.x(), 0.5 * size.y()});
  return LabelAt(room, variants.back(), center, false);
}

// Text along a line, readable from below or from the right.
TextLine TextOnLine(const std::string& text, const Vector2d& a, const Vector2d& b) {
  Vector2d along = (b - a).normalized();
  constexpr double kUpright = 0.02;  // walls a degree off the vertical read as vertical ones
  if (along.x() < -kUpright || (along.x() <= kUpright && along.y() > 0)) along = -along;
  // On paper y points down, so «above» the line is against its perpendicular.
  const Vector2d anchor = 0.5 * (a + b) - kTextGap_mm * Perpendicular(along);
  return {text, "dimension-text", anchor, RadToDeg(std::atan2(along.y(), along.x()))};
}

TurnedBox BoxOfText(const TextLine& text, double size_mm) {
  const double angle = DegToRad(text.angle_deg);
  const Vector2d along(std::cos(angle), std::sin(angle));
  const double half_height = 0.5 * 0.75 * size_mm;
  return {text.anchor - half_height * Perpendicular(along), along,
          0.5 * TextWidth(text.text, size_mm) + 0.3, half_height + 0.2};
}

// A wall's length from the fullest lettering to the scantest.
std::vector<std::string> LengthTexts(double length_m, double sigma_m) {
  const std::string length = fmt::format("{:.2f}", length_m);
  if (sigma_m <= 0) return {length};
  const std::string with_sigma = fmt::format("{} ± {:.2f}", length, std::max(sigma_m, 0.01));
  return {with_sigma + " m", with_sigma, length};
}

// True when `other` is parallel to `wall` and lies opposite or beside it with the same ends, so
// that one length tells both.
bool TellsSameLength(const Wall& wall, const Wall& other) {
  const Vector2d along = (wall.b - wall.a).normalized();
  const Vector2d a = other.a - wall.a, b = other.b - wall.a;
  if (std::abs(Perpendicular(along).dot(b - a)) > kSameLength_m) return false;
  const double length = (wall.b - wall.a).norm();
  const double begin = std::min(along.dot(a), along.dot(b));
  const double end = std::max(along.dot(a), along.dot(b));
  return std::abs(begin) <= kSameLength_m && std::abs(end - length) <= kSameLength_m;
}

bool PlaceWallDimension(const Wall& wall, const std::string& text, const PaperFrame& frame,
                        const PaperRoom& outline, TakenSpace& taken,
                        std::vector<DimensionLine>& dimensions) {
  const double length_m = (wall.b - wall.a).norm();
  if (length_m * frame.mm_per_m < TextWidth(text, kDimensionSize_mm) + 1) return false;
  const Vector2d a = frame * wall.a, b = frame * wall.b;
  // The room lies on the left in the plan, which is on the right on paper's flipped y.
  const Vector2d inwards = -Perpendicular((b - a).normalized());
  for (const double offset : kDimensionOffsets_mm) {
    DimensionLine line{wall.id, a, b, a + offset * inwards, b + offset * inwards, {}};
    line.text = TextOnLine(text, line.line_a, line.line_b);
    TurnedBox stroke = BoxOfSegment(line.line_a, line.line_b);
    stroke.half_width_mm -= 0.3;
    stroke.half_height_mm = 0.4;
    const TurnedBox lettering = BoxOfText(line.text, kDimensionSize_mm);
    if (!outline.Holds(stroke) || !outline.Holds(lettering) || !taken.IsFreeForLine(stroke) ||
        !taken.IsFreeForText(lettering)) {
      continue;
    }
    taken.TakeForLine(stroke);
    taken.TakeForText(lettering);
    dimensions.push_back(std::move(line));
    return true;
  }
  return false;
}

// Indices of the room's walls, long ones first.
std::vector<size_t> WallsByLength(const Storey& storey, int room_id) {
  std::vector<size_t> order;
  for (size_t i = 0; i < storey.walls.size(); ++i) {
    if (storey.walls[i].room_id == room_id && storey.walls[i].a != storey.walls[i].b) {
      order.push_back(i);
    }
  }
  const auto length_mm = [&](size_t i) {
    // Rounded, so that equal walls keep their order.
    return std::lround(1000 * (storey.walls[i].b - storey.walls[i].a).norm());
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return length_mm(i) > length_mm(j); });
  return order;
}

void PlaceWallDimensions(const Storey& storey, int room_id, const PaperFrame& frame,
                         const PaperRoom& outline, TakenSpace& taken,
                         std::vector<DimensionLine>& dimensions) {
  std::vector<const Wall*> told;
  for (const size_t i : WallsByLength(storey, room_id)) {
    const Wall& wall = storey.walls[i];
    const bool is_told = std::any_of(
        told.begin(), told.end(), [&](const Wall* other) { return TellsSameLength(wall, *other); });
    if (is_told) continue;
    const std::vector<std::string> texts =
        LengthTexts((wall.b - wall.a).norm(), wall.length_sigma_m);
    const bool is_placed = std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return PlaceWallDimension(wall, text, frame, outline, taken, dimensions);
    });
    if (is_placed) told.push_back(&wall);
  }
}

// Width below and depth on the left of the storey, between the outermost inner faces.
void PlaceOverallDimensions(const Storey& storey, const PaperFrame& frame,
                            const Eigen::AlignedBox2d& extent_m,
                            std::vector<DimensionLine>& dimensions) {
  Eigen::AlignedBox2d inner;
  for (const Room& room : storey.rooms) {
    for (const Vector2d& p : room.polygon.outer) inner.extend(p);
  }
  const Vector2d low = frame * inner.min(), high = frame * inner.max();
  const Vector2d outer = frame * extent_m.min() + Vector2d(-kOverallOffset_mm, kOverallOffset_mm);
  const Vector2d right(high.x(), low.y()), top(low.x(), high.y());
  DimensionLine width{-1, low, right, {low.x(), outer.y()}, {right.x(), outer.y()}, {}};
  width.text = TextOnLine(LengthTexts(inner.sizes().x(), 0).front(), width.line_a, width.line_b);
  DimensionLine depth{-1, low, top, {outer.x(), low.y()}, {outer.x(), top.y()}, {}};
  depth.text = TextOnLine(LengthTexts(inner.sizes().y(), 0).front(), depth.line_a, depth.line_b);
  dimensions.push_back(std::move(width));
  dimensions.push_back(std::move(depth));
}

}  // namespace

bool Overlap(const TurnedBox& a, const TurnedBox& b) {
  const std::array<Vector2d, 4> axes{a.axis, Perpendicular(a.axis), b.axis, Perpendicular(b.axis)};
  return std::all_of(axes.begin(), axes.end(),
                     [&](const Vector2d& axis) { return OverlapAlong(axis, a, b); });
}

double TextWidth(std::string_view utf8, double size_mm) {
  // Every character but UTF-8's continuation bytes.
  const auto num_characters = std::count_if(utf8.begin(), utf8.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  });
  return 0.62 * size_mm * static_cast<double>(num_characters);
}

StoreyLabels PlaceLabels(const Storey& storey, const PaperFrame& frame,
                         const Eigen::AlignedBox2d& extent_m, const std::vector<Vector2d>& avoided,
                         bool with_wall_dimensions) {
  StoreyLabels labels;
  if (storey.rooms.empty()) return labels;
  TakenSpace taken;
  std::vector<PaperRoom> outlines;
  for (const Room& room : storey.rooms) outlines.emplace_back(room, frame, avoided);
  for (size_t i = 0; i < outlines.size(); ++i) {
    labels.rooms.push_back(PlaceRoomLabel(storey.rooms[i], outlines[i], taken));
  }
  for (size_t i = 0; with_wall_dimensions && i < outlines.size(); ++i) {
    PlaceWallDimensions(storey, storey.rooms[i].id, frame, outlines[i], taken, labels.dimensions);
  }
  PlaceOverallDimensions(storey, frame, extent_m, labels.dimensions);
  return labels;
}

}  // namespace enfilade
