// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/colmap_database.h"

#include <sqlite3.h>

#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/sfm/descriptor_matcher.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int kPinholeModel = 1;
constexpr int kBusyTimeout_s = 5;
constexpr int64_t kMaxFeatures = int64_t{1} << 24;
// Rounding may place a feature just outside its picture.
constexpr double kMargin_px = 1;

[[noreturn]] void ThrowInvalid(const fs::path& path, const std::string& problem) {
  throw InvalidInputError(path.native(), problem, "delete it to find the features anew");
}

[[noreturn]] void ThrowSqliteError(const fs::path& path, int code, const std::string& message) {
  switch (code & 0xFF) {
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:
      ThrowInvalid(path, "is no database of COLMAP: " + message);
    default:
      throw IoError(path.native(), "cannot be read: " + message,
                    "check the permissions and close programs that use it");
  }
}

// A query and the row of its answer that it stands at.
class Query {
 public:
  Query(sqlite3* handle, const fs::path& path, const char* sql) : handle_(handle), path_(path) {
    Check(sqlite3_prepare_v2(handle, sql, -1, &statement_, nullptr));
  }
  ~Query() { sqlite3_finalize(statement_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  void Bind(int parameter, int64_t value) {
    Check(sqlite3_bind_int64(statement_, parameter, value));
  }
  void Bind(int parameter, const std::string& value) {
    Check(sqlite3_bind_text(statement_, parameter, value.data(), static_cast<int>(value.size()),
                            SQLITE_TRANSIENT));
  }
  // Moves to the next row; false behind the last one.
  [[nodiscard]] bool Next() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) Check(code);
    return code == SQLITE_ROW;
  }
  [[nodiscard]] int64_t Integer(int column) { return sqlite3_column_int64(statement_, column); }
  [[nodiscard]] std::string Bytes(int column) {
    const void* bytes = sqlite3_column_blob(statement_, column);
    const auto size = static_cast<size_t>(sqlite3_column_bytes(statement_, column));
    return size > 0 ? std::string(static_cast<const char*>(bytes), size) : std::string();
  }

 private:
  void Check(int code) {
    if (code != SQLITE_OK) ThrowSqliteError(path_, code, sqlite3_errmsg(handle_));
  }

  sqlite3* handle_;
  const fs::path& path_;
  sqlite3_stmt* statement_ = nullptr;
};

template <typename T>
std::vector<T> Values(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

// The standard deviation from (scale, orientation) or from an affine shape, whose columns' lengths
// are averaged as COLMAP does.
double Scale(std::span<const float> shape) {
  if (shape.size() == 2) return shape[0];
  return (std::hypot(shape[0], shape[2]) + std::hypot(shape[1], shape[3])) / 2.0;
}

bool IsInside(const Eigen::Vector2d& pixel, const Camera& camera) {
  return pixel.x() >= -kMargin_px && pixel.x() <= camera.width + kMargin_px &&
         pixel.y() >= -kMargin_px && pixel.y() <= camera.height + kMargin_px;
}

bool IsTable(const std::string& bytes, int64_t rows, int64_t columns, size_t value_size) {
  return rows >= 0 && rows <= kMaxFeatures &&
         bytes.size() == static_cast<size_t>(rows * columns) * value_size;
}

}  // namespace

ColmapDatabase::ColmapDatabase(const fs::path& path) : path_(path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    throw IoError(path.native(), "is not a regular file", "name a file");
  }
  // Writable, so that a journal can be worked in; SQLite itself falls back to reading.
  const int code = sqlite3_open_v2(path.c_str(), &handle_,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_FULLMUTEX, nullptr);
  if (code != SQLITE_OK) {
    const std::string message = sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    ThrowSqliteError(path, code, message);
  }
  sqlite3_busy_timeout(handle_, 1000 * kBusyTimeout_s);
}

ColmapDatabase::~ColmapDatabase() { sqlite3_close(handle_); }

bool ColmapDatabase::HasTables() const {
  std::set<std::string> tables;
  Query query(handle_, path_, "SELECT name FROM sqlite_master WHERE type = 'table'");
  while (query.Next()) tables.insert(query.Bytes(0));
  if (!tables.empty() && !tables.contains("cameras")) {
    ThrowInvalid(path_, "is no database of COLMAP: it has no table of cameras");
  }
  return tables.contains("images") && tables.contains("keypoints") &&
         tables.contains("descriptors");
}

std::set<std::string> ColmapDatabase::PicturesWithFeatures() const {
  if (!HasTables()) return {};
  std::set<std::string> names;
  Query query(handle_, path_,
              "SELECT name FROM images WHERE image_id IN (SELECT image_id FROM keypoints) "
              "AND image_id IN (SELECT image_id FROM descriptors)");
  while (query.Next()) names.insert(query.Bytes(0));
  return names;
}

std::optional<int64_t> ColmapDatabase::FindCamera(const Camera& camera) const {
  ENFILADE_CHECK(camera.model == CameraModel::kPinhole);
  if (!HasTables()) return std::nullopt;
  const std::vector<double> wanted{camera.fx, camera.fy, camera.cx, camera.cy};
  Query query(handle_, path_,
              "SELECT camera_id, params FROM cameras "
              "WHERE model = ?1 AND width = ?2 AND height = ?3 ORDER BY camera_id");
  query.Bind(1, int64_t{kPinholeModel});
  query.Bind(2, int64_t{camera.width});
  query.Bind(3, int64_t{camera.height});
  while (query.Next()) {
    if (Values<double>(query.Bytes(1)) == wanted) return query.Integer(0);
  }
  return std::nullopt;
}

ColmapFeatures ColmapDatabase::Read(const std::string& picture, const Camera& camera) const {
  Query query(handle_, path_,
              "SELECT k.rows, k.cols, k.data, d.rows, d.cols, d.data FROM images "
              "JOIN keypoints AS k USING (image_id) JOIN descriptors AS d USING (image_id) "
              "WHERE name = ?1");
  query.Bind(1, picture);
  if (!query.Next()) ThrowInvalid(path_, "holds no features of " + picture);
  const int64_t rows = query.Integer(0), columns = query.Integer(1);
  const std::string keypoints = query.Bytes(2), descriptors = query.Bytes(5);
  const bool is_shaped = (columns == 4 || columns == 6) &&
                         IsTable(keypoints, rows, columns, sizeof(float)) &&
                         query.Integer(3) == rows && query.Integer(4) == kDescriptorSize &&
                         IsTable(descriptors, rows, kDescriptorSize, 1);
  if (!is_shaped) ThrowInvalid(path_, "has features of a wrong shape for " + picture);

  ColmapFeatures features;
  const std::vector<float> values = Values<float>(keypoints);
  for (size_t at = 0; at < values.size(); at += static_cast<size_t>(columns)) {
    const std::span<const float> row(values.data() + at, static_cast<size_t>(columns));
    features.pixels.emplace_back(row[0], row[1]);
    features.scales_px.push_back(Scale(row.subspan(2)));
    const double scale = features.scales_px.back();
    if (!IsInside(features.pixels.back(), camera) || !std::isfinite(scale) || scale <= 0) {
      ThrowInvalid(path_, "has a feature out of bounds in " + picture);
    }
  }
  features.descriptors = Values<uint8_t>(descriptors);
  return features;
}

std::set<std::string> ReadPicturesWithFeatures(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path, ignored))) return {};
  return ColmapDatabase(path).PicturesWithFeatures();
}

}  // namespace enfilade
