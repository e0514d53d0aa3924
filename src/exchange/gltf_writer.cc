// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/gltf_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "enfilade/base/check.h"
#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "src/exchange/surface_name.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "GLB holds little-endian numbers");

// Constants of the glTF 2.0 specification.
constexpr uint32_t kGlbMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071;

constexpr int kJpegQuality = 88;

// Colours of faces without texture, linear RGB.
Json PlainMaterial(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kFloor:
      return {{"name", "floor"},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", {0.45, 0.36, 0.27, 1.0}}, {"metallicFactor", 0.0}}}};
    case SurfaceKind::kCeiling:
      return {{"name", "ceiling"},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", {0.9, 0.9, 0.9, 1.0}}, {"metallicFactor", 0.0}}}};
    case SurfaceKind::kWall:
      break;
  }
  return {{"name", "wall"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {0.75, 0.74, 0.71, 1.0}}, {"metallicFactor", 0.0}}}};
}

template <typename T>
void AppendBytes(const T& value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// Gathers the binary chunk and the JSON arrays that describe it.
class GlbBuilder {
 public:
  [[nodiscard]] int AddBufferView(std::string_view bytes, std::optional<int> target) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    binary_.append(bytes);
    return Append("bufferViews", std::move(view));
  }

  // Vectors as float32 with their bounds, which glTF wants exact.
  template <int N>
  [[nodiscard]] int AddVectors(const std::vector<Eigen::Matrix<double, N, 1>>& vectors) {
    using VectorF = Eigen::Matrix<float, N, 1>;
    std::string bytes;
    VectorF min = VectorF::Constant(std::numeric_limits<float>::max()), max = -min;
    for (const auto& vector : vectors) {
      // Adding zero turns −0 into 0.
      const VectorF v = vector.template cast<float>().array() + 0.0F;
      min = min.cwiseMin(v);
      max = max.cwiseMax(v);
      for (int i = 0; i < N; ++i) AppendBytes(v[i], bytes);
    }
    return Append("accessors", {{"bufferView", AddBufferView(bytes, kArrayBuffer)},
                                {"componentType", kFloat},
                                {"count", vectors.size()},
                                {"type", "VEC" + std::to_string(N)},
                                {"min", std::vector<double>(min.begin(), min.end())},
                                {"max", std::vector<double>(max.begin(), max.end())}});
  }

  [[nodiscard]] int AddIndices(const std::vector<std::array<int, 3>>& triangles,
                               size_t num_vertices) {
    const bool is_short = num_vertices <= std::numeric_limits<uint16_t>::max();
    std::string bytes;
    for (const std::array<int, 3>& triangle : triangles) {
      for (const int index : triangle) {
        is_short ? AppendBytes(static_cast<uint16_t>(index), bytes)
                 : AppendBytes(static_cast<uint32_t>(index), bytes);
      }
    }
    return Append("accessors", {{"bufferView", AddBufferView(bytes, kElementArrayBuffer)},
                                {"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                                {"count", 3 * triangles.size()},
                                {"type", "SCALAR"}});
  }

  // Adds `value` to the top-level array `key`; returns its index.
  int Append(const char* key, Json value) {
    json_[key].push_back(std::move(value));
    return static_cast<int>(json_[key].size()) - 1;
  }

  [[nodiscard]] Json& operator[](const char* key) { return json_[key]; }

  // Header, JSON chunk padded with spaces, binary chunk padded with zeros.
  [[nodiscard]] std::string Finish() {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    if (!binary_.empty()) json_["buffers"] = {{{"byteLength", binary_.size()}}};
    std::string json = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const size_t size = 12 + 8 + json.size() + (binary_.empty() ? 0 : 8 + binary_.size());
    ENFILADE_CHECK(size <= std::numeric_limits<uint32_t>::max());
    std::string glb;
    for (const uint32_t word : {kGlbMagic, uint32_t{2}, static_cast<uint32_t>(size),
                                static_cast<uint32_t>(json.size()), kJsonChunk}) {
      AppendBytes(word, glb);
    }
    glb += json;
    if (binary_.empty()) return glb;
    AppendBytes(static_cast<uint32_t>(binary_.size()), glb);
    AppendBytes(kBinaryChunk, glb);
    return glb + binary_;
  }

 private:
  Json json_ = Json::object();
  std::string binary_;
};

// One unlit material per texture, in the textures' order.
std::vector<int> AddTextures(const std::vector<ImageU8>& textures, GlbBuilder& glb) {
  std::vector<int> materials;
  for (size_t i = 0; i < textures.size(); ++i) {
    const std::string name = "atlas_" + std::to_string(i);
    const std::string jpeg = EncodeImage(textures[i], ".jpg", kJpegQuality);
    const int view = glb.AddBufferView(jpeg, std::nullopt);
    const int image =
        glb.Append("images", {{"bufferView", view}, {"mimeType", "image/jpeg"}, {"name", name}});
    const int texture = glb.Append("textures", {{"sampler", 0}, {"source", image}});
    materials.push_back(glb.Append(
        "materials", {{"name", name},
                      {"pbrMetallicRoughness",
                       {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0.0}}},
                      {"extensions", {{"KHR_materials_unlit", Json::object()}}}}));
  }
  if (!textures.empty()) {
    glb["samplers"] = {{{"magFilter", kLinear},
                        {"minFilter", kLinearMipmapLinear},
                        {"wrapS", kClampToEdge},
                        {"wrapT", kClampToEdge}}};
    glb["extensionsUsed"] = {"KHR_materials_unlit"};
  }
  return materials;
}

