// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/colmap_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/sfm/sql.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

// The columns that COLMAP 3.8 gives its tables, as far as they are read.
constexpr const char* kTables =
    "CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY, model INTEGER, width INTEGER, "
    "height INTEGER, params BLOB, prior_focal_length INTEGER);"
    "CREATE TABLE images (image_id INTEGER PRIMARY KEY, name TEXT UNIQUE, camera_id INTEGER);"
    "CREATE TABLE keypoints (image_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, data BLOB);"
    "CREATE TABLE descriptors (image_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, data "
    "BLOB);";

template <typename T>
std::string Blob(const std::vector<T>& values) {
  std::string hex = "x'";
  for (const T value : values) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const unsigned char byte : bytes) {
      hex += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
    }
  }
  return hex + "'";
}

std::vector<uint8_t> CountingDescriptor() {
  std::vector<uint8_t> values(128);
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<uint8_t>(2 * i);
  return values;
}

class ColmapDatabaseFile : public testing::Test {
 protected:
  void SetUp() override { RunSql(path_, kTables); }
  void AddPicture(const std::string& keypoints, const std::string& descriptors) {
    RunSql(path_,
           "INSERT INTO images VALUES (7, 'a.png', 1);"
           "INSERT INTO keypoints VALUES (7, " +
               keypoints +
               ");"
               "INSERT INTO descriptors VALUES (7, " +
               descriptors + ")");
  }
  [[nodiscard]] ColmapFeatures Read() const { return ColmapDatabase(path_).Read("a.png", camera_); }

  TempFolder folder_;
  fs::path path_ = folder_ / "Küche 1.db";
  Camera camera_ = PinholeCamera(40, 60, 30, 30, 20, 30);
  std::string descriptor_ = "1, 128, " + Blob(CountingDescriptor());
};

TEST_F(ColmapDatabaseFile, GivesAffineFeatures) {
  // Columns of the shape: lengths 5 and 3.
  AddPicture("1, 6, " + Blob<float>({10.5F, 20.25F, 3, 0, 4, 3}), descriptor_);
  const ColmapFeatures features = Read();
  EXPECT_THAT(features.pixels, ElementsAre(Eigen::Vector2d(10.5, 20.25)));
  EXPECT_THAT(features.scales_px, ElementsAre(4.0));
  EXPECT_EQ(features.descriptors, CountingDescriptor());
}

TEST_F(ColmapDatabaseFile, GivesFeaturesWithScaleAndOrientation) {
  AddPicture("1, 4, " + Blob<float>({0, 60, 2.5F, 1}), descriptor_);
  EXPECT_THAT(Read().pixels, ElementsAre(Eigen::Vector2d(0, 60)));
  EXPECT_THAT(Read().scales_px, ElementsAre(2.5));
}

TEST_F(ColmapDatabaseFile, KnowsPicturesWithoutAnyFeature) {
  AddPicture("0, 6, NULL", "0, 128, NULL");
  EXPECT_THAT(ColmapDatabase(path_).PicturesWithFeatures(), ElementsAre("a.png"));
  EXPECT_TRUE(Read().pixels.empty());
}

TEST_F(ColmapDatabaseFile, KnowsOnlyPicturesWithBothTables) {
  RunSql(path_,
         "INSERT INTO images VALUES (1, 'a', 1), (2, 'b', 1), (3, 'c', 1);"
         "INSERT INTO keypoints VALUES (1, 0, 6, NULL), (2, 0, 6, NULL);"
         "INSERT INTO descriptors VALUES (2, 0, 128, NULL), (3, 0, 128, NULL)");
  EXPECT_THAT(ColmapDatabase(path_).PicturesWithFeatures(), ElementsAre("b"));
  EXPECT_THROW((void)ColmapDatabase(path_).Read("a", camera_), InvalidInputError);
}

