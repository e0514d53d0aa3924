// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/superpixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

struct Center {
  float x = 0, y = 0, z = 0;  // direction
  float l = 0, a = 0, b = 0;
};

// Sums over pixels, weighed by solid angle.
struct Sums {
  double x = 0, y = 0, z = 0, l = 0, a = 0, b = 0, weight = 0;

  void Add(const Sums& other) {
    x += other.x, y += other.y, z += other.z;
    l += other.l, a += other.a, b += other.b;
    weight += other.weight;
  }
};

Center MeanOf(const Sums& sums) {
  const double norm = std::max(1e-12, std::hypot(sums.x, sums.y, sums.z));
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(sums.x / norm),        f(sums.y / norm),        f(sums.z / norm),
          f(sums.l / sums.weight), f(sums.a / sums.weight), f(sums.b / sums.weight)};
}

// The panorama in CIELAB, a plane a channel, and the directions of its rows and columns.
class Sphere {
 public:
  explicit Sphere(const ImageU8& rgb)
      : rows_(rgb.rows()), cols_(rgb.cols()), l_(rows_, cols_), a_(rows_, cols_), b_(rows_, cols_) {
    const cv::Mat in(rows_, cols_, CV_8UC3, const_cast<uint8_t*>(rgb.data().data()));
    cv::Mat scaled, lab;
    in.convertTo(scaled, CV_32F, 1.0 / 255);
    cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
    cv::Mat planes[] = {cv::Mat(rows_, cols_, CV_32F, l_.data().data()),
                        cv::Mat(rows_, cols_, CV_32F, a_.data().data()),
                        cv::Mat(rows_, cols_, CV_32F, b_.data().data())};
    cv::split(lab, planes);
    for (int r = 0; r < rows_; ++r) {
      const double elevation = kPi * (0.5 - (r + 0.5) / rows_);
      sin_elevation_.push_back(static_cast<float>(std::sin(elevation)));
      cos_elevation_.push_back(static_cast<float>(std::cos(elevation)));
    }
    for (int c = 0; c < cols_; ++c) {
      const double azimuth = 2 * kPi * (c + 0.5) / cols_ - kPi;
      cos_azimuth_.push_back(static_cast<float>(std::cos(azimuth)));
      sin_azimuth_.push_back(static_cast<float>(std::sin(azimuth)));
    }
  }

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] double PixelAngle(int row) const {
    return 2 * kPi * kPi / rows_ / cols_ * cos_elevation_[static_cast<size_t>(row)];
  }
  [[nodiscard]] Sums At(int r, int c) const {
    const auto row = static_cast<size_t>(r), col = static_cast<size_t>(c);
    const double w = PixelAngle(r), level = w * cos_elevation_[row];
    return {level * cos_azimuth_[col],
            level * sin_azimuth_[col],
            w * sin_elevation_[row],
            w * l_(r, c),
            w * a_(r, c),
            w * b_(r, c),
            w};
  }
  // Compares the pixels [begin, end) of a row with a centre: squared difference of colour and
  // `weight` times half the squared chord. Where it is the least so far, `label` becomes `id`.
  void Compare(int r, int begin, int end, const Center& center, float weight, int id, float* least,
               int* label) const {
    const auto row = static_cast<size_t>(r);
    const float* l = l_.row(r);
    const float* a = a_.row(r);
    const float* b = b_.row(r);
    const float x = weight * cos_elevation_[row] * center.x,
                y = weight * cos_elevation_[row] * center.y,
                z = weight * (1 - sin_elevation_[row] * center.z);
    for (int c = begin; c < end; ++c) {
      const float dl = l[c] - center.l, da = a[c] - center.a, db = b[c] - center.b;
      const float cost = dl * dl + da * da + db * db + z -
                         x * cos_azimuth_[static_cast<size_t>(c)] -
                         y * sin_azimuth_[static_cast<size_t>(c)];
      const bool is_less = cost < least[c];
      least[c] = is_less ? cost : least[c];
      label[c] = is_less ? id : label[c];
    }
  }

 private:
  int rows_, cols_;
  ImageF l_, a_, b_;
  std::vector<float> sin_elevation_, cos_elevation_, cos_azimuth_, sin_azimuth_;
};

// Columns [begin, end) that are a seed's place in its band.
struct Place {
  int begin = 0, end = 0, seed = 0;
};

struct Band {
  int first = 0, size = 0;    // of its seeds
  std::vector<Place> places;  // all columns in order; the seed across the seam has two
};

