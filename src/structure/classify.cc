// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/classify.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/optim/ordered_labels.h"
#include "enfilade/scene/camera.h"
#include "enfilade/structure/level_panorama.h"
#include "src/structure/colour_model.h"

namespace enfilade {
namespace {

// In the order of a column from below.
constexpr int kFloor = 0, kWall = 1, kCeiling = 2, kNumLabels = 3;
constexpr int kUnknown = -1;
// What a label other than the seed's costs, times the most that colour may count.
constexpr double kSeedFactor = 20;
// Probability of a colour that no seed has, in all.
constexpr double kNewColour = 1e-5;
// A wall may stand a little before where free space seems to end.
constexpr double kClearShare = 0.9;
constexpr double kNearestWall_m = 0.3;

SurfaceLabel ToSurface(int label) {
  switch (label) {
    case kFloor:
      return SurfaceLabel::kFloor;
    case kWall:
      return SurfaceLabel::kWall;
    case kCeiling:
      return SurfaceLabel::kCeiling;
    default:
      return SurfaceLabel::kOther;
  }
}

int FromSurface(SurfaceLabel label) {
  switch (label) {
    case SurfaceLabel::kFloor:
      return kFloor;
    case SurfaceLabel::kWall:
      return kWall;
    case SurfaceLabel::kCeiling:
      return kCeiling;
    default:
      return kUnknown;
  }
}

// The value of a column of the panorama, of which there are `cols`, among any number of columns.
double AtColumn(const std::vector<double>& values, int column, int cols) {
  return values[static_cast<size_t>(column) * values.size() / static_cast<size_t>(cols)];
}

// What the columns of a panorama bound: the distance of the nearest wall, at the panorama's
// columns.
class Bounds {
 public:
  Bounds(const ClassifyView& view, const ClassifyOptions& options)
      : floor_m_(view.floor_m),
        ceiling_m_(view.ceiling_m),
        max_m_(options.max_distance_m),
        power_(options.beyond_power),
        rows_(view.superpixels.label.rows()) {
    const int cols = view.superpixels.label.cols();
    for (int c = 0; c < cols; ++c) {
      const double clear_m = view.clear_m.empty() ? 0 : AtColumn(view.clear_m, c, cols);
      if (!view.wall_m.empty()) wall_m_.push_back(AtColumn(view.wall_m, c, cols));
      clear_m_.push_back(std::clamp(kClearShare * clear_m, kNearestWall_m, 0.99 * max_m_));
      is_known_.push_back(clear_m > kNearestWall_m);
    }
    for (int r = 0; r < rows_; ++r) {
      const double tangent = std::tan(kPi * (0.5 - (r + 0.5) / rows_));
      reach_m_.push_back(tangent < 0 ? floor_m_ / -tangent : ceiling_m_ / tangent);
    }
  }

  // Where the pixel's ray meets the floor or the ceiling, horizontally.
  [[nodiscard]] double Reach(int row) const { return reach_m_[static_cast<size_t>(row)]; }
  [[nodiscard]] int LabelBelow(int row) const { return 2 * row >= rows_ ? kFloor : kCeiling; }

  // The label that a pixel surely has: floor or ceiling before the nearest wall, wall where neither
  // would be met before the farthest.
  [[nodiscard]] int Certain(int row, int col) const {
    if (Reach(row) >= max_m_) return kWall;
    const auto c = static_cast<size_t>(col);
    return is_known_[c] && Reach(row) <= clear_m_[c] ? LabelBelow(row) : kUnknown;
  }

  // Probability that a pixel shows the wall: that it stands nearer than where the ray meets floor
  // or ceiling.
  [[nodiscard]] double WallProbability(int row, int col) const {
    const auto c = static_cast<size_t>(col);
    const double ratio = clear_m_[c] / Reach(row);
    if (ratio >= 1) return 0;
    if (!wall_m_.empty()) return 1 / (1 + std::pow(wall_m_[c] / Reach(row), power_));
    return 1 - std::pow(ratio, is_known_[c] ? power_ : 1);
  }

