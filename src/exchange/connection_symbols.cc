// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_symbols.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <pugixml.hpp>

#include "enfilade/geometry/angles.h"
#include "src/exchange/plan_labels.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using pugi::xml_node;

constexpr double kCameraRadius_mm = 0.95, kCameraRim_mm = 0.25;
constexpr double kWedgeLength_mm = 3.4, kWedgeHalfAngle_rad = DegToRad(28);
constexpr double kLegendText_mm = 1.9;

// The drawing has a place for at least one camera.
bool HasMap(const MapSheet& sheet) {
  return !sheet.panels.empty() && sheet.panels.front().component >= 0;
}

std::string SummaryLine(const ConnectionFacts& facts, const MapSheet& sheet) {
  const auto num_ties = static_cast<size_t>(
      std::ranges::count_if(facts.pairs, [](const PairFact& pair) { return pair.is_tie; }));
  const std::string counts =
      fmt::format("{} in {} · {}", Counted(facts.views.size(), "picture"),
                  Counted(facts.components.size(), "component"), Counted(num_ties, "connection"));
  return HasMap(sheet) ? fmt::format("Scale 1:{:.0f} · {}", sheet.scale_denominator, counts)
                       : counts;
}

std::string NoteLine(const ConnectionFacts& facts) {
  std::string note = "Seen from above, north free.";
  if (facts.components.size() > 1) {
    note +=
        " Every component has a frame of its own: distances count only within a panel. Red lines "
        "between panels: the strongest contradictions.";
  }
  return note;
}

// Entries from left to right: what is drawn takes `width_mm`, then comes its text.
class Legend {
 public:
  Legend(const Vector2d& begin, xml_node layer) : at_(begin), layer_(layer) {}

  // The middle of the symbol of the next entry.
  Vector2d Add(const std::string& text, double width_mm) {
    constexpr double kTextGap_mm = 1.2, kEntryGap_mm = 5;
    Vector2d middle = at_ + Vector2d(0.5 * width_mm, 0);
    const Vector2d anchor = at_ + Vector2d(width_mm + kTextGap_mm, 0.36 * kLegendText_mm);
    AppendText(layer_, {text, "sheet-note", anchor, 0});
    at_.x() = anchor.x() + TextWidth(text, kLegendText_mm) + kEntryGap_mm;
    return middle;
  }

 private:
  Vector2d at_;
  xml_node layer_;
};

void DrawLegend(const Vector2d& begin, double scale, xml_node layer) {
  Legend legend(begin, layer);
  const Vector2d camera = legend.Add("camera, looking towards the wedge", 5) - Vector2d(1.2, 0);
  AppendWedge(layer, camera, 0, 1);
  AppendCamera(layer, camera, false, 1);
  for (const int num_inliers : {10, 50, 200}) {
    const std::string text =
        num_inliers == 200 ? "200 features agree" : std::to_string(num_inliers);
    const Vector2d middle = legend.Add(text, 7);
    SetAttribute(AppendLine(layer, "tie", middle - Vector2d(3.5, 0), middle + Vector2d(3.5, 0)),
                 "stroke-width", Mm(TieWidth(num_inliers, scale)));
  }
  const Vector2d refused = legend.Add("refused: contradicts the others", 7);
  AppendLine(layer, "refused", refused - Vector2d(3.5, 0), refused + Vector2d(3.5, 0));
  const Vector2d points = legend.Add("reconstructed points", 4.5);
  constexpr std::array<const char*, 3> kStyles = {"points points-few", "points points-some",
                                                  "points points-many"};
  for (size_t i = 0; i < kStyles.size(); ++i) {
    const Vector2d at = points + Vector2d(1.4 * (static_cast<double>(i) - 1), 0);
    SetAttribute(AppendElement(layer, "path", kStyles[i]), "d",
                 fmt::format("M{} {}h0.7", Mm(at.x() - 0.35), Mm(at.y())));
  }
}

}  // namespace

double TieWidth(int num_inliers, double scale) {
  return scale * std::clamp(0.08 * std::sqrt(static_cast<double>(num_inliers)), 0.2, 1.6);
}

xml_node AppendCamera(xml_node parent, const Vector2d& center, bool is_inferred, double scale) {
  xml_node circle = AppendCircle(parent, is_inferred ? "camera camera-inferred" : "camera", center,
                                 kCameraRadius_mm * scale);
  SetAttribute(circle, "stroke-width", Mm(kCameraRim_mm * scale));
  return circle;
}

xml_node AppendWedge(xml_node parent, const Vector2d& tip, double yaw_rad, double scale) {
  const double length = kWedgeLength_mm * scale;
  const auto end = [&](double azimuth) {
    return Vector2d(tip + length * Vector2d(std::cos(azimuth), -std::sin(azimuth)));
  };
  const Vector2d right = end(yaw_rad - kWedgeHalfAngle_rad);
  const Vector2d left = end(yaw_rad + kWedgeHalfAngle_rad);
  xml_node wedge = AppendElement(parent, "path", "wedge");
  SetAttribute(
      wedge, "d",
      fmt::format("M {} {} L {} {} A {} {} 0 0 0 {} {} Z", Mm(tip.x()), Mm(tip.y()), Mm(right.x()),
                  Mm(right.y()), Mm(length), Mm(length), Mm(left.x()), Mm(left.y())));
  return wedge;
}

void DrawTitleBlock(const ConnectionFacts& facts, const MapSheet& sheet, xml_node root) {
  const xml_node layer = AppendLayer(root, "sheet", "sheet", "Sheet");
  const Vector2d size(kMapWidth_mm, sheet.height_mm);
  const Vector2d margin = Vector2d::Constant(kSheetMargin_mm);
  AppendRectangle(layer, "paper", {0, 0}, size);
  AppendRectangle(layer, "border", margin, size - 2 * margin);
  const double top = sheet.height_mm - kSheetMargin_mm - kMapTitleBlock_mm;
  const double right = kMapWidth_mm - kSheetMargin_mm, left = kSheetMargin_mm + 4;
  AppendLine(layer, "rule", {kSheetMargin_mm, top}, {right, top});
  AppendText(layer, {facts.title, "sheet-title", {left, top + 6.5}, 0});
  AppendText(layer, {SummaryLine(facts, sheet), "sheet-line", {left, top + 11.2}, 0});
  AppendText(layer, {NoteLine(facts), "sheet-note", {left, top + 14.9}, 0});
  DrawLegend({left, top + 20.5}, sheet.symbol_scale, layer);
  if (HasMap(sheet)) AppendScaleBar(layer, sheet.scale_denominator, {right - 6, top + 6});
}

}  // namespace enfilade
