// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

constexpr uint64_t kMaxCsvBytes = uint64_t{1} << 26;
constexpr double kQuaternionTolerance = 1e-2;
constexpr std::array<std::string_view, 8> kColumns = {"file", "x",  "y",  "z",
                                                      "qw",   "qx", "qy", "qz"};

std::string_view Trim(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// The fields of one line; a field in double quotes may hold commas, and "" for a quote (RFC 4180).
std::vector<std::string> SplitFields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[i++];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  for (std::string& field : fields) field = std::string(Trim(field));
  return fields;
}

struct CsvReader {
  const std::string& where;
  int line = 0;
  std::array<size_t, kColumns.size()> column{};  // of each name in kColumns

  [[noreturn]] void Fail(const std::string& problem, const std::string& cure) const {
    throw InvalidInputError(where, problem + " (line " + std::to_string(line) + ")", cure);
  }

  void ReadHeader(const std::vector<std::string>& fields) {
    for (size_t i = 0; i < kColumns.size(); ++i) {
      const auto it = std::find(fields.begin(), fields.end(), kColumns[i]);
      if (it == fields.end()) {
        Fail("has no column '" + std::string(kColumns[i]) + "'",
             "begin the file with file,x,y,z,qw,qx,qy,qz");
      }
      column[i] = static_cast<size_t>(it - fields.begin());
    }
  }

  [[nodiscard]] double Number(const std::vector<std::string>& fields, size_t i) const {
    const std::string& text = fields[column[i]];
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
      Fail("'" + text + "' is no number for " + std::string(kColumns[i]), "correct it");
    }
    return value;
  }

  [[nodiscard]] PosedPicture ReadPose(const std::vector<std::string>& fields) const {
    for (const size_t i : column) {
      if (i >= fields.size()) Fail("has too few fields", "check that the file is complete");
    }
    PosedPicture picture;
    picture.name = fields[column[0]];
    if (picture.name.empty()) Fail("names no picture", "fill in the column 'file'");
    picture.world_from_cam.translation = {Number(fields, 1), Number(fields, 2), Number(fields, 3)};
    const Eigen::Quaterniond q(Number(fields, 4), Number(fields, 5), Number(fields, 6),
                               Number(fields, 7));
    if (!(std::abs(q.norm() - 1) <= kQuaternionTolerance)) {
      Fail("the quaternion of '" + picture.name + "' has not length 1", "correct the rotation");
    }
    picture.world_from_cam.rotation = q.normalized().toRotationMatrix();
    return picture;
  }
};

}  // namespace

PoseFile ReadPoseCsv(const std::filesystem::path& path) {
  const std::string text = ReadFile(path, kMaxCsvBytes);
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // byte order mark
  PoseFile poses;
  poses.path = path;
  poses.base = path.parent_path();
  poses.source = PoseSource::kCsv;
  CsvReader reader{path.native()};
  bool has_header = false;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = Trim(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++reader.line;
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> fields = SplitFields(line);
    if (has_header) {
      poses.pictures.push_back(reader.ReadPose(fields));
    } else {
      reader.ReadHeader(fields);
      has_header = true;
    }
  }
  if (!has_header) {
    throw InvalidInputError(path.native(), "is empty", "begin it with file,x,y,z,qw,qx,qy,qz");
  }
  return poses;
}

}  // namespace enfilade
