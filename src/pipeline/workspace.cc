// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/workspace.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/pipeline/manifest.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

bool IsHidden(const fs::path& path) { return path.filename().native().starts_with('.'); }

// The names that WriteFileAtomic gives: ".<stem>.tmp<pid><extension>".
bool IsTemporary(const fs::path& path) {
  return IsHidden(path) && path.native().find(".tmp") != std::string::npos;
}

// A folder is ours when it has a manifest, and free for use when nothing visible is in it.
void CheckOwnership(const Workspace& workspace, WorkspaceUse use) {
  const fs::path& root = workspace.root();
  std::error_code error;
  const bool has_manifest = fs::exists(workspace.manifest_file(), error);
  if (has_manifest) {
    (void)ReadManifest(workspace.manifest_file());
    return;
  }
  if (use == WorkspaceUse::kExisting) {
    throw InvalidInputError(root.native(), "is no result folder (it has no manifest.json)",
                            "make it with 'enfilade run PATH -o OUT'");
  }
  fs::directory_iterator entries(root, error);
  if (error)
    throw IoError(root.native(), "cannot be listed: " + error.message(), "check the permissions");
  for (const fs::directory_entry& entry : entries) {
    if (!IsHidden(entry.path())) {
      throw InvalidInputError(root.native(), "is not empty and is no result folder",
                              "choose another folder with -o");
    }
  }
}

void RemoveTemporaries(const fs::path& root) {
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() && IsTemporary(entry.path())) leftovers.push_back(entry.path());
  }
  for (const fs::path& path : leftovers) fs::remove(path);
}

int OpenAndLock(const Workspace& workspace) {
  const int descriptor = ::open(workspace.lock_file().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw IoError(workspace.root().native(),
                  std::string("is not writable: ") + std::strerror(errno),
                  "choose another folder with -o");
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    ::close(descriptor);
    if (error == EWOULDBLOCK) {
      throw IoError(workspace.root().native(), "is in use by another run",
                    "wait for it or choose another folder with -o");
    }
    throw IoError(workspace.root().native(),
                  std::string("cannot be locked: ") + std::strerror(error),
                  "choose a folder on a file system with locks");
  }
  return descriptor;
}

}  // namespace

WorkspaceLock::WorkspaceLock(const Workspace& workspace, WorkspaceUse use) {
  if (use == WorkspaceUse::kCreate) CreateFolder(workspace.root());
  CheckOwnership(workspace, use);
  descriptor_ = OpenAndLock(workspace);
  try {
    RemoveTemporaries(workspace.root());
  } catch (const fs::filesystem_error& error) {
    ::close(descriptor_);
    throw IoError(workspace.root().native(), "cannot be tidied: " + error.code().message(),
                  "check the permissions of the files in it");
  }
}

// The lock file stays: removing it would let a third process lock a new file of the same name while
// a second one still waits for the old.
WorkspaceLock::~WorkspaceLock() { ::close(descriptor_); }

std::vector<fs::path> ListFiles(const Workspace& workspace,
                                const std::vector<fs::path>& relative_paths) {
  std::vector<fs::path> files;
  for (const fs::path& relative : relative_paths) {
    const fs::path path = workspace.root() / relative;
    if (fs::is_regular_file(path)) files.push_back(relative);
    if (!fs::is_directory(path)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file())
        files.push_back(entry.path().lexically_relative(workspace.root()));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void RemoveFiles(const Workspace& workspace, const std::vector<fs::path>& relative_paths) {
  for (const fs::path& relative : relative_paths) {
    std::error_code error;
    fs::remove_all(workspace.root() / relative, error);
    if (error) {
      throw IoError((workspace.root() / relative).native(), "cannot be removed: " + error.message(),
                    "check the permissions");
    }
  }
}

}  // namespace enfilade
