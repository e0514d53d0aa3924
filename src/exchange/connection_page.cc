// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_page.h"

#include <algorithm>
#include <pugixml.hpp>
#include <span>
#include <string>

#include "src/exchange/connection_advice.h"
#include "src/exchange/connection_map.h"
#include "src/exchange/connection_tables.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

using pugi::xml_node;

// No child selectors: XML would escape them, and a browser takes style as it stands.
constexpr const char* kPageStyle = R"(
:root { color-scheme: light; }
body { margin: 0; background: #eeebe4; color: #1c1c1c; line-height: 1.45;
 font-family: "DejaVu Sans", Arial, Helvetica, sans-serif; font-size: 14px; }
main { max-width: 1260px; margin: 0 auto; padding: 28px 24px 56px; }
h1 { font-size: 26px; margin: 0 0 16px; }
h2 { font-size: 17px; margin: 36px 0 8px; }
.intro { color: #555555; margin: 0 0 10px; max-width: 90ch; }
.tiles { display: flex; flex-wrap: wrap; gap: 12px; margin: 0 0 20px; }
.tile { background: #ffffff; border: 1px solid #dcd7cb; border-radius: 4px; padding: 10px 16px;
 min-width: 130px; }
.figure { display: block; font-size: 24px; font-weight: bold; }
.caption { color: #555555; font-size: 12px; }
.notice { background: #ffffff; border: 1px solid #dcd7cb; border-left: 4px solid #b7791f;
 border-radius: 4px; padding: 10px 18px; margin: 0 0 14px; }
.notice h2 { margin: 0 0 4px; font-size: 15px; }
.notice ul { margin: 0; padding-left: 20px; }
.notice li { margin: 3px 0; }
.map { margin: 0; background: #ffffff; border: 1px solid #dcd7cb; border-radius: 4px;
 overflow: hidden; }
.map svg { display: block; width: 100%; height: auto; }
.scroll { overflow-x: auto; background: #ffffff; border: 1px solid #dcd7cb; border-radius: 4px; }
table { border-collapse: collapse; width: 100%; font-size: 12.5px; }
th { text-align: left; font-weight: bold; padding: 8px; border-bottom: 2px solid #1c1c1c;
 vertical-align: bottom; background: #ffffff; }
td { padding: 5px 8px; border-bottom: 1px solid #ece8de; vertical-align: top; }
tr:last-child td { border-bottom: none; }
tbody tr:hover td { background-color: #f6f3ec; }
.name { display: inline-block; max-width: 40ch; overflow-wrap: break-word; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.bar { background-image: linear-gradient(#d3e2f2, #d3e2f2); background-repeat: no-repeat;
 background-position: right 4px; }
.faint { color: #9a958a; }
.why { min-width: 22ch; color: #333333; }
.chip { display: inline-block; border-radius: 9px; padding: 0 8px; font-size: 11.5px;
 white-space: nowrap; background: #e8e4da; color: #444444; }
.chip-tie { background: #d3e2f2; color: #1f4e82; }
.chip-against { background: #f8dcdc; color: #9b2323; }
.chip-weak { background: #fbeccb; color: #7a4d08; }
@media print { body { background: #ffffff; } main { max-width: none; padding: 0; }
 tr { break-inside: avoid; } .map { break-inside: avoid; } }
)";

void AppendTile(xml_node parent, size_t figure, const std::string& caption) {
  const xml_node tile = AppendElement(parent, "div", "tile");
  AppendWords(tile, "span", "figure", std::to_string(figure));
  AppendWords(tile, "span", "caption", caption);
}

void AppendTiles(const ConnectionFacts& facts, xml_node main) {
  const xml_node tiles = AppendElement(main, "div", "tiles");
  size_t largest = 0, num_ties = 0, num_against = 0;
  for (const ComponentFact& component : facts.components) {
    largest = std::max(largest, component.views.size());
  }
  for (const PairFact& pair : facts.pairs) {
    num_ties += pair.is_tie ? 1 : 0;
    num_against += IsContradiction(pair) ? 1 : 0;
  }
  AppendTile(tiles, facts.views.size(), "pictures");
  AppendTile(tiles, largest, "of them in the largest component");
  AppendTile(tiles, facts.components.size(), "components");
  AppendTile(tiles, num_ties, "pairs that connect");
  AppendTile(tiles, num_against, "pairs that contradict the others");
}

void AppendNotice(const std::string& heading, std::span<const std::string> lines, xml_node main) {
  if (lines.empty()) return;
  xml_node notice = AppendElement(main, "div", "notice");
  AppendWords(notice, "h2", "", heading);
  xml_node list = notice.append_child("ul");
  for (const std::string& line : lines) AppendWords(list, "li", "", line);
}

void AppendMap(const ConnectionFacts& facts, xml_node main) {
  pugi::xml_document drawing;
  DrawConnectionMap(facts, drawing);
  xml_node svg = AppendElement(main, "figure", "map").append_copy(drawing.child("svg"));
  svg.remove_attribute("width");
  svg.remove_attribute("height");
}

void AppendHead(const ConnectionFacts& facts, xml_node html) {
  SetAttribute(html, "lang", "en");
  xml_node head = html.append_child("head");
  SetAttribute(head.append_child("meta"), "charset", "utf-8");
  xml_node viewport = head.append_child("meta");
  SetAttribute(viewport, "name", "viewport");
  SetAttribute(viewport, "content", "width=device-width, initial-scale=1");
  AppendWords(head, "title", "", facts.title);
  AppendWords(head, "style", "", kPageStyle);
}

}  // namespace

void BuildConnectionPage(const ConnectionFacts& facts, pugi::xml_document& document) {
  document.append_child(pugi::node_doctype).set_value("html");
  xml_node html = document.append_child("html");
  AppendHead(facts, html);
  xml_node main = html.append_child("body").append_child("main");
  AppendWords(main, "h1", "", facts.title);
  AppendTiles(facts, main);
  AppendNotice("Warnings", facts.warnings, main);
  AppendNotice("What to do", WhatToDo(facts), main);
  AppendMap(facts, main);
  AppendViewTable(facts, main);
  AppendTieTable(facts, main);
  AppendRefusalTable(facts, main);
}

}  // namespace enfilade