// Bands of equal height from the top to the bottom, with seeds at equal spacing on the sphere.
class SeedBands {
 public:
  SeedBands(int rows, int cols, int count) : rows_(rows) {
    spacing_rad_ = std::sqrt(4 * kPi / count);
    const int num_bands = std::max(1, static_cast<int>(std::lround(kPi / spacing_rad_)));
    for (int i = 0; i < num_bands; ++i) {
      const double elevation = kPi * (0.5 - (i + 0.5) / num_bands);
      const auto size = std::lround(2 * kPi * std::cos(elevation) / spacing_rad_);
      AddBand(std::clamp(static_cast<int>(size), 1, cols), cols);
    }
  }

  [[nodiscard]] double spacing_rad() const { return spacing_rad_; }
  [[nodiscard]] int num_seeds() const { return num_seeds_; }
  [[nodiscard]] int size() const { return static_cast<int>(bands_.size()); }
  [[nodiscard]] const Band& band(int i) const { return bands_[static_cast<size_t>(i)]; }
  [[nodiscard]] int BandOfRow(int row) const { return std::min(size() - 1, row * size() / rows_); }

 private:
  void AddBand(int num_seeds, int cols) {
    // Each band starts elsewhere: nowhere do their places end in one line.
    constexpr double kGolden = 0.6180339887498949;
    const double shift = std::fmod(kGolden * static_cast<double>(bands_.size()), 1);
    Band band{num_seeds_, num_seeds, {}};
    for (int c = 0; c < cols; ++c) {
      const int seed =
          static_cast<int>(static_cast<double>(c) * num_seeds / cols + shift) % num_seeds;
      if (band.places.empty() || band.places.back().seed != seed)
        band.places.push_back({c, c, seed});
      band.places.back().end = c + 1;
    }
    bands_.push_back(std::move(band));
    num_seeds_ += num_seeds;
  }

  int rows_;
  double spacing_rad_ = 0;
  int num_seeds_ = 0;
  std::vector<Band> bands_;
};

// Gives every pixel of a row the best of the nine seeds about its place.
void AssignRow(const Sphere& sphere, const SeedBands& bands, const std::vector<Center>& centers,
               float weight, int row, std::vector<float>& least, Image<int>& label) {
  std::fill(least.begin(), least.end(), std::numeric_limits<float>::infinity());
  const int own = bands.BandOfRow(row);
  for (int i = std::max(0, own - 1); i <= std::min(bands.size() - 1, own + 1); ++i) {
    const Band& band = bands.band(i);
    const int reach = band.size < 3 ? band.size / 2 : 1;
    for (const Place& place : band.places) {
      for (int k = -reach; k <= reach; ++k) {
        const int id = band.first + (place.seed + k + band.size) % band.size;
        sphere.Compare(row, place.begin, place.end, centers[static_cast<size_t>(id)], weight, id,
                       least.data(), label.row(row));
      }
    }
  }
}

// Every pixel with the seed in whose place it lies.
Image<int> PlacesOfSeeds(const SeedBands& bands, int rows, int cols) {
  Image<int> label(rows, cols);
  for (int r = 0; r < rows; ++r) {
    const Band& band = bands.band(bands.BandOfRow(r));
    for (const Place& place : band.places)
      std::fill(label.row(r) + place.begin, label.row(r) + place.end, band.first + place.seed);
  }
  return label;
}

std::vector<Sums> SumsOf(const Sphere& sphere, const Image<int>& label, int count) {
  std::vector<Sums> sums(static_cast<size_t>(count));
  for (int r = 0; r < label.rows(); ++r) {
    for (int c = 0; c < label.cols(); ++c)
      sums[static_cast<size_t>(label(r, c))].Add(sphere.At(r, c));
  }
  return sums;
}

std::vector<Center> MoveCenters(const Sphere& sphere, const Image<int>& label,
                                std::vector<Center> centers) {
  const std::vector<Sums> sums = SumsOf(sphere, label, static_cast<int>(centers.size()));
  for (size_t i = 0; i < centers.size(); ++i) {
    if (sums[i].weight > 0) centers[i] = MeanOf(sums[i]);
  }
  return centers;
}

// Numbers the connected pieces of equal labels (4 neighbours, round the azimuth) in the order of
// their first pixels; returns how many there are.
int NumberPieces(Image<int>& label) {
  const int rows = label.rows(), cols = label.cols();
  Image<int> piece(rows, cols, 1, -1);
  std::vector<std::pair<int, int>> stack;
  int count = 0;
  for (int r0 = 0; r0 < rows; ++r0) {
    for (int c0 = 0; c0 < cols; ++c0) {
      if (piece(r0, c0) >= 0) continue;
      piece(r0, c0) = count;
      stack.assign(1, {r0, c0});
      while (!stack.empty()) {
        const auto [r, c] = stack.back();
        stack.pop_back();
        const std::pair<int, int> around[] = {
            {r - 1, c}, {r + 1, c}, {r, c > 0 ? c - 1 : cols - 1}, {r, c + 1 < cols ? c + 1 : 0}};
        for (const auto& [i, j] : around) {
          if (i < 0 || i >= rows || piece(i, j) >= 0 || label(i, j) != label(r0, c0)) continue;
          piece(i, j) = count;
          stack.emplace_back(i, j);
        }
      }
      ++count;
    }
  }
  label = std::move(piece);
  return count;
}

