// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/manifest.h"

#include <gmock/gmock.h>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

Manifest ExampleManifest() {
  Manifest manifest;
  manifest.program = "0.1.0+abc";
  manifest.input = "some/folder";
  manifest.num_threads = 2;
  manifest.seed = 7;
  manifest.pictures = {{"a.jpg", "11"}, {"b.jpg", "22"}};
  StageRecord record;
  record.name = "structure";
  record.key = "k";
  record.outcome = StageOutcome::kNoResult;
  record.reason = "no floor is seen";
  record.seconds = 1.25;
  record.peak_memory_mb = 300;
  record.options = {{"structure.step", "3"}};
  record.artifacts = {{"structure/structure.json", "33"}};
  manifest.stages = {record};
  return manifest;
}

TEST(Manifest, ReadsWhatItWrites) {
  const TempFolder folder;
  const Manifest written = ExampleManifest();
  WriteManifest(folder / "manifest.json", written);
  const Manifest read = ReadManifest(folder / "manifest.json");
  EXPECT_EQ(read.program, written.program);
  EXPECT_EQ(read.input, written.input);
  EXPECT_EQ(read.num_threads, written.num_threads);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.pictures, written.pictures);
  ASSERT_EQ(read.stages.size(), 1u);
  EXPECT_EQ(read.Find("nothing"), nullptr);
  const StageRecord* record = read.Find("structure");
  ASSERT_NE(record, nullptr);
  EXPECT_EQ(record->key, "k");
  EXPECT_EQ(record->outcome, StageOutcome::kNoResult);
  EXPECT_EQ(record->reason, "no floor is seen");
  EXPECT_EQ(record->seconds, 1.25);
  EXPECT_EQ(record->options, written.stages[0].options);
  EXPECT_EQ(record->artifacts, written.stages[0].artifacts);
}

TEST(Manifest, RefusesBrokenFiles) {
  const TempFolder folder;
  const auto path = folder / "manifest.json";
  EXPECT_THROW((void)ReadManifest(path), IoError);
  WriteManifest(path, ExampleManifest());
  const std::string whole = ReadFile(path);
  for (const size_t size : {size_t{0}, size_t{1}, whole.size() / 2, whole.size() - 3}) {
    WriteFileAtomic(path, whole.substr(0, size));
    EXPECT_THROW((void)ReadManifest(path), InvalidInputError) << size;
  }
  for (const std::string text :
       {"[]", "3", "{}", R"({"format": 3})", R"({"format": "other"})",
        R"({"format": "enfilade-manifest", "version": 2})",
        R"({"format": "enfilade-manifest", "version": 1, "program": "p", "input": "i",
            "num_threads": 1, "seed": 0, "pictures": {}, "stages": [{"name": "a", "key": "k",
            "outcome": "odd", "reason": ""}]})"}) {
    WriteFileAtomic(path, text);
    EXPECT_THROW((void)ReadManifest(path), InvalidInputError) << text;
  }
}

}  // namespace
}  // namespace enfilade
