// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/comparison_page.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace enfilade {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kBorder_m = 0.4;
// Pages of large homes stay below some 15 MB: five pictures a panorama, each some 20 kB.
constexpr size_t kMaxSheets = 64;

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark;
 --paper: #f4f3ef; --card: #ffffff; --ink: #1d1f23; --soft: #5d6370; --line: #dcdad2;
 --best: #dcefe1; --best-ink: #14532d; --plan: #2f6fb3; --truth: #1d1f23; --warn: #b7791f; }
@media (prefers-color-scheme: dark) { :root {
 --paper: #15171b; --card: #1e2127; --ink: #e8e8e4; --soft: #a2a8b3; --line: #343944;
 --best: #1d3a2a; --best-ink: #a7e0bb; --plan: #6fa8e0; --truth: #f1efe8; --warn: #d9a441; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); line-height: 1.5;
 font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", Arial, sans-serif; }
main { max-width: 1280px; margin: 0 auto; padding: 28px 20px 64px; }
h1 { font-size: 26px; line-height: 1.2; margin: 0 0 4px; }
h2 { font-size: 19px; margin: 44px 0 6px; }
h3 { font-size: 15px; margin: 22px 0 8px; }
p { margin: 0 0 10px; max-width: 84ch; }
.soft { color: var(--soft); }
.verdict { border-left: 4px solid var(--best-ink); background: var(--card); padding: 8px 14px;
 margin: 0 0 8px; max-width: 120ch; }
.verdict.against { border-left-color: var(--warn); }
.scroll { overflow-x: auto; background: var(--card); border: 1px solid var(--line);
 border-radius: 6px; margin: 14px 0 8px; }
.narrow { width: max-content; max-width: 100%; }
table { border-collapse: collapse; width: 100%; font-size: 13.5px; }
th, td { padding: 7px 10px; border-bottom: 1px solid var(--line); text-align: right;
 white-space: nowrap; font-variant-numeric: tabular-nums; }
tbody tr:last-child th, tbody tr:last-child td { border-bottom: none; }
thead th { vertical-align: bottom; font-weight: 600; white-space: normal; min-width: 68px;
 line-height: 1.25; }
thead th .unit { display: block; color: var(--soft); font-weight: 400; }
th:first-child { text-align: left; position: sticky; left: 0; background: var(--card);
 box-shadow: 1px 0 0 var(--line); font-weight: 600; min-width: 128px; }
td.best { background: var(--best); color: var(--best-ink); font-weight: 700; }
td.none { color: var(--soft); }
td.gone { text-align: left; white-space: normal; color: var(--warn); min-width: 260px; }
dl.meaning { display: grid; grid-template-columns: max-content 1fr; gap: 2px 14px; margin: 6px 0;
 font-size: 13px; color: var(--soft); }
dl.meaning dt { color: var(--ink); }
dl.meaning dd { margin: 0; }
.grid { display: grid; gap: 14px; grid-template-columns: repeat(auto-fill, minmax(290px, 1fr)); }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 6px;
 overflow: hidden; }
figure img, figure svg { display: block; width: 100%; height: auto; }
figcaption { padding: 8px 12px; font-size: 13.5px; font-weight: 600;
 border-top: 1px solid var(--line); }
figcaption span { font-weight: 400; color: var(--soft); }
.room { fill: var(--plan); fill-opacity: 0.38; stroke: var(--plan); stroke-width: 1.2;
 vector-effect: non-scaling-stroke; fill-rule: evenodd; }
.truth { fill: none; stroke: var(--truth); stroke-width: 1.4; vector-effect: non-scaling-stroke; }
.camera { fill: var(--soft); }
.bar { stroke: var(--ink); stroke-width: 2; vector-effect: non-scaling-stroke; }
svg text { fill: var(--ink); font-family: inherit; }
.key { display: inline-block; width: 12px; height: 12px; border-radius: 2px;
 vertical-align: -1px; margin: 0 3px 0 10px; }
.key:first-child { margin-left: 0; }
.key.floor { background: #3cc83c; } .key.wall { background: #c83c3c; }
.key.ceiling { background: #3c3cdc; }
.key.plan { background: var(--plan); opacity: 0.6; }
.key.outline { border: 2px solid var(--truth); }
details { border-top: 1px solid var(--line); padding: 8px 0; }
summary { cursor: pointer; overflow-wrap: anywhere; }
.sheet { display: grid; gap: 8px; grid-template-columns: repeat(auto-fit, minmax(200px, 1fr));
 margin: 8px 0; }
.sheet figcaption { padding: 4px 8px; font-size: 12.5px; font-weight: 400; }
@media (max-width: 560px) { main { padding: 18px 12px 48px; } h1 { font-size: 22px; }
 dl.meaning { grid-template-columns: 1fr; } dl.meaning dd { margin: 0 0 6px; }
 th:first-child { min-width: 104px; white-space: normal; }
 .sheet { grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); } }
)";

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

// For running text: a number and its percent sign stay on one line.
std::string Prose(std::string_view text) {
  std::string prose = Escaped(text);
  for (size_t i = prose.find(" %"); i != std::string::npos; i = prose.find(" %", i))
    prose.replace(i, 1, "\u00a0");
  return prose;
}

// RFC 4648.
std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t block = 0;
    for (size_t k = 0; k < 3; ++k)
      block = block << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[block >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

// Gathers the text of the page.
class Html {
 public:
  template <typename... Args>
  void Add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  void AddImage(std::string_view jpeg, std::string_view alt) {
    Add("<img loading=\"lazy\" alt=\"{}\" src=\"data:image/jpeg;base64,{}\"/>", Escaped(alt),
        Base64(jpeg));
  }
  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

// ---- The table.

void AddHead(const ComparedFigure& column, Html& html) {
  const size_t comma = column.head.rfind(", ");
  const std::string_view name = column.head.substr(0, comma);
  const std::string_view unit =
      comma == std::string_view::npos ? "" : column.head.substr(comma + 2);
  html.Add("<th scope=\"col\" title=\"{}\">{}<span class=\"unit\">{}</span></th>",
           Escaped(column.meaning), Escaped(name), Escaped(unit));
}

// Without a truth, and for truths without depth, whole columns would be empty.
std::vector<const ComparedFigure*> UsedColumns(const std::vector<ComparedMethod>& methods) {
  std::vector<const ComparedFigure*> used;
  for (const ComparedFigure& column : ComparedFigures()) {
    const auto has_figure = [&](const ComparedMethod& method) {
      return ComparedText(column, method) != kNoFigure;
    };
    if (std::any_of(methods.begin(), methods.end(), has_figure)) used.push_back(&column);
  }
  return used;
}

void AddTable(const ComparisonPage& page, Html& html) {
  const std::vector<ComparedMethod>& methods = page.methods;
  const std::vector<const ComparedFigure*> columns = UsedColumns(methods);
  html.Add("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">method</th>");
  for (const ComparedFigure* column : columns) AddHead(*column, html);
  html.Add("</tr></thead>\n<tbody>\n");
  for (size_t i = 0; i < methods.size(); ++i) {
    const ComparedMethod& method = methods[i];
    html.Add("<tr><th scope=\"row\">{}</th>", Escaped(method.title));
    const bool is_found = method.outcome == MethodOutcome::kFound;
    // What it cost stands in the last two columns.
    const size_t num_costs = std::min<size_t>(2, columns.size());
    const size_t first = is_found ? 0 : columns.size() - num_costs;
    if (!is_found && first > 0)
      html.Add("<td class=\"gone\" colspan=\"{}\">{}</td>", first, Escaped(method.reason));
    for (size_t k = first; k < columns.size(); ++k) {
      const std::string text = ComparedText(*columns[k], method);
      const bool is_best = BestOf(*columns[k], methods)[i];
      html.Add("<td{}>{}</td>",
               is_best             ? " class=\"best\""
               : text == kNoFigure ? " class=\"none\""
                                   : "",
               text);
    }
    html.Add("</tr>\n");
  }
  html.Add("</tbody></table></div>\n");
  const bool has_depth =
      std::any_of(columns.begin(), columns.end(),
                  [](const ComparedFigure* column) { return column->key == "depth_median_m"; });
  if (page.truth && !has_depth) {
    html.Add(
        "<p class=\"soft\">Errors of depth and normals are left out: this truth knows "
        "neither.</p>\n");
  }
  html.Add("<details><summary>What the columns mean</summary>\n<dl class=\"meaning\">");
  for (const ComparedFigure* column : columns)
    html.Add("<dt>{}</dt><dd>{}</dd>", Escaped(column->head), Escaped(column->meaning));
  html.Add("</dl></details>\n");
}

// ---- Plans.

AlignedBox2d ExtentOf(const ComparisonPage& page) {
  AlignedBox2d extent;
  const auto include = [&](const Polygon2& polygon) {
    for (const Vector2d& p : polygon.outer) extent.extend(p);
  };
  if (page.truth) std::for_each(page.truth->begin(), page.truth->end(), include);
  for (const ComparedMethod& method : page.methods) {
    for (const Storey& storey : method.plan.storeys) {
      for (const Room& room : storey.rooms) include(room.polygon);
    }
  }
  for (const Vector2d& camera : page.cameras) extent.extend(camera);
  if (extent.isEmpty()) extent.extend(Vector2d(0, 0));
  const Vector2d border = Vector2d::Constant(kBorder_m);
  return {extent.min() - border, extent.max() + border};
}

// In the drawing y grows down.
std::string PathOf(const Polygon2& polygon) {
  std::string path;
  for (const Ring2& ring : RingsOf(polygon)) {
    for (size_t i = 0; i < ring.size(); ++i)
      path += fmt::format("{}{:.3f} {:.3f}", i == 0 ? 'M' : 'L', ring[i].x(), 0.0 - ring[i].y());
    path += 'Z';
  }
  return path;
}

void AddPlan(const ComparisonPage& page, const ComparedMethod& method, const AlignedBox2d& extent,
             Html& html) {
  const Vector2d size = extent.sizes();
  const double left = extent.min().x(), top = -extent.max().y();
  const double text_m = 0.035 * size.maxCoeff();
  html.Add("<svg role=\"img\" aria-label=\"plan: {}\" viewBox=\"{:.3f} {:.3f} {:.3f} {:.3f}\">",
           Escaped(method.title), left, top, size.x(), size.y() + 2 * text_m);
  for (const Storey& storey : method.plan.storeys) {
    for (const Room& room : storey.rooms)
      html.Add("<path class=\"room\" d=\"{}\"/>", PathOf(room.polygon));
  }
  if (page.truth) {
    for (const Polygon2& part : *page.truth)
      html.Add("<path class=\"truth\" d=\"{}\"/>", PathOf(part));
  }
  for (const Vector2d& camera : page.cameras) {
    html.Add("<circle class=\"camera\" cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\"/>", camera.x(),
             0.0 - camera.y(), 0.006 * size.maxCoeff());
  }
  const double bar_m = size.maxCoeff() > 10 ? 5 : 1, y = top + size.y() + text_m;
  html.Add(
      "<path class=\"bar\" d=\"M{0:.3f} {1:.3f}H{2:.3f}\"/>"
      "<text x=\"{3:.3f}\" y=\"{4:.3f}\" font-size=\"{5:.3f}\">{6:g} m</text></svg>",
      left + kBorder_m, y, left + kBorder_m + bar_m, left + kBorder_m + bar_m + 0.4 * text_m,
      y + 0.35 * text_m, text_m, bar_m);
}

// "1 room", "2 rooms".
std::string Counted(const std::string& number, std::string_view noun) {
  return fmt::format("{} {}", number, number == "1" ? noun.substr(0, noun.size() - 1) : noun);
}

// The figures that a caption shows: those of these keys that there are.
std::string Caption(const ComparedMethod& method, std::initializer_list<std::string_view> keys) {
  std::string text;
  for (const ComparedFigure& column : ComparedFigures()) {
    if (std::find(keys.begin(), keys.end(), column.key) == keys.end()) continue;
    const std::string figure = ComparedText(column, method);
    if (figure == kNoFigure) continue;
    const size_t comma = column.head.rfind(", ");
    const bool has_unit = comma != std::string_view::npos;
    text += text.empty() ? "" : ", ";
    text += has_unit ? fmt::format("{} {} {}", column.head.substr(0, comma), figure,
                                   column.head.substr(comma + 2))
                     : Counted(figure, column.head);
  }
  return text;
}

void AddPlans(const ComparisonPage& page, Html& html) {
  html.Add("<h2>Plans{}</h2>\n<p class=\"soft\"><span class=\"key plan\"></span>rooms of the plan",
           page.truth ? " over the truth" : "");
  if (page.truth) html.Add(" <span class=\"key outline\"></span>true rooms");
  html.Add(
      ". Dots are cameras. All at one scale; storeys lie on one another, as they are judged.</p>\n"
      "<div class=\"grid\">\n");
  const AlignedBox2d extent = ExtentOf(page);
  for (const ComparedMethod& method : page.methods) {
    if (method.outcome != MethodOutcome::kFound) continue;
    html.Add("<figure>");
    AddPlan(page, method, extent, html);
    html.Add("<figcaption>{} <span>{}</span></figcaption></figure>\n", Escaped(method.title),
             Prose(Caption(method, {"area_error_gross", "rooms", "corners"})));
  }
  html.Add("</div>\n");
}

// ---- Models.

void AddModels(const ComparisonPage& page, std::string ComparedMethod::*jpeg,
               std::string_view where, std::initializer_list<std::string_view> keys, Html& html) {
  for (const ComparedMethod& method : page.methods) {
    if ((method.*jpeg).empty()) continue;
    html.Add("<figure>");
    html.AddImage(method.*jpeg, fmt::format("model {}: {}", where, method.title));
    html.Add("<figcaption>{} <span>{}</span></figcaption></figure>\n", Escaped(method.title),
             Escaped(Caption(method, keys)));
  }
}

void AddModels(const ComparisonPage& page, Html& html) {
  html.Add(
      "<h2>Models</h2>\n<p class=\"soft\">Surfaces are seen from inside the home only. Seen from "
      "above, ceilings and nearer walls are therefore not there.</p>\n"
      "<h3>From above</h3>\n<div class=\"grid\">\n");
  AddModels(page, &ComparedMethod::outside_jpeg, "from above", {"faces"}, html);
  html.Add("</div>\n<h3>From where {} was taken</h3>\n", Escaped(page.inside_picture));
  html.Add(
      "<p class=\"soft\">Doors of a plan stand shut and brown; where a model has no surface it is "
      "dark.</p>\n<div class=\"grid\">\n");
  if (!page.inside_photo_jpeg.empty()) {
    html.Add("<figure>");
    html.AddImage(page.inside_photo_jpeg, "photograph");
    html.Add("<figcaption>photograph</figcaption></figure>\n");
  }
  AddModels(page, &ComparedMethod::inside_jpeg, "from inside",
            {"depth_median_m", "normal_median_deg"}, html);
  html.Add("</div>\n");
}

// ---- Labels.

struct LabelKind {
  std::string_view title;
  std::string LabelSheet::*jpeg;
  std::optional<double> ComparedLabels::*accuracy;
};
constexpr std::array<LabelKind, 4> kLabelKinds = {{
    {"after points", &LabelSheet::points_jpeg, &ComparedLabels::points},
    {"after free space", &LabelSheet::free_space_jpeg, &ComparedLabels::free_space},
    {"final, propagated", &LabelSheet::final_jpeg, &ComparedLabels::superpixels},
    {"orientation map", &LabelSheet::orientation_jpeg, &ComparedLabels::orientation},
}};

std::string ShareText(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : std::string(kNoFigure);
}

void AddAccuracies(const ComparedLabels& labels, Html& html) {
  if (!labels.superpixels && !labels.orientation) return;
  html.Add(
      "<div class=\"scroll narrow\"><table>\n<thead><tr><th scope=\"col\">labels</th>"
      "<th scope=\"col\">pixels right<span class=\"unit\">median over panoramas</span></th>"
      "</tr></thead>\n<tbody>\n");
  const auto add = [&](std::string_view title, const std::optional<double>& share) {
    html.Add("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", title, ShareText(share));
  };
  for (const LabelKind& kind : kLabelKinds) add(kind.title, labels.*kind.accuracy);
  add("orientation map, completed by columns", labels.orientation_completed);
  add("wall profiles of the run", labels.profiles);
  html.Add("</tbody></table></div>\n");
}

void AddSheet(const LabelSheet& sheet, bool is_open, Html& html) {
  html.Add("<details{}><summary>{}</summary><div class=\"sheet\">\n",
           is_open ? " open=\"open\"" : "", Escaped(sheet.picture));
  const auto add = [&](const std::string& jpeg, std::string_view title) {
    if (jpeg.empty()) return;
    html.Add("<figure>");
    html.AddImage(jpeg, title);
    html.Add("<figcaption>{}</figcaption></figure>\n", title);
  };
  add(sheet.photo_jpeg, "photograph");
  for (const LabelKind& kind : kLabelKinds) add(sheet.*kind.jpeg, kind.title);
  html.Add("</div></details>\n");
}

void AddLabels(const ComparedLabels& labels, Html& html) {
  html.Add(
      "<h2>Floor, wall and ceiling</h2>\n<p class=\"soft\">The labels of superpixels after each "
      "stage of the paper's classification, beside the orientation map of Lee, Hebert and Kanade "
      "(2009): <span class=\"key floor\"></span>floor <span class=\"key wall\"></span>wall "
      "<span class=\"key ceiling\"></span>ceiling; not tinted: not known.</p>\n");
  if (!labels.reason.empty()) {
    html.Add("<p>There are none: {}.</p>\n", Escaped(labels.reason));
    return;
  }
  AddAccuracies(labels, html);
  const size_t num_shown = std::min(kMaxSheets, labels.sheets.size());
  for (size_t i = 0; i < num_shown; ++i) AddSheet(labels.sheets[i], i == 0, html);
  if (num_shown < labels.sheets.size()) {
    html.Add("<p class=\"soft\">The maps of the other {} panoramas lie beside this page.</p>\n",
             labels.sheets.size() - num_shown);
  }
}

void AddVerdicts(const ComparisonPage& page, Html& html) {
  if (!page.truth)
    html.Add("<p class=\"verdict against\">No truth was given: nothing is judged.</p>\n");
  for (const Verdict& verdict : Verdicts(page.methods)) {
    html.Add("<p class=\"verdict{}\">{}</p>\n", verdict.is_good ? "" : " against",
             Prose(verdict.text));
  }
}

}  // namespace

nlohmann::json LabelsToJson(const ComparedLabels& labels) {
  const auto value = [](const std::optional<double>& share) {
    return share ? nlohmann::json(*share) : nlohmann::json();
  };
  return {{"points", value(labels.points)},
          {"free_space", value(labels.free_space)},
          {"superpixels", value(labels.superpixels)},
          {"profiles", value(labels.profiles)},
          {"orientation", value(labels.orientation)},
          {"orientation_completed", value(labels.orientation_completed)}};
}

std::string FormatLabels(const ComparedLabels& labels) {
  return fmt::format(
      "labels right: after points {}, after free space {}, final {}; wall profiles {}; orientation "
      "maps {}, completed {}\n",
      ShareText(labels.points), ShareText(labels.free_space), ShareText(labels.superpixels),
      ShareText(labels.profiles), ShareText(labels.orientation),
      ShareText(labels.orientation_completed));
}

std::string FormatComparisonPage(const ComparisonPage& page) {
  Html html;
  html.Add(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>"
      "<title>{}: methods compared</title>\n<style>{}</style></head>\n<body><main>\n"
      "<h1>{}: methods compared</h1>\n"
      "<p class=\"soft\">{} panoramas. Every method is given the same wall profiles and points, in "
      "a process of its own. The best figure of a column is marked.</p>\n",
      Escaped(page.title), kStyle, Escaped(page.title), page.num_panoramas);
  AddVerdicts(page, html);
  AddTable(page, html);
  AddPlans(page, html);
  AddModels(page, html);
  AddLabels(page.labels, html);
  html.Add("</main></body></html>\n");
  return html.Take();
}

}  // namespace enfilade
