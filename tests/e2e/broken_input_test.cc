// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// Every way in which input or environment can be wrong: one line with the cause, exit code 1, and
// nothing half-written.
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "tests/e2e/program.h"
#include "tests/e2e/small_input.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

class BrokenInput : public testing::Test {
 protected:
  void SetUp() override { WriteSmallInput(input()); }

  [[nodiscard]] fs::path input() const { return folder_ / "in"; }
  [[nodiscard]] fs::path output() const { return folder_ / "out"; }
  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }

  [[nodiscard]] ProgramResult Run(const std::vector<std::string>& more = {},
                                  const ProgramConditions& conditions = {}) const {
    std::vector<std::string> arguments = {"run", input(), "-o", output()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments, conditions);
  }

  // A refusal before any work: the result folder is not even made.
  void ExpectRefusedAtOnce(const std::string& text, const std::vector<std::string>& more = {}) {
    ExpectRefusal(Run(more), text);
    EXPECT_FALSE(fs::exists(output()));
  }

 private:
  TempFolder folder_;
};

TEST_F(BrokenInput, MissingFolder) {
  fs::remove_all(input());
  ExpectRefusedAtOnce(input());
}

TEST_F(BrokenInput, EmptyFolder) {
  fs::remove_all(input());
  fs::create_directory(input());
  ExpectRefusedAtOnce(input());
}

TEST_F(BrokenInput, FileInsteadOfFolder) {
  fs::remove_all(input());
  WriteFileAtomic(input(), "x");
  ExpectRefusedAtOnce(input());
}

TEST_F(BrokenInput, NothingButPoses) {
  for (const auto& entry : fs::directory_iterator(input())) {
    if (entry.path().extension() == ".png") fs::remove(entry.path());
  }
  ExpectRefusedAtOnce("p1.png");
  ExpectRefusedAtOnce("has no pictures", {"--poses", "none"});
}

// Grey pictures show nothing that could tie them: each is a component of its own, none is dropped.
TEST_F(BrokenInput, PicturesThatNothingTies) {
  fs::remove(input() / "poses.csv");
  const ProgramResult result = Run({"--sfm.features.source", "opencv"});
  EXPECT_NE(result.exit_code, 2) << result.err;
  EXPECT_TRUE(fs::exists(output() / "connections/connections.html")) << result.err;
}

TEST_F(BrokenInput, PosesWithoutPictures) {
  fs::remove(input() / "p1.png");
  ExpectRefusedAtOnce("p1.png");
}

TEST_F(BrokenInput, PosesThatAreNoNumbers) {
  const std::string whole = ReadFile(input() / "poses.csv");
  for (const char* number : {"nan", "inf", "1e999", "one", ""}) {
    std::string text = whole;
    text.replace(text.find("1.5"), 3, number);
    WriteFileAtomic(input() / "poses.csv", text);
    ExpectRefusedAtOnce("poses.csv");
  }
}

TEST_F(BrokenInput, PosesCutShort) {
  const std::string whole = ReadFile(input() / "poses.csv");
  for (const size_t size : {size_t{0}, size_t{10}, whole.size() - 12}) {
    WriteFileAtomic(input() / "poses.csv", whole.substr(0, size));
    ExpectRefusedAtOnce("poses.csv");
  }
}

TEST_F(BrokenInput, PictureOfTheWrongShape) {
  WriteFileAtomic(input() / "p1.png", EncodeImage(ImageU8(64, 100, 3), ".png"));
  ExpectRefusedAtOnce("p1.png");
}

TEST_F(BrokenInput, PictureThatIsNone) {
  for (const char* bytes : {"", "no picture", "\x89PNG\r\n"}) {
    WriteFileAtomic(input() / "p1.png", std::string(bytes));
    ExpectRefusedAtOnce("p1.png");
  }
}

// Its head is whole, so only decoding finds out: the scene stays, and of structure nothing.
TEST_F(BrokenInput, TruncatedPicture) {
  const std::string whole = ReadFile(input() / "p1.png");
  WriteFileAtomic(input() / "p1.png", whole.substr(0, whole.size() / 2));
  ExpectRefusal(Run(), "p1.png");
  EXPECT_FALSE(fs::exists(output() / "structure"));
}

TEST_F(BrokenInput, TourWithoutScale) {
  fs::remove(input() / "poses.csv");
  WriteFileAtomic(input() / "zind_data.json", R"({"scale_meters_per_coordinate": {"floor_01": null},
      "merger": {"floor_01": {"complete_room_01": {"partial_room_01": {"pano_1": {
        "image_path": "p1.png", "camera_height": 1.0,
        "floor_plan_transformation": {"rotation": 10.0, "scale": 0.5, "translation": [1.0, 2.0]}
      }}}}}})");
  const ProgramResult assumed = RunProgram({"sfm", input(), "-o", output()});
  EXPECT_EQ(assumed.exit_code, 0);
  EXPECT_THAT(assumed.err, testing::HasSubstr("assumed"));
  const ProgramResult given =
      RunProgram({"sfm", input(), "-o", output(), "--camera-height", "1.5"});
  EXPECT_EQ(given.exit_code, 0);
  EXPECT_THAT(given.err, testing::Not(testing::HasSubstr("assumed")));
}