TEST_F(ColmapDatabaseFile, FindsAnEqualCamera) {
  EXPECT_EQ(ColmapDatabase(path_).FindCamera(camera_), std::nullopt);
  RunSql(path_,
         "INSERT INTO cameras VALUES "
         "(1, 2, 40, 60, " +
             Blob<double>({30, 30, 20, 30}) +
             ", 1),"
             "(2, 1, 40, 61, " +
             Blob<double>({30, 30, 20, 30}) +
             ", 1),"
             "(3, 1, 40, 60, " +
             Blob<double>({30, 31, 20, 30}) +
             ", 1),"
             "(4, 1, 40, 60, " +
             Blob<double>({30, 30, 20, 30}) + ", 1)");
  EXPECT_EQ(ColmapDatabase(path_).FindCamera(camera_), 4);
}

TEST_F(ColmapDatabaseFile, OfBrokenFeaturesIsRefused) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::string good = "1, 6, " + Blob<float>({1, 1, 1, 0, 0, 1});
  const std::vector<std::pair<std::string, std::string>> broken{
      {"2, 6, " + Blob<float>({1, 1, 1, 0, 0, 1}), descriptor_},
      {"1, 5, " + Blob<float>({1, 1, 1, 0, 0}), descriptor_},
      {"-1, 6, NULL", descriptor_},
      {"4611686018427387904, 4, NULL", "4611686018427387904, 128, NULL"},
      {"'many', 6, 'text'", descriptor_},
      {good, "1, 64, " + Blob(std::vector<uint8_t>(64))},
      {good, "1, 128, " + Blob(std::vector<uint8_t>(127))},
      {good, "0, 128, NULL"},
      {"1, 6, " + Blob<float>({kNan, 1, 1, 0, 0, 1}), descriptor_},
      {"1, 6, " + Blob<float>({1, 62, 1, 0, 0, 1}), descriptor_},
      {"1, 6, " + Blob<float>({1, -2, 1, 0, 0, 1}), descriptor_},
      {"1, 6, " + Blob<float>({1, 1, kNan, 0, 0, 1}), descriptor_},
      {"1, 6, " + Blob<float>({1, 1, kInfinity, 0, 0, 1}), descriptor_},
      {"1, 6, " + Blob<float>({1, 1, 0, 0, 0, 0}), descriptor_}};
  for (const auto& [keypoints, descriptors] : broken) {
    SCOPED_TRACE(keypoints);
    RunSql(path_, "DELETE FROM images; DELETE FROM keypoints; DELETE FROM descriptors");
    AddPicture(keypoints, descriptors);
    EXPECT_THROW((void)Read(), InvalidInputError);
  }
}

TEST_F(ColmapDatabaseFile, MadeInPartIsEmpty) {
  RunSql(path_, "DROP TABLE descriptors");
  EXPECT_TRUE(ColmapDatabase(path_).PicturesWithFeatures().empty());
  EXPECT_EQ(ColmapDatabase(path_).FindCamera(camera_), std::nullopt);
  WriteFileAtomic(path_, "");
  EXPECT_TRUE(ColmapDatabase(path_).PicturesWithFeatures().empty());
  fs::remove(path_);
  EXPECT_TRUE(ReadPicturesWithFeatures(path_).empty());
}

TEST_F(ColmapDatabaseFile, OfAnotherKindIsRefused) {
  const fs::path other = folder_ / "other.db";
  RunSql(other, "CREATE TABLE recipes (name TEXT)");
  EXPECT_THROW((void)ReadPicturesWithFeatures(other), InvalidInputError);
  WriteFileAtomic(other, std::string(5000, 'x'));
  EXPECT_THROW((void)ReadPicturesWithFeatures(other), InvalidInputError);
  EXPECT_THROW((void)ReadPicturesWithFeatures(folder_.path()), IoError);
  RunSql(path_, "ALTER TABLE images RENAME COLUMN name TO title");
  EXPECT_THROW((void)ReadPicturesWithFeatures(path_), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
