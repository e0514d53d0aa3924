// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/colmap_extractor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/fake_program.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ColmapExtractor : public testing::Test {
 protected:
  void Run(std::string_view body) {
    ColmapExtractorRun run{.program = FakeProgram(folder_ / "fake colmap", body),
                           .database = folder_ / "database.db",
                           .log = folder_ / "database.log",
                           .views = folder_.path(),
                           .camera = PinholeCamera(40, 60, 30.5, 30.5, 20, 30),
                           .pictures = {"b.png", "a.png"},
                           .min_contrast = 0.015};
    RunColmapExtractor(run, context_);
  }
  std::string ErrorOf(std::string_view body) {
    try {
      Run(body);
    } catch (const DependencyError& error) {
      return error.what();
    }
    return "";
  }

  TempFolder folder_;
  RunContext context_{3};
};

TEST_F(ColmapExtractor, IsToldAllThatMatters) {
  EXPECT_THAT(ErrorOf(R"(printf '%s\n' "$@")"), HasSubstr("left out 2 of 2 pictures"));
  EXPECT_EQ(ReadFile(folder_ / "pictures.txt"), "a.png\nb.png\n");
  EXPECT_THAT(ReadFile(folder_ / "database.log"),
              AllOf(HasSubstr("feature_extractor\n"),
                    HasSubstr("--image_path=" + folder_.path().native() + "\n"),
                    HasSubstr("camera_params=30.5,30.5,20,30\n"), HasSubstr("use_gpu=0\n"),
                    HasSubstr("num_threads=3\n"), HasSubstr("peak_threshold=0.005\n")));
}

TEST_F(ColmapExtractor, FailureNamesExitCodeLastWordsAndCure) {
  EXPECT_THAT(ErrorOf("echo first; echo '  ERROR: boom' >&2; echo '    @ 0x123 main'; exit 3"),
              AllOf(HasSubstr("fake colmap: failed with exit code 3"), HasSubstr("ERROR: boom)"),
                    HasSubstr("database.log"), HasSubstr("--sfm.features.source opencv")));
  EXPECT_THAT(ErrorOf("kill -11 $$"), AllOf(HasSubstr("signal 11"), HasSubstr("no word")));
  EXPECT_THAT(ErrorOf("printf '\\377\\n'; exit 1"), HasSubstr("\\xff"));
}

TEST_F(ColmapExtractor, GarbageOfItIsRefused) {
  EXPECT_THROW(Run("for a; do case $a in --database_path=*) yes nonsense | head -c 9999 > "
                   "\"${a#*=}\";; esac; done"),
               InvalidInputError);
}

TEST_F(ColmapExtractor, IsStoppedWithinSeconds) {
  const auto start = std::chrono::steady_clock::now();
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    context_.RequestStop();
  });
  EXPECT_THROW(Run("sleep 1000"), StoppedError);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

}  // namespace
}  // namespace enfilade
