// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "src/exchange/connection_advice.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

using pugi::xml_node;

// With a minus sign, and none before zero.
std::string Fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  return value < 0 && !is_zero ? "−" + text : text;
}

// Rows of a table. No cell is without content: a browser does not know <td/>.
class Table {
 public:
  struct Column {
    const char* heading;
    bool is_number;
  };

  Table(xml_node parent, std::span<const Column> columns) {
    xml_node table = AppendElement(parent, "div", "scroll").append_child("table");
    xml_node head = table.append_child("thead").append_child("tr");
    for (const Column& column : columns) {
      AppendWords(head, "th", column.is_number ? "number" : "", column.heading);
    }
    body_ = table.append_child("tbody");
  }

  void BeginRow() { row_ = body_.append_child("tr"); }
  void AddName(const std::string& text) {
    AppendWords(row_.append_child("td"), "span", "name", text);
  }
  void AddText(const std::string& text) { AppendWords(row_, "td", "why", text); }
  void AddNumber(const std::string& text) { AppendWords(row_, "td", "number", text); }
  void AddNumber(int value) { AddNumber(std::to_string(value)); }
  /// Degrees or metres that there may be none of.
  void AddNumber(const std::optional<double>& value, int decimals) {
    if (value && std::isfinite(*value)) {
      AddNumber(Fixed(*value, decimals));
    } else {
      AppendWords(row_, "td", "number faint", "–");
    }
  }
  void AddBar(int value, int largest) {
    const double share = largest > 0 ? 100.0 * value / largest : 0;
    xml_node cell = AppendWords(row_, "td", "number bar", std::to_string(value));
    SetAttribute(cell, "style", fmt::format("background-size: {:.1f}% 19px", share));
  }
  void AddChip(const std::string& style, const std::string& text) {
    xml_node cell = row_.append_child("td");
    if (text.empty()) {
      AppendWords(cell, "span", "faint", "–");
    } else {
      AppendWords(cell, "span", style, text);
    }
  }

 private:
  xml_node body_, row_;
};

std::optional<double> Deg(const std::optional<double>& rad) {
  return rad ? std::optional(RadToDeg(*rad)) : std::nullopt;
}

std::string Remark(const ViewFact& view) {
  if (view.num_ties == 0) return "tied to nothing";
  if (view.num_ties == 1) return "hangs on one pair";
  return view.is_inferred ? "pose inferred" : "";
}

void AddPair(const ConnectionFacts& facts, const PairFact& pair, int most_inliers, Table& table) {
  table.AddName(facts.views[static_cast<size_t>(pair.a)].picture);
  table.AddName(facts.views[static_cast<size_t>(pair.b)].picture);
  const std::string verdict(EnumNames(pair.verdict)[static_cast<size_t>(pair.verdict)]);
  table.AddChip(pair.is_tie             ? "chip chip-tie"
                : IsContradiction(pair) ? "chip chip-against"
                                        : "chip",
                verdict);
  table.AddNumber(pair.num_matches);
  table.AddBar(pair.num_inliers, most_inliers);
}

int MostInliers(std::span<const PairFact* const> pairs) {
  int most = 0;
  for (const PairFact* pair : pairs) most = std::max(most, pair->num_inliers);
  return most;
}

}  // namespace

xml_node AppendWords(xml_node parent, const char* name, const std::string& style,
                     const std::string& text) {
  xml_node node = style.empty() ? parent.append_child(name) : AppendElement(parent, name, style);
  node.text().set(text.c_str());
  return node;
}

