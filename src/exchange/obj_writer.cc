// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/obj_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <string>
#include <tuple>

#include "enfilade/base/check.h"
#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "src/exchange/surface_name.h"

namespace enfilade {
namespace {

constexpr int kJpegQuality = 92;
constexpr double kMicron_m = 1e-6;

std::string TextureName(size_t idx) { return fmt::format("textures/atlas_{}.jpg", idx); }

std::string_view PlainMaterialName(SurfaceKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"floor", "ceiling", "wall"};
  return kNames.at(static_cast<size_t>(kind));
}

std::string FormatMaterials(const BuildingModel& model) {
  std::string mtl = "# Materials of an Enfilade model\n";
  for (size_t i = 0; i < model.textures.size(); ++i) {
    mtl += fmt::format("\nnewmtl atlas_{}\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {}\n", i,
                       TextureName(i));
  }
  constexpr std::array<std::string_view, 3> kColours{"0.70 0.63 0.55", "0.95 0.95 0.95",
                                                     "0.88 0.87 0.86"};
  for (size_t kind = 0; kind < kColours.size(); ++kind) {
    mtl += fmt::format("\nnewmtl {}\nKa 0 0 0\nKd {}\nKs 0 0 0\nillum 1\n",
                       PlainMaterialName(static_cast<SurfaceKind>(kind)), kColours[kind]);
  }
  return mtl;
}

// Rounded to the micron, and without a negative zero.
double Rounded(double value) { return std::round(value / kMicron_m) * kMicron_m + 0.0; }

// Writes faces one after the other; positions of a room are shared.
class ObjText {
 public:
  explicit ObjText(std::string_view material_library)
      : text_(fmt::format("# Enfilade model: metres, z up, home frame\nmtllib {}\n",
                          material_library)) {}

  void AddFace(const ModelFace& face, size_t face_idx) {
    std::vector<int> positions;
    for (const Eigen::Vector3d& p : face.vertices) positions.push_back(PositionIndex(face, p));
    for (const Eigen::Vector2d& uv : face.uv) {
      // OBJ counts v from the bottom.
      Append("vt {:.6f} {:.6f}\n", uv.x(), 1 - uv.y());
    }
    Append("vn {:.6f} {:.6f} {:.6f}\n", Rounded(face.normal.x()), Rounded(face.normal.y()),
           Rounded(face.normal.z()));
    ++num_normals_;
    Append("g storey_{}/room_{}/{}\n", face.storey_idx, face.room_id, SurfaceName(face, face_idx));
    face.uv.empty() ? Append("usemtl {}\n", PlainMaterialName(face.kind))
                    : Append("usemtl atlas_{}\n", face.texture_idx);
    for (const std::array<int, 3>& triangle : face.triangles)
      AddTriangle(face, positions, triangle);
    num_texture_vertices_ += static_cast<int>(face.uv.size());
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <typename... Args>
  void Append(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  [[nodiscard]] int PositionIndex(const ModelFace& face, const Eigen::Vector3d& p) {
    const auto key = std::tuple(face.storey_idx, face.room_id, p.x(), p.y(), p.z());
    const auto [it, is_new] = position_index_.try_emplace(key, position_index_.size() + 1);
    if (is_new) Append("v {:.6f} {:.6f} {:.6f}\n", Rounded(p.x()), Rounded(p.y()), Rounded(p.z()));
    return static_cast<int>(it->second);
  }

  void AddTriangle(const ModelFace& face, const std::vector<int>& positions,
                   const std::array<int, 3>& triangle) {
    text_ += 'f';
    for (const int corner : triangle) {
      const int position = positions[static_cast<size_t>(corner)];
      face.uv.empty()
          ? Append(" {}//{}", position, num_normals_)
          : Append(" {}/{}/{}", position, num_texture_vertices_ + corner + 1, num_normals_);
    }
    text_ += '\n';
  }

  std::string text_;
  std::map<std::tuple<int, int, double, double, double>, size_t> position_index_;
  int num_texture_vertices_ = 0;
  int num_normals_ = 0;
};

}  // namespace

void WriteObj(const std::filesystem::path& path, const BuildingModel& model) {
  const std::string stem = path.stem().native();
  ENFILADE_CHECK(
      std::none_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isspace(c) != 0; }));
  for (size_t i = 0; i < model.textures.size(); ++i) {
    WriteImage(path.parent_path() / TextureName(i), model.textures[i], kJpegQuality);
  }
  WriteFileAtomic(path.parent_path() / (stem + ".mtl"), FormatMaterials(model));
  ObjText obj(stem + ".mtl");
  for (size_t f = 0; f < model.faces.size(); ++f) obj.AddFace(model.faces[f], f);
  WriteFileAtomic(path, obj.text());
}

}  // namespace enfilade
