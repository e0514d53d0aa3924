// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <opencv2/video/tracking.hpp>

#include "enfilade/image/codec.h"
#include "enfilade/sfm/klt_tracker.h"
#include "tests/sfm/rendered_film.h"
#include "tests/support/real_data.h"

// Tracks the corners of every tenth frame through the ten frames after it, with our three models
// and with cv::calcOpticalFlowPyrLK there and back: same corners, window, levels and bound on the
// way back. Films: rendered (with the truth) and the real frames of hololens_office (skipped where
// they are absent); as they are, and with known changes of brightness.
//
//   alive1, alive5, alive10   share of corners still tracked after as many frames, %
//   right1, right5, right10   share of corners tracked and within 1 px of the truth, of those that
//                             are still in view, %
//   gain_median, gain_worst   errors of the gains between frames, over the whole film, %
//   frames/s                  pyramid and tracking there and back; corners are not found anew
namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kSpan = 10;
enum Method { kPlain, kFrameGain, kFeatureGain, kOpenCv };
enum FilmKind { kRendered, kReal };
enum Change { kAsIs, kRamp, kJumps };

// Brightness over the frame before.
double KnownGain(Change change, int frame) {
  if (change == kRamp)
    return std::array{1.03, 1.1, 0.93, 1.05, 0.9, 0.97}[static_cast<size_t>(frame % 6)];
  if (change == kJumps) return frame % 3 == 1 ? 0.7 : frame % 3 == 2 ? 1 / 0.7 : 1.0;
  return 1;
}

KltOptions OptionsOf(Method method) {
  KltOptions options;
  options.gain = method == kFrameGain     ? KltGain::kFrame
                 : method == kFeatureGain ? KltGain::kFeature
                                          : KltGain::kNone;
  options.max_features = 1000;
  options.min_distance_px = 6;
  return options;
}

struct Film {
  RenderedFilm truth;  // frames have no truth in a real film
  bool has_truth = false;
};

Film LoadRealFilm() {
  Film film;
  std::vector<std::filesystem::path> files;
  const std::filesystem::path folder = RealDataFolder() / "hololens_office" / "images";
  if (!std::filesystem::exists(folder)) return film;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) film.truth.frames.push_back({ReadImageRgb(file), {}, {}});
  return film;
}

const Film& FilmOf(FilmKind kind) {
  static const Film kRenderedFilm{RenderFilm(5, 4 * kSpan + 1, CameraModel::kPinhole), true};
  static const Film kRealFilm = LoadRealFilm();
  return kind == kRendered ? kRenderedFilm : kRealFilm;
}

// The frames with their brightness changed; gains below one first, so that little clips.
std::vector<ImageU8> FramesOf(const Film& film, Change change) {
  std::vector<ImageU8> frames;
  double exposure = change == kAsIs ? 1 : 0.8;
  for (size_t f = 0; f < film.truth.frames.size(); ++f) {
    if (f > 0) exposure *= KnownGain(change, static_cast<int>(f));
    frames.push_back(TimesGain(film.truth.frames[f].rgb, exposure));
  }
  return frames;
}

struct Step {
  std::vector<Vector2d> positions_px;
  std::vector<char> is_tracked;
};

// Follows corners from frame to frame; one object a film.
class Follower {
 public:
  virtual ~Follower() = default;
  virtual void Load(const ImageU8& image) = 0;                         // the next frame
  virtual Step Follow(const std::vector<Vector2d>& positions_px) = 0;  // from the one before
};

class OurFollower : public Follower {
 public:
  OurFollower(const KltOptions& options, int num_threads)
      : options_(options), context_(num_threads) {}
  void Load(const ImageU8& image) override {
    last_ = std::move(next_);
    next_ = std::make_unique<GrayPyramid>(image, options_.num_levels, false, context_);
  }
  Step Follow(const std::vector<Vector2d>& positions_px) override {
    const FrameTrack track = TrackFeatures(*last_, *next_, positions_px, options_, context_);
    Step step{track.positions_px, {}};
    for (const TrackStatus status : track.statuses) {
      step.is_tracked.push_back(status == TrackStatus::kTracked);
    }
    return step;
  }

 private:
  KltOptions options_;
  RunContext context_;
  std::unique_ptr<GrayPyramid> last_, next_;
};

