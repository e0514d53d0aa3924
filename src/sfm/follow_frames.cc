// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/follow_frames.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/image/codec.h"
#include "src/sfm/pixel_of_ray.h"

namespace enfilade {
namespace {

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// The digits at the start of a name, without leading zeros.
std::string_view LeadingNumber(std::string_view name) {
  size_t end = 0;
  while (end < name.size() && IsDigit(name[end])) ++end;
  size_t start = 0;
  while (start + 1 < end && name[start] == '0') ++start;
  return name.substr(start, end - start);
}

// frame_9 comes before frame_10.
bool IsNameBefore(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (IsDigit(a.front()) && IsDigit(b.front())) {
      const std::string_view x = LeadingNumber(a), y = LeadingNumber(b);
      if (x != y) return std::make_pair(x.size(), x) < std::make_pair(y.size(), y);
      a = std::string_view(x.data() + x.size(), a.data() + a.size() - x.data() - x.size());
      b = std::string_view(y.data() + y.size(), b.data() + b.size() - y.data() - y.size());
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() < b.size();
}

void CheckSizes(std::span<const View> frames) {
  const Camera& first = frames.front().camera;
  for (const View& frame : frames) {
    if (frame.camera.width == first.width && frame.camera.height == first.height) continue;
    throw InvalidInputError(
        frame.path.native(),
        fmt::format("is {} x {} pixels, the first frame is {} x {}", frame.camera.width,
                    frame.camera.height, first.width, first.height),
        "give frames of one film, or leave --ordered out");
  }
}

// What is kept of a frame: features that show the scene, not the camera's stand.
Keyframe MakeKeyframe(int frame_idx, const TrackedFrame& tracked, const View& frame,
                      const Stand& stand) {
  const ImageU8 trusted = TrustedPixels(frame, stand);
  Keyframe keyframe;
  keyframe.frame_idx = frame_idx;
  keyframe.exposure = tracked.exposure;
  for (const TrackPoint& point : tracked.points) {
    const Eigen::Vector3d ray = frame.camera.RayFromPixel(point.position_px);
    if (*PixelOfRay(trusted, frame.camera, ray) == 0) continue;
    keyframe.track_ids.push_back(point.track_id);
    keyframe.rays.push_back(ray.cast<float>());
  }
  return keyframe;
}

// Places of the tracks that two keyframes share, counted from each one's first.
std::vector<FeatureMatch> SharedTracks(const Keyframe& a, int first_a, const Keyframe& b,
                                       int first_b) {
  std::vector<FeatureMatch> shared;
  size_t j = 0;
  for (size_t i = 0; i < a.track_ids.size(); ++i) {
    while (j < b.track_ids.size() && b.track_ids[j] < a.track_ids[i]) ++j;
    if (j == b.track_ids.size()) break;
    if (b.track_ids[j] != a.track_ids[i]) continue;
    shared.push_back({first_a + static_cast<int>(i), first_b + static_cast<int>(j), 0.0F});
  }
  return shared;
}

}  // namespace

std::vector<int> OrderByName(std::span<const View> views) {
  std::vector<int> order(views.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return IsNameBefore(views[static_cast<size_t>(a)].picture,
                        views[static_cast<size_t>(b)].picture);
  });
  return order;
}

std::vector<Keyframe> FollowFrames(std::span<const View> frames, const Stand& stand,
                                   const FollowOptions& options, RunContext& context) {
  ENFILADE_CHECK(!frames.empty());
  CheckSizes(frames);
  KltTracker tracker(options.tracking);
  for (const View& frame : frames) {
    context.CheckStop();
    tracker.AddFrame(ReadImageRgb(frame.path), context);
  }
  std::vector<Keyframe> keyframes;
  for (const int idx :
       SelectKeyframes(tracker.frames(), frames.front().camera, options.keyframes)) {
    const size_t i = static_cast<size_t>(idx);
    keyframes.push_back(MakeKeyframe(idx, tracker.frames()[i], frames[i], stand));
  }
  return keyframes;
}

std::vector<PairMatches> MatchesOfTracks(std::span<const Keyframe> keyframes,
                                         std::span<const PanoFeatures> features) {
  ENFILADE_CHECK(keyframes.size() == features.size());
  const auto first_of = [&](size_t view) {
    return features[view].size() - static_cast<int>(keyframes[view].rays.size());
  };
  std::vector<PairMatches> pairs;
  for (size_t a = 0; a < keyframes.size(); ++a) {
    for (size_t b = a + 1; b < keyframes.size(); ++b) {
      PairMatches pair{.a_idx = static_cast<int>(a), .b_idx = static_cast<int>(b), .matches = {}};
      pair.matches = SharedTracks(keyframes[a], first_of(a), keyframes[b], first_of(b));
      if (!pair.matches.empty()) pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

}  // namespace enfilade
