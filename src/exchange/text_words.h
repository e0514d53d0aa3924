// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace enfilade {

/// The words of a text one after the other, parted by white space. The text must outlive it.
class TextWords {
 public:
  explicit TextWords(std::string_view text) : rest_(text) {}

  /// Empty at the end.
  [[nodiscard]] std::string_view Next() {
    const size_t begin = rest_.find_first_not_of(kWhite);
    rest_.remove_prefix(std::min(begin, rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kWhite));
    rest_.remove_prefix(word.size());
    return word;
  }

  /// The next word as a finite number; none where it is something else.
  [[nodiscard]] std::optional<double> NextNumber() {
    const auto number = Parse<double>();
    return number && std::isfinite(*number) ? number : std::nullopt;
  }
  [[nodiscard]] std::optional<int64_t> NextInteger() { return Parse<int64_t>(); }

  [[nodiscard]] size_t num_bytes_left() const { return rest_.size(); }

 private:
  static constexpr std::string_view kWhite = " \t\r\n\v\f";

  template <typename T>
  [[nodiscard]] std::optional<T> Parse() {
    const std::string_view word = Next();
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size())
      return std::nullopt;
    return value;
  }

  std::string_view rest_;
};

}  // namespace enfilade
