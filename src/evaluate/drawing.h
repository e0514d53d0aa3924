// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <functional>
#include <memory>
#include <string>

namespace enfilade {

struct Color {
  double r, g, b, a;
};
inline constexpr Color kText{0.10, 0.10, 0.10, 1};

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using CairoContext = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// Pixels of 32 bits: CAIRO_FORMAT_RGB24.
[[nodiscard]] CairoSurface MakeImageSurface(int width_px, int height_px);

/// A context with the font of all our pictures.
[[nodiscard]] CairoContext StartDrawing(cairo_surface_t* surface);

/// Throws std::logic_error when something could not be drawn.
void CheckDrawing(cairo_t* cr);

/// The bytes of a PNG file.
[[nodiscard]] std::string EncodePng(cairo_surface_t* surface);

/// The bytes of an SVG file of what `draw` draws. The same drawing gives the same bytes, unless it
/// holds pictures, which cairo numbers through all drawings of a process.
[[nodiscard]] std::string DrawSvg(double width_px, double height_px,
                                  const std::function<void(cairo_surface_t*)>& draw);

/// Appends to the std::string behind `closure`: a cairo_write_func_t.
cairo_status_t AppendBytes(void* closure, const unsigned char* bytes, unsigned size);

void SetColor(cairo_t* cr, const Color& color);

enum class TextAlign { kLeft, kCenter, kRight };

/// One line whose baseline starts, has its middle or ends at (x, y).
void DrawText(cairo_t* cr, double x, double y, const std::string& text, double size_px,
              TextAlign align = TextAlign::kLeft);

}  // namespace enfilade
