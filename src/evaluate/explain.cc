// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/explain.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/geometry/angles.h"
#include "src/evaluate/drawing.h"

namespace enfilade {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kMargin_px = 24;
constexpr double kTitle_px = 34;
constexpr double kKey_px = 34;
constexpr double kMaxWidth_px = 640;
constexpr double kMaxHeight_px = 560;
constexpr int kMaxColumns = 4;
constexpr double kBorder_m = 0.4;
constexpr double kHighPercentile = 0.95;

constexpr Color kPaper{1, 1, 1, 1};
constexpr Color kFrame{0.75, 0.75, 0.75, 1};
constexpr Color kCore{0.80, 0.80, 0.80, 1};
constexpr Color kRoom{0.96, 0.94, 0.90, 1};
constexpr Color kCamera{0.10, 0.10, 0.10, 1};
constexpr Color kContour{0.55, 0.45, 0.75, 0.9};
constexpr Color kFirst{0.10, 0.35, 0.80, 1};
constexpr Color kCut{0.95, 0.50, 0.05, 1};
constexpr Color kAnchor{0.05, 0.55, 0.25, 1};
constexpr Color kSecond{0.80, 0.10, 0.12, 1};
constexpr Color kTruth{0.10, 0.18, 0.30, 1};
constexpr Color kTruthRoom{0.90, 0.93, 0.96, 1};
constexpr Color kLevels[3] = {{0.25, 0.40, 0.95, 1}, {0.05, 0.65, 0.20, 1}, {0.90, 0.10, 0.10, 1}};

// One storey's panels have one scale.
struct Panel {
  std::string title;
  std::function<void(cairo_t*)> draw;  // in metres, x to the right, y up
  bool has_levels = false;             // a key of low, medium and high stands below
};

// ---- In metres.

void StrokeRing(cairo_t* cr, const Ring2& ring, const Color& color, double width_px) {
  for (size_t i = 0; i < ring.size(); ++i) {
    i == 0 ? cairo_move_to(cr, ring[i].x(), ring[i].y())
           : cairo_line_to(cr, ring[i].x(), ring[i].y());
  }
  cairo_close_path(cr);
  double width = width_px, unused = 0;
  cairo_device_to_user_distance(cr, &width, &unused);
  cairo_set_line_width(cr, width);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
  SetColor(cr, color);
  cairo_stroke(cr);
}

void FillPolygon(cairo_t* cr, const Polygon2& polygon, const Color& color) {
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  for (const Ring2& ring : RingsOf(polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      i == 0 ? cairo_move_to(cr, ring[i].x(), ring[i].y())
             : cairo_line_to(cr, ring[i].x(), ring[i].y());
    }
    cairo_close_path(cr);
  }
  SetColor(cr, color);
  cairo_fill(cr);
}

void StrokePolygon(cairo_t* cr, const Polygon2& polygon, const Color& color, double width_px) {
  for (const Ring2& ring : RingsOf(polygon)) StrokeRing(cr, ring, color, width_px);
}

void StrokeLine(cairo_t* cr, const Vector2d& a, const Vector2d& b, const Color& color,
                double width_px) {
  double width = width_px, unused = 0;
  cairo_device_to_user_distance(cr, &width, &unused);
  cairo_set_line_width(cr, width);
  SetColor(cr, color);
  cairo_move_to(cr, a.x(), a.y());
  cairo_line_to(cr, b.x(), b.y());
  cairo_stroke(cr);
}

void DrawDot(cairo_t* cr, const Vector2d& at, const Color& color, double radius_px) {
  double radius = radius_px, unused = 0;
  cairo_device_to_user_distance(cr, &radius, &unused);
  cairo_new_sub_path(cr);
  cairo_arc(cr, at.x(), at.y(), radius, 0, 2 * kPi);
  SetColor(cr, color);
  cairo_fill(cr);
}

// Colours of cells as a picture over the frame; `color_of` gives null for cells left as they are.
void PaintCells(cairo_t* cr, const GridFrame& frame,
                const std::function<const Color*(int row, int col)>& color_of) {
  const CairoSurface surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, frame.cols, frame.rows),
      cairo_surface_destroy);
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  const auto byte = [](double value) { return static_cast<uint32_t>(std::lround(255 * value)); };
  for (int row = 0; row < frame.rows; ++row) {
    auto* pixels = reinterpret_cast<uint32_t*>(data + static_cast<ptrdiff_t>(row) * stride);
    for (int col = 0; col < frame.cols; ++col) {
      const Color* color = color_of(row, col);
      pixels[col] = color == nullptr
                        ? 0
                        : 0xFF000000U | byte(color->r) << 16 | byte(color->g) << 8 | byte(color->b);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_save(cr);
  cairo_translate(cr, frame.origin.x(), frame.origin.y());
  cairo_scale(cr, frame.cell_m, frame.cell_m);
  cairo_set_source_surface(cr, surface.get(), 0, 0);
  cairo_paint(cr);
  cairo_restore(cr);
}

// Levels of the positive values: thirds of what but the highest reach.
class Levels {
 public:
  explicit Levels(const ImageF& values) {
    std::vector<float> positive;
    for (const float value : values.data()) {
      if (value > 0) positive.push_back(value);
    }
    if (positive.empty()) return;
    const auto place =
        positive.begin() +
        static_cast<ptrdiff_t>(kHighPercentile * static_cast<double>(positive.size() - 1));
    std::nth_element(positive.begin(), place, positive.end());
    high_ = *place;
  }
  [[nodiscard]] const Color* ColorOf(float value) const {
    if (!(value > 0)) return nullptr;
    const int level = static_cast<int>(3 * value / high_);
    return &kLevels[std::clamp(level, 0, 2)];
  }

 private:
  float high_ = 1;
};

// The largest value of a cell and its neighbours: lines one cell wide vanish in small pictures.
float LargestAbout(const ImageF& values, int row, int col) {
  float largest = 0;
  for (int r = std::max(0, row - 1); r <= std::min(values.rows() - 1, row + 1); ++r) {
    for (int c = std::max(0, col - 1); c <= std::min(values.cols() - 1, col + 1); ++c)
      largest = std::max(largest, values(r, c));
  }
  return largest;
}

void PaintCore(cairo_t* cr, const GridFrame& frame, const CoreImage& core) {
  PaintCells(cr, frame, [&](int row, int col) { return core(row, col) != 0 ? &kCore : nullptr; });
}

void DrawCameras(cairo_t* cr, const std::vector<EvidenceCamera>& cameras) {
  for (const EvidenceCamera& camera : cameras) DrawDot(cr, camera.position, kCamera, 3.5);
}

void DrawFirstPath(cairo_t* cr, const PaperLoop& loop) {
  StrokeRing(cr, loop.first_path, kFirst, 2.2);
  StrokeLine(cr, loop.cut[0], loop.cut[1], kCut, 2.6);
  for (const Vector2d& end : loop.cut) DrawDot(cr, end, kCut, 3);
}

void DrawAnchor(cairo_t* cr, const PaperAnchor& anchor) {
  const Vector2d normal(-anchor.direction.y(), anchor.direction.x());
  double tick = 9, unused = 0;
  cairo_device_to_user_distance(cr, &tick, &unused);
  StrokeLine(cr, anchor.position, anchor.position + tick * normal, kAnchor, 1.6);
  DrawDot(cr, anchor.position, kAnchor, 3.2);
}

void DrawTruth(cairo_t* cr, const ExplainInput& input) {
  const JudgedPlan truth = JudgedPlanOf(*input.truth);
  const Eigen::Matrix4d matrix = input.home_from_truth.Matrix();
  const cairo_matrix_t home_from_truth = {matrix(0, 0), matrix(1, 0), matrix(0, 1),
                                          matrix(1, 1), matrix(0, 3), matrix(1, 3)};
  cairo_save(cr);
  cairo_transform(cr, &home_from_truth);
  for (const JudgedRoom& room : truth.rooms) {
    for (const Polygon2& part : room.region) {
      FillPolygon(cr, part, kTruthRoom);
      StrokePolygon(cr, part, kTruth, 1.8);
    }
  }
  cairo_restore(cr);
}

// ---- Panels.

Panel LevelPanel(std::string title, const GridFrame& frame, const ImageF& values, bool is_thin) {
  const Levels levels(values);
  return {std::move(title),
          [&frame, &values, levels, is_thin](cairo_t* cr) {
            PaintCells(cr, frame, [&](int row, int col) {
              return levels.ColorOf(is_thin ? LargestAbout(values, row, col) : values(row, col));
            });
          },
          true};
}

void AddPaperPanels(const EvidenceGrids& evidence, const PaperStorey& storey,
                    std::vector<Panel>& panels) {
  size_t num_anchors = 0, num_first = 0, num_second = 0;
  for (const PaperLoop& loop : storey.loops) {
    num_anchors += loop.anchors.size();
    num_first += loop.first_path.size();
    num_second += loop.second_path.size();
  }
  const auto core = [&](cairo_t* cr) { PaintCore(cr, evidence.frame, storey.core); };
  panels.push_back({fmt::format("Start and end line, first path: {} corners", num_first),
                    [core, &storey](cairo_t* cr) {
                      core(cr);
                      for (const PaperLoop& loop : storey.loops) DrawFirstPath(cr, loop);
                    }});
  panels.push_back(
      {fmt::format("{} anchors, in the order of the free space's contour", num_anchors),
       [core, &storey](cairo_t* cr) {
         core(cr);
         for (const PaperLoop& loop : storey.loops) {
           StrokeRing(cr, loop.contour, kContour, 1);
           for (const PaperAnchor& anchor : loop.anchors) DrawAnchor(cr, anchor);
         }
       }});
  panels.push_back(
      {fmt::format("Second path: {} corners", num_second), [core, &storey](cairo_t* cr) {
         core(cr);
         for (const PaperLoop& loop : storey.loops) {
           StrokeRing(cr, loop.second_path, kSecond, 2.4);
           for (const PaperAnchor& anchor : loop.anchors)
             DrawDot(cr, anchor.position, kAnchor, 2.2);
         }
       }});
}

std::vector<Panel> PanelsOf(const ExplainInput& input, size_t storey_idx) {
  const EvidenceGrids& evidence = input.evidence[storey_idx];
  const Storey& storey = input.floorplan.storeys[storey_idx];
  const bool is_paper = !input.paper.empty();
  const CoreImage& core = is_paper ? input.paper[storey_idx].core : evidence.core;
  std::vector<Panel> panels;
  panels.push_back(LevelPanel("Wall evidence", evidence.frame, evidence.wall, true));
  panels.push_back(LevelPanel("Free-space evidence", evidence.frame, evidence.free, false));
  panels.push_back({"Core free space and cameras", [&](cairo_t* cr) {
                      PaintCore(cr, evidence.frame, core);
                      DrawCameras(cr, evidence.cameras);
                    }});
  if (is_paper) {
    AddPaperPanels(evidence, input.paper[storey_idx], panels);
  } else {
    panels.push_back({fmt::format("Plan: {} rooms", storey.rooms.size()), [&](cairo_t* cr) {
                        for (const Room& room : storey.rooms) {
                          FillPolygon(cr, room.polygon, kRoom);
                          StrokePolygon(cr, room.polygon, kSecond, 2);
                        }
                      }});
  }
  if (input.truth != nullptr)
    panels.push_back({"Truth", [&](cairo_t* cr) { DrawTruth(cr, input); }});
  return panels;
}

// ---- The page.

AlignedBox2d ExtentOf(const ExplainInput& input) {
  AlignedBox2d extent;
  for (const Storey& storey : input.floorplan.storeys) {
    for (const Room& room : storey.rooms) {
      for (const Vector2d& p : room.polygon.outer) extent.extend(p);
    }
  }
  for (const PaperStorey& storey : input.paper) {
    for (const PaperLoop& loop : storey.loops) {
      for (const Ring2* ring : {&loop.first_path, &loop.second_path}) {
        for (const Vector2d& p : *ring) extent.extend(p);
      }
    }
  }
  if (extent.isEmpty()) extent.extend(Vector2d(0, 0));
  const Vector2d border = Vector2d::Constant(kBorder_m);
  return {extent.min() - border, extent.max() + border};
}

struct Layout {
  AlignedBox2d extent;
  double px_per_m = 1;
  int num_columns = 1;
  Vector2d panel_px{0, 0};  // without title and key
  double width_px = 0, height_px = 0;

  [[nodiscard]] Vector2d Corner(size_t row, size_t column) const {
    return {kMargin_px + static_cast<double>(column) * (panel_px.x() + kMargin_px),
            kMargin_px + static_cast<double>(row) * (panel_px.y() + kTitle_px + kKey_px)};
  }
};

Layout LayOut(const ExplainInput& input, const std::vector<std::vector<Panel>>& storeys) {
  Layout layout;
  layout.extent = ExtentOf(input);
  const Vector2d size = layout.extent.sizes();
  layout.px_per_m = std::min(kMaxWidth_px / size.x(), kMaxHeight_px / size.y());
  layout.panel_px = (layout.px_per_m * size).array().ceil();
  size_t num_rows = 0, num_panels = 1;
  for (const std::vector<Panel>& panels : storeys) num_panels = std::max(num_panels, panels.size());
  layout.num_columns = static_cast<int>(std::min<size_t>(num_panels, kMaxColumns));
  const auto columns = static_cast<size_t>(layout.num_columns);
  for (const std::vector<Panel>& panels : storeys)
    num_rows += (panels.size() + columns - 1) / columns;
  const Vector2d end = layout.Corner(num_rows, columns);
  layout.width_px = end.x();
  layout.height_px = end.y();
  return layout;
}

void DrawLevelKey(cairo_t* cr, const Vector2d& at) {
  constexpr const char* kNames[3] = {"low", "medium", "high"};
  double x = at.x();
  for (size_t i = 0; i < 3; ++i) {
    SetColor(cr, kLevels[i]);
    cairo_rectangle(cr, x, at.y() - 10, 16, 11);
    cairo_fill(cr);
    DrawText(cr, x + 21, at.y(), kNames[i], 13);
    x += 90;
  }
}

void DrawScaleBar(cairo_t* cr, const Layout& layout, const Vector2d& at) {
  const double length_m = layout.extent.sizes().maxCoeff() > 10 ? 5 : 1;
  SetColor(cr, kText);
  cairo_set_line_width(cr, 3);
  cairo_move_to(cr, at.x() - length_m * layout.px_per_m, at.y() - 4);
  cairo_line_to(cr, at.x(), at.y() - 4);
  cairo_stroke(cr);
  DrawText(cr, at.x() - length_m * layout.px_per_m - 8, at.y(), fmt::format("{:g} m", length_m), 13,
           TextAlign::kRight);
}

void DrawPanel(cairo_t* cr, const Layout& layout, const Panel& panel, char letter,
               const Vector2d& corner) {
  DrawText(cr, corner.x(), corner.y() + kTitle_px - 10, fmt::format("{}  {}", letter, panel.title),
           16);
  const Vector2d low = corner + Vector2d(0, kTitle_px);
  cairo_save(cr);
  cairo_rectangle(cr, low.x(), low.y(), layout.panel_px.x(), layout.panel_px.y());
  cairo_clip(cr);
  cairo_translate(cr, low.x(), low.y() + layout.panel_px.y());
  cairo_scale(cr, layout.px_per_m, -layout.px_per_m);
  cairo_translate(cr, -layout.extent.min().x(), -layout.extent.min().y());
  panel.draw(cr);
  cairo_restore(cr);
  SetColor(cr, kFrame);
  cairo_set_line_width(cr, 1);
  cairo_rectangle(cr, low.x(), low.y(), layout.panel_px.x(), layout.panel_px.y());
  cairo_stroke(cr);
  const Vector2d below = low + Vector2d(0, layout.panel_px.y() + 20);
  if (panel.has_levels) DrawLevelKey(cr, below);
  if (letter == 'c') DrawScaleBar(cr, layout, below + Vector2d(layout.panel_px.x(), 0));
}

void DrawPage(cairo_surface_t* surface, const Layout& layout,
              const std::vector<std::vector<Panel>>& storeys) {
  const CairoContext context = StartDrawing(surface);
  cairo_t* cr = context.get();
  SetColor(cr, kPaper);
  cairo_paint(cr);
  size_t first_row = 0;
  const auto columns = static_cast<size_t>(layout.num_columns);
  for (const std::vector<Panel>& panels : storeys) {
    for (size_t i = 0; i < panels.size(); ++i) {
      DrawPanel(cr, layout, panels[i], static_cast<char>('a' + i),
                layout.Corner(first_row + i / columns, i % columns));
    }
    first_row += (panels.size() + columns - 1) / columns;
  }
  CheckDrawing(cr);
}

std::vector<std::vector<Panel>> PanelsOf(const ExplainInput& input) {
  std::vector<std::vector<Panel>> storeys;
  for (size_t i = 0; i < input.evidence.size(); ++i) storeys.push_back(PanelsOf(input, i));
  return storeys;
}

}  // namespace

std::string RenderExplainSvg(const ExplainInput& input) {
  const std::vector<std::vector<Panel>> storeys = PanelsOf(input);
  const Layout layout = LayOut(input, storeys);
  return DrawSvg(layout.width_px, layout.height_px,
                 [&](cairo_surface_t* surface) { DrawPage(surface, layout, storeys); });
}

std::string RenderExplainPng(const ExplainInput& input) {
  const std::vector<std::vector<Panel>> storeys = PanelsOf(input);
  const Layout layout = LayOut(input, storeys);
  const CairoSurface surface =
      MakeImageSurface(static_cast<int>(layout.width_px), static_cast<int>(layout.height_px));
  DrawPage(surface.get(), layout, storeys);
  return EncodePng(surface.get());
}

}  // namespace enfilade
