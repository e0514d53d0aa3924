// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/wall_sigma.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "src/floorplan/box_index.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/wall_band.h"
#include "src/floorplan/wall_thickness.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// Measured walls: what does not depend on the distance (position, edges, the annotation), and what
// all columns of a panorama share, an angle (tilt, camera height, which line of the baseboard).
constexpr double kFixed_m = 0.022;
constexpr double kAngle_rad = 0.0077;
constexpr double kLineHeight_m = 1.4;  // of floor and ceiling lines from the camera
constexpr double kMaxRange_m = 8;      // of r²/h + h: beyond, walls are no better known from afar
constexpr double kUnseenDistance_m = 2.5;

// Log-odds that the line is another surface.
constexpr double kWrong = 1.5;
constexpr double kWrongOfLength = -1.0;  // of ln(length / 1 m)
constexpr double kWrongOfUnseen = 1.85;
constexpr double kWrongOfCollinear = -1.75;  // of ln(1 + length / 1 m)
constexpr double kWrongOfTwin = -1.3;
constexpr double kWrongOfAgreeing = -0.9;  // of ln(1 + panoramas)
constexpr double kWrongBy_m = 0.71;        // mean distance of the right surface

constexpr double kShortest_m = 0.05;
constexpr double kParallel = 0.98;  // cosine
constexpr double kOnLine_m = 0.06;
constexpr double kMaxCollinear_m = 8;
constexpr double kThinnestWall_m = 0.03, kThickestWall_m = 0.3;
constexpr double kTwinOverlap = 0.3;  // of the wall's length
constexpr size_t kFewColumns = 3;

bool IsWitness(const WallWitness& witness) { return witness.sightings.size() >= kFewColumns; }
bool IsAgreeing(const WallWitness& witness) {
  return IsWitness(witness) && witness.agreeing_share > 0.5;
}

struct Line {
  explicit Line(const Wall& wall)
      : origin(wall.a), along((wall.b - wall.a).normalized()), normal(-along.y(), along.x()) {}
  Vector2d origin, along, normal;  // normal: into the room
};

double CollinearLength(const Storey& storey, const BoxIndex& index, const Wall& wall) {
  const Line line(wall);
  const Vector2d reach = index.bounds().diagonal().norm() * line.along;
  const Box2 beside = Grown(BoxOf(wall.a - reach, wall.a + reach), kOnLine_m);
  double sum = 0;
  for (const size_t i : index.Touching(beside)) {
    const Wall& other = storey.walls[i];
    const double length = (other.b - other.a).norm();
    if (&other == &wall || length < kShortest_m) continue;
    const bool is_parallel = std::abs(line.along.dot(other.b - other.a)) > kParallel * length;
    const bool is_on_line = std::abs(line.normal.dot(other.a - line.origin)) < kOnLine_m &&
                            std::abs(line.normal.dot(other.b - line.origin)) < kOnLine_m;
    if (is_parallel && is_on_line) sum += length;
  }
  return std::min(sum, kMaxCollinear_m);
}

bool HasTwin(const Storey& storey, const BoxIndex& index, const Wall& wall) {
  const double least_m = kTwinOverlap * (wall.b - wall.a).norm();
  const std::vector<size_t> near = index.Touching(Grown(BoxOf(wall.a, wall.b), kThickestWall_m));
  return std::any_of(near.begin(), near.end(), [&](size_t i) {
    const Wall& other = storey.walls[i];
    if ((other.b - other.a).norm() < kShortest_m) return false;
    const std::optional<FarFace> face = FarFaceOf(wall.a, wall.b, other.a, other.b, kParallel);
    return face && face->gap_m > kThinnestWall_m && face->gap_m < kThickestWall_m &&
           face->common_m >= least_m;
  });
}

