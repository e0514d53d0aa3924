// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/geometry/angles.h"
#include "src/exchange/json_geometry.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

constexpr char kFormat[] = "enfilade-connections";
constexpr int kVersion = 1;

// Four decimals say all there is to say: a tenth of a millimetre, a third of an arc second.
Json Rounded(double value) {
  if (!std::isfinite(value)) return {};
  const double rounded = std::round(value * 1e4) / 1e4;
  return rounded == 0 ? 0.0 : rounded;  // no negative zero
}

Json RoundedDeg(const std::optional<double>& rad) { return rad ? Rounded(RadToDeg(*rad)) : Json(); }

Json ComponentToJson(const ComponentFact& component, const ConnectionFacts& facts) {
  Json pictures = Json::array();
  for (const int view : component.views) {
    pictures.push_back(facts.views[static_cast<size_t>(view)].picture);
  }
  return {{"component", component.idx},
          {"num_pictures", component.views.size()},
          {"pictures", std::move(pictures)},
          {"extent_m", {Rounded(component.extent_m.x()), Rounded(component.extent_m.y())}}};
}

Json ViewToJson(const ViewFact& view, const ConnectionFacts& facts) {
  const auto& p = view.position_m;
  return {{"picture", view.picture},
          {"component", facts.components[static_cast<size_t>(view.component)].idx},
          {"inferred", view.is_inferred},
          {"num_features", view.num_features},
          {"num_points", view.num_points},
          {"num_connections", view.num_ties},
          {"position_m", {Rounded(p.x()), Rounded(p.y()), Rounded(p.z())}},
          {"yaw_deg", RoundedDeg(view.yaw_rad)},
          {"tilt_deg", RoundedDeg(view.tilt_rad)}};
}

Json PairToJson(const PairFact& pair, const ConnectionFacts& facts) {
  const auto picture = [&](int view) { return facts.views[static_cast<size_t>(view)].picture; };
  return {{"views", {pair.a, pair.b}},
          {"pictures", {picture(pair.a), picture(pair.b)}},
          {"verdict", EnumToName(pair.verdict)},
          {"num_matches", pair.num_matches},
          {"num_inliers", pair.num_inliers},
          {"parallax_deg", RoundedDeg(pair.parallax_rad)},
          {"log10_chance", Rounded(pair.log10_chance)},
          {"distance_m", pair.distance_m ? Rounded(*pair.distance_m) : Json()},
          {"yaw_miss_deg", RoundedDeg(pair.yaw_miss_rad)},
          {"direction_miss_deg", RoundedDeg(pair.direction_miss_rad)}};
}

}  // namespace

Json ConnectionsToJson(const ConnectionFacts& facts) {
  Json components = Json::array(), views = Json::array(), pairs = Json::array();
  for (const ComponentFact& c : facts.components) components.push_back(ComponentToJson(c, facts));
  for (const ViewFact& view : facts.views) views.push_back(ViewToJson(view, facts));
  for (const PairFact& pair : facts.pairs) pairs.push_back(PairToJson(pair, facts));
  return {{"format", kFormat},
          {"version", kVersion},
          {"components", std::move(components)},
          {"views", std::move(views)},
          {"pairs", std::move(pairs)},
          {"num_pairs_left_out", facts.num_left_out},
          {"num_pairs_not_matched", facts.num_not_matched},
          {"warnings", facts.warnings}};
}

}  // namespace enfilade