// Materials of textured and plain faces; the plain ones are made when first needed.
class Materials {
 public:
  Materials(const std::vector<ImageU8>& textures, GlbBuilder& glb)
      : glb_(glb), textured_(AddTextures(textures, glb)) {}

  [[nodiscard]] int Of(const ModelFace& face) {
    if (!face.uv.empty()) return textured_.at(static_cast<size_t>(face.texture_idx));
    int& material = plain_.at(static_cast<size_t>(face.kind));
    if (material < 0) material = glb_.Append("materials", PlainMaterial(face.kind));
    return material;
  }

 private:
  GlbBuilder& glb_;
  std::vector<int> textured_;
  std::array<int, 3> plain_{-1, -1, -1};
};

void CheckFace(const ModelFace& face, const BuildingModel& model) {
  ENFILADE_CHECK(!face.triangles.empty());
  ENFILADE_CHECK(face.uv.empty() || face.uv.size() == face.vertices.size());
  ENFILADE_CHECK(face.uv.empty() || (face.texture_idx >= 0 &&
                                     face.texture_idx < static_cast<int>(model.textures.size())));
  for (const Eigen::Vector2d& uv : face.uv) {
    ENFILADE_CHECK(uv.minCoeff() >= 0 && uv.maxCoeff() <= 1);
  }
}

int AddSurface(const ModelFace& face, const std::string& name, Materials& materials,
               GlbBuilder& glb) {
  Json attributes{{"POSITION", glb.AddVectors<3>(face.vertices)},
                  {"NORMAL", glb.AddVectors<3>(
                                 std::vector<Eigen::Vector3d>(face.vertices.size(), face.normal))}};
  if (!face.uv.empty()) attributes["TEXCOORD_0"] = glb.AddVectors<2>(face.uv);
  const int indices = glb.AddIndices(face.triangles, face.vertices.size());
  const Json primitive{
      {"attributes", attributes}, {"indices", indices}, {"material", materials.Of(face)}};
  const int mesh = glb.Append("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
  return glb.Append("nodes", {{"name", name}, {"mesh", mesh}});
}

int AddRoom(const BuildingModel& model, int storey_idx, const Room& room, Materials& materials,
            GlbBuilder& glb) {
  const std::string name = "room_" + std::to_string(room.id);
  Json children = Json::array();
  for (size_t f = 0; f < model.faces.size(); ++f) {
    const ModelFace& face = model.faces[f];
    if (face.storey_idx != storey_idx || face.room_id != room.id) continue;
    CheckFace(face, model);
    children.push_back(AddSurface(face, name + "/" + SurfaceName(face, f), materials, glb));
  }
  Json node{{"name", name},
            {"extras",
             {{"id", room.id},
              {"area_m2", Area(room.polygon)},
              {"floor_z", room.floor_z},
              {"ceiling_z", room.ceiling_z}}}};
  if (!children.empty()) node["children"] = std::move(children);
  return glb.Append("nodes", std::move(node));
}

int AddStorey(const BuildingModel& model, const Floorplan& plan, int storey_idx,
              Materials& materials, GlbBuilder& glb) {
  const Storey& storey = plan.storeys[static_cast<size_t>(storey_idx)];
  Json node{{"name", "storey_" + std::to_string(storey.id)},
            {"extras", {{"id", storey.id}, {"floor_z", storey.floor_z}}}};
  for (const Room& room : storey.rooms) {
    node["children"].push_back(AddRoom(model, storey_idx, room, materials, glb));
  }
  return glb.Append("nodes", std::move(node));
}

void CheckRoomsKnown(const BuildingModel& model, const Floorplan& plan) {
  for (const ModelFace& face : model.faces) {
    ENFILADE_CHECK(face.storey_idx >= 0 && face.storey_idx < static_cast<int>(plan.storeys.size()));
    const std::vector<Room>& rooms = plan.storeys[static_cast<size_t>(face.storey_idx)].rooms;
    ENFILADE_CHECK_MSG(std::any_of(rooms.begin(), rooms.end(),
                                   [&](const Room& room) { return room.id == face.room_id; }),
                       "room " + std::to_string(face.room_id));
  }
}

}  // namespace

std::string FormatGlb(const BuildingModel& model, const Floorplan& plan, std::string_view version) {
  CheckRoomsKnown(model, plan);
  GlbBuilder glb;
  glb["asset"] = {{"version", "2.0"}, {"generator", "Enfilade " + std::string(version)}};
  Materials materials(model.textures, glb);
  // A quarter turn about x: (x, y, z) with z up becomes (x, z, −y) with y up.
  const double s = std::sqrt(0.5);
  Json root{{"name", "home"}, {"rotation", {-s, 0.0, 0.0, s}}};
  for (size_t i = 0; i < plan.storeys.size(); ++i) {
    root["children"].push_back(AddStorey(model, plan, static_cast<int>(i), materials, glb));
  }
  const int root_idx = glb.Append("nodes", std::move(root));
  glb.Append("scenes", {{"name", "home"}, {"nodes", {root_idx}}});
  glb["scene"] = 0;
  return glb.Finish();
}

void WriteGlb(const std::filesystem::path& path, const BuildingModel& model, const Floorplan& plan,
              std::string_view version) {
  WriteFileAtomic(path, FormatGlb(model, plan, version));
}

}  // namespace enfilade
