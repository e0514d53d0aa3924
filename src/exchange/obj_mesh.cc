// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/obj_mesh.h"

#include <cstdint>
#include <sstream>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr uint64_t kMaxObjBytes = uint64_t{1} << 28;

struct ObjParser {
  explicit ObjParser(const std::string& file) : where(file) {}

  const std::string& where;
  int line = 0;
  ObjMesh mesh;

  [[noreturn]] void Fail(const std::string& problem) const {
    throw InvalidInputError(where, problem + " (line " + std::to_string(line) + ")",
                            "check that the file is a complete OBJ mesh");
  }

  void ReadVertex(std::istringstream& words) {
    Vector3d v;
    if (!(words >> v.x() >> v.y() >> v.z()) || !v.allFinite())
      Fail("a vertex is not three numbers");
    if (v.cwiseAbs().maxCoeff() > 1e9) Fail("a vertex is out of range");
    mesh.vertices.push_back(v);
  }

  // "12", "12/3", "12/3/4", "12//4" or a negative index counted from the end.
  [[nodiscard]] int VertexIdx(const std::string& word) const {
    const auto num_vertices = static_cast<int64_t>(mesh.vertices.size());
    int64_t index = 0;
    std::istringstream digits(word.substr(0, word.find('/')));
    if (!(digits >> index) || !digits.eof()) Fail("a face has no vertex index");
    if (index < 0) index += num_vertices + 1;
    if (index < 1 || index > num_vertices) Fail("a face refers to a vertex that is not there");
    return static_cast<int>(index - 1);
  }

  void ReadFace(std::istringstream& words) {
    std::vector<int> corners;
    for (std::string word; words >> word;) corners.push_back(VertexIdx(word));
    if (corners.size() < 3) Fail("a face has fewer than three vertices");
    const int group_idx = static_cast<int>(mesh.groups.size()) - 1;
    for (size_t i = 2; i < corners.size(); ++i) {
      mesh.triangles.push_back({{corners[0], corners[i - 1], corners[i]}, group_idx});
    }
  }

  void ReadGroup(std::istringstream& words) {
    mesh.groups.emplace_back();
    words >> mesh.groups.back();
  }

  void Parse(const std::string& text) {
    std::istringstream lines(text);
    for (std::string row; std::getline(lines, row);) {
      ++line;
      std::istringstream words(row);
      std::string keyword;
      words >> keyword;
      if (keyword == "v") ReadVertex(words);
      if (keyword == "f") ReadFace(words);
      if (keyword == "g") ReadGroup(words);
    }
    if (mesh.triangles.empty()) Fail("has no faces");
  }
};

}  // namespace

ObjMesh ReadObjMesh(const std::filesystem::path& path) {
  ObjParser parser(path.native());
  parser.Parse(ReadFile(path, kMaxObjBytes));
  return std::move(parser.mesh);
}

}  // namespace enfilade
