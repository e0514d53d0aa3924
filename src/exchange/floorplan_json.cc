// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/floorplan_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"
#include "enfilade/geometry/boolean.h"
#include "src/exchange/json_geometry.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using Eigen::Vector2d;

constexpr char kFormat[] = "enfilade-floorplan";
constexpr int kVersion = 1;

// ---- Writing.

double Round(double value, double steps) {
  ENFILADE_CHECK(std::isfinite(value));
  return std::round(value * steps) / steps + 0.0;  // no negative zero
}

double Length(double value) { return Round(value, 1e6); }

Json ToJson(const Vector2d& p) { return {Length(p.x()), Length(p.y())}; }

Json ToJson(const Ring2& ring) {
  Json points = Json::array();
  for (const Vector2d& p : ring) points.push_back(ToJson(p));
  return points;
}

Json ToJson(const Rigid3& transform) {
  const Eigen::Matrix4d matrix = transform.Matrix();
  Json rows = Json::array();
  for (int i = 0; i < 16; ++i) {
    rows.push_back(i % 4 == 3 ? Length(matrix(i / 4, i % 4)) : Round(matrix(i / 4, i % 4), 1e9));
  }
  return rows;
}

Json FlatToJson(const Ring2& ring) {
  Json numbers = Json::array();
  for (const Vector2d& p : ring) {
    numbers.push_back(Length(p.x()));
    numbers.push_back(Length(p.y()));
  }
  return numbers;
}

// Many outlines, so on few lines: points in one list of numbers, a letter an edge.
Json CurveToJson(const std::vector<OutlineChoice>& curve) {
  Json list = Json::array();
  for (size_t i = 0; i < curve.size(); ++i) {
    const OutlineChoice& choice = curve[i];
    std::string seen;
    for (const WallSeen wall : choice.seen) seen += EnumToName(wall)[0];
    Json sigmas = Json::array();
    for (const double sigma_m : choice.sigma_m) sigmas.push_back(Length(sigma_m));
    Json holes = Json::array();
    for (const Ring2& hole : choice.polygon.holes) holes.push_back(FlatToJson(hole));
    Json change;
    if (i + 1 < curve.size()) {
      const MultiPolygon2 here = {choice.polygon}, next = {curve[i + 1].polygon};
      change = Length(Area(Difference(here, next)) + Area(Difference(next, here)));
    }
    list.push_back({{"vertices", choice.NumVertices()},
                    {"cost_m", Length(choice.cost_m)},
                    {"area_m2", Length(Area(choice.polygon))},
                    {"area_change_m2", change},
                    {"outline", FlatToJson(choice.polygon.outer)},
                    {"holes", holes},
                    {"seen", seen},
                    {"sigma_m", sigmas}});
  }
  return list;
}

Json RoomPair(int room_id, const std::optional<int>& other_room_id) {
  return {room_id, other_room_id ? Json(*other_room_id) : Json()};
}

Json ToJson(const Room& room) {
  Json holes = Json::array();
  for (const Ring2& hole : room.polygon.holes) holes.push_back(ToJson(hole));
  Json json = {{"id", room.id},
               {"polygon", ToJson(room.polygon.outer)},
               {"holes", holes},
               {"floor_z", Length(room.floor_z)},
               {"ceiling_z", Length(room.ceiling_z)},
               {"ceiling", room.has_level_ceiling ? "level" : "sloped"},
               {"area_m2", Length(Area(room.polygon))},
               {"area_sigma_m2", Length(room.area_sigma_m2)}};
  if (!room.curve.empty()) json["curve"] = CurveToJson(room.curve);
  return json;
}

Json ToJson(const Wall& wall) {
  return {{"id", wall.id},
          {"a", ToJson(wall.a)},
          {"b", ToJson(wall.b)},
          {"rooms", RoomPair(wall.room_id, wall.other_room_id)},
          {"thickness_m", Length(wall.thickness_m)},
          {"thickness", wall.is_thickness_measured ? "measured" : "assumed"},
          {"seen", EnumToName(wall.seen)},
          {"sigma_m", Length(wall.sigma_m)},
          {"length_sigma_m", Length(wall.length_sigma_m)}};
}

Json ToJson(const Opening& opening) {
  return {{"id", opening.id},
          {"kind", EnumToName(opening.kind)},
          {"wall", opening.wall_id},
          {"a", ToJson(opening.a)},
          {"b", ToJson(opening.b)},
          {"sill_z", Length(opening.sill_z)},
          {"head_z", Length(opening.head_z)},
          {"rooms", RoomPair(opening.room_id, opening.other_room_id)}};
}

Json ToJson(const Storey& storey);
Json ToJson(const PlanCamera& camera);