void AppendViewTable(const ConnectionFacts& facts, xml_node parent) {
  constexpr Table::Column kColumns[] = {{"Picture", false}, {"Component", true}, {"Pairs", true},
                                        {"Features", true}, {"Points", true},    {"x, m", true},
                                        {"y, m", true},     {"z, m", true},      {"Yaw, °", true},
                                        {"Tilt, °", true},  {"Remark", false}};
  AppendWords(parent, "h2", "", "Pictures");
  AppendWords(parent, "p", "intro",
              "Pairs: how many others it is tied to. Points: how many reconstructed points it "
              "shows. Positions count within a component; yaw is the direction of the picture's "
              "centre, counter-clockwise from x.");
  std::vector<const ViewFact*> views;
  int most_ties = 0;
  for (const ViewFact& view : facts.views) {
    views.push_back(&view);
    most_ties = std::max(most_ties, view.num_ties);
  }
  std::ranges::stable_sort(
      views, {}, [](const ViewFact* view) { return std::tie(view->component, view->picture); });
  Table table(parent, kColumns);
  for (const ViewFact* view : views) {
    table.BeginRow();
    table.AddName(view->picture);
    table.AddNumber(facts.components[static_cast<size_t>(view->component)].idx);
    table.AddBar(view->num_ties, most_ties);
    table.AddNumber(view->num_features);
    table.AddNumber(view->num_points);
    for (int axis = 0; axis < 3; ++axis) table.AddNumber(view->position_m[axis], 2);
    table.AddNumber(Deg(view->yaw_rad), 1);
    table.AddNumber(Deg(view->tilt_rad), 1);
    table.AddChip("chip chip-weak", Remark(*view));
  }
}

void AppendTieTable(const ConnectionFacts& facts, xml_node parent) {
  constexpr Table::Column kColumns[] = {
      {"Picture", false},       {"Picture", false},    {"Verdict", false},    {"Matches", true},
      {"Agree", true},          {"Parallax, °", true}, {"Distance, m", true}, {"Yaw off, °", true},
      {"Bearing off, °", true}, {"log₁₀ chance", true}};
  std::vector<const PairFact*> ties;
  for (const PairFact& pair : facts.pairs) {
    if (pair.is_tie) ties.push_back(&pair);
  }
  AppendWords(parent, "h2", "", "Pairs that connect");
  if (ties.empty()) {
    AppendWords(parent, "p", "intro", "None.");
    return;
  }
  AppendWords(parent, "p", "intro",
              "Agree: matches that fit one position of the two. Off: how far the pair alone is "
              "from the result of all. Chance: how many such agreements random matches would "
              "give.");
  std::ranges::stable_sort(ties, std::ranges::greater{}, &PairFact::num_inliers);
  const int most_inliers = MostInliers(ties);
  Table table(parent, kColumns);
  for (const PairFact* pair : ties) {
    table.BeginRow();
    AddPair(facts, *pair, most_inliers, table);
    table.AddNumber(Deg(pair->parallax_rad), 1);
    table.AddNumber(pair->distance_m, 2);
    table.AddNumber(Deg(pair->yaw_miss_rad), 2);
    table.AddNumber(Deg(pair->direction_miss_rad), 2);
    table.AddNumber(pair->log10_chance, 0);
  }
}

void AppendRefusalTable(const ConnectionFacts& facts, xml_node parent) {
  constexpr Table::Column kColumns[] = {
      {"Picture", false}, {"Picture", false}, {"Verdict", false},   {"Matches", true},
      {"Agree", true},    {"Why", false},     {"What to do", false}};
  constexpr size_t kMaxRefusals = 200;
  std::vector<const PairFact*> refusals;
  for (const PairFact& pair : facts.pairs) {
    if (!pair.is_tie) refusals.push_back(&pair);
  }
  std::ranges::stable_sort(refusals, std::ranges::greater{}, [](const PairFact* pair) {
    return std::tuple(!pair->is_within, IsContradiction(*pair), pair->num_inliers,
                      pair->num_matches);
  });
  AppendWords(parent, "h2", "", "Pairs that were refused");
  if (facts.num_not_matched > 0) {
    AppendWords(parent, "p", "intro",
                fmt::format("Not matched: {} pairs of pictures that look less alike than others.",
                            facts.num_not_matched));
  }
  if (refusals.empty()) {
    AppendWords(parent, "p", "intro", "None.");
    return;
  }
  std::string intro = "First those that could tie components together, then contradictions.";
  if (refusals.size() > kMaxRefusals) {
    intro += fmt::format(" The first {} of {}; connections.json has all.", kMaxRefusals,
                         refusals.size());
    refusals.resize(kMaxRefusals);
  }
  AppendWords(parent, "p", "intro", intro);
  const int most_inliers = MostInliers(refusals);
  Table table(parent, kColumns);
  for (const PairFact* pair : refusals) {
    table.BeginRow();
    AddPair(facts, *pair, most_inliers, table);
    table.AddText(ReasonFor(*pair));
    table.AddText(CureFor(*pair));
  }
}

}  // namespace enfilade
