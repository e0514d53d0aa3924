// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/workspace.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/pipeline/manifest.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(WorkspaceLock, MakesTheFolder) {
  const TempFolder folder;
  const WorkspaceLock lock(Workspace(folder / "a/b"), WorkspaceUse::kCreate);
  EXPECT_TRUE(fs::is_directory(folder / "a/b"));
}

TEST(WorkspaceLock, RefusesAFolderOfSomethingElse) {
  const TempFolder folder;
  WriteFileAtomic(folder / "holiday.jpg", "x");
  const Workspace workspace(folder.path());
  EXPECT_THAT([&] { const WorkspaceLock lock(workspace, WorkspaceUse::kCreate); },
              ThrowsMessage<InvalidInputError>(HasSubstr("is not empty and is no result folder")));
  EXPECT_FALSE(fs::exists(workspace.lock_file()));
}

TEST(WorkspaceLock, RefusesABrokenManifest) {
  const TempFolder folder;
  const Workspace workspace(folder.path());
  WriteFileAtomic(workspace.manifest_file(), "{\"format\": \"enfi");
  EXPECT_THROW(WorkspaceLock(workspace, WorkspaceUse::kCreate), InvalidInputError);
}

TEST(WorkspaceLock, RefusesAFolderWithoutManifestForAStage) {
  const TempFolder folder;
  for (const char* name : {"", "missing"}) {
    EXPECT_THAT(
        [&] { const WorkspaceLock lock(Workspace(folder / name), WorkspaceUse::kExisting); },
        ThrowsMessage<InvalidInputError>(HasSubstr("has no manifest.json")));
  }
  EXPECT_FALSE(fs::exists(folder / "missing"));
}

TEST(WorkspaceLock, RefusesAFileInTheWay) {
  const TempFolder folder;
  WriteFileAtomic(folder / "out", "x");
  EXPECT_THROW(WorkspaceLock(Workspace(folder / "out"), WorkspaceUse::kCreate), IoError);
  EXPECT_THROW(WorkspaceLock(Workspace("/proc/enfilade"), WorkspaceUse::kCreate), IoError);
}

TEST(WorkspaceLock, RefusesASecondRun) {
  const TempFolder folder;
  const Workspace workspace(folder / "out");
  {
    const WorkspaceLock lock(workspace, WorkspaceUse::kCreate);
    EXPECT_THAT([&] { const WorkspaceLock second(workspace, WorkspaceUse::kCreate); },
                ThrowsMessage<IoError>(HasSubstr("is in use by another run")));
  }
  EXPECT_NO_THROW(WorkspaceLock(workspace, WorkspaceUse::kCreate));
}

TEST(WorkspaceLock, IsReleasedWhenTheProcessIsKilled) {
  const TempFolder folder;
  const Workspace workspace(folder / "out");
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const WorkspaceLock lock(workspace, WorkspaceUse::kCreate);
    (void)!write(ready[1], "x", 1);
    pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THROW(WorkspaceLock(workspace, WorkspaceUse::kCreate), IoError);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(WorkspaceLock(workspace, WorkspaceUse::kCreate));
  close(ready[0]);
  close(ready[1]);
}

TEST(WorkspaceLock, RemovesTemporariesOfAKilledRun) {
  const TempFolder folder;
  const Workspace workspace(folder.path());
  WriteManifest(workspace.manifest_file(), {});
  WriteFileAtomic(folder / "structure/.profile_0001.tmp4711.bin", "half");
  WriteFileAtomic(folder / "structure/profile_0000.bin", "whole");
  const WorkspaceLock lock(workspace, WorkspaceUse::kCreate);
  EXPECT_FALSE(fs::exists(folder / "structure/.profile_0001.tmp4711.bin"));
  EXPECT_TRUE(fs::exists(folder / "structure/profile_0000.bin"));
}

TEST(ListFiles, IsSortedRelativeAndSkipsWhatIsAbsent) {
  const TempFolder folder;
  WriteFileAtomic(folder / "b/2", "");
  WriteFileAtomic(folder / "b/1", "");
  WriteFileAtomic(folder / "a", "");
  WriteFileAtomic(folder / "other", "");
  EXPECT_THAT(ListFiles(Workspace(folder.path()), {"b", "absent", "a"}),
              testing::ElementsAre("a", "b/1", "b/2"));
}

}  // namespace
}  // namespace enfilade
