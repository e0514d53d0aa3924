// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/register.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"
#include "enfilade/sfm/pair_length.h"
#include "enfilade/sfm/positions.h"
#include "enfilade/sfm/view_graph.h"
#include "src/sfm/assemble.h"
#include "src/sfm/guided_matches.h"
#include "src/sfm/level_rays.h"
#include "src/sfm/match_pairs.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// The pairs to match, with what is known of them beside the pictures' descriptors.
std::vector<PairToMatch> ListPairs(std::span<const ViewPair> selected,
                                   std::span<const PairMatches> followed,
                                   std::span<const FloorMatch> floors) {
  std::map<ViewPair, PairToMatch> to_match;
  for (const ViewPair& pair : selected) to_match[pair];
  for (const PairMatches& pair : followed)
    to_match[{pair.a_idx, pair.b_idx}].followed = pair.matches;
  for (const FloorMatch& floor : floors) to_match[{floor.a_idx, floor.b_idx}].floor = &floor;
  std::vector<PairToMatch> pairs;
  for (auto& [views, pair] : to_match) {
    pair.a_idx = views.a_idx;
    pair.b_idx = views.b_idx;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

constexpr double kWeakLog10Chance = -10;

// Lengths from floor and ceiling, then made to agree with each other.
void FindLengths(const LevelRays& level, std::vector<PanoPair>& pairs) {
  std::vector<std::vector<LengthVote>> votes(pairs.size());
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].verdict != PairVerdict::kAccepted) continue;
    votes[k] = CollectLengthVotes(pairs[k], level[static_cast<size_t>(pairs[k].a_idx)],
                                  level[static_cast<size_t>(pairs[k].b_idx)]);
  }
  const double ceiling = FindCeiling(votes);
  for (size_t k = 0; k < pairs.size(); ++k) SetLength(votes[k], ceiling, pairs[k]);
  SolveLengths(CollectLengthRatios(pairs, level), pairs);
  // A weak pair whose points lie on neither floor nor ceiling and that shares none with others is
  // more often false than true.
  for (PanoPair& pair : pairs) {
    const bool is_weak = pair.log10_chance > kWeakLog10Chance && pair.length <= 0;
    if (pair.verdict == PairVerdict::kAccepted && is_weak) pair.verdict = PairVerdict::kChance;
  }
}

// Heights at which many points lie above the cameras.
std::vector<double> FindCeilings(std::span<const Track> tracks) {
  constexpr double kBin = 0.01, kLowest = 1.2, kHighest = 3.5;
  constexpr int kReach = 2;
  constexpr double kMinPoints = 8;
  constexpr int kApart = 8;
  constexpr int kSurroundings = 25;
  constexpr double kProminence = 2;
  const int num_bins = static_cast<int>((kHighest - kLowest) / kBin);
  std::vector<double> counts(static_cast<size_t>(num_bins), 0);
  for (const Track& track : tracks) {
    const int center = static_cast<int>(std::floor((track.position.z() - kLowest) / kBin));
    for (int i = std::max(0, center - kReach); i <= std::min(num_bins - 1, center + kReach); ++i) {
      counts[static_cast<size_t>(i)] += 1;
    }
  }
  // Walls have points at all heights: a level plane stands out from what lies about it.
  const auto background = [&](int at) {
    double sum = 0, count = 0;
    for (int i = std::max(0, at - kSurroundings); i <= std::min(num_bins - 1, at + kSurroundings);
         ++i) {
      if (std::abs(i - at) <= 2 * kReach) continue;
      sum += counts[static_cast<size_t>(i)];
      count += 1;
    }
    return sum / count;
  };
  struct Peak {
    double count;
    int bin;
  };
  std::vector<Peak> peaks;
  for (int i = 0; i < num_bins; ++i) {
    const double count = counts[static_cast<size_t>(i)];
    if (count >= kMinPoints && count > kProminence * background(i)) peaks.push_back({count, i});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& x, const Peak& y) { return x.count > y.count; });
  std::vector<double> ceilings;
  std::vector<int> taken;
  for (const Peak& peak : peaks) {
    const bool is_near = std::any_of(taken.begin(), taken.end(), [&](int other) {
      return std::abs(other - peak.bin) <= kApart;
    });
    if (is_near) continue;
    taken.push_back(peak.bin);
    ceilings.push_back(kLowest + (peak.bin + 0.5) * kBin);
  }
  return ceilings;
}