 private:
  double floor_m_, ceiling_m_, max_m_, power_;
  int rows_;
  std::vector<double> clear_m_, wall_m_, reach_m_;
  std::vector<bool> is_known_;
};

// What is summed up over a superpixel's pixels.
struct Region {
  std::array<double, kNumLabels> certain_sr{};
  std::array<double, kNumLabels> probable_sr{};  // by elevation alone
  std::array<int, kNumLabels> num_points{};
  double seen_sr = 0, sr = 0;
  bool has_wall_before_end = false;
};

struct Border {
  double length = 0;   // in superpixels
  double lines = 0;    // of it that runs along lines
  double p_above = 0;  // of it that is level, p above q
  double q_above = 0;
};

// One panorama on its way through the stages.
class PanoramaClassifier {
 public:
  PanoramaClassifier(const ClassifyView& view, const ClassifyOptions& options)
      : view_(view),
        options_(options),
        label_(view.superpixels.label),
        bounds_(view, options),
        regions_(view.superpixels.pixels.size()),
        seed_(regions_.size(), kUnknown),
        point_seed_(regions_.size(), kUnknown) {
    ENFILADE_CHECK(view.floor_m > 0 && view.ceiling_m > 0);
    AddPixels();
    AddPoints();
    for (size_t i = 0; i < regions_.size(); ++i) {
      point_seed_[i] = PointSeed(regions_[i]);
      seed_[i] = SeedOf(regions_[i], point_seed_[i]);
      if (seed_[i] == kUnknown) continue;
      const Superpixel& pixel = view_.superpixels.pixels[i];
      colours_.Add(seed_[i], pixel.lab, regions_[i].seen_sr);
    }
  }

  [[nodiscard]] const ColourModel& colours() const { return colours_; }

  [[nodiscard]] Classification Solve(const ColourModel& home) {
    ColourModel own = colours_;
    own.Finish();
    Classification result;
    const std::vector<double> costs = Costs(own, home, result);
    const std::vector<LabelEdge> edges = Edges();
    const OrderedLabels found = FindOrderedLabels(costs, kNumLabels, edges);
    result.energy = found.energy;
    result.seed_energy = EnergyOfCheapest(costs, edges);
    result.num_superpixels = static_cast<int>(regions_.size());
    for (size_t i = 0; i < regions_.size(); ++i) {
      result.num_point_seeds += point_seed_[i] != kUnknown;
      result.num_free_seeds += point_seed_[i] == kUnknown && seed_[i] != kUnknown;
      result.num_contradictions += regions_[i].has_wall_before_end;
      if (seed_[i] != kUnknown) result.seed_sr[static_cast<size_t>(seed_[i])] += regions_[i].sr;
    }
    result.maps.after_points = Painted(point_seed_);
    result.maps.after_free_space = Painted(seed_);
    result.maps.final_labels = Painted(found.label);
    return result;
  }

 private:
  [[nodiscard]] double PixelAngle(int row) const {
    return 2 * kPi * kPi / label_.rows() / label_.cols() *
           std::cos(kPi * (0.5 - (row + 0.5) / label_.rows()));
  }

  void AddPixels() {
    for (int r = 0; r < label_.rows(); ++r) {
      const double sr = PixelAngle(r);
      const int below = bounds_.LabelBelow(r);
      for (int c = 0; c < label_.cols(); ++c) {
        Region& region = regions_[static_cast<size_t>(label_(r, c))];
        region.sr += sr;
        if (view_.is_seen.empty() || view_.is_seen(r, c) != 0) region.seen_sr += sr;
        const int certain = bounds_.Certain(r, c);
        if (certain != kUnknown) region.certain_sr[static_cast<size_t>(certain)] += sr;
        const double wall = bounds_.WallProbability(r, c);
        region.probable_sr[kWall] += wall * sr;
        region.probable_sr[static_cast<size_t>(below)] += (1 - wall) * sr;
      }
    }
  }

