// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {

/// Values that use all their bits, for exact round trips.
inline std::vector<float> RandomFloats(size_t size, std::mt19937& random) {
  std::vector<float> values(size);
  for (float& value : values) value = std::generate_canonical<float, 24>(random) * 10;
  return values;
}

/// Damages one file of a whole artefact in every way and expects one clear refusal each.
inline void ExpectRefusesDamage(const std::filesystem::path& path,
                                const std::function<void()>& read) {
  const std::string whole = ReadFile(path);
  for (size_t size = 0; size + 1 < whole.size(); size += 1 + whole.size() / 17) {
    WriteFileAtomic(path, whole.substr(0, size));
    EXPECT_THROW(read(), InvalidInputError) << path << " cut at " << size;
  }
  WriteFileAtomic(path, whole + "tail");
  EXPECT_THROW(read(), InvalidInputError) << path << " too long";
  std::filesystem::remove(path);
  EXPECT_THROW(read(), IoError) << path << " missing";
  WriteFileAtomic(path, whole);
  EXPECT_NO_THROW(read());
}

/// Overwrites bytes of a binary file.
inline void Poke(const std::filesystem::path& path, size_t offset, const void* bytes, size_t size) {
  std::string content = ReadFile(path);
  ASSERT_LE(offset + size, content.size());
  content.replace(offset, size, static_cast<const char*>(bytes), size);
  WriteFileAtomic(path, content);
}

}  // namespace enfilade
