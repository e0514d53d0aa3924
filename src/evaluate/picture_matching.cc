// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/picture_matching.h"

#include <map>
#include <string_view>

namespace enfilade {
namespace {

constexpr int kUnmatched = -1;

std::string_view FileName(std::string_view path) {
  const size_t slash = path.find_last_of("/\\");
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

// Pairs what is still free on both sides and has the same non-empty key.
template <typename KeyOf>
void MatchBy(const KeyOf& key_of, std::span<const PictureKey> result,
             std::span<const PictureKey> truth, std::vector<bool>& is_truth_taken,
             std::vector<int>& matches) {
  std::map<std::string_view, std::vector<int>>
      free_truth;  // last to first, so that back() is first
  for (int i = static_cast<int>(truth.size()) - 1; i >= 0; --i) {
    const std::string_view key = key_of(truth[static_cast<size_t>(i)]);
    if (!is_truth_taken[static_cast<size_t>(i)] && !key.empty()) free_truth[key].push_back(i);
  }
  for (size_t i = 0; i < result.size(); ++i) {
    if (matches[i] != kUnmatched) continue;
    const auto candidates = free_truth.find(key_of(result[i]));
    if (candidates == free_truth.end() || candidates->second.empty()) continue;
    matches[i] = candidates->second.back();
    candidates->second.pop_back();
    is_truth_taken[static_cast<size_t>(matches[i])] = true;
  }
}

template <typename Items>
std::vector<PictureKey> KeysOf(const Items& items) {
  std::vector<PictureKey> keys;
  keys.reserve(items.size());
  for (const auto& item : items) keys.push_back({item.picture, item.sha256});
  return keys;
}

}  // namespace

std::vector<PictureKey> PictureKeys(const Scene& scene) { return KeysOf(scene.views); }

std::vector<PictureKey> PictureKeys(const Floorplan& floorplan) {
  return KeysOf(floorplan.cameras);
}

std::vector<PictureKey> PictureKeys(const GroundTruth& truth) { return KeysOf(truth.views); }

std::vector<int> MatchPictures(std::span<const PictureKey> result,
                               std::span<const PictureKey> truth) {
  std::vector<int> matches(result.size(), kUnmatched);
  std::vector<bool> is_truth_taken(truth.size(), false);
  const auto by_hash = [](const PictureKey& key) -> std::string_view { return key.sha256; };
  const auto by_name = [](const PictureKey& key) { return FileName(key.picture); };
  MatchBy(by_hash, result, truth, is_truth_taken, matches);
  MatchBy(by_name, result, truth, is_truth_taken, matches);
  return matches;
}

}  // namespace enfilade
