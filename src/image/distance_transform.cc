// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/distance_transform.h"

#include <cmath>
#include <limits>

namespace enfilade {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// One-dimensional squared distance transform: out[q] = min_p (q − p)² + f[p], as the lower envelope
// of parabolas. `parabola` and `start` are scratch of size n and n + 1.
void TransformLine(const std::vector<double>& f, std::vector<double>& out,
                   std::vector<int>& parabola, std::vector<double>& start) {
  const int n = static_cast<int>(f.size());
  int count = 0;
  for (int q = 0; q < n; ++q) {
    if (f[q] == kFar) continue;
    double s = -kFar;
    while (count > 0) {
      const int p = parabola[count - 1];
      s = ((f[q] + double(q) * q) - (f[p] + double(p) * p)) / (2.0 * (q - p));
      if (s > start[count - 1]) break;
      --count;
    }
    start[count] = count == 0 ? -kFar : s;
    parabola[count++] = q;
  }
  if (count == 0) {
    out = f;
    return;
  }
  for (int q = 0, k = 0; q < n; ++q) {
    while (k + 1 < count && start[k + 1] < q) ++k;
    const int p = parabola[k];
    out[q] = double(q - p) * (q - p) + f[p];
  }
}

// Runs TransformLine along the columns, then along the rows, of 0 / infinity costs.
ImageF TransformImage(const ImageU8& mask) {
  const int rows = mask.rows(), cols = mask.cols();
  Image<double> squared(rows, cols);
  std::vector<double> f, out, start(static_cast<size_t>(std::max(rows, cols)) + 1);
  std::vector<int> parabola(static_cast<size_t>(std::max(rows, cols)));

  f.resize(static_cast<size_t>(rows));
  out.resize(f.size());
  for (int c = 0; c < cols; ++c) {
    for (int r = 0; r < rows; ++r) f[r] = mask(r, c) != 0 ? 0.0 : kFar;
    TransformLine(f, out, parabola, start);
    for (int r = 0; r < rows; ++r) squared(r, c) = out[r];
  }
  ImageF distance(rows, cols);
  f.resize(static_cast<size_t>(cols));
  out.resize(f.size());
  for (int r = 0; r < rows; ++r) {
    f.assign(squared.row(r), squared.row(r) + cols);
    TransformLine(f, out, parabola, start);
    for (int c = 0; c < cols; ++c) {
      distance(r, c) = static_cast<float>(std::sqrt(out[c]));
    }
  }
  return distance;
}

}  // namespace

ImageF DistanceToMask(const ImageU8& mask) {
  ENFILADE_CHECK(mask.channels() == 1);
  return TransformImage(mask);
}

ImageU8 ErodeByDisc(const ImageU8& mask, double radius_px) {
  // A zero ring round the picture stands for the outside.
  ImageU8 outside(mask.rows() + 2, mask.cols() + 2, 1, 1);
  for (int r = 0; r < mask.rows(); ++r) {
    for (int c = 0; c < mask.cols(); ++c) outside(r + 1, c + 1) = mask(r, c) == 0;
  }
  const ImageF distance = DistanceToMask(outside);
  ImageU8 eroded(mask.rows(), mask.cols());
  for (int r = 0; r < mask.rows(); ++r) {
    for (int c = 0; c < mask.cols(); ++c) eroded(r, c) = distance(r + 1, c + 1) > radius_px;
  }
  return eroded;
}

ImageU8 DilateByDisc(const ImageU8& mask, double radius_px) {
  const ImageF distance = DistanceToMask(mask);
  ImageU8 dilated(mask.rows(), mask.cols());
  for (size_t i = 0; i < dilated.data().size(); ++i)
    dilated.data()[i] = distance.data()[i] <= radius_px;
  return dilated;
}

ImageU8 OpenByDisc(const ImageU8& mask, double radius_px) {
  return DilateByDisc(ErodeByDisc(mask, radius_px), radius_px);
}

}  // namespace enfilade