class OpenCvFollower : public Follower {
 public:
  OpenCvFollower(const KltOptions& options, int num_threads) : options_(options) {
    cv::setNumThreads(num_threads);
  }
  void Load(const ImageU8& image) override {
    cv::Mat gray(image.rows(), image.cols(), CV_8U);
    for (int r = 0; r < image.rows(); ++r) {
      const uint8_t* source = image.row(r);
      for (int c = 0; c < image.cols(); ++c, source += 3) {
        gray.at<uint8_t>(r, c) =
            static_cast<uint8_t>((77 * source[0] + 150 * source[1] + 29 * source[2] + 128) >> 8);
      }
    }
    last_.swap(next_);
    cv::buildOpticalFlowPyramid(gray, next_, Window(), options_.num_levels - 1);
  }
  Step Follow(const std::vector<Vector2d>& positions_px) override {
    std::vector<cv::Point2f> start, there, back;
    for (const Vector2d& p : positions_px) start.emplace_back(p.x() - 0.5, p.y() - 0.5);
    Step step;
    if (start.empty()) return step;
    std::vector<uint8_t> is_there, is_back;
    Flow(last_, next_, start, there, is_there);
    Flow(next_, last_, there, back, is_back);
    const double half = 0.5 * options_.window_px;
    for (size_t i = 0; i < start.size(); ++i) {
      const Vector2d p(there[i].x + 0.5, there[i].y + 0.5);
      const cv::Mat& frame = next_[0];
      const bool is_inside = p.x() >= half && p.y() >= half && p.x() <= frame.cols - half &&
                             p.y() <= frame.rows - half;
      step.positions_px.push_back(p);
      step.is_tracked.push_back(is_there[i] && is_back[i] && is_inside &&
                                cv::norm(back[i] - start[i]) <= options_.max_forward_backward_px);
    }
    return step;
  }

 private:
  [[nodiscard]] cv::Size Window() const { return {options_.window_px, options_.window_px}; }
  void Flow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
            const std::vector<cv::Point2f>& start, std::vector<cv::Point2f>& end,
            std::vector<uint8_t>& status) const {
    const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS,
                                    options_.max_iterations, options_.convergence_px);
    cv::calcOpticalFlowPyrLK(from, to, start, end, status, cv::noArray(), Window(),
                             options_.num_levels - 1, criteria, 0, 1e-4);
  }

  KltOptions options_;
  std::vector<cv::Mat> last_, next_;
};

std::unique_ptr<Follower> MakeFollower(Method method, int num_threads) {
  if (method == kOpenCv) return std::make_unique<OpenCvFollower>(OptionsOf(method), num_threads);
  return std::make_unique<OurFollower>(OptionsOf(method), num_threads);
}

struct Score {
  double num_corners = 0;
  std::array<double, kSpan + 1> alive{}, right{}, wrong{}, visible{};
};

// Follows the corners of frame `begin` over kSpan frames.
void FollowSpan(const Film& film, const std::vector<ImageU8>& frames, int begin, Method method,
                Score& score) {
  RunContext context(2);
  // The same corners for all changes of brightness.
  const GrayPyramid first(film.truth.frames[static_cast<size_t>(begin)].rgb, 1, false, context);
  std::vector<Vector2d> at = DetectFeatures(first, {}, OptionsOf(method), context), start = at;
  const auto follower = MakeFollower(method, 2);
  follower->Load(frames[static_cast<size_t>(begin)]);
  score.num_corners += static_cast<double>(at.size());
  for (int i = 1; i <= kSpan; ++i) {
    const size_t s = static_cast<size_t>(i);
    follower->Load(frames[static_cast<size_t>(begin + i)]);
    Step step = follower->Follow(at);
    std::vector<Vector2d> left, left_start;
    for (size_t j = 0; j < at.size(); ++j) {
      if (!step.is_tracked[j]) continue;
      left.push_back(step.positions_px[j]);
      left_start.push_back(start[j]);
      ++score.alive[s];
      if (!film.has_truth) continue;
      const auto truth = film.truth.Follow(begin, begin + i, start[j]);
      const bool is_right = truth && (*truth - step.positions_px[j]).norm() < 1;
      score.right[s] += is_right;
      score.wrong[s] += truth && !is_right;
    }
    at = left;
    start = left_start;
  }
  if (!film.has_truth) return;
  for (const Vector2d& corner : DetectFeatures(first, {}, OptionsOf(method), context)) {
    for (int i = 1; i <= kSpan; ++i) {
      score.visible[static_cast<size_t>(i)] +=
          film.truth.Follow(begin, begin + i, corner).has_value();
    }
  }
}