double SquaredColourDistance(const Sums& p, const Sums& q) {
  const Center a = MeanOf(p), b = MeanOf(q);
  const double dl = a.l - b.l, da = a.a - b.a, db = a.b - b.b;
  return dl * dl + da * da + db * db;
}

// Which pieces touch: pairs (low, high), sorted, each once.
std::vector<std::pair<int, int>> TouchingPieces(const Image<int>& label) {
  std::vector<std::pair<int, int>> pairs;
  const auto add = [&](int p, int q) {
    if (p != q) pairs.emplace_back(std::min(p, q), std::max(p, q));
  };
  const int rows = label.rows(), cols = label.cols();
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      add(label(r, c), label(r, c + 1 < cols ? c + 1 : 0));
      if (r + 1 < rows) add(label(r, c), label(r + 1, c));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// Lets pieces smaller than `min_sr`, the smallest first, join the touching piece of the most
// similar colour. Returns the piece that each has become part of.
std::vector<int> JoinSmallPieces(const Image<int>& label, std::vector<Sums> sums, double min_sr) {
  std::vector<std::vector<int>> touching(sums.size());
  for (const auto& [p, q] : TouchingPieces(label)) {
    touching[static_cast<size_t>(p)].push_back(q);
    touching[static_cast<size_t>(q)].push_back(p);
  }
  std::vector<int> part_of(sums.size());
  std::iota(part_of.begin(), part_of.end(), 0);
  const auto find = [&](int piece) {
    while (part_of[static_cast<size_t>(piece)] != piece)
      piece = part_of[static_cast<size_t>(piece)];
    return piece;
  };
  std::vector<int> order = part_of;
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) {
    return sums[static_cast<size_t>(p)].weight < sums[static_cast<size_t>(q)].weight;
  });
  for (const int piece : order) {
    const auto p = static_cast<size_t>(piece);
    if (find(piece) != piece || sums[p].weight >= min_sr) continue;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int other : touching[p]) {
      const int root = find(other);
      if (root == piece) continue;
      const double distance = SquaredColourDistance(sums[p], sums[static_cast<size_t>(root)]);
      if (distance < least) {
        least = distance;
        best = root;
      }
    }
    if (best < 0) continue;
    const auto b = static_cast<size_t>(best);
    part_of[p] = best;
    sums[b].Add(sums[p]);
    touching[b].insert(touching[b].end(), touching[p].begin(), touching[p].end());
  }
  for (int& piece : part_of) piece = find(piece);
  return part_of;
}

}  // namespace

Superpixels MakeSuperpixels(const ImageU8& panorama, const SuperpixelOptions& options) {
  ENFILADE_CHECK(panorama.channels() == 3 && panorama.rows() > 0 &&
                 panorama.cols() == 2 * panorama.rows());
  const Sphere sphere(panorama);
  const int rows = sphere.rows(), cols = sphere.cols();
  const SeedBands bands(rows, cols, options.count);
  // Half the squared chord between the places of two neighbours is worth the compactness.
  const auto weight = static_cast<float>(2 * options.compactness * options.compactness /
                                         (bands.spacing_rad() * bands.spacing_rad()));
  Superpixels result;
  result.label = PlacesOfSeeds(bands, rows, cols);
  std::vector<Center> centers(static_cast<size_t>(bands.num_seeds()));
  std::vector<float> least(static_cast<size_t>(cols));
  for (int i = 0; i < options.num_iterations; ++i) {
    centers = MoveCenters(sphere, result.label, std::move(centers));
    for (int r = 0; r < rows; ++r)
      AssignRow(sphere, bands, centers, weight, r, least, result.label);
  }
  const int num_pieces = NumberPieces(result.label);
  const double min_sr = options.min_share * 4 * kPi / bands.num_seeds();
  const std::vector<int> part_of =
      JoinSmallPieces(result.label, SumsOf(sphere, result.label, num_pieces), min_sr);
  for (int& label : result.label.data()) label = part_of[static_cast<size_t>(label)];
  const int count = NumberPieces(result.label);
  for (const Sums& sums : SumsOf(sphere, result.label, count)) {
    const Center mean = MeanOf(sums);
    result.pixels.push_back(
        {{mean.l, mean.a, mean.b}, {mean.x, mean.y, mean.z}, static_cast<float>(sums.weight)});
  }
  return result;
}

}  // namespace enfilade