template <typename T>
Json ListToJson(const std::vector<T>& values) {
  Json list = Json::array();
  for (const T& value : values) list.push_back(ToJson(value));
  return list;
}

Json ToJson(const Storey& storey) {
  return {{"id", storey.id},
          {"floor_z", Length(storey.floor_z)},
          {"rooms", ListToJson(storey.rooms)},
          {"walls", ListToJson(storey.walls)},
          {"openings", ListToJson(storey.openings)}};
}

Json ToJson(const PlanCamera& camera) {
  return {{"picture", camera.picture},      {"sha256", camera.sha256},
          {"storey", camera.storey_idx},    {"component", camera.component_idx},
          {"inferred", camera.is_inferred}, {"world_from_cam", ToJson(camera.world_from_cam)}};
}

Json ToJson(const VertexDial& dial) {
  return {{"vertices", dial.num_vertices},
          {"cost_m", Length(dial.cost_m)},
          {"bound_m", Length(dial.bound_m)},
          {"openings_dropped", dial.num_openings_dropped}};
}

// ---- Reading. Every function blames the file `where`.

int IntegerOf(const Json& object, const char* key, const std::string& where) {
  const int64_t value = JsonInteger(object, key, where);
  if (value < INT32_MIN || value > INT32_MAX) {
    throw InvalidInputError(where, std::string("key '") + key + "' is out of range",
                            "correct the number");
  }
  return static_cast<int>(value);
}

double NumberOr(const Json& object, const char* key, double missing, const std::string& where) {
  return object.contains(key) && !object[key].is_null() ? JsonNumber(object, key, where) : missing;
}

const Json& ListOr(const Json& object, const char* key, const std::string& where) {
  static const Json kNone = Json::array();
  return object.is_object() && !object.contains(key) ? kNone : JsonArray(object, key, where);
}

Vector2d PointOf(const Json& object, const char* key, const std::string& where) {
  return Vector2FromJson(JsonArray(object, key, where), where, std::string("'") + key + "'");
}