// Gains of all frames but the first, with features found anew where some are lost; 0: none.
std::vector<double> GainsOf(const std::vector<ImageU8>& frames, Method method) {
  RunContext context(2);
  KltTracker tracker(OptionsOf(method));
  std::vector<double> gains;
  for (const ImageU8& frame : frames) {
    gains.push_back(tracker.AddFrame(frame, context).gain.value_or(0));
  }
  gains.erase(gains.begin());
  return gains;
}

// Relative errors, rising. Of the real film only the changes are known: gains are compared with
// those of the film as it is.
std::vector<double> GainErrors(const Film& film, Change change, Method method) {
  const std::vector<double> gains = GainsOf(FramesOf(film, change), method),
                            own = GainsOf(FramesOf(film, kAsIs), method);
  std::vector<double> errors;
  for (size_t i = 0; i < gains.size(); ++i) {
    if (gains[i] == 0 || own[i] == 0) {
      errors.push_back(1);
      continue;
    }
    const double known = KnownGain(change, static_cast<int>(i) + 1) * (film.has_truth ? 1 : own[i]);
    errors.push_back(std::abs(gains[i] / known - 1));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

void BM_Quality(benchmark::State& state) {
  const Method method = static_cast<Method>(state.range(0));
  const Film& film = FilmOf(static_cast<FilmKind>(state.range(1)));
  const Change change = static_cast<Change>(state.range(2));
  if (film.truth.frames.empty()) {
    state.SkipWithError("real data 'hololens_office' is absent");
    return;
  }
  const std::vector<ImageU8> frames = FramesOf(film, change);
  Score score;
  for (auto _ : state) {
    for (int begin = 0; begin + kSpan < static_cast<int>(frames.size()); begin += kSpan) {
      FollowSpan(film, frames, begin, method, score);
    }
  }
  for (const int i : {1, 5, 10}) {
    const size_t s = static_cast<size_t>(i);
    state.counters["alive" + std::to_string(i)] = 100 * score.alive[s] / score.num_corners;
    if (film.has_truth) {
      state.counters["right" + std::to_string(i)] = 100 * score.right[s] / score.visible[s];
      state.counters["wrong" + std::to_string(i)] = 100 * score.wrong[s] / score.num_corners;
    }
  }
  state.counters["corners"] = score.num_corners;
  if (method != kFrameGain && method != kFeatureGain) return;
  const std::vector<double> errors = GainErrors(film, change, method);
  state.counters["gain_median"] = 100 * errors[errors.size() / 2];
  state.counters["gain_worst"] = 100 * errors.back();
}

void BM_Speed(benchmark::State& state) {
  const Method method = static_cast<Method>(state.range(0));
  const int num_threads = static_cast<int>(state.range(1));
  const Film& film = FilmOf(FilmOf(kReal).truth.frames.empty() ? kRendered : kReal);
  const std::vector<ImageU8> frames = FramesOf(film, kRamp);
  RunContext context(1);
  const GrayPyramid first(frames[0], 1, false, context);
  const std::vector<Vector2d> corners = DetectFeatures(first, {}, OptionsOf(method), context);
  const auto follower = MakeFollower(method, num_threads);
  follower->Load(frames[0]);
  size_t f = 0;
  for (auto _ : state) {
    // To and fro, always with all the corners.
    f = 1 - f;
    follower->Load(frames[f]);
    benchmark::DoNotOptimize(follower->Follow(corners));
  }
  state.counters["corners"] = static_cast<double>(corners.size());
  state.counters["frames/s"] = benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(BM_Speed)
    ->ArgNames({"method", "threads"})
    ->ArgsProduct({{kPlain, kFrameGain, kFeatureGain, kOpenCv}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Quality)
    ->ArgNames({"method", "film", "change"})
    ->ArgsProduct({{kPlain, kFrameGain, kFeatureGain, kOpenCv},
                   {kRendered, kReal},
                   {kAsIs, kRamp, kJumps}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
