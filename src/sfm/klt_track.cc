// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "src/sfm/klt_features.h"
#include "src/sfm/klt_gain.h"
#include "src/sfm/klt_shift.h"
#include "src/sfm/klt_window.h"

namespace enfilade {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kChunkFeatures = 128;  // worth starting a thread for
constexpr int kMaxGainRounds = 4;
// Coarse levels only start the finer ones.
constexpr double kCoarseConvergence_px = 0.05;
constexpr double kGainConvergence = 2e-4;
constexpr double kCoarseGainConvergence = 2e-3;
// More in one round is a linearisation that went wrong.
constexpr double kMaxGainStep = 0.7;

struct Feature {
  Vector2d first_px{0, 0};
  Vector2d second_px{0, 0};
  double log_gain = 0;
  TrackStatus status = TrackStatus::kTracked;
  double residual = 255;
  bool has_texture = false;  // on the level at hand, like what follows
  Matrix2d inverse_tensor = Matrix2d::Identity();
  GainBlock block;
};

double SmallerEigenvalue(const Matrix2d& m) {
  return 0.5 * (m(0, 0) + m(1, 1)) - std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
}

// Wraps the position round; false when it is outside.
bool KeepInLevel(const GrayLevel& level, Vector2d& position) {
  if (level.wraps_around) position.x() -= level.cols * std::floor(position.x() / level.cols);
  return position.x() >= 0 && position.x() <= level.cols && position.y() >= 0 &&
         position.y() <= level.rows;
}

// The position as it is where the shift would take it out of the picture.
Vector2d ShiftedWithin(const GrayLevel& level, const Vector2d& position, const Vector2d& shift) {
  Vector2d shifted = position + shift;
  return KeepInLevel(level, shifted) ? shifted : position;
}

// Follows a set of features from one frame to another, from the coarsest level to the finest.
class PairTracker {
 public:
  PairTracker(const GrayPyramid& first, const GrayPyramid& second, const KltOptions& options,
              RunContext& context)
      : first_(first),
        second_(second),
        options_(options),
        kernel_(KernelOfWindow(options.window_px)),
        num_plane_values_(kNumWindowPlanes * options.window_px * options.window_px),
        context_(context) {}

  // With `is_gain_known` the features keep their log gains.
  void Follow(std::vector<Feature>& features, bool is_gain_known) {
    planes_.resize(features.size() * static_cast<size_t>(num_plane_values_));
    for (int l = first_.num_levels() - 1; l >= 0; --l) {
      ForEach(features, [&](Feature& feature, float* planes) { Cut(l, feature, planes); });
      for (int round = 0; round < kMaxGainRounds; ++round) {
        const double change = is_gain_known ? 0 : StepGains(features);
        if (round > 0 && change < (l == 0 ? kGainConvergence : kCoarseGainConvergence)) break;
        ForEach(features, [&](Feature& feature, float* planes) { Move(l, feature, planes); });
      }
    }
    for (Feature& feature : features) Judge(feature);
  }

 private:
  template <typename Body>
  void ForEach(std::vector<Feature>& features, const Body& body) {
    const size_t num_chunks = (features.size() + kChunkFeatures - 1) / kChunkFeatures;
    ParallelFor(context_, "", static_cast<int64_t>(num_chunks), [&](int64_t chunk) {
      const size_t begin = static_cast<size_t>(chunk) * kChunkFeatures;
      const size_t end = std::min(begin + kChunkFeatures, features.size());
      for (size_t i = begin; i < end; ++i) {
        if (features[i].status != TrackStatus::kTracked) continue;
        body(features[i], planes_.data() + i * static_cast<size_t>(num_plane_values_));
      }
    });
  }

  // The window of the first frame and the sums at the start of a level.
  void Cut(int l, Feature& feature, float* planes) const {
    const Matrix2d tensor = kernel_.cut(first_.level(l), feature.first_px * LevelScale(l), planes);
    feature.has_texture = SmallerEigenvalue(tensor) >= MinEigenvalue(feature);
    if (!feature.has_texture) return;
    feature.inverse_tensor = tensor.inverse();
    feature.block.tensor = tensor;
    UpdateSums(l, feature, planes);
  }

