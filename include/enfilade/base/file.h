// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace enfilade {

/// A regular file opened for reading in pieces: for hashes and for headers of large files.
class FileReader {
 public:
  /// Throws IoError when the file is missing, no regular file or unreadable. Never blocks (named
  /// pipes are refused).
  explicit FileReader(const std::filesystem::path& path);
  ~FileReader();
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  [[nodiscard]] uint64_t size() const { return size_; }

  /// The bytes [offset, offset + count), fewer at the end of the file. Throws IoError.
  [[nodiscard]] std::string ReadAt(uint64_t offset, size_t count) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  uint64_t size_ = 0;
};

/// The whole content of a regular file.
///
/// Throws IoError when the file is missing, no regular file or unreadable, InvalidInputError when
/// it is larger than `max_bytes`: readers of text formats pass a bound so that a wrong file named
/// by mistake fails at once.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path,
                                   uint64_t max_bytes = uint64_t{1} << 32);

/// Writes `bytes` to a temporary file beside `path`, flushes it to disk and renames it. After a
/// crash or a full disk `path` holds the old content or the new, never a part. Creates missing
/// parent folders. A symbolic link at `path` is replaced, not followed. Throws IoError.
void WriteFileAtomic(const std::filesystem::path& path, std::string_view bytes);

/// As above for writers that need a path (image codecs): `write` gets the temporary path, which has
/// the same extension as `path`. If `write` throws, the temporary file is removed.
void WriteFileAtomic(const std::filesystem::path& path,
                     const std::function<void(const std::filesystem::path& temporary)>& write);

/// Creates the folder and its parents. Throws IoError when that fails or something else is there.
void CreateFolder(const std::filesystem::path& path);

}  // namespace enfilade