  void AddPoints() {
    for (const SeenPoint& point : view_.points) {
      const int label = FromSurface(point.label);
      if (label == kUnknown) continue;
      const auto [row, col] =
          LevelPixels{label_.rows(), label_.cols()}.At(point.direction.cast<double>());
      Region& region = regions_[static_cast<size_t>(label_(row, col))];
      ++region.num_points[static_cast<size_t>(label)];
    }
  }

  [[nodiscard]] int PointSeed(const Region& region) const {
    const auto most = std::max_element(region.num_points.begin(), region.num_points.end());
    const bool is_alone =
        std::count(region.num_points.begin(), region.num_points.end(), *most) == 1;
    if (*most < options_.min_seed_points || !is_alone) return kUnknown;
    return static_cast<int>(most - region.num_points.begin());
  }

  [[nodiscard]] int SeedOf(Region& region, int point_seed) const {
    for (const int label : {kFloor, kCeiling}) {
      if (region.certain_sr[static_cast<size_t>(label)] < options_.seed_share * region.sr) continue;
      region.has_wall_before_end = point_seed == kWall;
      return label;
    }
    if (point_seed != kUnknown) return point_seed;
    return region.certain_sr[kWall] > 0.99 * region.sr ? kWall : kUnknown;
  }

  // nodes × labels: minus log probability by colour and elevation, by the size of the superpixel.
  [[nodiscard]] std::vector<double> Costs(const ColourModel& own, const ColourModel& home,
                                          Classification& result) const {
    std::vector<double> costs;
    result.costs.resize(regions_.size());
    double mean_sr = 0;
    for (const Region& region : regions_)
      mean_sr += region.sr / static_cast<double>(regions_.size());
    for (size_t i = 0; i < regions_.size(); ++i) {
      const Region& region = regions_[i];
      std::array<double, kNumLabels> probability{};
      double sum = 0;
      for (int label = 0; label < kNumLabels; ++label) {
        const auto& lab = view_.superpixels.pixels[i].lab;
        const double colour = (1 - options_.home_share) * own.Density(label, lab) +
                              options_.home_share * home.Density(label, lab) + kNewColour;
        const double seen = region.seen_sr / region.sr;
        probability[static_cast<size_t>(label)] = (seen * colour + (1 - seen) * kNewColour) *
                                                  region.probable_sr[static_cast<size_t>(label)] /
                                                  region.sr;
        sum += probability[static_cast<size_t>(label)];
      }
      for (int label = 0; label < kNumLabels; ++label) {
        const double p = probability[static_cast<size_t>(label)] / sum;
        double cost = std::min(options_.max_cost, -std::log(std::max(p, 1e-12)));
        if (seed_[i] != kUnknown) cost = label == seed_[i] ? 0 : kSeedFactor * options_.max_cost;
        costs.push_back(cost * region.sr / mean_sr);
        result.costs[i][static_cast<size_t>(label)] =
            static_cast<float>(std::min(cost, options_.max_cost));
      }
    }
    return costs;
  }

  [[nodiscard]] double LineAt(int row, int col) const {
    if (view_.lines.empty()) return 0;
    const auto at = static_cast<int64_t>(col) * view_.lines.cols() / label_.cols();
    const auto line_row = static_cast<int64_t>(row) * view_.lines.rows() / label_.rows();
    return view_.lines(static_cast<int>(line_row), static_cast<int>(at)) / 255.0;
  }

