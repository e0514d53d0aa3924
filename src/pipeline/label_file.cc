// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/label_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "enfilade/base/errors.h"
#include "enfilade/image/codec.h"
#include "enfilade/scene/surface_label.h"
#include "enfilade/structure/label_tint.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

struct Stage {
  std::string_view name;
  ImageU8 LabelMaps::*map;
};
constexpr std::array<Stage, 3> kStages = {{{"points", &LabelMaps::after_points},
                                           {"free_space", &LabelMaps::after_free_space},
                                           {"final", &LabelMaps::final_labels}}};
constexpr int kJpegQuality = 85;

fs::path MapFile(const fs::path& folder, int view_idx, std::string_view stage) {
  return folder / fmt::format("labels_{:04}_{}.png", view_idx, stage);
}

}  // namespace

void WriteLabelMaps(const fs::path& folder, int view_idx, const LabelMaps& maps) {
  for (const Stage& stage : kStages)
    WriteImage(MapFile(folder, view_idx, stage.name), maps.*stage.map);
}

std::optional<LabelMaps> ReadLabelMaps(const fs::path& folder, int view_idx) {
  if (!fs::exists(MapFile(folder, view_idx, kStages.back().name))) return std::nullopt;
  LabelMaps maps;
  for (const Stage& stage : kStages) {
    const fs::path file = MapFile(folder, view_idx, stage.name);
    ImageU8& map = maps.*stage.map;
    map = ReadImageGray(file);
    const ImageU8& first = maps.*kStages.front().map;
    const bool has_shape = map.rows() == first.rows() && map.cols() == 2 * map.rows();
    if (!has_shape || std::any_of(map.data().begin(), map.data().end(), [](uint8_t value) {
          return value >= EnumNames(SurfaceLabel()).size();
        })) {
      throw InvalidInputError(file.native(), "is no label map of this panorama",
                              "run 'enfilade structure OUT' again");
    }
  }
  return maps;
}

void WriteLabelPicture(const fs::path& folder, int view_idx, const LabelMaps& maps,
                       const ImageU8& picture) {
  const int rows = maps.final_labels.rows(), cols = maps.final_labels.cols();
  ImageU8 sheet(static_cast<int>(kStages.size()) * rows, cols, 3);
  for (size_t k = 0; k < kStages.size(); ++k) {
    const ImageU8 tinted = TintByLabels(picture, maps.*kStages[k].map);
    std::copy(tinted.data().begin(), tinted.data().end(), sheet.row(static_cast<int>(k) * rows));
  }
  WriteImage(folder / fmt::format("labels_{:04}.jpg", view_idx), sheet, kJpegQuality);
}

}  // namespace enfilade