// How far a shared error of one radian moves a wall (r = h / tan φ), averaged over the panoramas
// that measured it, near ones counting most as they do in the evidence.
double Leverage(std::span<const WallWitness> witnesses, double& distance_m) {
  const bool has_agreeing = std::any_of(witnesses.begin(), witnesses.end(), IsAgreeing);
  double weights = 0, sum = 0, distances = 0;
  for (const WallWitness& witness : witnesses) {
    if (has_agreeing ? !IsAgreeing(witness) : !IsWitness(witness)) continue;
    const double r = witness.distance_m, of_view = r * r / kLineHeight_m + kLineHeight_m;
    const double weight = 1 / (of_view * of_view);
    weights += weight;
    sum += weight * of_view;
    distances += weight * r;
  }
  distance_m = weights > 0 ? distances / weights : 0;
  if (weights == 0) return kUnseenDistance_m * kUnseenDistance_m / kLineHeight_m + kLineHeight_m;
  return std::min(sum / weights, kMaxRange_m);
}

double WrongProbability(const WallSigma::Grounds& grounds) {
  const double log_odds =
      kWrong + kWrongOfLength * std::log(std::max(grounds.length_m, kShortest_m)) +
      kWrongOfUnseen * (1 - grounds.seen_share) +
      kWrongOfCollinear * std::log1p(grounds.collinear_m) + (grounds.has_twin ? kWrongOfTwin : 0) +
      kWrongOfAgreeing * std::log1p(grounds.num_agreeing);
  return 1 / (1 + std::exp(-log_odds));
}

// Rings are runs of walls of one room in which each ends where the next begins.
struct RingWalls {
  std::vector<size_t> previous, next;  // of each wall of the storey, by index
};

RingWalls LinkWalls(const std::vector<Wall>& walls) {
  RingWalls ring{std::vector<size_t>(walls.size()), std::vector<size_t>(walls.size())};
  for (size_t begin = 0; begin < walls.size();) {
    size_t end = begin + 1;
    while (end < walls.size() && walls[end].room_id == walls[begin].room_id &&
           walls[end].a == walls[end - 1].b) {
      ++end;
    }
    for (size_t i = begin; i < end; ++i) {
      ring.next[i] = i + 1 < end ? i + 1 : begin;
      ring.previous[ring.next[i]] = i;
    }
    begin = end;
  }
  return ring;
}

// A quantity that changes by `gradient` when the wall moves outwards.
struct Part {
  size_t wall_idx = 0;
  double gradient = 0;
};

// Standard deviation of a sum over walls of one room. Their measured errors have a common part;
// the rest, and the choice of surfaces, are each wall's own.
double SigmaOfSum(const std::vector<WallSigma>& sigmas, const std::vector<Part>& parts) {
  double common = 0, own_variance = 0;
  for (const Part& part : parts) {
    const WallSigma& sigma = sigmas[part.wall_idx];
    const double shared_m = std::sqrt(kSharedVariance) * sigma.measured_m;
    common += part.gradient * shared_m;
    own_variance +=
        part.gradient * part.gradient * (sigma.sigma_m * sigma.sigma_m - shared_m * shared_m);
  }
  return std::sqrt(common * common + own_variance);
}

// How the length of `wall` changes when it and a neighbour at one of its ends move outwards.
void AddCorner(const Line& wall, size_t wall_idx, const Line& neighbour, size_t neighbour_idx,
               double end_sign, std::vector<Part>& parts) {
  Eigen::Matrix2d normals;
  normals << -wall.normal.transpose(), -neighbour.normal.transpose();
  if (std::abs(normals.determinant()) < 0.1) return;  // in one line: the corner is no corner
  // The corner c has normals · c = offsets; its way along the wall makes the wall longer.
  const Eigen::RowVector2d gradient = end_sign * wall.along.transpose() * normals.inverse();
  parts.push_back({wall_idx, gradient.x()});
  parts.push_back({neighbour_idx, gradient.y()});
}

double LengthSigma(const std::vector<Wall>& walls, const RingWalls& ring,
                   const std::vector<WallSigma>& sigmas, size_t i) {
  std::vector<Part> corners;
  const Line line(walls[i]);
  AddCorner(line, i, Line(walls[ring.next[i]]), ring.next[i], 1, corners);
  AddCorner(line, i, Line(walls[ring.previous[i]]), ring.previous[i], -1, corners);
  std::vector<Part> parts;  // each wall once
  for (const Part& corner : corners) {
    const auto same = std::find_if(parts.begin(), parts.end(), [&](const Part& part) {
      return part.wall_idx == corner.wall_idx;
    });
    if (same == parts.end()) {
      parts.push_back(corner);
    } else {
      same->gradient += corner.gradient;
    }
  }
  return SigmaOfSum(sigmas, parts);
}

}  // namespace

