// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/error_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "enfilade/image/resize.h"
#include "src/evaluate/drawing.h"

namespace enfilade {
namespace {

constexpr int kPanelWidth_px = 1024, kPanelHeight_px = 512;
constexpr int kMargin_px = 20;
constexpr int kHead_px = 62;     // title and figures
constexpr int kCaption_px = 48;  // under each panel
constexpr double kMaxDepthError_m = 0.30;
constexpr double kMaxNormalError_deg = 30;
constexpr double kScaleWidth_px = 360;

constexpr Color kUnjudged{0.62, 0.62, 0.62, 1};
constexpr Color kFaceless{0, 0, 0, 1};
constexpr Color kTooNear{0.13, 0.35, 0.75, 1};
constexpr Color kTooFar{0.78, 0.12, 0.10, 1};
constexpr Color kWhite{1, 1, 1, 1};
constexpr Color kTurned{0.45, 0.02, 0.08, 1};
constexpr Color kTurnedHalf{0.95, 0.55, 0.20, 1};
constexpr std::array<uint8_t, 3> kEdge{255, 225, 0};

Color Mix(const Color& a, const Color& b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), 1};
}

// Of a share in [−1, 1] of the largest error shown.
Color DepthColor(double share) {
  return Mix(kWhite, share < 0 ? kTooNear : kTooFar, std::min(1.0, std::abs(share)));
}

// Of a share in [0, 1].
Color NormalColor(double share) {
  const double t = 2 * std::min(1.0, share);
  return t < 1 ? Mix(kWhite, kTurnedHalf, t) : Mix(kTurnedHalf, kTurned, t - 1);
}

ImageU8 Colored(const ImageF& error, double max_error,
                const std::function<Color(double)>& color_of) {
  ImageU8 rgb(error.rows(), error.cols(), 3);
  for (int row = 0; row < error.rows(); ++row) {
    for (int col = 0; col < error.cols(); ++col) {
      const double e = error(row, col);
      const Color color = std::isnan(e)   ? kUnjudged
                          : std::isinf(e) ? kFaceless
                                          : color_of(e / max_error);
      for (int k = 0; k < 3; ++k) {
        const double value = k == 0 ? color.r : k == 1 ? color.g : color.b;
        rgb(row, col, k) = static_cast<uint8_t>(std::lround(255 * value));
      }
    }
  }
  return rgb;
}

// Every pixel shown as it is.
ImageU8 Enlarged(const ImageU8& rgb) {
  ImageU8 panel(kPanelHeight_px, kPanelWidth_px, 3);
  const cv::Mat from(rgb.rows(), rgb.cols(), CV_8UC3, const_cast<uint8_t*>(rgb.data().data()));
  cv::Mat to(panel.rows(), panel.cols(), CV_8UC3, panel.data().data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_NEAREST);
  return panel;
}

// The panorama with a line wherever neighbouring pixels of the map see different faces.
ImageU8 WithEdges(const ImageU8& rgb, const Image<int>& face_idx) {
  ImageU8 panel = rgb.empty() ? ImageU8(kPanelHeight_px, kPanelWidth_px, 3, 160)
                              : ReduceImage(rgb, kPanelHeight_px, kPanelWidth_px);
  const auto face_at = [&](int row, int col) {
    return face_idx(std::min(row, panel.rows() - 1) * face_idx.rows() / panel.rows(),
                    col % panel.cols() * face_idx.cols() / panel.cols());
  };
  for (int row = 0; row < panel.rows(); ++row) {
    for (int col = 0; col < panel.cols(); ++col) {
      const int face = face_at(row, col);
      if (face == face_at(row, col + 1) && face == face_at(row + 1, col)) continue;
      for (int k = 0; k < 3; ++k) panel(row, col, k) = kEdge.at(static_cast<size_t>(k));
    }
  }
  return panel;
}

