// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "enfilade/base/check.h"
#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/evaluate/regions.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/boolean.h"
#include "src/evaluate/drawing.h"
#include "src/evaluate/moved_result.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMargin_px = 30;
constexpr double kLegendWidth_px = 330;
constexpr double kMinHeight_px = 640;
constexpr double kLine_px = 20;
constexpr double kTargetBar_px = 150;
constexpr double kDotRadius_px = 4.5;

constexpr Color kTruthRoom{0.90, 0.93, 0.96, 1};
constexpr Color kMissed{0.22, 0.50, 0.85, 0.45};
constexpr Color kSurplus{0.93, 0.50, 0.15, 0.55};
constexpr Color kTruthWall{0.10, 0.18, 0.30, 1};
constexpr Color kPlanWall{0.80, 0.10, 0.12, 1};
constexpr Color kTruthDoor{0.10, 0.60, 0.35, 1};
constexpr Color kProfile{0.45, 0.25, 0.60, 0.35};
constexpr Color kGood{0.10, 0.60, 0.35, 1};
constexpr Color kFair{0.95, 0.70, 0.10, 1};
constexpr Color kPoor{0.80, 0.10, 0.12, 1};
constexpr Color kUnknown{0.35, 0.35, 0.35, 1};

struct CameraMark {
  Vector2d position;
  Color color;
};

// All that is drawn, in the world's plan, metres.
struct Drawing {
  MultiPolygon2 truth, missed, surplus;
  std::vector<Segment2> truth_walls, truth_doors, plan_walls, plan_doors;
  std::vector<Ring2> profiles;
  std::vector<CameraMark> cameras;
};

Color ColorOfShare(const std::optional<double>& share) {
  if (!share) return kUnknown;
  return *share >= 0.8 ? kGood : *share >= 0.6 ? kFair : kPoor;
}

std::vector<CameraMark> MarkCameras(const EvaluationInput& input, const ColumnFigures& columns) {
  std::vector<CameraMark> marks;
  const auto mark = [&](const std::string& picture, const Rigid3& world_from_cam) {
    std::optional<double> share;
    for (const PanoramaFigures& panorama : columns.panoramas) {
      if (panorama.picture == picture) share = panorama.within_10pct;
    }
    marks.push_back({world_from_cam.translation.head<2>(), ColorOfShare(share)});
  };
  if (input.scene != nullptr) {
    for (const View& view : input.scene->views) mark(view.picture, view.world_from_cam);
  } else if (input.floorplan != nullptr) {
    for (const PlanCamera& camera : input.floorplan->cameras) {
      mark(camera.picture, camera.world_from_cam);
    }
  }
  return marks;
}

std::vector<Ring2> ProfileRings(const Scene& scene, const Structure& structure) {
  std::vector<Ring2> rings;
  const Rigid3 world_from_home = structure.home_from_world.Inverse();
  for (const WallProfile& profile : structure.profiles) {
    const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
    const Vector2d origin = view.world_from_cam.translation.head<2>();
    Ring2 ring;
    for (int c = 0; c < profile.num_columns(); ++c) {
      const size_t i = static_cast<size_t>(c);
      if (!profile.is_seen.empty() && profile.is_seen[i] == 0) continue;
      const double azimuth = AzimuthOfColumn(c, profile.num_columns());
      const Vector3d direction(std::cos(azimuth), std::sin(azimuth), 0);
      const double r = profile.wall_m[i];
      if (std::isfinite(r))
        ring.push_back(origin + r * (world_from_home.rotation * direction).head<2>());
    }
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings;
}

Drawing MakeDrawing(const EvaluationInput& given, const GroundTruth& truth,
                    const EvaluationReport& report, const OverlayOptions& options) {
  const MovedResult moved(given, report.truth_from_world);
  const EvaluationInput& input = moved.input();
  Drawing drawing;
  const JudgedPlan truth_plan = JudgedPlanOf(truth);
  drawing.truth = NetRegion(truth_plan);
  drawing.truth_walls = truth_plan.walls;
  drawing.truth_doors = truth_plan.doors;
  if (input.floorplan != nullptr) {
    const JudgedPlan plan = JudgedPlanOf(*input.floorplan);
    const MultiPolygon2 net = NetRegion(plan);
    drawing.missed = Difference(drawing.truth, net);
    drawing.surplus = Difference(net, drawing.truth);
    drawing.plan_walls = plan.walls;
    drawing.plan_doors = plan.doors;
  }
  if (options.draw_profiles && input.structure != nullptr) {
    drawing.profiles = ProfileRings(*input.scene, *input.structure);
  }
  drawing.cameras = MarkCameras(input, report.columns);
  return drawing;
}

// Where the plan lies on the page: pixel = (margin + s·(x − min.x), height − margin − s·(y −
// min.y)).
struct Page {
  Vector2d min{0, 0};
  double px_per_m = 100;
  double width_px = 0, height_px = 0, drawing_width_px = 0;

  [[nodiscard]] Vector2d ToPixel(const Vector2d& p) const {
    return {kMargin_px + px_per_m * (p.x() - min.x()),
            height_px - kMargin_px - px_per_m * (p.y() - min.y())};
  }
};

Page LayOut(const Drawing& drawing, const OverlayOptions& options) {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d max = -min;
  const auto include = [&](const Vector2d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  };
  for (const MultiPolygon2* region : {&drawing.truth, &drawing.surplus}) {
    for (const Polygon2& part : *region) {
      for (const Vector2d& p : part.outer) include(p);
    }
  }
  for (const CameraMark& camera : drawing.cameras) include(camera.position);
  if (!(min.x() <= max.x())) min = max = Vector2d::Zero();
  const Vector2d size = (max - min).cwiseMax(1.0);
  Page page;
  page.min = min;
  page.px_per_m = options.longest_side_px / size.maxCoeff();
  page.drawing_width_px = page.px_per_m * size.x() + 2 * kMargin_px;
  page.width_px = std::ceil(page.drawing_width_px + kLegendWidth_px);
  page.height_px = std::ceil(std::max(kMinHeight_px, page.px_per_m * size.y() + 2 * kMargin_px));
  return page;
}

void TraceRing(cairo_t* cr, const Page& page, const Ring2& ring) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d p = page.ToPixel(ring[i]);
    i == 0 ? cairo_move_to(cr, p.x(), p.y()) : cairo_line_to(cr, p.x(), p.y());
  }
  cairo_close_path(cr);
}

