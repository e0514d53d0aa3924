// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/short_names.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

namespace enfilade {
namespace {

constexpr size_t kLongest = 14;  // characters
constexpr size_t kKept = 12;     // beside "…"
constexpr const char* kCut = "…";

enum class Kind { kLetter, kDigit, kOther };

// Bytes of characters beyond ASCII count as letters.
Kind KindOf(char c) {
  if (c >= '0' && c <= '9') return Kind::kDigit;
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c < 0 || c > '~';
  return is_letter ? Kind::kLetter : Kind::kOther;
}

// True where neither a word nor a number would be cut apart.
bool MayCut(std::string_view text, size_t at) {
  return at == 0 || at >= text.size() || KindOf(text[at - 1]) != KindOf(text[at]) ||
         KindOf(text[at]) == Kind::kOther;
}

// True where a character of UTF-8 text begins.
bool IsBoundary(std::string_view text, size_t at) {
  return at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80;
}

size_t NumCharacters(std::string_view text) {
  size_t count = 0;
  for (size_t i = 0; i < text.size(); ++i) count += IsBoundary(text, i) ? 1 : 0;
  return count;
}

// The byte at which the character with index `count` begins.
size_t ByteOfCharacter(std::string_view text, size_t count) {
  size_t at = 0;
  for (; at < text.size(); ++at) {
    if (IsBoundary(text, at) && count-- == 0) break;
  }
  return at;
}

// Bytes that all names have in common at their ends; something is left of each.
size_t CommonSuffix(std::span<const std::string> names) {
  size_t length = names.front().size();
  for (const std::string& name : names) {
    const auto begin =
        std::mismatch(name.rbegin(), name.rend(), names.front().rbegin(), names.front().rend())
            .first;
    length = std::min(length, static_cast<size_t>(begin - name.rbegin()));
  }
  const auto is_good = [&](const std::string& name) {
    return length < name.size() && MayCut(name, name.size() - length);
  };
  while (length > 0 && !std::ranges::all_of(names, is_good)) --length;
  return length;
}

// The same at their beginnings, without the ends.
size_t CommonPrefix(std::span<const std::string> names, size_t suffix) {
  size_t length = names.front().size();
  for (const std::string& name : names) {
    const auto end = std::ranges::mismatch(name, names.front()).in1;
    length = std::min(length, static_cast<size_t>(end - name.begin()));
  }
  const auto is_good = [&](const std::string& name) {
    return length + suffix < name.size() && MayCut(name, length);
  };
  while (length > 0 && !std::ranges::all_of(names, is_good)) --length;
  return length;
}

// Ways to write a long name, the most telling first.
std::vector<std::string> Cuts(const std::string& name) {
  const size_t count = NumCharacters(name);
  if (count <= kLongest) return {name};
  const std::string end = name.substr(ByteOfCharacter(name, count - kKept));
  const std::string begin = name.substr(0, ByteOfCharacter(name, kKept));
  const std::string half_end = name.substr(ByteOfCharacter(name, count - kKept / 2));
  const std::string half_begin = name.substr(0, ByteOfCharacter(name, kKept / 2));
  return {kCut + end, begin + kCut, half_begin + kCut + half_end, name};
}

}  // namespace

std::vector<std::string> ShortNames(std::span<const std::string> names) {
  std::vector<std::string> cores(names.begin(), names.end());
  if (std::set<std::string>(cores.begin(), cores.end()).size() > 1) {
    const size_t suffix = CommonSuffix(names), prefix = CommonPrefix(names, suffix);
    for (std::string& core : cores) core = core.substr(prefix, core.size() - prefix - suffix);
  } else {
    for (std::string& core : cores) core = std::filesystem::path(core).stem().string();
  }
  std::multiset<std::string> cuts;
  for (const std::string& core : std::set<std::string>(cores.begin(), cores.end())) {
    for (const std::string& cut : Cuts(core)) cuts.insert(cut);
  }
  for (std::string& core : cores) {
    for (const std::string& cut : Cuts(core)) {
      if (cuts.count(cut) > 1) continue;
      core = cut;
      break;
    }
  }
  return cores;
}

}  // namespace enfilade
