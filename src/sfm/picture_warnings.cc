// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/picture_warnings.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr size_t kMaxNamed = 12;
constexpr int kStrongLines = 8;
constexpr double kMaxToldError_rad = DegToRad(2);

// "a.jpg, b.jpg and 4 more"
std::string NamesOf(std::span<const View> views, std::span<const size_t> chosen) {
  std::string text;
  for (size_t k = 0; k < std::min(chosen.size(), kMaxNamed); ++k) {
    text += (k > 0 ? ", " : "") + views[chosen[k]].picture;
  }
  if (chosen.size() > kMaxNamed) text += fmt::format(" and {} more", chosen.size() - kMaxNamed);
  return text;
}

const std::string& NameOf(std::span<const View> views, int idx) {
  return views[static_cast<size_t>(idx)].picture;
}

}  // namespace

void WarnOfUpsideDown(std::span<const View> views, std::span<const OddTie> upside_down,
                      std::vector<std::string>& warnings) {
  for (const OddTie& tie : upside_down) {
    warnings.push_back(fmt::format("{} stands upside down beside {}; it is used so",
                                   NameOf(views, tie.view_idx), NameOf(views, tie.partner_idx)));
  }
}

void WarnOfMirrored(std::span<const View> views, std::span<const OddTie> mirrored,
                    std::vector<std::string>& warnings) {
  for (const OddTie& tie : mirrored) {
    warnings.push_back(fmt::format("{} is mirrored beside {}: flip it and start again",
                                   NameOf(views, tie.view_idx), NameOf(views, tie.partner_idx)));
  }
}

void WarnOfCopies(std::span<const View> views, std::span<const OddTie> copies,
                  std::vector<std::string>& warnings) {
  for (const OddTie& tie : copies) {
    warnings.push_back(
        fmt::format("{} and {} show the same from one place: take one of them away "
                    "if they are copies of one picture",
                    NameOf(views, tie.partner_idx), NameOf(views, tie.view_idx)));
  }
}

void WarnOfUntied(std::span<const View> views, std::span<const int> component_idx,
                  std::vector<std::string>& warnings) {
  std::vector<size_t> sizes(views.size(), 0);
  for (const int component : component_idx) ++sizes[static_cast<size_t>(component)];
  std::vector<size_t> alone;
  for (size_t i = 0; i < views.size(); ++i) {
    if (sizes[static_cast<size_t>(component_idx[i])] == 1) alone.push_back(i);
  }
  if (views.size() == 1) {
    warnings.push_back(views.front().picture +
                       " is the only panorama: nothing confirms the height of its camera");
  } else if (alone.size() == views.size()) {
    warnings.push_back("nothing ties any two of these panoramas together: " +
                       NamesOf(views, alone));
  } else if (!alone.empty()) {
    warnings.push_back(fmt::format("nothing ties {} of {} panoramas to the others: {}",
                                   alone.size(), views.size(), NamesOf(views, alone)));
  }
  const auto num_groups = std::count_if(sizes.begin(), sizes.end(), [](size_t n) { return n > 1; });
  if (num_groups > 1) {
    warnings.push_back(
        fmt::format("nothing ties {} groups of panoramas to each other: connections.html shows "
                    "which, and where one more picture would help",
                    num_groups));
  }
}

void WarnOfToldVerticals(std::span<const View> views, std::span<const Gravity> gravity,
                         std::vector<std::string>& warnings) {
  std::vector<size_t> wrong;
  double worst_rad = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    if (!views[i].told_up_in_cam || gravity[i].num_lines < kStrongLines) continue;
    const Eigen::Vector3d& told = *views[i].told_up_in_cam;
    const Eigen::Vector3d& up = gravity[i].up_in_cam;
    const double apart_rad = std::atan2(told.cross(up).norm(), told.dot(up));
    if (apart_rad <= kMaxToldError_rad) continue;
    wrong.push_back(i);
    worst_rad = std::max(worst_rad, apart_rad);
  }
  if (wrong.empty()) return;
  warnings.push_back(
      fmt::format("lines of {} pictures contradict the tilt that their XMP metadata tell, by up to "
                  "{:.0f}°; the lines are believed: {}",
                  wrong.size(), RadToDeg(worst_rad), NamesOf(views, wrong)));
}

}  // namespace enfilade
