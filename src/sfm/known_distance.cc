// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "enfilade/base/errors.h"
#include "enfilade/sfm/metric_scale.h"

namespace enfilade {
namespace {

constexpr const char* kOption = "--known-distance";
constexpr double kMinDistance = 0.1;

[[noreturn]] void Refuse(const std::string& what, const std::string& cure) {
  throw InvalidInputError(kOption, what, cure);
}

int FindView(std::string_view name, std::span<const View> views) {
  for (size_t i = 0; i < views.size(); ++i) {
    const std::filesystem::path picture = views[i].picture;
    if (picture == name || picture.stem() == name) return static_cast<int>(i);
  }
  Refuse(fmt::format("names '{}', which is none of the pictures", name),
         "give names as they stand in the folder");
}

KnownDistance ParseOne(std::string_view text, std::span<const View> views) {
  const size_t first = text.find(','), last = text.rfind(',');
  double metres = 0;
  if (last != std::string_view::npos) {
    const auto [end, error] =
        std::from_chars(text.data() + last + 1, text.data() + text.size(), metres);
    if (error != std::errc() || end != text.data() + text.size()) metres = 0;
  }
  if (first == last || !std::isfinite(metres) || metres <= 0) {
    Refuse(fmt::format("'{}' is no distance", text),
           "write PICTURE,PICTURE,METRES, as in a.jpg,b.jpg,3.20");
  }
  const KnownDistance known{FindView(text.substr(0, first), views),
                            FindView(text.substr(first + 1, last - first - 1), views), metres};
  if (known.a_idx == known.b_idx) {
    Refuse(fmt::format("'{}' names one picture twice", text), "give two different pictures");
  }
  return known;
}

}  // namespace

std::vector<KnownDistance> ParseKnownDistances(const std::string& text,
                                               std::span<const View> views) {
  std::vector<KnownDistance> known;
  std::string_view rest = text;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(';'), rest.size());
    known.push_back(ParseOne(rest.substr(0, end), views));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return known;
}

std::vector<MeasuredDistance> MeasureDistances(std::span<const KnownDistance> known,
                                               std::span<const View> views,
                                               std::span<const Eigen::Vector3d> positions,
                                               std::span<const int> component_idx) {
  std::vector<MeasuredDistance> measured;
  for (const KnownDistance& distance : known) {
    const size_t a = static_cast<size_t>(distance.a_idx), b = static_cast<size_t>(distance.b_idx);
    const std::string &name_a = views[a].picture, &name_b = views[b].picture;
    if (component_idx[a] != component_idx[b]) {
      Refuse(fmt::format("tells the distance of {} and {}, which nothing ties together", name_a,
                         name_b),
             "measure between two pictures of one component (connections.html shows them)");
    }
    const double camera_heights = (positions[a] - positions[b]).norm();
    if (camera_heights < kMinDistance) {
      Refuse(
          fmt::format("tells the distance of {} and {}, which stand at one place", name_a, name_b),
          "measure between two pictures that are some metres apart");
    }
    measured.push_back({name_a + " – " + name_b, distance.metres, camera_heights});
  }
  return measured;
}

}  // namespace enfilade