// The tracks of one component.
std::vector<Track> TracksOf(int component, std::span<const int> component_idx,
                            std::span<const Track> tracks) {
  std::vector<Track> chosen;
  for (const Track& track : tracks) {
    const size_t view = static_cast<size_t>(track.observations.front().view_idx);
    if (component_idx[view] == component) chosen.push_back(track);
  }
  return chosen;
}

double NumRays(std::span<const Track> tracks) {
  double count = 0;
  for (const Track& track : tracks) count += static_cast<double>(track.observations.size());
  return count;
}

void AdjustComponents(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                      const RegisterOptions& options, RunContext& context,
                      Registration& registration) {
  constexpr std::array<double, 4> kMaxErrors_deg = {2.0, 1.0, 0.5, 0.3};
  const std::vector<Track> chains = BuildTracks(registration.pairs, features);
  const int num_components =
      1 + *std::max_element(registration.component_idx.begin(), registration.component_idx.end());
  double sum_squares = 0;
  registration.tracks.clear();
  for (int component = 0; component < num_components; ++component) {
    const std::vector<Track> own = TracksOf(component, registration.component_idx, chains);
    std::vector<Track> tracks;
    LevelPlanes planes;
    double error_rad = 0;
    for (const double max_error_deg : kMaxErrors_deg) {
      context.CheckStop();
      const TriangulationBounds bounds{.max_error_rad = DegToRad(max_error_deg)};
      tracks = TriangulateTracks(registration.world_from_cam, features, bounds, own);
      planes.ceilings = FindCeilings(tracks);
      error_rad = AdjustBundle(features, gravity, options.bundle, registration.world_from_cam,
                               tracks, planes);
    }
    sum_squares += NumRays(tracks) * error_rad * error_rad;
    registration.tracks.insert(registration.tracks.end(), tracks.begin(), tracks.end());
    if (component == 0) registration.ceilings = planes.ceilings;
  }
  registration.ray_error_rad = std::sqrt(sum_squares / std::max(1.0, NumRays(registration.tracks)));
}

}  // namespace

void RefineRegistration(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                        const RegisterOptions& options, RunContext& context,
                        Registration& registration) {
  AdjustComponents(features, gravity, options, context, registration);
  if (!options.use_guided) return;
  MatchGuided(features, gravity, options, context, registration);
  AdjustComponents(features, gravity, options, context, registration);
}

Registration RegisterFeatures(std::span<const PanoFeatures> features,
                              std::span<const Gravity> gravity, const RegisterOptions& options,
                              RunContext& context, std::span<const PairMatches> followed,
                              std::span<const FloorMatch> floors) {
  const int num_views = static_cast<int>(features.size());
  if (num_views == 0) return {};
  const LevelRays level = TurnLevel(features, gravity);
  Registration registration;
  const std::vector<ViewPair> selected =
      SelectPairs(features, options.selection, options.match, context);
  registration.pairs = MatchPairs(ListPairs(selected, followed, floors), features, gravity, level,
                                  options.match, options.two_view, context);
  FindLengths(level, registration.pairs);
  AssembleGroups(num_views, registration.pairs);
  const std::vector<double> yaws = AverageYaws(num_views, registration.pairs);
  const std::vector<Eigen::Vector2d> positions = SolvePositions(yaws, registration.pairs);
  registration.component_idx = FindComponents(num_views, registration.pairs);
  for (size_t i = 0; i < features.size(); ++i) {
    registration.world_from_cam.push_back(
        {RotationZ(yaws[i]) * LevelFromCam(gravity[i]), {positions[i].x(), positions[i].y(), 1}});
  }
  RefineRegistration(features, gravity, options, context, registration);
  return registration;
}

}  // namespace enfilade