void DrawPanel(cairo_t* cr, const ImageU8& rgb, double y) {
  const CairoSurface surface = MakeImageSurface(rgb.cols(), rgb.rows());
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < rgb.rows(); ++row) {
    for (int col = 0; col < rgb.cols(); ++col) {
      unsigned char* pixel = bytes + row * stride + 4 * col;  // blue, green, red
      for (int k = 0; k < 3; ++k) pixel[k] = rgb(row, col, 2 - k);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_set_source_surface(cr, surface.get(), kMargin_px, y);
  cairo_paint(cr);
  SetColor(cr, kUnjudged);  // white panels need a border on white paper
  cairo_set_line_width(cr, 1);
  cairo_rectangle(cr, kMargin_px - 0.5, y - 0.5, rgb.cols() + 1, rgb.rows() + 1);
  cairo_stroke(cr);
}

// Colours of the shares from `low` to 1 with five ticks, right-aligned under a panel.
void DrawScale(cairo_t* cr, double y, double low, double max_error, const char* unit,
               const std::function<Color(double)>& color_of) {
  const double x = kMargin_px + kPanelWidth_px - kScaleWidth_px - 30;
  for (int i = 0; i < kScaleWidth_px; ++i) {
    SetColor(cr, color_of(low + (1 - low) * (i + 0.5) / kScaleWidth_px));
    cairo_rectangle(cr, x + i, y + 6, 1, 14);
    cairo_fill(cr);
  }
  for (int tick = 0; tick <= 4; ++tick) {
    const double error = max_error * (low + (1 - low) * tick / 4);
    const char* bound = tick == 4 ? "≥ " : tick == 0 && low < 0 ? "≤ " : "";
    DrawText(cr, x + kScaleWidth_px * tick / 4, y + 36,
             fmt::format("{}{}{:g} {}", bound, error < 0 ? "−" : "", std::abs(error), unit), 12,
             TextAlign::kCenter);
  }
}

void DrawMarks(cairo_t* cr, double y) {
  const auto mark = [&](double x, const Color& color, const char* text) {
    SetColor(cr, color);
    cairo_rectangle(cr, x, y + 6, 22, 14);
    cairo_fill(cr);
    DrawText(cr, x + 28, y + 18, text, 13);
  };
  mark(kMargin_px + 330, kUnjudged, "not judged");
  mark(kMargin_px + 450, kFaceless, "no face");
}

std::string FiguresLine(const PanoramaModelError& figures) {
  const auto show = [](const std::optional<double>& value, double factor, const char* unit) {
    return value ? fmt::format("{:.1f} {}", factor * *value, unit) : std::string("n/a");
  };
  return fmt::format(
      "depth: median {}, within 5 % {}    normals: median {}    pixels with a face {}",
      show(figures.depth_median_m, 100, "cm"), show(figures.depth_within_5pct, 100, "%"),
      show(figures.normal_median_deg, 1, "°"), show(figures.hit_share, 100, "%"));
}

}  // namespace

std::string RenderErrorMapPng(const ModelErrorMap& map, const ImageU8& rgb,
                              const std::string& title) {
  constexpr int kStep_px = kPanelHeight_px + kCaption_px;
  const CairoSurface surface =
      MakeImageSurface(kPanelWidth_px + 2 * kMargin_px, kHead_px + 3 * kStep_px);
  const CairoContext context = StartDrawing(surface.get());
  cairo_t* cr = context.get();
  SetColor(cr, kWhite);
  cairo_paint(cr);
  DrawText(cr, kMargin_px, 26, title, 18);
  DrawText(cr, kMargin_px, 50, FiguresLine(map.figures), 14);

  double y = kHead_px;
  DrawPanel(cr, WithEdges(rgb, map.face_idx), y);
  DrawText(cr, kMargin_px, y + kPanelHeight_px + 18, "panorama with the edges of the model", 13);
  y += kStep_px;
  DrawPanel(cr, Enlarged(Colored(map.depth_error_m, kMaxDepthError_m, DepthColor)), y);
  DrawText(cr, kMargin_px, y + kPanelHeight_px + 18, "depth: model − truth along the ray", 13);
  DrawMarks(cr, y + kPanelHeight_px);
  DrawScale(cr, y + kPanelHeight_px, -1, 100 * kMaxDepthError_m, "cm", DepthColor);
  y += kStep_px;
  DrawPanel(cr, Enlarged(Colored(map.normal_error_deg, kMaxNormalError_deg, NormalColor)), y);
  DrawText(cr, kMargin_px, y + kPanelHeight_px + 18, "normals: angle between model and truth", 13);
  DrawMarks(cr, y + kPanelHeight_px);
  DrawScale(cr, y + kPanelHeight_px, 0, kMaxNormalError_deg, "°", NormalColor);
  CheckDrawing(cr);
  return EncodePng(surface.get());
}

}  // namespace enfilade