  // Corners were found in a part of the window, so they pass at once; and later on until they have
  // lost half of their texture. On the way back the frame is as bright as `log_gain` says.
  [[nodiscard]] double MinEigenvalue(const Feature& feature) const {
    return 0.5 * kCornerArea * options_.min_eigenvalue *
           std::exp(-2 * std::max(feature.log_gain, 0.0));
  }

  void UpdateSums(int l, Feature& feature, const float* planes) const {
    const WindowSums sums = kernel_.sums(second_.level(l), feature.second_px * LevelScale(l),
                                         static_cast<float>(std::exp(-feature.log_gain)), planes);
    const Matrix2d tensor = feature.block.tensor;
    feature.block = sums.block;
    feature.block.tensor = tensor;
    // In grey levels of the darker frame: so noise counts alike whichever comes first.
    const double darker = std::min(1.0, std::exp(feature.log_gain));
    feature.residual = std::min(255.0, darker * std::sqrt(sums.residual2) / options_.window_px);
  }

  // Gauss–Newton steps of the displacement for the present gain. The gradients are those of the
  // first frame, so that their tensor is the same in all steps (inverse composition).
  void Move(int l, Feature& feature, const float* planes) const {
    if (!feature.has_texture) return;
    const GrayLevel& level = second_.level(l);
    const double convergence =
        l == 0 ? options_.convergence_px : std::max(options_.convergence_px, kCoarseConvergence_px);
    const Vector2d start = feature.second_px * LevelScale(l);
    Vector2d position = start;
    const float inverse_gain = static_cast<float>(std::exp(-feature.log_gain));
    for (int i = 0; i < options_.max_iterations; ++i) {
      const Vector2d step = -(feature.inverse_tensor *
                              kernel_.gradient_residual(level, position, inverse_gain, planes));
      position += step;
      if (!KeepInLevel(level, position)) {
        // On a coarse level it may be a false start.
        position = start;
        if (l == 0) feature.status = TrackStatus::kOutOfPicture;
        break;
      }
      if (step.squaredNorm() < convergence * convergence) break;
    }
    feature.second_px = position / LevelScale(l);
    UpdateSums(l, feature, planes);
  }

  // One step of the gains, in the order of the features; returns the largest change.
  double StepGains(std::vector<Feature>& features) const;

  void Judge(Feature& feature) const {
    if (feature.status != TrackStatus::kTracked) return;
    if (!IsInsidePicture(feature.second_px, first_.rows(), first_.cols(), options_)) {
      feature.status = TrackStatus::kOutOfPicture;
    } else if (!feature.has_texture) {
      feature.status = TrackStatus::kNoTexture;
    } else if (!(feature.residual <= options_.max_residual)) {
      feature.status = TrackStatus::kResidual;
    }
  }

  static double LevelScale(int l) { return std::ldexp(1.0, -l); }

  const GrayPyramid& first_;
  const GrayPyramid& second_;
  const KltOptions& options_;
  const WindowKernel& kernel_;
  int num_plane_values_;
  RunContext& context_;
  std::vector<float> planes_;
};

// What each feature says about its gain; nothing where it is lost.
struct GainVotes {
  std::vector<double> log_gains;
  std::vector<double> information;

  explicit GainVotes(std::span<const Feature> features) {
    log_gains.reserve(features.size());
    information.reserve(features.size());
    for (const Feature& feature : features) {
      const bool is_heard = feature.status == TrackStatus::kTracked && feature.has_texture;
      const ReducedGain reduced = is_heard ? EliminateDisplacement(feature.block) : ReducedGain();
      log_gains.push_back(feature.log_gain + std::clamp(reduced.step, -kMaxGainStep, kMaxGainStep));
      information.push_back(reduced.information);
    }
  }

