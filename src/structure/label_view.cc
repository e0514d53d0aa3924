// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/structure/label_view.h"

#include <algorithm>
#include <cmath>

#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

// The mean over blocks of factor × factor pixels.
ImageU8 Reduced(const ImageU8& picture, int factor) {
  if (factor == 1) return picture;
  ImageU8 reduced(picture.rows() / factor, picture.cols() / factor, picture.channels());
  for (int r = 0; r < reduced.rows(); ++r) {
    for (int c = 0; c < reduced.cols(); ++c) {
      for (int k = 0; k < picture.channels(); ++k) {
        int sum = 0;
        for (int i = 0; i < factor; ++i) {
          for (int j = 0; j < factor; ++j) sum += picture(r * factor + i, c * factor + j, k);
        }
        reduced(r, c, k) = static_cast<uint8_t>((sum + factor * factor / 2) / (factor * factor));
      }
    }
  }
  return reduced;
}

// The largest whole number by which rows and columns can be divided without going below the width.
int FactorFor(const ImageU8& picture, int width) {
  int factor = std::max(1, picture.cols() / width);
  while (picture.rows() % factor != 0 || picture.cols() % factor != 0) --factor;
  return factor;
}

}  // namespace

ClassifyView MakeLabelView(const LevelPanorama& panorama, const LineResponse& lines,
                           const ClassifyOptions& options) {
  const int factor = FactorFor(panorama.rgb, options.width);
  ClassifyView view;
  view.superpixels = MakeSuperpixels(Reduced(panorama.rgb, factor), options.superpixels);
  view.is_seen = Reduced(panorama.is_seen, factor);
  view.lines = lines.family[0];
  for (size_t i = 0; i < view.lines.data().size(); ++i)
    view.lines.data()[i] = std::max(view.lines.data()[i], lines.family[1].data()[i]);
  return view;
}

std::vector<double> ClearDistances(const EvidenceGrids& evidence, const Eigen::Vector2d& camera,
                                   int num_columns) {
  const GridFrame& frame = evidence.frame;
  const double step_m = 0.5 * frame.cell_m;
  std::vector<double> distances;
  for (int c = 0; c < num_columns; ++c) {
    const double azimuth = AzimuthOfColumn(c, num_columns);
    const Eigen::Vector2d ray(std::cos(azimuth), std::sin(azimuth));
    int num_steps = 0;
    while (true) {
      const Eigen::Vector2d p = camera + num_steps * step_m * ray;
      const int row = frame.Row(p.y()), col = frame.Col(p.x());
      if (!frame.IsInside(row, col) || evidence.core(row, col) == 0) break;
      ++num_steps;
    }
    distances.push_back(num_steps * step_m);
  }
  return distances;
}

}  // namespace enfilade