  [[nodiscard]] std::map<std::pair<int, int>, Border> Borders() const {
    std::map<std::pair<int, int>, Border> borders;
    const double spacing = std::sqrt(4 * kPi / static_cast<double>(regions_.size()));
    const double height = kPi / label_.rows() / spacing;
    for (int r = 0; r < label_.rows(); ++r) {
      const double width =
          2 * kPi / label_.cols() / spacing * std::cos(kPi * (0.5 - (r + 1.0) / label_.rows()));
      for (int c = 0; c < label_.cols(); ++c) {
        const int p = label_(r, c);
        const int right = label_(r, c + 1 < label_.cols() ? c + 1 : 0);
        if (right != p) borders[std::minmax(p, right)].length += height;
        if (r + 1 == label_.rows()) continue;
        const int below = label_(r + 1, c);
        if (below == p) continue;
        Border& border = borders[std::minmax(p, below)];
        border.length += width;
        border.lines += width * std::max(LineAt(r, c), LineAt(r + 1, c));
        (p < below ? border.p_above : border.q_above) += width;
      }
    }
    return borders;
  }

  [[nodiscard]] double SquaredColourDistance(int p, int q) const {
    const auto& a = view_.superpixels.pixels[static_cast<size_t>(p)].lab;
    const auto& b = view_.superpixels.pixels[static_cast<size_t>(q)].lab;
    return std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2);
  }

  [[nodiscard]] std::vector<LabelEdge> Edges() const {
    const std::map<std::pair<int, int>, Border> borders = Borders();
    double mean = 1e-3;
    for (const auto& [pair, border] : borders)
      mean += SquaredColourDistance(pair.first, pair.second) / static_cast<double>(borders.size());
    std::vector<LabelEdge> edges;
    for (const auto& [pair, border] : borders) {
      const auto& [p, q] = pair;
      const double length = border.length - options_.line_discount * border.lines;
      const double smooth =
          options_.smoothness * length * std::exp(-0.5 * SquaredColourDistance(p, q) / mean);
      // p above q: q's label may not be the upper one.
      edges.push_back({p, q, smooth + options_.order_cost * border.q_above,
                       smooth + options_.order_cost * border.p_above});
    }
    return edges;
  }

  // The energy of the labels that each superpixel would have by itself.
  [[nodiscard]] static double EnergyOfCheapest(const std::vector<double>& costs,
                                               const std::vector<LabelEdge>& edges) {
    std::vector<int> label;
    double energy = 0;
    for (size_t i = 0; i < costs.size(); i += kNumLabels) {
      const auto first = costs.begin() + static_cast<std::ptrdiff_t>(i);
      const auto least = std::min_element(first, first + kNumLabels);
      label.push_back(static_cast<int>(least - first));
      energy += *least;
    }
    for (const LabelEdge& edge : edges) {
      const int steps = label[static_cast<size_t>(edge.p)] - label[static_cast<size_t>(edge.q)];
      energy += steps > 0 ? steps * edge.p_above : -steps * edge.q_above;
    }
    return energy;
  }

  [[nodiscard]] ImageU8 Painted(const std::vector<int>& label) const {
    ImageU8 map(label_.rows(), label_.cols());
    for (size_t i = 0; i < map.data().size(); ++i) {
      map.data()[i] = static_cast<uint8_t>(ToSurface(label[static_cast<size_t>(label_.data()[i])]));
    }
    return map;
  }

  const ClassifyView& view_;
  const ClassifyOptions& options_;
  const Image<int>& label_;
  Bounds bounds_;
  std::vector<Region> regions_;
  std::vector<int> seed_, point_seed_;
  ColourModel colours_;
};

// Sums of a column's costs from the top to each row, by label.
using CostSums = std::array<std::vector<double>, kNumLabels>;

// The columns [begin, end) of the panorama in the mean.
CostSums SumCosts(const Image<int>& label, const std::vector<std::array<float, 3>>& costs,
                  int begin, int end) {
  CostSums sums;
  const double step = kPi / label.rows() / (end - begin);
  for (int l = 0; l < kNumLabels; ++l) {
    std::vector<double>& sum = sums[static_cast<size_t>(l)];
    sum.assign(static_cast<size_t>(label.rows()) + 1, 0);
    for (int r = 0; r < label.rows(); ++r) {
      double cost = 0;
      for (int c = begin; c < end; ++c)
        cost += costs[static_cast<size_t>(label(r, c))][static_cast<size_t>(l)];
      sum[static_cast<size_t>(r) + 1] = sum[static_cast<size_t>(r)] + step * cost;
    }
  }
  return sums;
}

double AtRow(const std::vector<double>& sums, double row) {
  const double at = std::clamp(row, 0.0, static_cast<double>(sums.size()) - 1.001);
  const auto i = static_cast<size_t>(at);
  const double t = at - static_cast<double>(i);
  return (1 - t) * sums[i] + t * sums[i + 1];
}

}  // namespace