  [[nodiscard]] double Common() const { return RobustInformationMean(log_gains, information); }
};

double PairTracker::StepGains(std::vector<Feature>& features) const {
  const GainVotes votes(features);
  const double common = votes.Common();
  double change = 0;
  for (size_t i = 0; i < features.size(); ++i) {
    double log_gain = common;
    const double pull = options_.gain_stiffness * features[i].block.gain;
    if (options_.gain == KltGain::kFeature && votes.information[i] + pull > 0) {
      log_gain = (votes.information[i] * votes.log_gains[i] + pull * common) /
                 (votes.information[i] + pull);
    }
    change = std::max(change, std::abs(log_gain - features[i].log_gain));
    features[i].log_gain = log_gain;
  }
  return change;
}

// Tracks the survivors back, with their gains inverted, and compares with where they came from.
void CheckBackward(PairTracker& backward, const GrayLevel& level, const Vector2d& shift,
                   double max_miss_px, std::vector<Feature>& features) {
  std::vector<Feature> returning;
  std::vector<size_t> indices;
  for (size_t i = 0; i < features.size(); ++i) {
    if (features[i].status != TrackStatus::kTracked) continue;
    Feature& feature = returning.emplace_back();
    feature.first_px = features[i].second_px;
    feature.second_px = ShiftedWithin(level, feature.first_px, -shift);
    feature.log_gain = -features[i].log_gain;
    indices.push_back(i);
  }
  backward.Follow(returning, true);
  for (size_t j = 0; j < returning.size(); ++j) {
    Vector2d miss = returning[j].second_px - features[indices[j]].first_px;
    if (level.wraps_around) miss.x() = std::remainder(miss.x(), level.cols);
    // Lost for other reasons on the way back: there is no way back either.
    if (returning[j].status != TrackStatus::kTracked || !(miss.norm() <= max_miss_px)) {
      features[indices[j]].status = TrackStatus::kForwardBackward;
    }
  }
}

std::vector<Feature> StartFeatures(std::span<const Vector2d> positions_px, const Vector2d& shift,
                                   const GrayPyramid& frame, const KltOptions& options) {
  std::vector<Feature> features(positions_px.size());
  for (size_t i = 0; i < features.size(); ++i) {
    ENFILADE_CHECK(positions_px[i].allFinite());
    features[i].first_px = positions_px[i];
    features[i].second_px = ShiftedWithin(frame.level(0), positions_px[i], shift);
    if (!IsInsidePicture(positions_px[i], frame.rows(), frame.cols(), options)) {
      features[i].status = TrackStatus::kOutOfPicture;
    }
  }
  return features;
}

FrameTrack ResultOf(std::span<const Feature> features, KltGain gain) {
  FrameTrack track;
  for (const Feature& feature : features) {
    track.positions_px.push_back(feature.second_px);
    track.statuses.push_back(feature.status);
    track.gains.push_back(std::exp(feature.log_gain));
    track.residuals.push_back(feature.residual);
  }
  if (gain != KltGain::kNone && track.NumTracked() > 0) {
    track.gain = std::exp(GainVotes(features).Common());
  }
  return track;
}

}  // namespace

FrameTrack TrackFeatures(const GrayPyramid& first, const GrayPyramid& second,
                         std::span<const Vector2d> positions_px, const KltOptions& options,
                         RunContext& context) {
  ENFILADE_CHECK(first.rows() == second.rows() && first.cols() == second.cols());
  ENFILADE_CHECK(first.num_levels() == second.num_levels());
  ENFILADE_CHECK(first.wraps_around() == options.wraps_around &&
                 second.wraps_around() == options.wraps_around);
  const Vector2d shift =
      options.has_coarse_shift ? ShiftOfPicture(first, second) : Vector2d::Zero();
  std::vector<Feature> features = StartFeatures(positions_px, shift, first, options);
  PairTracker(first, second, options, context).Follow(features, options.gain == KltGain::kNone);
  if (options.max_forward_backward_px > 0) {
    PairTracker backward(second, first, options, context);
    CheckBackward(backward, first.level(0), shift, options.max_forward_backward_px, features);
  }
  return ResultOf(features, options.gain);
}

}  // namespace enfilade