Ring2 RingOf(const Json& json, bool is_hole, const std::string& what, const std::string& where) {
  Ring2 ring = RingFromJson(json, where, what);
  if (ring.size() < 3) {
    throw InvalidInputError(where, what + " has fewer than three points", "give a closed outline");
  }
  if ((SignedArea(ring) < 0) != is_hole) std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring2 FlatRingOf(const Json& json, bool is_hole, const std::string& what,
                 const std::string& where) {
  Ring2 ring;
  if (json.is_array() && json.size() % 2 == 0) {
    for (size_t i = 0; i + 1 < json.size(); i += 2) {
      ring.emplace_back(NumberFromJson(json[i], where, what),
                        NumberFromJson(json[i + 1], where, what));
    }
  }
  // Turning it would part the edges from what is said of them.
  if (ring.size() < 3 || (SignedArea(ring) < 0) != is_hole) {
    throw InvalidInputError(where, what + " is no outline of x, y, x, y, … in the right direction",
                            "make the plan again");
  }
  return ring;
}

WallSeen SeenOfLetter(char letter, const std::string& what, const std::string& where) {
  for (const WallSeen seen : {WallSeen::kSeen, WallSeen::kPartly, WallSeen::kInferred}) {
    if (EnumToName(seen)[0] == letter) return seen;
  }
  throw InvalidInputError(where, "'seen' of " + what + " has a letter that is none of s, p and i",
                          "make the plan again");
}

OutlineChoice OutlineChoiceOf(const Json& json, const std::string& room, const std::string& where) {
  OutlineChoice choice;
  const int num_vertices = IntegerOf(json, "vertices", where);
  const std::string what = room + " with " + std::to_string(num_vertices) + " corners";
  choice.cost_m = JsonNumber(json, "cost_m", where);
  choice.polygon.outer = FlatRingOf(JsonArray(json, "outline", where), false, what, where);
  for (const Json& hole : ListOr(json, "holes", where)) {
    choice.polygon.holes.push_back(FlatRingOf(hole, true, what, where));
  }
  for (const char letter : JsonString(json, "seen", where)) {
    choice.seen.push_back(SeenOfLetter(letter, what, where));
  }
  for (const Json& sigma_m : JsonArray(json, "sigma_m", where)) {
    choice.sigma_m.push_back(NumberFromJson(sigma_m, where, "'sigma_m' of " + what));
  }
  const auto num_edges = static_cast<size_t>(choice.NumVertices());
  if (choice.NumVertices() != num_vertices || choice.seen.size() != num_edges ||
      choice.sigma_m.size() != num_edges) {
    throw InvalidInputError(where, what + " tells another number of corners or edges",
                            "make the plan again");
  }
  return choice;
}

std::vector<OutlineChoice> CurveOf(const Json& json, const std::string& room,
                                   const std::string& where) {
  std::vector<OutlineChoice> curve;
  for (const Json& choice : ListOr(json, "curve", where)) {
    curve.push_back(OutlineChoiceOf(choice, room, where));
    const size_t n = curve.size();
    if (n > 1 && curve[n - 2].NumVertices() >= curve[n - 1].NumVertices()) {
      throw InvalidInputError(where, "the curve of " + room + " does not ascend",
                              "make the plan again");
    }
  }
  return curve;
}

Room RoomOf(const Json& json, double storey_floor_z, const std::string& where) {
  Room room;
  room.id = IntegerOf(json, "id", where);
  const std::string what = "the polygon of room " + std::to_string(room.id);
  room.polygon.outer = RingOf(JsonArray(json, "polygon", where), false, what, where);
  for (const Json& hole : ListOr(json, "holes", where)) {
    room.polygon.holes.push_back(RingOf(hole, true, what, where));
  }
  room.floor_z = NumberOr(json, "floor_z", storey_floor_z, where);
  room.ceiling_z = JsonNumber(json, "ceiling_z", where);
  room.has_level_ceiling =
      !json.contains("ceiling") || JsonString(json, "ceiling", where) == "level";
  room.area_sigma_m2 = NumberOr(json, "area_sigma_m2", 0, where);
  room.curve = CurveOf(json, "room " + std::to_string(room.id), where);
  return room;
}

// "rooms": [id, id or null]; both must be rooms of the storey.
void ReadRoomPair(const Json& json, const std::set<int64_t>& room_ids, const std::string& where,
                  int& room_id, std::optional<int>& other_room_id) {
  const Json& pair = JsonArray(json, "rooms", where);
  const auto is_room = [&](const Json& id) {
    return id.is_number_integer() && room_ids.contains(id.get<int64_t>());
  };
  if (pair.size() != 2 || !is_room(pair[0]) || !(pair[1].is_null() || is_room(pair[1]))) {
    throw InvalidInputError(where, "'rooms' of a wall or opening is " + pair.dump(),
                            "give the id of a room and that of another or null");
  }
  room_id = pair[0].get<int>();
  if (!pair[1].is_null()) other_room_id = pair[1].get<int>();
}

Wall WallOf(const Json& json, const std::set<int64_t>& room_ids, const std::string& where) {
  Wall wall;
  wall.id = IntegerOf(json, "id", where);
  wall.a = PointOf(json, "a", where);
  wall.b = PointOf(json, "b", where);
  ReadRoomPair(json, room_ids, where, wall.room_id, wall.other_room_id);
  wall.thickness_m = NumberOr(json, "thickness_m", 0, where);
  wall.is_thickness_measured =
      json.contains("thickness") && JsonString(json, "thickness", where) == "measured";
  if (json.contains("seen")) {
    wall.seen = EnumFromName<WallSeen>(JsonString(json, "seen", where), where, "'seen' of a wall");
  }
  wall.sigma_m = NumberOr(json, "sigma_m", 0, where);
  wall.length_sigma_m = NumberOr(json, "length_sigma_m", 0, where);
  return wall;
}

Opening OpeningOf(const Json& json, const std::set<int64_t>& room_ids,
                  const std::set<int64_t>& wall_ids, const std::string& where) {
  Opening opening;
  opening.id = IntegerOf(json, "id", where);
  opening.kind =
      EnumFromName<OpeningKind>(JsonString(json, "kind", where), where, "'kind' of an opening");
  opening.wall_id = IntegerOf(json, "wall", where);
  if (!wall_ids.contains(opening.wall_id)) {
    throw InvalidInputError(where,
                            "opening " + std::to_string(opening.id) + " is in wall " +
                                std::to_string(opening.wall_id) + ", which is not there",
                            "check that the file is complete");
  }
  opening.a = PointOf(json, "a", where);
  opening.b = PointOf(json, "b", where);
  opening.sill_z = JsonNumber(json, "sill_z", where);
  opening.head_z = JsonNumber(json, "head_z", where);
  ReadRoomPair(json, room_ids, where, opening.room_id, opening.other_room_id);
  return opening;
}

Storey StoreyOf(const Json& json, const std::string& where) {
  Storey storey;
  storey.id = IntegerOf(json, "id", where);
  storey.floor_z = JsonNumber(json, "floor_z", where);
  std::set<int64_t> room_ids, wall_ids;
  for (const Json& room : JsonArray(json, "rooms", where)) {
    storey.rooms.push_back(RoomOf(room, storey.floor_z, where));
    room_ids.insert(storey.rooms.back().id);
  }
  for (const Json& wall : ListOr(json, "walls", where)) {
    storey.walls.push_back(WallOf(wall, room_ids, where));
    wall_ids.insert(storey.walls.back().id);
  }
  for (const Json& opening : ListOr(json, "openings", where)) {
    storey.openings.push_back(OpeningOf(opening, room_ids, wall_ids, where));
  }
  return storey;
}

VertexDial DialOf(const Json& json, const std::string& where) {
  return {IntegerOf(json, "vertices", where), JsonNumber(json, "cost_m", where),
          JsonNumber(json, "bound_m", where), IntegerOf(json, "openings_dropped", where)};
}

// What the dial needs: the rooms of the plan as drawn are those of the plan, and have walls where
// they have curves.
void CheckDialled(const Floorplan& plan, const std::string& where) {
  const std::vector<Storey>& drawn = plan.drawn_storeys.empty() ? plan.storeys : plan.drawn_storeys;
  const auto is_same_room = [](const Room& a, const Room& b) { return a.id == b.id; };
  bool is_whole = drawn.size() == plan.storeys.size();
  for (size_t s = 0; is_whole && s < drawn.size(); ++s) {
    is_whole = std::equal(drawn[s].rooms.begin(), drawn[s].rooms.end(),
                          plan.storeys[s].rooms.begin(), plan.storeys[s].rooms.end(), is_same_room);
  }
  if (!is_whole) {
    throw InvalidInputError(where, "'drawn_storeys' has other rooms than 'storeys'",
                            "make the plan again");
  }
  for (size_t s = 0; s < drawn.size(); ++s) {
    for (const Room& room : plan.storeys[s].rooms) {
      const auto is_its = [&](const Wall& wall) { return wall.room_id == room.id; };
      if (!room.curve.empty() &&
          std::none_of(drawn[s].walls.begin(), drawn[s].walls.end(), is_its)) {
        throw InvalidInputError(where,
                                "room " + std::to_string(room.id) + " has a curve but no walls",
                                "make the plan again");
      }
    }
  }
}

PlanCamera CameraOf(const Json& json, size_t num_storeys, const std::string& where) {
  PlanCamera camera;
  camera.picture = JsonString(json, "picture", where);
  if (json.contains("sha256")) camera.sha256 = JsonString(json, "sha256", where);
  camera.storey_idx = json.contains("storey") ? IntegerOf(json, "storey", where) : 0;
  if (camera.storey_idx < 0 || static_cast<size_t>(camera.storey_idx) >= num_storeys) {
    throw InvalidInputError(where, "'" + camera.picture + "' is on a storey that is not there",
                            "check that the file is complete");
  }
  camera.component_idx = json.contains("component") ? IntegerOf(json, "component", where) : 0;
  camera.is_inferred = json.contains("inferred") && json["inferred"] == Json(true);
  camera.world_from_cam = Rigid3FromJson(JsonArray(json, "world_from_cam", where), where,
                                         "world_from_cam of '" + camera.picture + "'");
  return camera;
}

}  // namespace