LabelMaps MapsInCamera(const LabelMaps& level, const Eigen::Matrix3d& home_from_cam) {
  const int rows = level.final_labels.rows(), cols = level.final_labels.cols();
  const Camera camera = EquirectangularCamera(cols, rows);
  const LevelPixels pixels{rows, cols};
  LabelMaps maps{ImageU8(rows, cols), ImageU8(rows, cols), ImageU8(rows, cols)};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const auto [row, col] = pixels.At(home_from_cam * camera.RayFromPixel({c + 0.5, r + 0.5}));
      maps.after_points(r, c) = level.after_points(row, col);
      maps.after_free_space(r, c) = level.after_free_space(row, col);
      maps.final_labels(r, c) = level.final_labels(row, col);
    }
  }
  return maps;
}

ColumnScores ScoreLabels(const ClassifyView& view, const Classification& labels, int num_columns,
                         const DistanceBins& bins, double max_loss) {
  const Image<int>& label = view.superpixels.label;
  const auto column = [&](int c) {
    return static_cast<int>(static_cast<int64_t>(c) * label.cols() / num_columns);
  };
  ImageF scores(num_columns, bins.count);
  const auto row_at = [&](double height_m, double distance_m) {
    return label.rows() * (0.5 - std::atan(height_m / distance_m) / kPi);
  };
  for (int c = 0; c < num_columns; ++c) {
    const CostSums sums =
        SumCosts(label, labels.costs, column(c), std::max(column(c + 1), column(c) + 1));
    for (int b = 0; b < bins.count; ++b) {
      const double top = row_at(view.ceiling_m, bins.Distance(b)),
                   foot = row_at(-view.floor_m, bins.Distance(b));
      scores(c, b) = static_cast<float>(-AtRow(sums[kCeiling], top) -
                                        (AtRow(sums[kWall], foot) - AtRow(sums[kWall], top)) -
                                        (sums[kFloor].back() - AtRow(sums[kFloor], foot)));
    }
    float* row = scores.row(c);
    const float most = *std::max_element(row, row + bins.count);
    for (int b = 0; b < bins.count; ++b)
      row[b] = std::max(row[b] - most, -static_cast<float>(max_loss));
  }
  ColumnScores result;
  result.family.assign(kNumFamilies, scores);
  return result;
}

std::vector<Classification> ClassifyPanoramas(const std::vector<ClassifyView>& views,
                                              const ClassifyOptions& options, RunContext& context) {
  std::vector<std::unique_ptr<PanoramaClassifier>> classifiers(views.size());
  const auto count = static_cast<int64_t>(views.size());
  ParallelFor(context, "seeds", count, [&](int64_t i) {
    const auto v = static_cast<size_t>(i);
    classifiers[v] = std::make_unique<PanoramaClassifier>(views[v], options);
  });
  ColourModel home;
  for (const auto& classifier : classifiers) home.Add(classifier->colours());
  home.Finish();
  std::vector<Classification> results(views.size());
  ParallelFor(context, "classification", count, [&](int64_t i) {
    const auto v = static_cast<size_t>(i);
    results[v] = classifiers[v]->Solve(home);
  });
  return results;
}

}  // namespace enfilade
