// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/wall_report.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "src/exchange/plan_sheet.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using pugi::xml_node;

constexpr const char* kStyle = R"(
text { font-family: "DejaVu Sans", Arial, Helvetica, sans-serif; font-size: 2.4px; fill: #1c1c1c; }
.paper { fill: #ffffff; }
.room { fill: #f6f3ec; stroke: none; }
.face { fill: none; stroke: #000000; stroke-width: 0.4; stroke-linecap: square; }
.face-inferred { stroke-dasharray: 1.2 0.9; stroke-linecap: butt; }
.face-asked { fill: none; stroke: #dc1e1e; stroke-width: 1; stroke-linecap: square; }
.next-best { fill: none; stroke: #dc1e1e; stroke-width: 0.4; stroke-dasharray: 1.5 1; }
.opening { fill: none; stroke: #f6f3ec; stroke-width: 0.6; }
.view { fill: #2b6cb0; fill-opacity: 0.08; stroke: none; }
.camera { fill: #2b6cb0; stroke: none; }
.agrees { fill: #23863a; stroke: none; }
.disagrees { fill: #e07b00; stroke: none; }
)";

constexpr double kMargin_m = 0.6;
constexpr double kMmPerM = 20;

std::string Count(size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

const std::string& PictureOf(const Scene& scene, const WallWitness& witness) {
  return scene.views[static_cast<size_t>(witness.view_idx)].picture;
}

std::string HeadLine(const WallExplanation& why) {
  const Wall& wall = why.wall;
  return fmt::format(
      "wall {} of room {}, storey {}: {} along {:.0f} % of its length\n"
      "  {:.2f} ± {:.2f} m long, from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f})\n",
      wall.id, wall.room_id, why.storey_idx,
      wall.seen == WallSeen::kInferred
          ? "inferred, evidence"
          : std::string(wall.seen == WallSeen::kSeen ? "seen" : "partly seen,"),
      100 * why.sigma.grounds.seen_share, (wall.b - wall.a).norm(), wall.length_sigma_m, wall.a.x(),
      wall.a.y(), wall.b.x(), wall.b.y());
}

std::string SigmaLines(const WallSigma& sigma) {
  const WallSigma::Grounds& grounds = sigma.grounds;
  const std::string from = sigma.distance_m > 0
                               ? fmt::format("from {:.1f} m away", sigma.distance_m)
                               : "that no panorama sees";
  return fmt::format(
      "  offset ± {:.3f} m: ± {:.3f} m for a wall {}; {:.0f} % that the line is another "
      "surface's,\n    since it is {:.2f} m long, {:.1f} m of other walls lie on its line, {} a "
      "wall's thickness behind it, {} agree{}\n",
      sigma.sigma_m, sigma.measured_m, from, 100 * sigma.wrong_probability, grounds.length_m,
      grounds.collinear_m, grounds.has_twin ? "a room ends" : "no room ends",
      Count(static_cast<size_t>(grounds.num_agreeing), "panorama"),
      grounds.num_agreeing == 1 ? "s" : "");
}

std::string NeighbourLines(const WallExplanation& why) {
  std::string text;
  if (why.behind) {
    text += fmt::format("  behind it, {:.2f} m away: wall {} of room {}\n", why.behind->gap_m,
                        why.behind->wall_id, why.behind->room_id);
  } else {
    text += "  behind it: no wall of another room within 1 m\n";
  }
  text += fmt::format("  thickness {:.2f} m, {}\n", why.wall.thickness_m,
                      why.wall.is_thickness_measured ? "measured" : "assumed");
  for (const Opening& opening : why.openings) {
    text += fmt::format("  {} {} on it: {:.2f} m wide, head at {:.2f} m\n",
                        EnumNames(OpeningKind{})[static_cast<size_t>(opening.kind)], opening.id,
                        (opening.b - opening.a).norm(), opening.head_z);
  }
  return text;
}

std::string WitnessLines(const Scene& scene, const WallExplanation& why) {
  size_t num_columns = 0, name_width = 8;
  for (const WallWitness& witness : why.witnesses) {
    num_columns += witness.sightings.size();
    name_width = std::max(name_width, PrintablePath(PictureOf(scene, witness)).size());
  }
  std::string text = fmt::format(
      "  seen by {} in {}, {} within 10 cm\n", Count(why.witnesses.size(), "panorama"),
      Count(num_columns, "column"), Count(static_cast<size_t>(why.num_points), "point"));
  if (why.witnesses.empty()) return text;
  text += fmt::format("    {:{}}  distance    range  incidence  columns  within 5 %  wall off by\n",
                      "panorama", name_width);
  for (const WallWitness& witness : why.witnesses) {
    text += fmt::format("    {:{}}  {:6.2f} m  {:5.2f} m  {:8.0f}°  {:7}  {:8.0f} %  {:+9.3f} m\n",
                        PrintablePath(PictureOf(scene, witness)), name_width, witness.distance_m,
                        witness.range_m, RadToDeg(witness.incidence_rad), witness.sightings.size(),
                        100 * witness.agreeing_share, witness.offset_m);
  }
  return text;
}

std::string CostText(const OutlineCost& cost) {
  return fmt::format(
      "{:.2f} m ({:.2f} m unseen, {:.3f} m² free outside, {:.3f} m² solid inside, {})",
      cost.total_m, cost.unseen_m, cost.free_outside_m2, cost.solid_inside_m2,
      Count(static_cast<size_t>(cost.num_corners), "corner"));
}

std::string CostLines(const WallExplanation& why) {
  std::string text = fmt::format("  cost in metres of unseen wall: {}\n", CostText(why.cost));
  if (!why.next_best) return text + "  without it: the walls beside it leave it no other place\n";
  return text + fmt::format(
                    "  without it: the wall moved {:.2f} m {}, its next best place\n"
                    "    it and the walls beside it now    {}\n"
                    "    and with the wall moved           {}\n",
                    std::abs(why.next_best->outwards_m),
                    why.next_best->outwards_m > 0 ? "outwards" : "into the room",
                    CostText(why.next_best->here), CostText(why.next_best->there));
}

Vector2d PositionOf(const Floorplan& plan, const Scene& scene, const WallWitness& witness) {
  const View& view = scene.views[static_cast<size_t>(witness.view_idx)];
  return (plan.home_from_world * view.world_from_cam.translation).head<2>();
}

xml_node AppendPath(xml_node parent, const char* style, const std::vector<Vector2d>& points,
                    const PaperFrame& frame) {
  std::string path;
  for (const Vector2d& p : points) {
    const Vector2d q = frame * p;
    path += fmt::format("{}{} {} ", path.empty() ? "M " : "L ", Mm(q.x()), Mm(q.y()));
  }
  xml_node node = AppendElement(parent, "path", style);
  SetAttribute(node, "d", path + "Z");
  return node;
}

void DrawPlan(const Storey& storey, const PaperFrame& frame, xml_node root) {
  for (const Room& room : storey.rooms) AppendPath(root, "room", room.polygon.outer, frame);
  for (const Wall& wall : storey.walls) {
    const bool is_inferred = wall.seen == WallSeen::kInferred;
    AppendLine(root, is_inferred ? "face face-inferred" : "face", frame * wall.a, frame * wall.b);
  }
  for (const Opening& opening : storey.openings)
    AppendLine(root, "opening", frame * opening.a, frame * opening.b);
}

void DrawWitness(const std::string& picture, const Vector2d& eye, const Wall& wall,
                 const WallWitness& witness, const PaperFrame& frame, xml_node root) {
  const Vector2d along = (wall.b - wall.a).normalized();
  const auto [first, last] =
      std::minmax_element(witness.sightings.begin(), witness.sightings.end(),
                          [](const auto& s, const auto& t) { return s.along_m < t.along_m; });
  AppendPath(root, "view", {eye, wall.a + first->along_m * along, wall.a + last->along_m * along},
             frame);
  for (const WallSighting& sighting : witness.sightings) {
    const Vector2d at = wall.a + sighting.along_m * along;
    const Vector2d seen = eye + sighting.profile_m / sighting.distance_m * (at - eye);
    AppendCircle(root, Agrees(sighting) ? "agrees" : "disagrees", frame * seen, 0.35);
  }
  AppendCircle(root, "camera", frame * eye, 1);
  AppendText(root, {PrintablePath(picture), "name", frame * eye + Vector2d(1.5, -1), 0});
}

}  // namespace

std::string FormatWallReport(const Scene& scene, const WallExplanation& why) {
  return HeadLine(why) + SigmaLines(why.sigma) + NeighbourLines(why) + WitnessLines(scene, why) +
         CostLines(why);
}

std::string FormatWallSvg(const Floorplan& plan, const Scene& scene, const WallExplanation& why) {
  const Storey& storey = plan.storeys.at(static_cast<size_t>(why.storey_idx));
  const Wall& wall = why.wall;
  Eigen::AlignedBox2d extent;
  for (const Room& room : storey.rooms) {
    if (room.id != wall.room_id) continue;
    for (const Vector2d& p : room.polygon.outer) extent.extend(p);
  }
  extent.extend(wall.a).extend(wall.b);
  for (const WallWitness& witness : why.witnesses) extent.extend(PositionOf(plan, scene, witness));
  extent.extend(Vector2d(extent.min() - Vector2d::Constant(kMargin_m)));
  extent.extend(Vector2d(extent.max() + Vector2d::Constant(kMargin_m)));

  const Vector2d size = kMmPerM * extent.sizes();
  const PaperFrame frame{kMmPerM, kMmPerM * Vector2d(-extent.min().x(), extent.max().y())};
  pugi::xml_document document;
  xml_node root = AppendDrawing(document, size);
  root.append_child("title").text().set(fmt::format("Wall {}", wall.id).c_str());
  root.append_child("style").text().set(kStyle);
  AppendRectangle(root, "paper", {0, 0}, size);
  DrawPlan(storey, frame, root);
  if (why.next_best) {
    const Vector2d along = (wall.b - wall.a).normalized();
    const Vector2d shift = why.next_best->outwards_m * Vector2d(along.y(), -along.x());
    AppendLine(root, "next-best", frame * (wall.a + shift), frame * (wall.b + shift));
  }
  AppendLine(root, "face-asked", frame * wall.a, frame * wall.b);
  for (const WallWitness& witness : why.witnesses) {
    DrawWitness(PictureOf(scene, witness), PositionOf(plan, scene, witness), wall, witness, frame,
                root);
  }
  return FormatXml(document);
}

}  // namespace enfilade
