// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/plan_labels.h"
#include "src/exchange/plan_poche.h"
#include "src/exchange/plan_sheet.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using pugi::xml_node;

constexpr const char* kStyle = R"(
text { font-family: "DejaVu Sans", Arial, Helvetica, sans-serif; fill: #1c1c1c; }
.paper { fill: #ffffff; }
.border { fill: none; stroke: #1c1c1c; stroke-width: 0.35; }
.rule { fill: none; stroke: #1c1c1c; stroke-width: 0.18; }
.room { fill: #f6f3ec; stroke: none; }
.body { fill: #3b3b3b; stroke: none; }
.body-inferred { fill: #d9d6cf; stroke: none; }
.face { fill: none; stroke: #000000; stroke-width: 0.3; stroke-linecap: square; }
.face-inferred { stroke-dasharray: 1.2 0.9; stroke-linecap: butt; }
.opening { fill: none; stroke: #1c1c1c; stroke-width: 0.18; }
.leaf { stroke-width: 0.35; }
.door, .passage { stroke-dasharray: 0.8 0.6; }
.dimension { fill: none; stroke: #6a6a6a; stroke-width: 0.13; }
.tick { fill: none; stroke: #1c1c1c; stroke-width: 0.25; }
.dimension-text { font-size: 1.8px; text-anchor: middle; fill: #333333; }
.room-name { font-size: 2.6px; font-weight: bold; text-anchor: middle; }
.room-area { font-size: 2.4px; text-anchor: middle; }
.room-height { font-size: 2px; text-anchor: middle; fill: #555555; }
.room-small { font-size: 1.7px; text-anchor: middle; }
.storey-name { font-size: 2.4px; fill: #555555; }
.camera { fill: none; stroke: #2b6cb0; stroke-width: 0.18; }
.camera-inferred { stroke-dasharray: 0.4 0.3; }
.sheet-title { font-size: 4.4px; font-weight: bold; }
.sheet-line { font-size: 2.6px; }
.sheet-note { font-size: 1.9px; fill: #555555; }
.scale-text { font-size: 1.9px; text-anchor: middle; }
.scale-dark { fill: #1c1c1c; stroke: #1c1c1c; stroke-width: 0.18; }
.scale-light { fill: #ffffff; stroke: #1c1c1c; stroke-width: 0.18; }
)";

std::string PathOfRing(const Ring2& ring, const PaperFrame& frame) {
  std::string path;
  for (const Vector2d& p : ring) {
    const Vector2d q = frame * p;
    path += fmt::format("{}{} {} ", path.empty() ? "M " : "L ", Mm(q.x()), Mm(q.y()));
  }
  return path + "Z";
}

std::string PathOfPolygon(const Polygon2& polygon, const PaperFrame& frame) {
  std::string path = PathOfRing(polygon.outer, frame);
  for (const Ring2& hole : polygon.holes) path += " " + PathOfRing(hole, frame);
  return path;
}

xml_node AppendPolygon(xml_node parent, const std::string& style, const Polygon2& polygon,
                       const PaperFrame& frame) {
  xml_node path = AppendElement(parent, "path", style);
  SetAttribute(path, "fill-rule", "evenodd");
  SetAttribute(path, "d", PathOfPolygon(polygon, frame));
  return path;
}

Eigen::AlignedBox2d ExtentOf(const Storey& storey, const WallBodies& bodies) {
  Eigen::AlignedBox2d extent;
  const auto add = [&](const MultiPolygon2& region) {
    for (const Polygon2& polygon : region) {
      for (const Vector2d& p : polygon.outer) extent.extend(p);
    }
  };
  add(bodies.seen);
  add(bodies.inferred);
  for (const Room& room : storey.rooms) add({room.polygon});
  return extent.isEmpty() ? Eigen::AlignedBox2d(Vector2d(0, 0), Vector2d(0, 0)) : extent;
}

void DrawRooms(const Storey& storey, const PaperFrame& frame, xml_node layer) {
  for (const Room& room : storey.rooms) {
    xml_node path = AppendPolygon(layer, "room", room.polygon, frame);
    SetAttribute(path, "data-room", std::to_string(room.id));
    SetAttribute(path, "data-area-m2", fmt::format("{:.3f}", Area(room.polygon)));
    SetAttribute(path, "data-height-m", fmt::format("{:.3f}", room.ceiling_z - room.floor_z));
  }
}

void DrawWalls(const Storey& storey, const WallBodies& bodies, const PaperFrame& frame,
               xml_node layer) {
  for (const Polygon2& body : bodies.inferred) AppendPolygon(layer, "body-inferred", body, frame);
  for (const Polygon2& body : bodies.seen) AppendPolygon(layer, "body", body, frame);
  for (const Wall& wall : storey.walls) {
    const bool is_inferred = wall.seen == WallSeen::kInferred;
    xml_node face = AppendLine(layer, is_inferred ? "face face-inferred" : "face", frame * wall.a,
                               frame * wall.b);
    SetAttribute(face, "data-wall", std::to_string(wall.id));
    SetAttribute(face, "data-room", std::to_string(wall.room_id));
    SetAttribute(face, "data-length-m", fmt::format("{:.3f}", (wall.b - wall.a).norm()));
    if (wall.sigma_m > 0) {
      SetAttribute(face, "data-sigma-m", fmt::format("{:.3f}", wall.sigma_m));
      SetAttribute(face, "data-length-sigma-m", fmt::format("{:.3f}", wall.length_sigma_m));
    }
    SetAttribute(face, "data-thickness-m", fmt::format("{:.3f}", wall.thickness_m));
    SetAttribute(face, "data-thickness", wall.is_thickness_measured ? "measured" : "assumed");
    SetAttribute(face, "data-seen",
                 std::string(EnumNames(WallSeen{})[static_cast<size_t>(wall.seen)]));
  }
}

// Jambs across the wall; the leaf of a door in the middle (which way it turns is not known), the
// faces and the pane of a window.
void DrawOpenings(const Storey& storey, const PaperFrame& frame, xml_node layer) {
  constexpr const char* kStyles[] = {"opening door", "opening passage", "opening window"};
  for (const Opening& opening : storey.openings) {
    const Ring2 ring = OpeningFootprint(storey, opening);
    if (ring.empty()) continue;
    xml_node group = AppendElement(layer, "g", kStyles[static_cast<size_t>(opening.kind)]);
    SetAttribute(group, "data-opening", std::to_string(opening.id));
    SetAttribute(group, "data-width-m", fmt::format("{:.3f}", (opening.b - opening.a).norm()));
    AppendLine(group, "jamb", frame * ring[0], frame * ring[3]);
    AppendLine(group, "jamb", frame * ring[1], frame * ring[2]);
    if (opening.kind == OpeningKind::kWindow) {
      AppendLine(group, "pane", frame * ring[0], frame * ring[1]);
      AppendLine(group, "pane", frame * ring[3], frame * ring[2]);
    }
    if (opening.kind != OpeningKind::kOpening) {
      AppendLine(group, opening.kind == OpeningKind::kDoor ? "leaf" : "pane",
                 frame * Vector2d(0.5 * (ring[0] + ring[3])),
                 frame * Vector2d(0.5 * (ring[1] + ring[2])));
    }
  }
}

void DrawDimension(const DimensionLine& dimension, xml_node layer) {
  constexpr double kTick_mm = 0.7, kOvershoot_mm = 0.8;
  const Vector2d along = (dimension.line_b - dimension.line_a).normalized();
  // An oblique stroke of 45°.
  const Vector2d slash =
      kTick_mm * Vector2d(along.x() + along.y(), along.y() - along.x()).normalized();
  xml_node group = AppendElement(layer, "g", "dimension-group");
  if (dimension.wall_id >= 0) SetAttribute(group, "data-wall", std::to_string(dimension.wall_id));
  AppendLine(group, "dimension", dimension.line_a, dimension.line_b);
  const auto draw_end = [&](const Vector2d& measured, const Vector2d& end) {
    const Vector2d away = (end - measured).normalized();
    AppendLine(group, "dimension", measured + kOvershoot_mm * away, end + kOvershoot_mm * away);
    AppendLine(group, "tick", end - slash, end + slash);
  };
  draw_end(dimension.measured_a, dimension.line_a);
  draw_end(dimension.measured_b, dimension.line_b);
  AppendText(group, dimension.text);
}

// A camera of the storey and its place on the sheet.
struct PaperCamera {
  const PlanCamera* camera = nullptr;
  Vector2d position{0, 0};
};

std::vector<PaperCamera> CamerasOf(const Floorplan& plan, int storey_idx, const PaperFrame& frame) {
  std::vector<PaperCamera> cameras;
  for (const PlanCamera& camera : plan.cameras) {
    if (camera.storey_idx != storey_idx) continue;
    const Eigen::Vector3d in_home = plan.home_from_world * camera.world_from_cam.translation;
    cameras.push_back({&camera, frame * Vector2d(in_home.head<2>())});
  }
  return cameras;
}

void DrawCameras(const std::vector<PaperCamera>& cameras, xml_node layer) {
  for (const auto& [camera, position] : cameras) {
    xml_node circle = AppendCircle(layer, camera->is_inferred ? "camera camera-inferred" : "camera",
                                   position, 0.6);
    SetAttribute(circle, "data-picture", PrintablePath(camera->picture));
  }
}

void DrawStorey(const Floorplan& plan, int storey_idx, const WallBodies& bodies,
                const PaperFrame& frame, const PlanSvgOptions& options, xml_node root) {
  const Storey& storey = plan.storeys[static_cast<size_t>(storey_idx)];
  const std::string id = fmt::format("storey-{}", storey.id);
  const xml_node group = AppendLayer(root, id, "storey", fmt::format("Storey {}", storey.id));
  const auto layer = [&](const char* name, const char* label) {
    return AppendLayer(group, id + "-" + name, name, label);
  };
  const Eigen::AlignedBox2d extent = ExtentOf(storey, bodies);
  std::vector<PaperCamera> cameras;
  if (options.show_cameras) cameras = CamerasOf(plan, storey_idx, frame);
  std::vector<Vector2d> avoided;
  for (const PaperCamera& camera : cameras) avoided.push_back(camera.position);
  const StoreyLabels labels =
      PlaceLabels(storey, frame, extent, avoided, options.show_wall_dimensions);
  DrawRooms(storey, frame, layer("rooms", "Rooms"));
  DrawWalls(storey, bodies, frame, layer("walls", "Walls"));
  DrawOpenings(storey, frame, layer("openings", "Openings"));
  DrawCameras(cameras, layer("cameras", "Cameras"));
  const xml_node dimensions = layer("dimensions", "Dimensions");
  for (const DimensionLine& dimension : labels.dimensions) DrawDimension(dimension, dimensions);
  const xml_node lettering = layer("labels", "Labels");
  for (const RoomLabel& label : labels.rooms) {
    xml_node room = AppendElement(lettering, "g", "room-label");
    SetAttribute(room, "data-room", std::to_string(label.room_id));
    for (const TextLine& line : label.lines) AppendText(room, line);
  }
  if (plan.storeys.size() > 1) {
    const Vector2d corner(extent.min().x(), extent.max().y());
    AppendText(lettering, {fmt::format("Storey {}", storey.id), "storey-name",
                           frame * corner - Vector2d(0, 1.5), 0});
  }
}

std::string SummaryLine(const Floorplan& plan, const PlanSheet& sheet) {
  size_t num_rooms = 0;
  double area_m2 = 0;
  for (const Storey& storey : plan.storeys) {
    num_rooms += storey.rooms.size();
    for (const Room& room : storey.rooms) area_m2 += Area(room.polygon);
  }
  const std::string paper = sheet.format == "custom"
                                ? fmt::format("{:.0f} × {:.0f} mm", sheet.width_mm, sheet.height_mm)
                                : sheet.format;
  return fmt::format("Scale 1:{} on {} · {} room{} · {:.1f} m² net", sheet.scale_denominator, paper,
                     num_rooms, num_rooms == 1 ? "" : "s", area_m2);
}

void DrawSheet(const Floorplan& plan, const PlanSheet& sheet, const PlanSvgOptions& options,
               xml_node root) {
  const xml_node layer = AppendLayer(root, "sheet", "sheet", "Sheet");
  const Vector2d size(sheet.width_mm, sheet.height_mm);
  const Vector2d margin = Vector2d::Constant(kSheetMargin_mm);
  AppendRectangle(layer, "paper", {0, 0}, size);
  AppendRectangle(layer, "border", margin, size - 2 * margin);
  const double top = sheet.height_mm - kSheetMargin_mm - kTitleBlock_mm;
  AppendLine(layer, "rule", {kSheetMargin_mm, top}, {sheet.width_mm - kSheetMargin_mm, top});
  const double left = kSheetMargin_mm + 4;
  AppendText(layer, {PrintablePath(options.title), "sheet-title", {left, top + 6.5}, 0});
  AppendText(layer, {SummaryLine(plan, sheet), "sheet-line", {left, top + 11.2}, 0});
  AppendText(layer,
             {"Lengths in metres between inner wall faces, areas within them, each ± one standard "
              "deviation. Wall thickness is assumed unless both sides were seen.",
              "sheet-note",
              {left, top + 14.9},
              0});
  AppendText(layer,
             {"Dashed faces and light bodies: inferred, no picture shows them. Circles: where "
              "pictures were taken.",
              "sheet-note",
              {left, top + 17.8},
              0});
  AppendScaleBar(layer, sheet.scale_denominator, {sheet.width_mm - kSheetMargin_mm - 6, top + 6});
}

}  // namespace

std::string FormatPlanSvg(const Floorplan& plan, const PlanSvgOptions& options) {
  std::vector<WallBodies> bodies;
  std::vector<Eigen::AlignedBox2d> extents;
  for (const Storey& storey : plan.storeys) {
    bodies.push_back(BuildWallBodies(storey));
    extents.push_back(ExtentOf(storey, bodies.back()));
  }
  const PlanSheet sheet = LayOutSheet(extents);
  pugi::xml_document document;
  xml_node root = AppendDrawing(document, {sheet.width_mm, sheet.height_mm});
  root.append_child("title").text().set(PrintablePath(options.title).c_str());
  root.append_child("desc").text().set(
      (SummaryLine(plan, sheet) + ". One unit is one millimetre on paper.").c_str());
  root.append_child("style").text().set(kStyle);
  DrawSheet(plan, sheet, options, root);
  for (size_t i = 0; i < plan.storeys.size(); ++i) {
    DrawStorey(plan, static_cast<int>(i), bodies[i], sheet.frames[i], options, root);
  }
  return FormatXml(document);
}

void WritePlanSvg(const std::filesystem::path& path, const Floorplan& plan,
                  const PlanSvgOptions& options) {
  WriteFileAtomic(path, FormatPlanSvg(plan, options));
}

}  // namespace enfilade
