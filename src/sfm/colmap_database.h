// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "enfilade/scene/camera.h"

struct sqlite3;

namespace enfilade {

/// The features of one picture as COLMAP stores them.
struct ColmapFeatures {
  std::vector<Eigen::Vector2d> pixels;  ///< n; centre of the top-left pixel is (0.5, 0.5)
  std::vector<double> scales_px;        ///< n standard deviations of the blob
  std::vector<uint8_t> descriptors;     ///< n × 128; RootSIFT times 512, cut at 255
};

/// A reader of the databases that COLMAP 3 writes (its database.cc says how).
///
/// All functions throw InvalidInputError for a file that is no such database or holds nonsense,
/// IoError for one that cannot be read or is in use. They may be called by several threads at once.
class ColmapDatabase {
 public:
  /// Opens the file, which must exist. A run of COLMAP that was killed may have left a journal
  /// beside it, which is worked in now.
  explicit ColmapDatabase(const std::filesystem::path& path);
  ~ColmapDatabase();
  ColmapDatabase(const ColmapDatabase&) = delete;
  ColmapDatabase& operator=(const ColmapDatabase&) = delete;

  /// Names of the pictures whose features are there, be they none.
  [[nodiscard]] std::set<std::string> PicturesWithFeatures() const;

  /// The id of the first camera equal to a pinhole camera.
  [[nodiscard]] std::optional<int64_t> FindCamera(const Camera& camera) const;

  /// The features of a picture of PicturesWithFeatures, in the order of the database. Pixels lie
  /// within width × height of `camera`.
  [[nodiscard]] ColmapFeatures Read(const std::string& picture, const Camera& camera) const;

 private:
  /// COLMAP makes its tables one by one: a run killed at its start leaves some or none.
  [[nodiscard]] bool HasTables() const;

  std::filesystem::path path_;
  sqlite3* handle_ = nullptr;
};

/// PicturesWithFeatures of a database, none where the file is missing.
[[nodiscard]] std::set<std::string> ReadPicturesWithFeatures(const std::filesystem::path& path);

}  // namespace enfilade
