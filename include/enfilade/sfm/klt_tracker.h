// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/image/image.h"
#include "enfilade/sfm/gray_pyramid.h"

namespace enfilade {

/// Which changes of brightness between two frames are modelled.
enum class KltGain {
  kNone,     ///< none: plain tracking
  kFrame,    ///< one gain for the pair of frames
  kFeature,  ///< one gain a feature, drawn towards that of all
};
[[nodiscard]] std::span<const std::string_view> EnumNames(KltGain);

struct KltOptions {
  KltGain gain = KltGain::kFrame;
  int window_px = 16;
  int num_levels = 4;
  int max_iterations = 10;
  double convergence_px = 0.01;
  double min_eigenvalue = 10.0;
  double max_forward_backward_px = 0.5;
  double max_residual = 15.0;
  double gain_stiffness = 0.5;
  int max_features = 1000;
  double min_distance_px = 10.0;
  bool has_coarse_shift = true;
  bool wraps_around = false;
  double skipped_rows_share = 0.0;

  void Visit(OptionVisitor& v) {
    v("gain", gain,
      "none: brightness is constant; frame: one gain a pair of frames; feature: one gain a "
      "feature.");
    v("window_px", window_px, "Side of the window that is tracked, a multiple of 4, pixels.",
      {8, 24});
    v("num_levels", num_levels, "Most levels of the pyramid.", {1, 10});
    v("max_iterations", max_iterations, "Most steps of a feature on a level for a given gain.",
      {1, 100});
    v("convergence_px", convergence_px,
      "Step on the finest level below which a feature stands still, pixels.", {1e-5, 1.0});
    v("min_eigenvalue", min_eigenvalue,
      "Least texture of a corner: the smaller eigenvalue of the mean squared gradients in 5 x 5 "
      "pixels, squared grey levels per squared pixel.",
      {1e-3, 1e4});
    v("max_forward_backward_px", max_forward_backward_px,
      "Most that tracking there and back may miss the start, pixels; 0: not checked.",
      {0.0, 100.0});
    v("max_residual", max_residual,
      "Most that a window may differ after tracking, root mean square in grey levels of 255.",
      {0.1, 255.0});
    v("gain_stiffness", gain_stiffness,
      "Pull of a feature's gain towards that of all, as a multiple of what its pixels say.",
      {0.0, 1e6});
    v("max_features", max_features, "Most features in a frame.", {0, 1000000});
    v("min_distance_px", min_distance_px, "Least distance between features where they are found.",
      {1.0, 1000.0});
    v("has_coarse_shift", has_coarse_shift,
      "Start from the shift of the whole picture, for cameras that turn quickly.");
    v("wraps_around", wraps_around, "The left and right edge meet, as in panoramas all round.");
    v("skipped_rows_share", skipped_rows_share,
      "Share of the rows at the top and at the bottom that has no features: the poles of a "
      "panorama.",
      {0.0, 0.45});
  }
};

/// What became of a feature; the first reason that holds.
enum class TrackStatus : uint8_t {
  kTracked,
  kOutOfPicture,     ///< its window is not wholly within the picture and the rows in use
  kNoTexture,        ///< less than half of what makes a corner, or clipped
  kResidual,         ///< the windows differ too much
  kForwardBackward,  ///< tracking back does not return
};

/// Where features of one frame are in another. All arrays are parallel to the given features.
struct FrameTrack {
  std::vector<Eigen::Vector2d> positions_px;  ///< of no meaning unless tracked
  std::vector<TrackStatus> statuses;
  std::vector<double> gains;      ///< brightness in the second frame over that in the first
  std::vector<double> residuals;  ///< root mean square in grey levels, at most 255
  /// Of the pair of frames; none for KltGain::kNone and where nothing was tracked.
  std::optional<double> gain;

  [[nodiscard]] int NumTracked() const;
};

/// Corners to track (Shi and Tomasi, CVPR 1994): local maxima of the smaller eigenvalue of the
/// squared gradients in 5 × 5 pixels, best first, at least min_distance_px from each other and
/// from `existing_px`, with a window wholly in the picture; at most as many as are missing to
/// max_features. Positions in pixels, at the centres of pixels. Cost linear in pixels.
[[nodiscard]] std::vector<Eigen::Vector2d> DetectFeatures(
    const GrayPyramid& picture, std::span<const Eigen::Vector2d> existing_px,
    const KltOptions& options, RunContext& context);

/// Follows features from `first` to `second`, in pixels of level 0.
///
/// Minimises Σ (I₂(x + d_i) / exp(k_i) − I₁(x))² over all windows, their displacements d_i and log
/// gains k_i, from coarse to fine; the start is the shift of the whole picture if so asked. With
/// one gain a frame, k_i = K, and the displacements are eliminated from the block-arrow system of
/// all features (Kim, Frahm and Pollefeys, ICCV 2007), with less say for features that ask for
/// another gain than most; with one gain a feature, each is solved with a pull towards that common
/// gain, which is then renewed (Zach, Gallup and Frahm, CVGPU 2008). Pixels clipped in either frame
/// say nothing about gains.
///
/// Requires pyramids of equal size, levels and wrapping, and finite positions. The result does not
/// depend on the number of threads. Cost linear in features. docs/algorithms/tracking.md.
[[nodiscard]] FrameTrack TrackFeatures(const GrayPyramid& first, const GrayPyramid& second,
                                       std::span<const Eigen::Vector2d> positions_px,
                                       const KltOptions& options, RunContext& context);

/// One feature of a frame.
struct TrackPoint {
  int track_id = 0;
  Eigen::Vector2d position_px{0, 0};
};

struct TrackedFrame {
  std::vector<TrackPoint> points;  ///< by rising track_id
  std::optional<double> gain;      ///< brightness over that of the frame before
  double exposure = 1;             ///< brightness over that of the first frame: product of gains
};

/// A feature over consecutive frames; its id is its place in KltTracker::Tracks().
struct FeatureTrack {
  int first_frame_idx = 0;
  std::vector<Eigen::Vector2d> positions_px;  ///< in frames first_frame_idx, first_frame_idx + 1, …
};

/// Follows features through frames that arrive in order, and finds new ones where some are lost.
///
/// Stateful: holds the pyramid of the last frame. Unknown gains count as one in `exposure`, and
/// errors of gains add up over frames.
class KltTracker {
 public:
  /// Throws InvalidInputError for options out of range.
  explicit KltTracker(const KltOptions& options);

  /// Takes the next frame, grey or RGB; the result is valid until the next call. Throws
  /// InvalidInputError when its size or channels are not usable or differ from the frames before.
  const TrackedFrame& AddFrame(const ImageU8& image, RunContext& context);

  [[nodiscard]] const std::vector<TrackedFrame>& frames() const { return frames_; }
  [[nodiscard]] std::vector<FeatureTrack> Tracks() const;

 private:
  void CheckFrame(const ImageU8& image) const;
  TrackedFrame FollowInto(const GrayPyramid& next, RunContext& context) const;
  void Refill(const GrayPyramid& pyramid, TrackedFrame& frame, RunContext& context);

  KltOptions options_;
  std::optional<GrayPyramid> last_;
  std::vector<TrackedFrame> frames_;
  int num_tracks_ = 0;
};

}  // namespace enfilade