void FillRegion(cairo_t* cr, const Page& page, const MultiPolygon2& region, const Color& color) {
  SetColor(cr, color);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  for (const Polygon2& part : region) {
    TraceRing(cr, page, part.outer);
    for (const Ring2& hole : part.holes) TraceRing(cr, page, hole);
    cairo_fill(cr);
  }
}

void StrokeSegments(cairo_t* cr, const Page& page, const std::vector<Segment2>& segments,
                    const Color& color, double width_px) {
  SetColor(cr, color);
  cairo_set_line_width(cr, width_px);
  for (const Segment2& segment : segments) {
    const Vector2d a = page.ToPixel(segment[0]), b = page.ToPixel(segment[1]);
    cairo_move_to(cr, a.x(), a.y());
    cairo_line_to(cr, b.x(), b.y());
  }
  cairo_stroke(cr);
}

void StrokeRings(cairo_t* cr, const Page& page, const std::vector<Ring2>& rings,
                 const Color& color) {
  SetColor(cr, color);
  cairo_set_line_width(cr, 1);
  for (const Ring2& ring : rings) TraceRing(cr, page, ring);
  cairo_stroke(cr);
}

void DrawDot(cairo_t* cr, const Vector2d& at, const Color& color) {
  cairo_new_sub_path(cr);
  cairo_arc(cr, at.x(), at.y(), kDotRadius_px, 0, 2 * kPi);
  SetColor(cr, color);
  cairo_fill_preserve(cr);
  SetColor(cr, {1, 1, 1, 1});
  cairo_set_line_width(cr, 1.2);
  cairo_stroke(cr);
}

void DrawPlan(cairo_t* cr, const Page& page, const Drawing& drawing) {
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  FillRegion(cr, page, drawing.truth, kTruthRoom);
  FillRegion(cr, page, drawing.missed, kMissed);
  FillRegion(cr, page, drawing.surplus, kSurplus);
  StrokeRings(cr, page, drawing.profiles, kProfile);
  StrokeSegments(cr, page, drawing.truth_walls, kTruthWall, 2.6);
  StrokeSegments(cr, page, drawing.truth_doors, kTruthDoor, 2.6);
  StrokeSegments(cr, page, drawing.plan_walls, kPlanWall, 1.4);
  const double dashes[] = {4, 3};
  cairo_set_dash(cr, dashes, 2, 0);
  StrokeSegments(cr, page, drawing.plan_doors, kPlanWall, 1.4);
  cairo_set_dash(cr, nullptr, 0, 0);
  for (const CameraMark& camera : drawing.cameras)
    DrawDot(cr, page.ToPixel(camera.position), camera.color);
}

// The longest of 1, 2, 5 · 10ⁿ metres that is not much longer than the target.
double BarLength(double px_per_m) {
  const double target_m = kTargetBar_px / px_per_m;
  const double power = std::pow(10, std::floor(std::log10(target_m)));
  const double rest = target_m / power;
  return power * (rest >= 5 ? 5 : rest >= 2 ? 2 : 1);
}

double DrawScaleBar(cairo_t* cr, const Page& page, double x, double y) {
  const double length_m = BarLength(page.px_per_m);
  SetColor(cr, kText);
  cairo_set_line_width(cr, 3);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  cairo_move_to(cr, x, y);
  cairo_line_to(cr, x + length_m * page.px_per_m, y);
  cairo_stroke(cr);
  DrawText(cr, x, y - 8, fmt::format("{:g} m", length_m), 13);
  return y + 1.6 * kLine_px;
}

