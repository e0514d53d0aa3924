// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/photo_sphere.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <string_view>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Tags = std::map<std::string, std::string, std::less<>>;

constexpr double kMaxSide_px = 1e6;
// Shapes that differ by more belong to different pictures.
constexpr double kShapeTolerance = 0.01;

// Tags stand as attributes of rdf:Description or as elements below it. Writers choose the prefix,
// so the names alone count; no other namespace has them.
class TagCollector : public pugi::xml_tree_walker {
 public:
  bool for_each(pugi::xml_node& node) override {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      tags.emplace(LocalName(attribute.name()), attribute.value());
    }
    tags.emplace(LocalName(node.name()), node.child_value());
    return true;
  }
  Tags tags;

 private:
  static std::string LocalName(std::string_view name) {
    const size_t colon = name.find(':');
    return std::string(colon == std::string_view::npos ? name : name.substr(colon + 1));
  }
};

std::optional<double> Number(const Tags& tags, std::string_view name, double low, double high) {
  const auto tag = tags.find(name);
  if (tag == tags.end()) return std::nullopt;
  std::string_view text = tag->second;
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || !(value >= low && value <= high)) return std::nullopt;
  return value;
}

std::optional<ImageSize> Size(const Tags& tags, std::string_view width, std::string_view height) {
  const std::optional<double> w = Number(tags, width, 1, kMaxSide_px);
  const std::optional<double> h = Number(tags, height, 1, kMaxSide_px);
  if (!w || !h) return std::nullopt;
  return ImageSize{static_cast<int>(*w), static_cast<int>(*h)};
}

}  // namespace

std::optional<Eigen::Vector3d> PhotoSphere::UpInCam() const {
  if (!pitch_deg && !roll_deg) return std::nullopt;
  const double pitch = DegToRad(pitch_deg.value_or(0)), roll = DegToRad(roll_deg.value_or(0));
  return Eigen::Vector3d(-std::sin(roll) * std::cos(pitch), -std::cos(roll) * std::cos(pitch),
                         std::sin(pitch));
}

bool PhotoSphere::IsCropped(const ImageSize& picture) const {
  if (!full_size || !cropped_size) return false;
  const double told = static_cast<double>(cropped_size->width) / cropped_size->height;
  const double shape = static_cast<double>(picture.width) / picture.height;
  if (std::abs(told / shape - 1) > kShapeTolerance) return false;
  return cropped_size->width < full_size->width || cropped_size->height < full_size->height;
}

PhotoSphere ParsePhotoSphere(const std::string& xmp_packet) {
  PhotoSphere sphere;
  pugi::xml_document document;
  if (!document.load_buffer(xmp_packet.data(), xmp_packet.size())) return sphere;
  TagCollector collector;
  document.traverse(collector);
  const Tags& tags = collector.tags;
  sphere.pitch_deg = Number(tags, "PosePitchDegrees", -90, 90);
  sphere.roll_deg = Number(tags, "PoseRollDegrees", -180, 180);
  sphere.full_size = Size(tags, "FullPanoWidthPixels", "FullPanoHeightPixels");
  sphere.cropped_size = Size(tags, "CroppedAreaImageWidthPixels", "CroppedAreaImageHeightPixels");
  return sphere;
}

}  // namespace enfilade
