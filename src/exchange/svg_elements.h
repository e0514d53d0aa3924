// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace pugi {
class xml_document;
class xml_node;
}  // namespace pugi

namespace enfilade {

/// One line of text on its baseline; the style says whether the anchor is its middle or an end.
struct TextLine {
  std::string text;
  std::string style;  ///< CSS class
  Eigen::Vector2d anchor{0, 0};
  double angle_deg = 0;  ///< as SVG turns: clockwise on paper
};

/// Millimetres with at most three decimals and no negative zero.
[[nodiscard]] std::string Mm(double value);

void SetAttribute(pugi::xml_node node, const char* name, const std::string& value);

/// Appends elements of CSS class `style`, all lengths in user units, and returns them.
pugi::xml_node AppendElement(pugi::xml_node parent, const char* name, const std::string& style);
pugi::xml_node AppendLine(pugi::xml_node parent, const std::string& style, const Eigen::Vector2d& a,
                          const Eigen::Vector2d& b);
pugi::xml_node AppendRectangle(pugi::xml_node parent, const std::string& style,
                               const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
pugi::xml_node AppendCircle(pugi::xml_node parent, const std::string& style,
                            const Eigen::Vector2d& center, double radius);
pugi::xml_node AppendText(pugi::xml_node parent, const TextLine& line);

/// A group that Inkscape shows as a layer called `label`.
pugi::xml_node AppendLayer(pugi::xml_node parent, const std::string& id, const std::string& style,
                           const std::string& label);

/// The XML declaration and an empty drawing of the given size whose user unit is a millimetre.
pugi::xml_node AppendDrawing(pugi::xml_document& document, const Eigen::Vector2d& size_mm);

/// Five alternating parts of whole metres, each at least 8 mm long, with figures above; styles
/// scale-bar, scale-dark, scale-light and scale-text. One metre is 1000 / scale_denominator units.
void AppendScaleBar(pugi::xml_node parent, double scale_denominator,
                    const Eigen::Vector2d& right_end);

/// The document as UTF-8 text, indented by one space a level, with no declaration but its own.
[[nodiscard]] std::string FormatXml(const pugi::xml_document& document);

}  // namespace enfilade
