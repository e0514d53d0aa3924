// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include "enfilade/base/errors.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().native());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void WritePlain(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Lets no file of this process grow beyond `num_bytes`: writes come up short and then fail, as on a
// full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t num_bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{num_bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

// Root may write anywhere, so it steps down to a user without rights.
class WithoutRootRights {
 public:
  WithoutRootRights() {
    if (was_root_) was_root_ = seteuid(65534) == 0;
  }
  ~WithoutRootRights() {
    if (was_root_ && seteuid(0) != 0) std::abort();
  }
  WithoutRootRights(const WithoutRootRights&) = delete;
  WithoutRootRights& operator=(const WithoutRootRights&) = delete;

 private:
  bool was_root_ = geteuid() == 0;
};

TEST(ReadFile, GivesBackAllBytes) {
  const TempFolder folder;
  const std::string bytes("a\0\r\n\xff", 5);
  WritePlain(folder / "file", bytes);
  EXPECT_EQ(ReadFile(folder / "file"), bytes);
  WritePlain(folder / "empty", "");
  EXPECT_EQ(ReadFile(folder / "empty"), "");
}

TEST(ReadFile, RefusesWhatIsNoFile) {
  const TempFolder folder;
  EXPECT_THAT([&] { (void)ReadFile(folder / "missing.csv"); },
              ThrowsMessage<IoError>(
                  AllOf(HasSubstr("missing.csv"), HasSubstr("No such file"), HasSubstr("path"))));
  EXPECT_THAT([&] { (void)ReadFile(folder.path()); },
              ThrowsMessage<IoError>(HasSubstr("not a regular file")));
  EXPECT_THROW((void)ReadFile("/dev/zero"), IoError);
  EXPECT_THROW((void)ReadFile(""), IoError);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW((void)ReadFile(folder / "pipe"), IoError);  // and does not wait for a writer
}

TEST(ReadFile, RefusesHugeFilesWithoutReadingThem) {
  const TempFolder folder;
  WritePlain(folder / "sparse", "x");
  fs::resize_file(folder / "sparse", uint64_t{1} << 40);
  EXPECT_THROW((void)ReadFile(folder / "sparse"), InvalidInputError);
  WritePlain(folder / "eleven", "12345678901");
  EXPECT_THAT([&] { (void)ReadFile(folder / "eleven", 10); },
              ThrowsMessage<InvalidInputError>(AllOf(HasSubstr("11 bytes"), HasSubstr("the 10"))));
  EXPECT_EQ(ReadFile(folder / "eleven", 11).size(), 11);
}

TEST(ReadFile, NamesThatAreNotUtf8) {
  const TempFolder folder;
  WritePlain(folder / "caf\xe9", "ok");
  EXPECT_EQ(ReadFile(folder / "caf\xe9"), "ok");
  EXPECT_THAT([&] { (void)ReadFile(folder / "th\xe9"); },
              ThrowsMessage<IoError>(HasSubstr("th\\xe9")));
}

TEST(ReadFile, UnreadableFile) {
  const TempFolder folder;
  fs::permissions(folder.path(), fs::perms(0755));
  WritePlain(folder / "secret", "x");
  fs::permissions(folder / "secret", fs::perms::none);
  const WithoutRootRights rights;
  if (geteuid() == 0) GTEST_SKIP() << "root that cannot step down may read anything";
  EXPECT_THAT([&] { (void)ReadFile(folder / "secret"); },
              ThrowsMessage<IoError>(HasSubstr("check the permissions")));
}

TEST(FileReader, ReadsPieces) {
  const TempFolder folder;
  WritePlain(folder / "file", "0123456789");
  const FileReader file(folder / "file");
  EXPECT_EQ(file.size(), 10);
  EXPECT_EQ(file.ReadAt(3, 4), "3456");
  EXPECT_EQ(file.ReadAt(8, 100), "89");
  EXPECT_EQ(file.ReadAt(10, 1), "");
  EXPECT_EQ(file.ReadAt(uint64_t{1} << 50, 1), "");
}

TEST(FileReader, SeesThatTheFileBecameShorter) {
  const TempFolder folder;
  WritePlain(folder / "file", "0123456789");
  const FileReader file(folder / "file");
  fs::resize_file(folder / "file", 4);
  EXPECT_EQ(file.ReadAt(0, 10), "0123");
}

TEST(WriteFileAtomic, CreatesFoldersAndReplaces) {
  const TempFolder folder;
  const fs::path path = folder / "a" / "b" / "c.txt";
  WriteFileAtomic(path, "one");
  EXPECT_EQ(ReadFile(path), "one");
  WriteFileAtomic(path, "two");
  EXPECT_EQ(ReadFile(path), "two");
  EXPECT_THAT(NamesIn(path.parent_path()), ElementsAre("c.txt"));
}

TEST(WriteFileAtomic, WritesInTheCurrentFolder) {
  const TempFolder folder;
  const fs::path old_folder = fs::current_path();
  fs::current_path(folder.path());
  WriteFileAtomic("plain", "x");
  fs::current_path(old_folder);
  EXPECT_EQ(ReadFile(folder / "plain"), "x");
}