double SigmaOfMixture(double measured_m, double wrong_probability) {
  ENFILADE_CHECK(measured_m > 0 && wrong_probability >= 0 && wrong_probability <= 1);
  const auto normal = [](double k) { return std::erf(k / std::numbers::sqrt2); };
  const auto within = [&](double bound_m) {
    return (1 - wrong_probability) * normal(bound_m / measured_m) +
           wrong_probability * (1 - std::exp(-bound_m / kWrongBy_m));
  };
  const double target = 2 * normal(1) + normal(2);
  double low = 0, high = measured_m + 10 * kWrongBy_m;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (2 * within(middle) + within(2 * middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<WallSigma> FindWallSigmas(const EvidenceGrids& evidence, const Storey& storey,
                                      std::span<const std::vector<WallWitness>> witnesses,
                                      const FloorplanOptions& options) {
  ENFILADE_CHECK(witnesses.size() == storey.walls.size());
  const LoopField field = NormaliseEvidence(evidence, options);
  const BoxIndex index = IndexWalls(storey.walls);
  std::vector<WallSigma> sigmas(storey.walls.size());
  for (size_t i = 0; i < sigmas.size(); ++i) {
    const Wall& wall = storey.walls[i];
    WallSigma& sigma = sigmas[i];
    sigma.grounds = {
        .length_m = (wall.b - wall.a).norm(),
        .seen_share = MeasureWallBand(field, wall.a, wall.b, options.slide_m).seen_share,
        .collinear_m = CollinearLength(storey, index, wall),
        .has_twin = HasTwin(storey, index, wall),
        .num_agreeing =
            static_cast<int>(std::count_if(witnesses[i].begin(), witnesses[i].end(), IsAgreeing))};
    const double leverage = Leverage(witnesses[i], sigma.distance_m);
    sigma.measured_m = std::hypot(kFixed_m, kAngle_rad * leverage);
    sigma.wrong_probability = WrongProbability(sigma.grounds);
    sigma.sigma_m = SigmaOfMixture(sigma.measured_m, sigma.wrong_probability);
  }
  return sigmas;
}

void AssignSumSigmas(const std::vector<WallSigma>& sigmas, Storey& storey) {
  ENFILADE_CHECK(sigmas.size() == storey.walls.size());
  const RingWalls ring = LinkWalls(storey.walls);
  for (size_t i = 0; i < sigmas.size(); ++i)
    storey.walls[i].length_sigma_m = LengthSigma(storey.walls, ring, sigmas, i);
  // A wall that moves outwards adds its length times the way.
  std::map<int, std::vector<Part>> parts_of_room;
  for (size_t i = 0; i < sigmas.size(); ++i) {
    const Wall& wall = storey.walls[i];
    parts_of_room[wall.room_id].push_back({i, (wall.b - wall.a).norm()});
  }
  for (Room& room : storey.rooms) room.area_sigma_m2 = SigmaOfSum(sigmas, parts_of_room[room.id]);
}

void AssignSigmas(const Scene& scene, const Structure& structure,
                  const std::vector<EvidenceGrids>& evidence, const FloorplanOptions& options,
                  Floorplan& plan) {
  ENFILADE_CHECK(evidence.size() == plan.storeys.size());
  for (size_t s = 0; s < plan.storeys.size(); ++s) {
    Storey& storey = plan.storeys[s];
    if (storey.walls.empty()) continue;
    const std::vector<WallSigma> sigmas =
        FindWallSigmas(evidence[s], storey,
                       FindWallWitnesses(scene, structure, storey, static_cast<int>(s)), options);
    for (size_t i = 0; i < sigmas.size(); ++i) storey.walls[i].sigma_m = sigmas[i].sigma_m;
    AssignSumSigmas(sigmas, storey);
  }
}

}  // namespace enfilade