void WriteFloorplanJson(const std::filesystem::path& path, const Floorplan& floorplan,
                        const Json& provenance) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"home_from_world", ToJson(floorplan.home_from_world)},
               {"storeys", ListToJson(floorplan.storeys)},
               {"cameras", ListToJson(floorplan.cameras)},
               {"provenance", provenance}};
  if (floorplan.dial) json["dial"] = ToJson(*floorplan.dial);
  if (!floorplan.drawn_storeys.empty()) json["drawn_storeys"] = ListToJson(floorplan.drawn_storeys);
  WriteJsonFile(path, json);
}

Floorplan ReadFloorplanJson(const std::filesystem::path& path) {
  const std::string& where = path.native();
  const Json json = ReadJsonFile(path);
  if (JsonString(json, "format", where) != kFormat) {
    throw InvalidInputError(where, "is no floorplan.json of this project", "give such a file");
  }
  if (JsonInteger(json, "version", where) != kVersion) {
    throw InvalidInputError(where, "has an unknown version", "use the program that wrote it");
  }
  Floorplan floorplan;
  floorplan.home_from_world =
      Rigid3FromJson(JsonArray(json, "home_from_world", where), where, "home_from_world");
  for (const Json& storey : JsonArray(json, "storeys", where)) {
    floorplan.storeys.push_back(StoreyOf(storey, where));
  }
  for (const Json& camera : ListOr(json, "cameras", where)) {
    floorplan.cameras.push_back(CameraOf(camera, floorplan.storeys.size(), where));
  }
  if (json.contains("dial")) floorplan.dial = DialOf(json["dial"], where);
  for (const Json& storey : ListOr(json, "drawn_storeys", where)) {
    floorplan.drawn_storeys.push_back(StoreyOf(storey, where));
  }
  CheckDialled(floorplan, where);
  return floorplan;
}

}  // namespace enfilade
