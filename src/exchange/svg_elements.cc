// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/svg_elements.h"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

namespace enfilade {

using Eigen::Vector2d;
using pugi::xml_node;

std::string Mm(double value) {
  std::string text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

void SetAttribute(xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name) = value.c_str();
}

xml_node AppendElement(xml_node parent, const char* name, const std::string& style) {
  xml_node node = parent.append_child(name);
  SetAttribute(node, "class", style);
  return node;
}

xml_node AppendLine(xml_node parent, const std::string& style, const Vector2d& a,
                    const Vector2d& b) {
  xml_node line = AppendElement(parent, "line", style);
  SetAttribute(line, "x1", Mm(a.x()));
  SetAttribute(line, "y1", Mm(a.y()));
  SetAttribute(line, "x2", Mm(b.x()));
  SetAttribute(line, "y2", Mm(b.y()));
  return line;
}

xml_node AppendRectangle(xml_node parent, const std::string& style, const Vector2d& corner,
                         const Vector2d& size) {
  xml_node rectangle = AppendElement(parent, "rect", style);
  SetAttribute(rectangle, "x", Mm(corner.x()));
  SetAttribute(rectangle, "y", Mm(corner.y()));
  SetAttribute(rectangle, "width", Mm(size.x()));
  SetAttribute(rectangle, "height", Mm(size.y()));
  return rectangle;
}

xml_node AppendCircle(xml_node parent, const std::string& style, const Vector2d& center,
                      double radius) {
  xml_node circle = AppendElement(parent, "circle", style);
  SetAttribute(circle, "cx", Mm(center.x()));
  SetAttribute(circle, "cy", Mm(center.y()));
  SetAttribute(circle, "r", Mm(radius));
  return circle;
}

xml_node AppendText(xml_node parent, const TextLine& line) {
  xml_node text = AppendElement(parent, "text", line.style);
  SetAttribute(text, "x", Mm(line.anchor.x()));
  SetAttribute(text, "y", Mm(line.anchor.y()));
  if (line.angle_deg != 0) {
    SetAttribute(text, "transform",
                 fmt::format("rotate({} {} {})", Mm(line.angle_deg), Mm(line.anchor.x()),
                             Mm(line.anchor.y())));
  }
  text.text().set(line.text.c_str());
  return text;
}

xml_node AppendLayer(xml_node parent, const std::string& id, const std::string& style,
                     const std::string& label) {
  xml_node layer = parent.append_child("g");
  SetAttribute(layer, "id", id);
  SetAttribute(layer, "class", style);
  SetAttribute(layer, "inkscape:groupmode", "layer");
  SetAttribute(layer, "inkscape:label", label);
  return layer;
}

xml_node AppendDrawing(pugi::xml_document& document, const Vector2d& size_mm) {
  xml_node declaration = document.append_child(pugi::node_declaration);
  SetAttribute(declaration, "version", "1.0");
  SetAttribute(declaration, "encoding", "UTF-8");
  xml_node root = document.append_child("svg");
  SetAttribute(root, "xmlns", "http://www.w3.org/2000/svg");
  SetAttribute(root, "xmlns:inkscape", "http://www.inkscape.org/namespaces/inkscape");
  SetAttribute(root, "version", "1.1");
  SetAttribute(root, "width", Mm(size_mm.x()) + "mm");
  SetAttribute(root, "height", Mm(size_mm.y()) + "mm");
  SetAttribute(root, "viewBox", fmt::format("0 0 {} {}", Mm(size_mm.x()), Mm(size_mm.y())));
  return root;
}

void AppendScaleBar(xml_node parent, double scale_denominator, const Vector2d& right_end) {
  constexpr int kParts = 5;
  constexpr double kMinPart_mm = 8, kHeight_mm = 1.6;
  double part_m = 1;
  while (part_m * 1000 / scale_denominator < kMinPart_mm) part_m *= part_m == 2 ? 2.5 : 2;
  const double part_mm = part_m * 1000 / scale_denominator;
  const Vector2d begin = right_end - Vector2d(kParts * part_mm, 0);
  xml_node group = AppendElement(parent, "g", "scale-bar");
  for (int i = 0; i < kParts; ++i) {
    AppendRectangle(group, i % 2 == 0 ? "scale-dark" : "scale-light",
                    begin + Vector2d(i * part_mm, 0), {part_mm, kHeight_mm});
  }
  for (int i = 0; i <= kParts; ++i) {
    const char* unit = i == kParts ? " m" : "";
    AppendText(group, {fmt::format("{:g}{}", i * part_m, unit), "scale-text",
                       begin + Vector2d(i * part_mm, -0.8), 0});
  }
}

std::string FormatXml(const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, " ", pugi::format_indent | pugi::format_no_declaration, pugi::encoding_utf8);
  return text.str();
}

}  // namespace enfilade
