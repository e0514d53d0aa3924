// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <type_traits>

namespace enfilade {

/// Appends the bytes of a number, the lowest first on any machine.
template <typename T>
requires std::is_arithmetic_v<T>
void AppendLittleEndian(T value, std::string& bytes) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace enfilade
