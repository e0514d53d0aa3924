// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace enfilade {

static_assert(std::endian::native == std::endian::little, "our binary files are little-endian");

/// Builds the bytes of a binary file: magic, version, then whatever is added.
class BinaryWriter {
 public:
  BinaryWriter(std::string_view magic, uint32_t version) : bytes_(magic) { Add(version); }

  template <typename T>
  requires std::is_arithmetic_v<T>
  void Add(T value) { AddArray(std::span<const T>(&value, 1)); }
  template <typename T>
  void AddArray(std::span<const T> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what BinaryWriter wrote. Throws InvalidInputError, naming the file, when magic or version
/// differ, when it ends early or goes on too long.
class BinaryReader {
 public:
  BinaryReader(const std::filesystem::path& path, std::string_view magic, uint32_t version);

  template <typename T>
  requires std::is_arithmetic_v<T>
  [[nodiscard]] T Get() {
    T value;
    GetArray(std::span<T>(&value, 1));
    return value;
  }
  /// A number of elements in [0, max].
  [[nodiscard]] int GetSize(int max);
  template <typename T>
  void GetArray(std::span<T> values) {
    if (values.empty()) return;
    std::memcpy(values.data(), Take(values.size_bytes()), values.size_bytes());
  }
  /// As above; NaN and infinities are refused.
  void GetFiniteArray(std::span<float> values);
  [[nodiscard]] double GetFinite();
  /// Throws unless at least `num_bytes` are left: before memory is taken for them.
  void Require(uint64_t num_bytes) const;
  /// Throws when bytes are left over.
  void Finish() const;

 private:
  [[nodiscard]] const char* Take(size_t num_bytes);
  [[noreturn]] void Fail(const std::string& problem) const;

  std::string where_;
  std::string bytes_;
  size_t position_ = 0;
};

}  // namespace enfilade
