// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/drawing.h"

#include <cairo-svg.h>

#include <regex>

#include "enfilade/base/check.h"

namespace enfilade {

CairoSurface MakeImageSurface(int width_px, int height_px) {
  return {cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px),
          cairo_surface_destroy};
}

CairoContext StartDrawing(cairo_surface_t* surface) {
  CairoContext context(cairo_create(surface), cairo_destroy);
  cairo_select_font_face(context.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  return context;
}

void CheckDrawing(cairo_t* cr) {
  ENFILADE_CHECK_MSG(cairo_status(cr) == CAIRO_STATUS_SUCCESS,
                     cairo_status_to_string(cairo_status(cr)));
}

std::string EncodePng(cairo_surface_t* surface) {
  std::string bytes;
  ENFILADE_CHECK(cairo_surface_write_to_png_stream(surface, AppendBytes, &bytes) ==
                 CAIRO_STATUS_SUCCESS);
  return bytes;
}

std::string DrawSvg(double width_px, double height_px,
                    const std::function<void(cairo_surface_t*)>& draw) {
  std::string bytes;
  {
    const CairoSurface surface(
        cairo_svg_surface_create_for_stream(AppendBytes, &bytes, width_px, height_px),
        cairo_surface_destroy);
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    draw(surface.get());
    cairo_surface_finish(surface.get());
    ENFILADE_CHECK(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS);
  }
  // cairo numbers the surfaces of a process and writes the number into the file.
  static const std::regex kSurfaceId("id=\"surface[0-9]+\"");
  return std::regex_replace(bytes, kSurfaceId, "id=\"drawing\"");
}

cairo_status_t AppendBytes(void* closure, const unsigned char* bytes, unsigned size) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), size);
  return CAIRO_STATUS_SUCCESS;
}

void SetColor(cairo_t* cr, const Color& color) {
  cairo_set_source_rgba(cr, color.r, color.g, color.b, color.a);
}

void DrawText(cairo_t* cr, double x, double y, const std::string& text, double size_px,
              TextAlign align) {
  SetColor(cr, kText);
  cairo_set_font_size(cr, size_px);
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  if (align == TextAlign::kCenter) x -= 0.5 * extents.x_advance;
  if (align == TextAlign::kRight) x -= extents.x_advance;
  cairo_move_to(cr, x, y);
  cairo_show_text(cr, text.c_str());
}

}  // namespace enfilade
