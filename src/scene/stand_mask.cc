// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/stand_mask.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/image/codec.h"

namespace enfilade {
namespace {

constexpr int kWorkingRows = 256;
constexpr double kReferenceTop = 0.70;  // −36° elevation
constexpr double kSearchTop = 5.0 / 6;  // −60°

// Grey levels per two pixels at which a gradient counts half: weaker ones are noise, and no strong
// one (sun on the floor of one picture) outweighs the rest.
constexpr float kHalfGradient = 8;

// Mean brightness in blocks of `factor` × `factor` pixels.
ImageF ShrinkToGray(const ImageU8& image, int factor) {
  ImageF gray(image.rows() / factor, image.cols() / factor);
  const int block_values = factor * image.channels();
  for (int r = 0; r < gray.rows(); ++r) {
    for (int c = 0; c < gray.cols(); ++c) {
      int sum = 0;
      for (int y = 0; y < factor; ++y) {
        const uint8_t* values = image.row(r * factor + y) + c * block_values;
        for (int k = 0; k < block_values; ++k) sum += values[k];
      }
      gray(r, c) = static_cast<float>(sum) / static_cast<float>(factor * block_values);
    }
  }
  return gray;
}

// Sums over one row: |mean gradient|² and mean |gradient|² over the pictures.
struct RowSums {
  double of_mean = 0;
  double of_each = 0;
};

RowSums SumRow(const std::vector<ImageF>& grays, int row) {
  const int cols = grays[0].cols();
  const double n = static_cast<double>(grays.size());
  RowSums sums;
  for (int c = 0; c < cols; ++c) {
    const int left = c > 0 ? c - 1 : cols - 1, right = c + 1 < cols ? c + 1 : 0;
    double sum_x = 0, sum_y = 0;
    for (const ImageF& gray : grays) {
      const float x = gray(row, right) - gray(row, left);
      const float y = gray(row + 1, c) - gray(row - 1, c);
      const float weight = 1 / (std::hypot(x, y) + kHalfGradient);
      sum_x += weight * x;
      sum_y += weight * y;
      sums.of_each += (weight * x * weight * x + weight * y * weight * y) / n;
    }
    sums.of_mean += (sum_x * sum_x + sum_y * sum_y) / (n * n);
  }
  return sums;
}

// Agreement of the pictures' gradients a row, pooled over three rows: 0 expected where they are
// independent, 1 where they are the same. NaN outside [first_row, rows − 1).
std::vector<double> Agreement(const std::vector<ImageF>& grays, int first_row) {
  const int rows = grays[0].rows();
  const double n = static_cast<double>(grays.size());
  std::vector<RowSums> sums(static_cast<size_t>(rows));
  for (int r = first_row - 1; r + 1 < rows; ++r) sums[static_cast<size_t>(r)] = SumRow(grays, r);
  std::vector<double> agreement(static_cast<size_t>(rows), std::nan(""));
  for (size_t r = static_cast<size_t>(first_row); r + 1 < sums.size(); ++r) {
    const double of_mean = sums[r - 1].of_mean + sums[r].of_mean + sums[r + 1].of_mean;
    const double of_each = sums[r - 1].of_each + sums[r].of_each + sums[r + 1].of_each;
    agreement[r] = of_each > 0 ? (n * of_mean / of_each - 1) / (n - 1) : 0;
  }
  return agreement;
}

// The first row of the stand's body; none when the rows above agree as well or nothing does.
std::optional<int> FirstRowOfBody(const std::vector<double>& agreement, size_t num_pictures) {
  // Stands give 0.2 to 1. By chance three pictures agree up to 0.12, many hardly ever.
  const double min_agreement = 0.15 + 0.3 / static_cast<double>(num_pictures);
  constexpr double kNumSigma = 4;
  const int rows = static_cast<int>(agreement.size());
  const int reference_top = static_cast<int>(std::ceil(kReferenceTop * rows));
  const int search_top = static_cast<int>(std::ceil(kSearchTop * rows));
  double mean = 0, square = 0;
  for (int r = reference_top; r < search_top; ++r) {
    mean += agreement[static_cast<size_t>(r)] / (search_top - reference_top);
    square += std::pow(agreement[static_cast<size_t>(r)], 2) / (search_top - reference_top);
  }
  if (mean > min_agreement) return std::nullopt;
  const double sigma = std::sqrt(std::max(0.0, square - mean * mean));
  const double threshold = std::max(min_agreement, mean + kNumSigma * sigma);
  for (int r = search_top; r + 1 < rows; ++r) {
    if (agreement[static_cast<size_t>(r)] >= threshold) return r;
  }
  return std::nullopt;
}

// The views whose pictures may tell where the stand is: panoramas of the most common size.
std::vector<const View*> ComparableViews(const Scene& scene) {
  std::map<std::pair<int, int>, std::vector<const View*>> views_of_size;
  for (const View& view : scene.views) {
    if (view.camera.model != CameraModel::kEquirectangular || !view.mask_path.empty()) continue;
    views_of_size[{view.camera.width, view.camera.height}].push_back(&view);
  }
  std::vector<const View*> most;
  for (auto& [size, views] : views_of_size) {
    if (views.size() > most.size()) most = std::move(views);
  }
  return most;
}

ImageU8 ReadMask(const View& view) {
  ImageU8 mask = ReadImageGray(view.mask_path);
  if (mask.rows() != view.camera.height || mask.cols() != view.camera.width) {
    throw InvalidInputError(view.mask_path.native(), "is not of the size of " + view.picture,
                            "give masks of the pictures' size");
  }
  for (uint8_t& value : mask.data()) value = value > 0 ? 255 : 0;
  return mask;
}

}  // namespace

int Stand::NumTrustedRows(int rows) const {
  return std::clamp(static_cast<int>(std::floor((1 - masked_share) * rows)), 0, rows);
}

Stand FindStand(std::span<const ImageU8> panoramas, const StandOptions& options) {
  const Stand assumed{options.default_share, false};
  if (static_cast<int>(panoramas.size()) < std::max(2, options.min_pictures)) return assumed;
  const int rows = panoramas[0].rows(), cols = panoramas[0].cols();
  ENFILADE_CHECK(rows >= 64 && cols >= 64);
  const int factor = std::max(1, rows / kWorkingRows);

  std::vector<ImageF> grays;
  for (const ImageU8& panorama : panoramas) {
    ENFILADE_CHECK(panorama.rows() == rows && panorama.cols() == cols);
    grays.push_back(ShrinkToGray(panorama, factor));
  }
  const int working_rows = grays[0].rows();
  const int first_row = static_cast<int>(std::ceil(kReferenceTop * working_rows));
  const std::optional<int> body = FirstRowOfBody(Agreement(grays, first_row), grays.size());
  if (!body) return assumed;
  const double body_share = 1 - static_cast<double>(*body) / working_rows;
  return {std::min(0.5, body_share + options.margin_share), true};
}

Stand FindStandOfScene(const Scene& scene, const StandOptions& options, RunContext& context) {
  constexpr size_t kMaxPictures = 8;
  const std::vector<const View*> views = ComparableViews(scene);
  const size_t num_pictures = std::min(views.size(), kMaxPictures);
  if (static_cast<int>(num_pictures) < options.min_pictures) return {options.default_share, false};
  std::vector<ImageU8> panoramas(num_pictures);
  ParallelFor(context, "camera's stand", static_cast<int64_t>(num_pictures), [&](int64_t i) {
    const size_t view_idx = static_cast<size_t>(i) * views.size() / num_pictures;
    panoramas[static_cast<size_t>(i)] = ReadImageRgb(views[view_idx]->path);
  });
  return FindStand(panoramas, options);
}

ImageU8 TrustedPixels(const View& view, const Stand& stand) {
  if (!view.mask_path.empty()) return ReadMask(view);
  ImageU8 mask(view.camera.height, view.camera.width, 1, 255);
  if (view.camera.model != CameraModel::kEquirectangular) return mask;
  for (int r = stand.NumTrustedRows(mask.rows()); r < mask.rows(); ++r) {
    std::fill_n(mask.row(r), mask.cols(), uint8_t{0});
  }
  return mask;
}

}  // namespace enfilade
