// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/klt_tracker.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "enfilade/base/errors.h"
#include "src/sfm/klt_features.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// New features are looked for when fewer than this share of the most is left.
constexpr double kRefillShare = 0.9;
// Tracks that come closer than this share of the least distance follow the same thing.
constexpr double kMergeShare = 0.5;

std::vector<Vector2d> PositionsOf(const TrackedFrame& frame) {
  std::vector<Vector2d> positions;
  positions.reserve(frame.points.size());
  for (const TrackPoint& point : frame.points) positions.push_back(point.position_px);
  return positions;
}

std::string SizeText(int rows, int cols) {
  return std::to_string(cols) + " x " + std::to_string(rows);
}

}  // namespace

std::span<const std::string_view> EnumNames(KltGain) {
  static constexpr std::array<std::string_view, 3> kNames = {"none", "frame", "feature"};
  return kNames;
}

int FrameTrack::NumTracked() const {
  return static_cast<int>(std::count(statuses.begin(), statuses.end(), TrackStatus::kTracked));
}

KltTracker::KltTracker(const KltOptions& options) : options_(options) {
  ValidateOptions(VisitorOf(options_), "tracking options");
  if (options_.window_px % 4 != 0) {
    throw InvalidInputError("window_px", "is no multiple of 4", "give 8, 12, 16, 20 or 24");
  }
}

void KltTracker::CheckFrame(const ImageU8& image) const {
  const std::string where = "frame " + std::to_string(frames_.size());
  if (image.empty()) throw InvalidInputError(where, "is empty", "leave it out");
  if (image.channels() != 1 && image.channels() != 3) {
    throw InvalidInputError(where, "has " + std::to_string(image.channels()) + " channels",
                            "give grey or RGB pictures");
  }
  if (last_ && (last_->rows() != image.rows() || last_->cols() != image.cols())) {
    throw InvalidInputError(where,
                            "has " + SizeText(image.rows(), image.cols()) +
                                " pixels, those before " + SizeText(last_->rows(), last_->cols()),
                            "track films of one size");
  }
}

const TrackedFrame& KltTracker::AddFrame(const ImageU8& image, RunContext& context) {
  CheckFrame(image);
  GrayPyramid pyramid(image, options_.num_levels, options_.wraps_around, context);
  TrackedFrame frame = last_ ? FollowInto(pyramid, context) : TrackedFrame();
  Refill(pyramid, frame, context);
  last_ = std::move(pyramid);
  return frames_.emplace_back(std::move(frame));
}

TrackedFrame KltTracker::FollowInto(const GrayPyramid& next, RunContext& context) const {
  const TrackedFrame& previous = frames_.back();
  const FrameTrack track = TrackFeatures(*last_, next, PositionsOf(previous), options_, context);
  TrackedFrame frame;
  frame.gain = track.gain;
  frame.exposure = previous.exposure * track.gain.value_or(1.0);
  // Older tracks come first, so that they stay where two meet.
  SpacedPositions spaced(next.rows(), next.cols(), kMergeShare * options_.min_distance_px,
                         options_.wraps_around);
  for (size_t i = 0; i < track.statuses.size(); ++i) {
    const Vector2d& position = track.positions_px[i];
    if (track.statuses[i] != TrackStatus::kTracked || !spaced.TryAdd(position)) continue;
    frame.points.push_back({previous.points[i].track_id, position});
  }
  return frame;
}

void KltTracker::Refill(const GrayPyramid& pyramid, TrackedFrame& frame, RunContext& context) {
  if (static_cast<double>(frame.points.size()) >= kRefillShare * options_.max_features) return;
  for (const Vector2d& position : DetectFeatures(pyramid, PositionsOf(frame), options_, context)) {
    frame.points.push_back({num_tracks_++, position});
  }
}

std::vector<FeatureTrack> KltTracker::Tracks() const {
  std::vector<FeatureTrack> tracks(static_cast<size_t>(num_tracks_));
  for (size_t f = 0; f < frames_.size(); ++f) {
    for (const TrackPoint& point : frames_[f].points) {
      FeatureTrack& track = tracks[static_cast<size_t>(point.track_id)];
      if (track.positions_px.empty()) track.first_frame_idx = static_cast<int>(f);
      track.positions_px.push_back(point.position_px);
    }
  }
  return tracks;
}

}  // namespace enfilade