struct KeyLine {
  const char* text;
  Color color;
  enum { kPatch, kStroke, kDot } mark;
};
constexpr KeyLine kKeyLines[] = {
    {"true rooms", kTruthRoom, KeyLine::kPatch},
    {"missed by the plan", kMissed, KeyLine::kPatch},
    {"too much in the plan", kSurplus, KeyLine::kPatch},
    {"true wall", kTruthWall, KeyLine::kStroke},
    {"true door", kTruthDoor, KeyLine::kStroke},
    {"wall of the plan", kPlanWall, KeyLine::kStroke},
    {"camera, columns within 10 % ≥ 0.8", kGood, KeyLine::kDot},
    {"0.6 – 0.8", kFair, KeyLine::kDot},
    {"below 0.6", kPoor, KeyLine::kDot},
    {"not judged", kUnknown, KeyLine::kDot},
};

double DrawKey(cairo_t* cr, double x, double y) {
  for (const KeyLine& line : kKeyLines) {
    SetColor(cr, line.color);
    if (line.mark == KeyLine::kPatch) {
      cairo_rectangle(cr, x, y - 11, 26, 13);
      cairo_fill(cr);
    } else if (line.mark == KeyLine::kStroke) {
      cairo_set_line_width(cr, 2.6);
      cairo_move_to(cr, x, y - 5);
      cairo_line_to(cr, x + 26, y - 5);
      cairo_stroke(cr);
    } else {
      DrawDot(cr, {x + 13, y - 5}, line.color);
    }
    DrawText(cr, x + 36, y, line.text, 13);
    y += kLine_px;
  }
  return y;
}

constexpr const char* kKeyFigures[] = {
    "area_iou_gross",
    "area_iou_net",
    "area_error_gross",
    "wall_plan_to_truth_median_m",
    "wall_truth_to_plan_median_m",
    "wall_within_10cm",
    "column_median_deg",
    "columns_within_5pct",
    "columns_within_10pct",
    "panorama_iou_median",
    "ceiling_median_m",
    "rooms_total",
    "rooms_iou50",
    "room_f1_10cm",
    "corner_f1_10cm",
};

void DrawFigures(cairo_t* cr, double x, double y, const MetricReport& figures) {
  for (const char* key : kKeyFigures) {
    const auto figure = figures.find(key);
    if (figure == figures.end()) continue;
    const std::string value =
        figure->second ? fmt::format("{:.4g}", *figure->second) : std::string("n/a");
    DrawText(cr, x, y, key, 13);
    DrawText(cr, x + kLegendWidth_px - 2 * kMargin_px, y, value, 13, TextAlign::kRight);
    y += kLine_px;
  }
}

void DrawPage(cairo_t* cr, const Page& page, const Drawing& drawing, const MetricReport& figures) {
  SetColor(cr, {1, 1, 1, 1});
  cairo_paint(cr);
  DrawPlan(cr, page, drawing);
  const double x = page.drawing_width_px + 0.5 * kMargin_px;
  double y = DrawScaleBar(cr, page, x, 2 * kMargin_px);
  y = DrawKey(cr, x, y);
  DrawFigures(cr, x, y + kLine_px, figures);
}

void DrawOn(cairo_surface_t* surface, const Page& page, const Drawing& drawing,
            const MetricReport& figures) {
  const CairoContext context = StartDrawing(surface);
  DrawPage(context.get(), page, drawing, figures);
  CheckDrawing(context.get());
}

}  // namespace

void OverlayOptions::Visit(OptionVisitor& v) {
  v("longest_side_px", longest_side_px, "Longest side of the drawing without its legend.",
    {100, 10000});
  v("draw_profiles", draw_profiles, "Draw the wall profile of every panorama.");
}

std::string RenderOverlaySvg(const EvaluationInput& input, const GroundTruth& truth,
                             const EvaluationReport& report, const OverlayOptions& options) {
  const Drawing drawing = MakeDrawing(input, truth, report, options);
  const Page page = LayOut(drawing, options);
  return DrawSvg(page.width_px, page.height_px,
                 [&](cairo_surface_t* surface) { DrawOn(surface, page, drawing, report.figures); });
}

std::string RenderOverlayPng(const EvaluationInput& input, const GroundTruth& truth,
                             const EvaluationReport& report, const OverlayOptions& options) {
  const Drawing drawing = MakeDrawing(input, truth, report, options);
  const Page page = LayOut(drawing, options);
  const CairoSurface surface =
      MakeImageSurface(static_cast<int>(page.width_px), static_cast<int>(page.height_px));
  DrawOn(surface.get(), page, drawing, report.figures);
  return EncodePng(surface.get());
}

}  // namespace enfilade
