// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/ply_points.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/cloud_point.h"
#include "src/exchange/text_words.h"

namespace enfilade {
namespace {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

// Both families of names that PLY files use.
std::optional<PlyType> TypeOf(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<PlyType>(i);
  }
  return std::nullopt;
}

size_t SizeOf(PlyType type) {
  constexpr std::array<size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

struct Property {
  std::string name;
  PlyType type = PlyType::kFloat32;
  std::optional<PlyType> count_type;  // of a list
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;

  [[nodiscard]] std::optional<size_t> Find(std::string_view property) const {
    for (size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property && !properties[i].count_type) return i;
    }
    return std::nullopt;
  }
};

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& path)
      : where_(path.native()), bytes_(ReadFile(path)), words_({}) {}

  std::vector<ScenePoint> Read() {
    ReadHeader();
    words_ = TextWords(std::string_view(bytes_).substr(position_));
    for (const Element& element : elements_) {
      RequireRoom(element);
      if (element.name == "vertex") return ReadVertices(element);
      for (uint64_t i = 0; i < element.count; ++i) PassOver(element);
    }
    Fail("has no vertices", "give a point cloud");
  }

 private:
  [[noreturn]] void Fail(const std::string& problem, const std::string& cure) const {
    throw InvalidInputError(where_, problem, cure);
  }
  [[noreturn]] void FailCut() const { Fail("ends too early", "check that the file is complete"); }
  [[noreturn]] void FailHeader(std::string_view line) const {
    Fail("has a PLY header with '" + std::string(line.substr(0, 80)) + "'",
         "check that it is a point cloud in PLY form");
  }

  std::string_view TakeLine() {
    const size_t end = bytes_.find('\n', position_);
    if (end == std::string::npos) FailCut();
    std::string_view line = std::string_view(bytes_).substr(position_, end - position_);
    position_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void ReadHeader() {
    if (!bytes_.starts_with("ply")) Fail("is no PLY file", "give a point cloud in PLY form");
    static_cast<void>(TakeLine());
    for (;;) {
      const std::string_view line = TakeLine();
      TextWords words(line);
      const std::string_view keyword = words.Next();
      if (keyword == "end_header") return;
      if (keyword == "format") {
        ReadFormat(words.Next(), line);
      } else if (keyword == "element") {
        const std::string name(words.Next());
        const std::optional<int64_t> count = words.NextInteger();
        if (!count || *count < 0) FailHeader(line);
        elements_.push_back({name, static_cast<uint64_t>(*count), {}});
      } else if (keyword == "property") {
        ReadProperty(words, line);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        FailHeader(line);
      }
    }
  }

  void ReadFormat(std::string_view name, std::string_view line) {
    if (name == "ascii") {
      format_ = PlyFormat::kAscii;
    } else if (name == "binary_little_endian") {
      format_ = PlyFormat::kLittleEndian;
    } else if (name == "binary_big_endian") {
      format_ = PlyFormat::kBigEndian;
    } else {
      FailHeader(line);
    }
  }

  void ReadProperty(TextWords& words, std::string_view line) {
    Property property;
    std::string_view type = words.Next();
    if (type == "list") {
      property.count_type = TypeOf(words.Next());
      if (!property.count_type) FailHeader(line);
      type = words.Next();
    }
    const std::optional<PlyType> known = TypeOf(type);
    property.name = words.Next();
    if (!known || property.name.empty() || elements_.empty()) FailHeader(line);
    property.type = *known;
    elements_.back().properties.push_back(property);
  }

  [[nodiscard]] size_t BytesLeft() const {
    return format_ == PlyFormat::kAscii ? words_.num_bytes_left() : bytes_.size() - position_;
  }

  // Before memory is taken or time is spent: a digit and a blank a number, at the least.
  void RequireRoom(const Element& element) const {
    uint64_t least_bytes = 0;
    for (const Property& property : element.properties) {
      least_bytes +=
          format_ == PlyFormat::kAscii ? 2 : SizeOf(property.count_type.value_or(property.type));
    }
    if (least_bytes == 0 && element.count > 0) FailHeader("element " + element.name);
    // The last number of a text may end with it.
    const uint64_t num_bytes = BytesLeft() + (format_ == PlyFormat::kAscii ? 1 : 0);
    if (element.count == 0 || element.count <= num_bytes / least_bytes) return;
    Fail(fmt::format("says that it has {} of '{}', for which it is too short", element.count,
                     element.name),
         "check that the file is complete");
  }

  double TakeValue(PlyType type) {
    if (format_ == PlyFormat::kAscii) {
      const std::string_view word = words_.Next();
      if (word.empty()) FailCut();
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) {
        Fail("has '" + std::string(word.substr(0, 40)) + "' where a number should be",
             "check that the file is complete");
      }
      return value;
    }
    switch (type) {
      case PlyType::kInt8:
        return TakeBinary<int8_t>();
      case PlyType::kUint8:
        return TakeBinary<uint8_t>();
      case PlyType::kInt16:
        return TakeBinary<int16_t>();
      case PlyType::kUint16:
        return TakeBinary<uint16_t>();
      case PlyType::kInt32:
        return TakeBinary<int32_t>();
      case PlyType::kUint32:
        return TakeBinary<uint32_t>();
      case PlyType::kFloat32:
        return static_cast<double>(TakeBinary<float>());
      case PlyType::kFloat64:
        break;
    }
    return TakeBinary<double>();
  }

  template <typename T>
  T TakeBinary() {
    std::array<char, sizeof(T)> raw;
    if (bytes_.size() - position_ < sizeof(T)) FailCut();
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    const bool is_native =
        (format_ == PlyFormat::kLittleEndian) == (std::endian::native == std::endian::little);
    if (!is_native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  void PassOverList(const Property& list) {
    const double count = TakeValue(*list.count_type);
    const size_t least_bytes = format_ == PlyFormat::kAscii ? 1 : SizeOf(list.type);
    if (!(count >= 0) || count > static_cast<double>(BytesLeft() / least_bytes)) FailCut();
    for (auto i = static_cast<uint64_t>(count); i > 0; --i) TakeValue(list.type);
  }

  void PassOver(const Element& element) {
    for (const Property& property : element.properties) {
      if (property.count_type) {
        PassOverList(property);
      } else {
        TakeValue(property.type);
      }
    }
  }

  // The places of three properties, under the first of the names that is there.
  using Triple = std::array<size_t, 3>;
  static std::optional<Triple> FindTriple(
      const Element& element, std::initializer_list<std::array<std::string_view, 3>> names) {
    for (const auto& [a, b, c] : names) {
      const auto x = element.Find(a), y = element.Find(b), z = element.Find(c);
      if (x && y && z) return Triple{*x, *y, *z};
    }
    return std::nullopt;
  }

  static uint8_t Colour(double value, PlyType type) {
    const bool is_fraction = type == PlyType::kFloat32 || type == PlyType::kFloat64;
    const bool is_wide = type == PlyType::kInt16 || type == PlyType::kUint16;
    const double level = is_fraction ? 255 * value : is_wide ? value / 257 : value;
    return static_cast<uint8_t>(std::lround(level > 0 ? std::min(level, 255.0) : 0));
  }

  std::vector<ScenePoint> ReadVertices(const Element& element) {
    const auto position = FindTriple(element, {{"x", "y", "z"}});
    const auto normal = FindTriple(element, {{"nx", "ny", "nz"}});
    const auto colour = FindTriple(element, {{"red", "green", "blue"},
                                             {"diffuse_red", "diffuse_green", "diffuse_blue"},
                                             {"r", "g", "b"}});
    if (!position) Fail("has vertices without x, y and z", "give a point cloud in PLY form");
    if (!normal) {
      Fail("has points without normals (nx, ny, nz)",
           "let the program that made it write normals, or compute them with CloudCompare");
    }
    std::vector<ScenePoint> points(element.count);
    std::vector<double> row(element.properties.size());
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t k = 0; k < row.size(); ++k) {
        const Property& property = element.properties[k];
        if (property.count_type) {
          PassOverList(property);
        } else {
          row[k] = TakeValue(property.type);
        }
      }
      const auto vector = [&](const Triple& at) {
        return Eigen::Vector3d(row[at[0]], row[at[1]], row[at[2]]);
      };
      points[i].position = vector(*position);
      points[i].normal = vector(*normal);
      CheckCloudPoint(points[i], i, where_);
      for (int k = 0; colour && k < 3; ++k) {
        const size_t at = (*colour)[static_cast<size_t>(k)];
        points[i].rgb[k] = Colour(row[at], element.properties[at].type);
      }
    }
    return points;
  }

  std::string where_;
  std::string bytes_;
  size_t position_ = 0;
  PlyFormat format_ = PlyFormat::kAscii;
  std::vector<Element> elements_;
  TextWords words_;  // of an ascii body
};

}  // namespace

std::vector<ScenePoint> ReadPlyPoints(const std::filesystem::path& path) {
  return PlyReader(path).Read();
}

}  // namespace enfilade
