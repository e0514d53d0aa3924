// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWriteCure = "check that the folder is writable and the disk has room";

[[noreturn]] void ThrowWriteError(const fs::path& path, int error) {
  throw IoError(path.native(), std::string("cannot be written: ") + std::strerror(error),
                std::string(kWriteCure));
}

// Closes on scope exit.
struct FileDescriptor {
  explicit FileDescriptor(int descriptor) : value(descriptor) {}
  ~FileDescriptor() {
    if (value >= 0) ::close(value);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int value;
};

void FlushToDisk(const fs::path& path, const fs::path& blamed) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.value < 0) ThrowWriteError(blamed, errno);
  if (::fsync(file.value) == 0) return;
  // Some network and user-space file systems know no fsync: nothing that a user could mend.
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) ThrowWriteError(blamed, errno);
}

// Unique among the threads and processes that write into the folder, hidden, and short enough even
// where the name itself has the 255 bytes that file systems allow.
fs::path TemporaryBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  constexpr size_t kMaxStemBytes = 128;
  const std::string name = "." + path.stem().native().substr(0, kMaxStemBytes) + ".tmp" +
                           std::to_string(::getpid()) + "-" + std::to_string(counter++) +
                           path.extension().native();
  return path.parent_path() / name;
}

void WriteAll(const fs::path& path, std::string_view bytes, const fs::path& blamed) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.value < 0) ThrowWriteError(blamed, errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.value, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) ThrowWriteError(blamed, errno);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

}  // namespace

FileReader::FileReader(const fs::path& path) : path_(path) {
  // Without O_NONBLOCK, opening a named pipe would wait for a writer.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.value < 0) {
    const int error = errno;
    throw IoError(path.native(), std::string("cannot be opened: ") + std::strerror(error),
                  error == ENOENT ? "check the path" : "check the permissions");
  }
  struct stat info {};
  if (::fstat(file.value, &info) != 0 || !S_ISREG(info.st_mode)) {
    throw IoError(path.native(), "is not a regular file", "name a file");
  }
  size_ = static_cast<uint64_t>(info.st_size);
  std::swap(descriptor_, file.value);
}

FileReader::~FileReader() { ::close(descriptor_); }

std::string FileReader::ReadAt(uint64_t offset, size_t count) const {
  if (offset >= size_) return {};
  std::string bytes(static_cast<size_t>(std::min<uint64_t>(count, size_ - offset)), '\0');
  size_t num_read = 0;
  while (num_read < bytes.size()) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + num_read, bytes.size() - num_read,
                                static_cast<off_t>(offset + num_read));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw IoError(path_.native(), std::string("cannot be read: ") + std::strerror(errno),
                    "check the disk");
    }
    if (got == 0) break;  // the file became shorter
    num_read += static_cast<size_t>(got);
  }
  bytes.resize(num_read);
  return bytes;
}

std::string ReadFile(const fs::path& path, uint64_t max_bytes) {
  const FileReader file(path);
  if (file.size() > max_bytes) {
    throw InvalidInputError(path.native(),
                            "has " + std::to_string(file.size()) + " bytes, more than the " +
                                std::to_string(max_bytes) + " that such a file can have",
                            "check that it is the right file");
  }
  return file.ReadAt(0, static_cast<size_t>(file.size()));
}

void WriteFileAtomic(const fs::path& path, std::string_view bytes) {
  WriteFileAtomic(path, [&](const fs::path& temporary) { WriteAll(temporary, bytes, path); });
}

void WriteFileAtomic(const fs::path& path,
                     const std::function<void(const fs::path& temporary)>& write) {
  if (path.has_parent_path()) CreateFolder(path.parent_path());
  const fs::path temporary = TemporaryBeside(path);
  try {
    write(temporary);
    FlushToDisk(temporary, path);
    if (::rename(temporary.c_str(), path.c_str()) != 0) ThrowWriteError(path, errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void CreateFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  std::error_code is_folder_error;
  if (error || !fs::is_directory(path, is_folder_error)) {
    throw IoError(path.native(),
                  "cannot be made a folder: " + (error ? error.message() : "a file is in the way"),
                  std::string(kWriteCure));
  }
}

}  // namespace enfilade
