// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "src/exchange/connection_labels.h"
#include "src/exchange/connection_sheet.h"
#include "src/exchange/connection_symbols.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using pugi::xml_node;

constexpr const char* kStyle = R"(
text { font-family: "DejaVu Sans", Arial, Helvetica, sans-serif; fill: #1c1c1c; }
.paper { fill: #ffffff; }
.border { fill: none; stroke: #1c1c1c; stroke-width: 0.35; }
.rule { fill: none; stroke: #1c1c1c; stroke-width: 0.18; }
.panel { fill: #faf8f4; stroke: #e3dfd6; stroke-width: 0.18; }
.panel-heading { font-size: 2.8px; font-weight: bold; }
.panel-details { font-size: 2.2px; fill: #555555; }
.points { fill: none; stroke-width: 0.45; stroke-linecap: round; }
.points-few { stroke: #cfc6b3; }
.points-some { stroke: #b3a88f; }
.points-many { stroke: #8b806a; }
.tie { stroke: #2b6cb0; stroke-opacity: 0.38; stroke-linecap: round; }
.refused { stroke: #c53030; stroke-opacity: 0.75; stroke-width: 0.3; stroke-dasharray: 1.3 0.9; }
.wedge { fill: #2b6cb0; fill-opacity: 0.3; }
.camera { fill: #1f4e82; stroke: #ffffff; }
.camera-inferred { fill: #ffffff; stroke: #1f4e82; }
.map-name { font-size: 2.2px; stroke: #faf8f4; stroke-width: 0.5px; stroke-linejoin: round;
 paint-order: stroke; }
.name-start { text-anchor: start; }
.name-middle { text-anchor: middle; }
.name-end { text-anchor: end; }
.sheet-title { font-size: 4.4px; font-weight: bold; }
.sheet-line { font-size: 2.6px; }
.sheet-note { font-size: 1.9px; fill: #555555; }
.scale-text { font-size: 1.9px; text-anchor: middle; }
.scale-dark { fill: #1c1c1c; stroke: #1c1c1c; stroke-width: 0.18; }
.scale-light { fill: #ffffff; stroke: #1c1c1c; stroke-width: 0.18; }
)";

constexpr size_t kMaxRefusals = 40;  // more of these long lines would cover everything

// A pair that is drawn.
struct DrawnPair {
  const PairFact* pair = nullptr;
  MapSegment segment;
};

MapSegment SegmentOf(const PairFact& pair, const MapSheet& sheet) {
  return {sheet.cameras_mm[static_cast<size_t>(pair.a)],
          sheet.cameras_mm[static_cast<size_t>(pair.b)]};
}

// Weak ties first, so that strong ones lie above them.
std::vector<DrawnPair> DrawnTies(const ConnectionFacts& facts, const MapSheet& sheet) {
  std::vector<DrawnPair> drawn;
  for (const PairFact& pair : facts.pairs) {
    if (!pair.is_tie || !pair.is_within) continue;
    drawn.push_back({&pair, SegmentOf(pair, sheet)});
  }
  std::ranges::stable_sort(drawn, {}, [](const DrawnPair& d) { return d.pair->num_inliers; });
  return drawn;
}

// Contradictions within components and the strongest one between any two of them; of many the
// strongest.
std::vector<DrawnPair> DrawnRefusals(const ConnectionFacts& facts, const MapSheet& sheet) {
  std::vector<const PairFact*> refusals;
  std::set<std::pair<int, int>> bridged;
  for (const PairFact& pair : facts.pairs) {
    if (IsContradiction(pair)) refusals.push_back(&pair);
  }
  std::ranges::stable_sort(refusals, std::ranges::greater{}, &PairFact::num_inliers);
  std::vector<DrawnPair> drawn;
  for (const PairFact* pair : refusals) {
    if (drawn.size() == kMaxRefusals) break;
    const int component_a = facts.views[static_cast<size_t>(pair->a)].component;
    const int component_b = facts.views[static_cast<size_t>(pair->b)].component;
    if (!pair->is_within && !bridged.insert(std::minmax(component_a, component_b)).second) continue;
    drawn.push_back({pair, SegmentOf(*pair, sheet)});
  }
  return drawn;
}

// One path for each of three densities, in cells of half a millimetre.
void DrawPoints(const ConnectionFacts& facts, const MapPanel& panel, xml_node layer) {
  constexpr double kCell_mm = 0.5;
  constexpr std::array<const char*, 3> kStyles = {"points points-few", "points points-some",
                                                  "points points-many"};
  std::map<std::pair<int, int>, int> counts;
  const Eigen::AlignedBox2d map(panel.box_mm.min() + Vector2d(1, kPanelHeading_mm),
                                panel.box_mm.max() - Vector2d(1, 1));
  for (const PointFact& point : facts.points) {
    const Vector2d at = panel.frame * point.position_m;
    if (point.component != panel.component || !map.contains(at)) continue;
    const Eigen::Vector2i cell = (at / kCell_mm).array().floor().cast<int>();
    ++counts[{cell.y(), cell.x()}];
  }
  std::array<std::string, 3> paths;
  for (const auto& [cell, count] : counts) {
    const size_t density = count < 2 ? 0 : count < 5 ? 1 : 2;
    paths[density] += fmt::format("M{} {}h0", Mm(kCell_mm * (cell.second + 0.5)),
                                  Mm(kCell_mm * (cell.first + 0.5)));
  }
  for (size_t i = 0; i < paths.size(); ++i) {
    if (!paths[i].empty()) SetAttribute(AppendElement(layer, "path", kStyles[i]), "d", paths[i]);
  }
}

std::string PictureOf(const ConnectionFacts& facts, int view) {
  return facts.views[static_cast<size_t>(view)].picture;
}

void AppendTooltip(xml_node node, const std::string& text) {
  node.append_child("title").text().set(text.c_str());
}

void DrawPair(const ConnectionFacts& facts, const DrawnPair& drawn, const char* style,
              double symbol_scale, xml_node layer) {
  const PairFact& pair = *drawn.pair;
  xml_node line = AppendLine(layer, style, drawn.segment.a, drawn.segment.b);
  SetAttribute(line, "data-a", PictureOf(facts, pair.a));
  SetAttribute(line, "data-b", PictureOf(facts, pair.b));
  SetAttribute(line, "data-inliers", std::to_string(pair.num_inliers));
  if (pair.is_tie) {
    SetAttribute(line, "stroke-width", Mm(TieWidth(pair.num_inliers, symbol_scale)));
  }
  AppendTooltip(line,
                fmt::format("{} – {}: {} of {} agree", PictureOf(facts, pair.a),
                            PictureOf(facts, pair.b), pair.num_inliers,
                            Counted(static_cast<size_t>(pair.num_matches), "match", "matches")));
}

void DrawCamera(const ConnectionFacts& facts, const ViewFact& view, const Vector2d& at,
                double scale, xml_node layer) {
  xml_node camera = AppendCamera(layer, at, view.is_inferred, scale);
  SetAttribute(camera, "data-picture", view.picture);
  SetAttribute(camera, "data-component",
               std::to_string(facts.components[static_cast<size_t>(view.component)].idx));
  AppendTooltip(camera, fmt::format("{}: {}, {}", view.picture,
                                    Counted(static_cast<size_t>(view.num_ties), "connection"),
                                    Counted(static_cast<size_t>(view.num_points), "point")));
}

// Dots above all wedges.
void DrawCameras(const ConnectionFacts& facts, const MapSheet& sheet, xml_node layer) {
  const auto is_listed = [&](const ViewFact& view) {
    return facts.components[static_cast<size_t>(view.component)].views.size() < 2;
  };
  for (size_t i = 0; i < facts.views.size(); ++i) {
    const ViewFact& view = facts.views[i];
    if (is_listed(view)) continue;
    AppendWedge(layer, sheet.cameras_mm[i], view.yaw_rad, sheet.symbol_scale);
  }
  for (size_t i = 0; i < facts.views.size(); ++i) {
    const ViewFact& view = facts.views[i];
    DrawCamera(facts, view, sheet.cameras_mm[i], is_listed(view) ? 1 : sheet.symbol_scale, layer);
  }
}

void DrawPanel(const ConnectionFacts& facts, const MapPanel& panel, xml_node layer) {
  AppendRectangle(layer, "panel", panel.box_mm.min(), panel.box_mm.sizes());
  const Vector2d corner = panel.box_mm.min() + Vector2d(kPanelPadding_mm, 0);
  AppendText(layer, {panel.heading, "panel-heading", corner + Vector2d(0, 5.6), 0});
  AppendText(layer, {panel.details, "panel-details", corner + Vector2d(0, 9.3), 0});
  if (panel.component >= 0) DrawPoints(facts, panel, layer);
}

// What the map shows, from the bottom up.
void DrawMap(const ConnectionFacts& facts, const MapSheet& sheet, xml_node root) {
  const xml_node panels = AppendLayer(root, "panels", "panels", "Panels and points");
  for (const MapPanel& panel : sheet.panels) DrawPanel(facts, panel, panels);
  const std::vector<DrawnPair> ties = DrawnTies(facts, sheet);
  const std::vector<DrawnPair> refusals = DrawnRefusals(facts, sheet);
  const xml_node pairs = AppendLayer(root, "pairs", "pairs", "Pairs");
  for (const DrawnPair& pair : ties) DrawPair(facts, pair, "tie", sheet.symbol_scale, pairs);
  for (const DrawnPair& pair : refusals) {
    DrawPair(facts, pair, "refused", sheet.symbol_scale, pairs);
  }
  DrawCameras(facts, sheet, AppendLayer(root, "cameras", "cameras", "Cameras"));
  std::vector<MapSegment> lines;
  lines.reserve(ties.size() + refusals.size());
  for (const DrawnPair& pair : ties) lines.push_back(pair.segment);
  for (const DrawnPair& pair : refusals) lines.push_back(pair.segment);
  const xml_node names = AppendLayer(root, "names", "names", "Names");
  for (const TextLine& name : PlaceNames(facts, sheet, lines)) AppendText(names, name);
}

}  // namespace

void DrawConnectionMap(const ConnectionFacts& facts, pugi::xml_document& document) {
  const MapSheet sheet = LayOutMap(facts);
  xml_node root = AppendDrawing(document, {kMapWidth_mm, sheet.height_mm});
  root.append_child("title").text().set(facts.title.c_str());
  root.append_child("desc").text().set("Cameras from above. One unit is one millimetre on paper.");
  root.append_child("style").text().set(kStyle);
  DrawTitleBlock(facts, sheet, root);
  DrawMap(facts, sheet, root);
}

}  // namespace enfilade