TEST(WriteFileAtomic, LongNames) {
  const TempFolder folder;
  const std::string name = std::string(251, 'n') + ".txt";
  WriteFileAtomic(folder / name, "x");
  EXPECT_EQ(ReadFile(folder / name), "x");
}

TEST(WriteFileAtomic, FailingWriterLeavesTheOldContent) {
  const TempFolder folder;
  WriteFileAtomic(folder / "f.png", "old");
  fs::path seen;
  const auto failing = [&](const fs::path& temporary) {
    seen = temporary;
    WritePlain(temporary, "half");
    throw InvalidInputError("a", "b", "c");
  };
  EXPECT_THROW(WriteFileAtomic(folder / "f.png", failing), InvalidInputError);
  EXPECT_EQ(seen.extension(), ".png");
  EXPECT_EQ(seen.parent_path(), folder.path());
  EXPECT_EQ(ReadFile(folder / "f.png"), "old");
  EXPECT_THAT(NamesIn(folder.path()), ElementsAre("f.png"));
}

TEST(WriteFileAtomic, WriterThatWritesNothing) {
  const TempFolder folder;
  EXPECT_THROW(WriteFileAtomic(folder / "f", [](const fs::path&) {}), IoError);
}

TEST(WriteFileAtomic, FullDiskLeavesTheOldContent) {
  const TempFolder folder;
  WriteFileAtomic(folder / "plan.svg", "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_THAT([&] { WriteFileAtomic(folder / "plan.svg", std::string(5000, 'x')); },
                ThrowsMessage<IoError>(
                    AllOf(HasSubstr("plan.svg: cannot be written"), HasSubstr("disk has room"))));
  }
  EXPECT_EQ(ReadFile(folder / "plan.svg"), "old");
  EXPECT_THAT(NamesIn(folder.path()), ElementsAre("plan.svg"));
}

TEST(WriteFileAtomic, DeviceWithoutSpaceIsNotFollowed) {
  // A link to /dev/full is replaced by the file: what was asked for exists and is whole.
  const TempFolder folder;
  fs::create_symlink("/dev/full", folder / "link");
  WriteFileAtomic(folder / "link", "x");
  EXPECT_EQ(ReadFile(folder / "link"), "x");
  EXPECT_FALSE(fs::is_symlink(folder / "link"));
}

TEST(WriteFileAtomic, ReadOnlyFolder) {
  const TempFolder folder;
  fs::permissions(folder.path(), fs::perms(0555));
  {
    const WithoutRootRights rights;
    if (geteuid() == 0) GTEST_SKIP() << "root that cannot step down may write anywhere";
    EXPECT_THAT([&] { WriteFileAtomic(folder / "f", "x"); },
                ThrowsMessage<IoError>(HasSubstr("Permission denied")));
    EXPECT_THROW(CreateFolder(folder / "below"), IoError);
  }
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_THAT(NamesIn(folder.path()), IsEmpty());
}

TEST(WriteFileAtomic, ReadOnlyFileSystem) {
  // /proc takes no new files, whoever asks.
  EXPECT_THROW(WriteFileAtomic("/proc/enfilade/f", "x"), IoError);
  EXPECT_THROW(WriteFileAtomic("/proc/enfilade", "x"), IoError);
}

TEST(WriteFileAtomic, FolderInTheWay) {
  const TempFolder folder;
  fs::create_directory(folder / "plan.svg");
  EXPECT_THROW(WriteFileAtomic(folder / "plan.svg", "x"), IoError);
  EXPECT_THAT(NamesIn(folder.path()), ElementsAre("plan.svg"));
}

TEST(WriteFileAtomic, ThreadsThatWriteTheSameFile) {
  const TempFolder folder;
  {
    std::vector<std::jthread> writers;
    for (char c = 'a'; c < 'e'; ++c) {
      writers.emplace_back([&, c] {
        for (int i = 0; i < 20; ++i) WriteFileAtomic(folder / "f", std::string(10000, c));
      });
    }
  }
  const std::string bytes = ReadFile(folder / "f");
  EXPECT_EQ(bytes, std::string(10000, bytes.front()));
  EXPECT_THAT(NamesIn(folder.path()), ElementsAre("f"));
}

TEST(CreateFolder, IsIdempotentAndSeesFilesInTheWay) {
  const TempFolder folder;
  CreateFolder(folder / "a" / "b");
  CreateFolder(folder / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder / "a" / "b"));
  WritePlain(folder / "file", "");
  EXPECT_THAT([&] { CreateFolder(folder / "file"); },
              ThrowsMessage<IoError>(HasSubstr("cannot be made a folder")));
  EXPECT_THROW(CreateFolder(folder / "file" / "below"), IoError);
  EXPECT_THROW(CreateFolder(""), IoError);
}

}  // namespace
}  // namespace enfilade