TEST_F(BrokenInput, OptionsOutOfRange) {
  ExpectRefusedAtOnce("camera_height_m", {"--camera-height", "-1"});
  ExpectRefusedAtOnce("camera_height_m", {"--camera-height", "tall"});
  ExpectRefusedAtOnce("--threads", {"--threads", "-1"});
  ExpectRefusedAtOnce("--structure.num_columns", {"--structure.num_colums", "512"});
  ExpectRefusedAtOnce("--max-memory", {"--max-memory", "10"});
}

TEST_F(BrokenInput, ConfigThatIsWrong) {
  const fs::path config = folder() / "config.json";
  for (const char* text : {"", "{", "[]", R"({"structure": 3})", R"({"sfm": {"camera_height": 1}})",
                           R"({"sfm": {"poses": 3}})"}) {
    WriteFileAtomic(config, std::string(text));
    ExpectRefusedAtOnce("config.json", {"--config", config});
  }
}

TEST_F(BrokenInput, OutputThatIsSomethingElse) {
  WriteFileAtomic(output() / "holiday.txt", "dear diary");
  ExpectRefusal(Run(), "is not empty");
  EXPECT_EQ(std::distance(fs::directory_iterator(output()), fs::directory_iterator()), 1);
}

TEST_F(BrokenInput, OutputThatIsAFile) {
  WriteFileAtomic(output(), "x");
  ExpectRefusal(Run(), output());
  EXPECT_EQ(ReadFile(output()), "x");
}

TEST_F(BrokenInput, OutputThatIsReadOnly) {
  fs::create_directory(output());
  fs::permissions(output(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                fs::perms::others_exec);
  fs::permissions(folder(), fs::perms::all);
  ProgramConditions as_nobody;
  as_nobody.is_as_nobody = geteuid() == 0;
  ExpectRefusal(Run({}, as_nobody), output());
  EXPECT_TRUE(fs::is_empty(output()));
}

TEST_F(BrokenInput, FilesThatCannotGrow) {
  ProgramConditions small_files;
  small_files.max_file_bytes = 30000;
  ExpectRefusal(Run({}, small_files), output());
  EXPECT_FALSE(fs::exists(output() / "structure"));
  EXPECT_EQ(RunProgram({"sfm", input(), "-o", output()}).exit_code, 0);
}

TEST_F(BrokenInput, FullDisk) {
  fs::create_directory(output());
  if (mount("none", output().c_str(), "tmpfs", 0, "size=16k") != 0) {
    GTEST_SKIP() << "needs the right to mount";
  }
  const ProgramResult result = Run();
  umount(output().c_str());
  ExpectRefusal(result, output());
  EXPECT_THAT(result.err, testing::HasSubstr("No space left"));
}

TEST_F(BrokenInput, FolderNameThatIsNoUtf8) {
  const fs::path odd = folder() / "in\xff\n";
  fs::rename(input(), odd);
  EXPECT_EQ(RunProgram({"sfm", odd, "-o", output()}).exit_code, 0);
  fs::remove(odd / "p1.png");
  ExpectRefusal(RunProgram({"sfm", odd, "-o", folder() / "other"}), "in\\xff\\x0a");
}

TEST_F(BrokenInput, StageWithoutTheStageBefore) {
  ExpectRefusal(RunProgram({"structure", output()}), "manifest.json");
  ASSERT_EQ(RunProgram({"sfm", input(), "-o", output()}).exit_code, 0);
  ExpectRefusal(RunProgram({"floorplan", output()}), "evidence");
}

TEST_F(BrokenInput, PictureThatChangedMeanwhile) {
  ASSERT_EQ(RunProgram({"sfm", input(), "-o", output()}).exit_code, 0);
  fs::copy_file(input() / "p0.png", input() / "p1.png", fs::copy_options::overwrite_existing);
  ExpectRefusal(RunProgram({"structure", output()}), "has changed");
}

TEST_F(BrokenInput, ManifestThatIsBroken) {
  ASSERT_EQ(RunProgram({"sfm", input(), "-o", output()}).exit_code, 0);
  const std::string whole = ReadFile(output() / "manifest.json");
  WriteFileAtomic(output() / "manifest.json", whole.substr(0, whole.size() / 2));
  ExpectRefusal(Run(), "manifest.json");
}

TEST_F(BrokenInput, TruthOfAnotherHome) {
  ASSERT_EQ(RunProgram({"sfm", input(), "-o", output()}).exit_code, 0);
  ExpectRefusal(RunProgram({"evaluate", output(), "--truth", input()}), input());
}

}  // namespace
}  // namespace enfilade
