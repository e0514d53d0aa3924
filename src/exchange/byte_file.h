// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <type_traits>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {

static_assert(std::endian::native == std::endian::little, "these files are little-endian");

/// Values one after the other from the bytes of one little-endian file. Throws InvalidInputError
/// where it ends too early or goes on too long.
class ByteFile {
 public:
  /// `what` the file should be, for messages: "a binary COLMAP model".
  ByteFile(const std::filesystem::path& path, std::string what)
      : where_(path.native()), what_(std::move(what)), bytes_(ReadFile(path)) {}

  [[nodiscard]] const std::string& where() const { return where_; }

  template <typename T>
  requires std::is_arithmetic_v<T>
  [[nodiscard]] T Take() {
    if (bytes_.size() - position_ < sizeof(T)) Fail();
    T value;
    std::memcpy(&value, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  /// Up to the next zero byte, which is taken as well.
  [[nodiscard]] std::string TakeText() {
    const size_t end = bytes_.find('\0', position_);
    if (end == std::string::npos) Fail();
    std::string text = bytes_.substr(position_, end - position_);
    position_ = end + 1;
    return text;
  }

  /// A number, of type T, of entries of `size` bytes each, for which the file must have room.
  template <typename T = uint64_t>
  [[nodiscard]] size_t TakeCount(uint64_t size) {
    const T count = Take<T>();
    if (count > (bytes_.size() - position_) / size) Fail();
    return static_cast<size_t>(count);
  }

  void ExpectEnd() const {
    if (position_ == bytes_.size()) return;
    throw InvalidInputError(where_, "goes on after its last entry", "check that it is " + what_);
  }

 private:
  [[noreturn]] void Fail() const {
    throw InvalidInputError(where_, "ends too early", "check that the file is complete");
  }

  std::string where_;
  std::string what_;
  std::string bytes_;
  size_t position_ = 0;
};

}  // namespace enfilade
