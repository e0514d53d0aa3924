// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/point_matching.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
constexpr int kFree = -1;

class Matcher {
 public:
  Matcher(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b, double max_distance_m)
      : neighbours_(a.size()), partner_of_b_(b.size(), kFree), seen_in_(b.size(), kFree) {
    for (size_t i = 0; i < a.size(); ++i) {
      for (size_t j = 0; j < b.size(); ++j) {
        if ((a[i] - b[j]).norm() <= max_distance_m) neighbours_[i].push_back(j);
      }
    }
  }

  [[nodiscard]] int Count() {
    int num_pairs = 0;
    for (size_t i = 0; i < neighbours_.size(); ++i) num_pairs += Augment(i, static_cast<int>(i));
    return num_pairs;
  }

 private:
  // Finds a partner for i, moving others to their next choice; `round` marks what it looked at.
  bool Augment(size_t i, int round) {
    for (const size_t j : neighbours_[i]) {
      if (seen_in_[j] == round) continue;
      seen_in_[j] = round;
      if (partner_of_b_[j] == kFree || Augment(static_cast<size_t>(partner_of_b_[j]), round)) {
        partner_of_b_[j] = static_cast<int>(i);
        return true;
      }
    }
    return false;
  }

  std::vector<std::vector<size_t>> neighbours_;
  std::vector<int> partner_of_b_;
  std::vector<int> seen_in_;
};

}  // namespace

int CountPointMatches(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b,
                      double max_distance_m) {
  return Matcher(a, b, max_distance_m).Count();
}

std::optional<double> F1(int hits, size_t num_a, size_t num_b) {
  if (num_a + num_b == 0) return std::nullopt;
  return 2.0 * hits / static_cast<double>(num_a + num_b);
}

}  // namespace enfilade
