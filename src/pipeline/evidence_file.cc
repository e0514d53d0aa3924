// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/evidence_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/image/codec.h"
#include "src/pipeline/binary_file.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "enfilade-evidence";
constexpr std::string_view kGridMagic = "ENFGRID1";
constexpr int kVersion = 1;
constexpr int kMaxStoreys = 1000;
constexpr int kMaxCells = 1 << 16;  // along one side
constexpr int kMaxViews = 1 << 20;
// Up to so many cores a cell's takes one byte, else two.
constexpr int kMaxByteCores = 255, kMaxCores = 65535;
constexpr int kLastMode = static_cast<int>(EvidenceMode::kCounts);

fs::path StoreyFile(const fs::path& folder, size_t storey_idx, std::string_view ending) {
  return folder / fmt::format("storey_{}{}", storey_idx, ending);
}

void WriteGrids(const fs::path& path, const EvidenceGrids& grids) {
  const GridFrame& frame = grids.frame;
  const auto has_shape = [&](const auto& image) {
    return image.rows() == frame.rows && image.cols() == frame.cols && image.channels() == 1;
  };
  ENFILADE_CHECK(has_shape(grids.wall) && has_shape(grids.free) && has_shape(grids.support) &&
                 has_shape(grids.core));
  BinaryWriter writer(kGridMagic, kVersion);
  writer.Add(frame.origin.x());
  writer.Add(frame.origin.y());
  writer.Add(frame.cell_m);
  writer.Add(static_cast<int32_t>(frame.rows));
  writer.Add(static_cast<int32_t>(frame.cols));
  writer.Add(static_cast<int32_t>(grids.mode));
  writer.Add(static_cast<int32_t>(grids.num_cores));
  writer.Add(static_cast<int32_t>(grids.cameras.size()));
  for (const EvidenceCamera& camera : grids.cameras) {
    writer.Add(static_cast<int32_t>(camera.view_idx));
    writer.Add(camera.position.x());
    writer.Add(camera.position.y());
  }
  writer.AddArray(std::span(grids.wall.data()));
  writer.AddArray(std::span(grids.free.data()));
  writer.AddArray(std::span(grids.support.data()));
  if (grids.num_cores <= kMaxByteCores) {
    const std::vector<uint8_t> core(grids.core.data().begin(), grids.core.data().end());
    writer.AddArray(std::span(core));
  } else {
    writer.AddArray(std::span(grids.core.data()));
  }
  WriteFileAtomic(path, writer.bytes());
}

EvidenceGrids ReadGrids(const fs::path& path) {
  BinaryReader reader(path, kGridMagic, kVersion);
  EvidenceGrids grids;
  GridFrame& frame = grids.frame;
  frame.origin.x() = reader.GetFinite();
  frame.origin.y() = reader.GetFinite();
  frame.cell_m = reader.GetFinite();
  frame.rows = reader.GetSize(kMaxCells);
  frame.cols = reader.GetSize(kMaxCells);
  grids.mode = static_cast<EvidenceMode>(reader.GetSize(kLastMode));
  grids.num_cores = reader.GetSize(kMaxCores);
  grids.cameras.resize(static_cast<size_t>(reader.GetSize(kMaxViews)));
  for (EvidenceCamera& camera : grids.cameras) {
    camera.view_idx = reader.GetSize(kMaxViews);
    camera.position.x() = reader.GetFinite();
    camera.position.y() = reader.GetFinite();
  }
  const size_t core_bytes = grids.num_cores <= kMaxByteCores ? 1 : 2;
  reader.Require(uint64_t{2 * sizeof(float) + 1 + core_bytes} * static_cast<uint64_t>(frame.rows) *
                 static_cast<uint64_t>(frame.cols));
  grids.wall = ImageF(frame.rows, frame.cols);
  grids.free = ImageF(frame.rows, frame.cols);
  grids.support = ImageU8(frame.rows, frame.cols);
  grids.core = CoreImage(frame.rows, frame.cols);
  reader.GetFiniteArray(grids.wall.data());
  reader.GetFiniteArray(grids.free.data());
  reader.GetArray(std::span(grids.support.data()));
  if (core_bytes == 1) {
    std::vector<uint8_t> core(grids.core.data().size());
    reader.GetArray(std::span(core));
    std::copy(core.begin(), core.end(), grids.core.data().begin());
  } else {
    reader.GetArray(std::span(grids.core.data()));
  }
  reader.Finish();
  const bool is_cell_positive = frame.cell_m > 0;
  const bool are_cores_known = std::all_of(grids.core.data().begin(), grids.core.data().end(),
                                           [&](uint16_t core) { return core <= grids.num_cores; });
  if (!is_cell_positive || !are_cores_known) {
    throw InvalidInputError(path.native(), "contradicts itself",
                            "run 'enfilade evidence OUT' again");
  }
  return grids;
}

// Grey picture with y up: the largest magnitude becomes black or white, zero mid grey.
ImageU8 PictureOf(const ImageF& values) {
  float limit = 1e-6F;
  for (const float value : values.data()) limit = std::max(limit, std::abs(value));
  ImageU8 picture(values.rows(), values.cols());
  for (int row = 0; row < values.rows(); ++row) {
    for (int col = 0; col < values.cols(); ++col) {
      picture(values.rows() - 1 - row, col) =
          static_cast<uint8_t>(std::lround(127.5F + 127.5F * values(row, col) / limit));
    }
  }
  return picture;
}

// Cores in distinct colours on black, y up.
ImageU8 PictureOf(const CoreImage& core) {
  ImageU8 picture(core.rows(), core.cols(), 3);
  for (int row = 0; row < core.rows(); ++row) {
    for (int col = 0; col < core.cols(); ++col) {
      const int id = core(row, col);
      for (int channel = 0; channel < 3 && id > 0; ++channel) {
        picture(core.rows() - 1 - row, col, channel) =
            static_cast<uint8_t>(96 + (id * (67 + 46 * channel)) % 160);
      }
    }
  }
  return picture;
}

// A storey that nothing is known of has no pictures.
void WritePicture(const fs::path& path, const ImageU8& picture) {
  if (picture.empty()) return;
  WriteFileAtomic(path, EncodeImage(picture, ".png"));
}

}  // namespace

void WriteEvidence(const fs::path& folder, const std::vector<EvidenceGrids>& storeys) {
  for (size_t i = 0; i < storeys.size(); ++i) {
    WriteGrids(StoreyFile(folder, i, ".bin"), storeys[i]);
    WritePicture(StoreyFile(folder, i, "_wall.png"), PictureOf(storeys[i].wall));
    WritePicture(StoreyFile(folder, i, "_free.png"), PictureOf(storeys[i].free));
    WritePicture(StoreyFile(folder, i, "_core.png"), PictureOf(storeys[i].core));
  }
  WriteJsonFile(folder / "evidence.json",
                {{"format", kFormat}, {"version", kVersion}, {"num_storeys", storeys.size()}});
}

std::vector<EvidenceGrids> ReadEvidence(const fs::path& folder) {
  const fs::path path = folder / "evidence.json";
  const std::string where = path.native();
  const nlohmann::json json = ReadJsonFile(path);
  const auto num_storeys = JsonInteger(json, "num_storeys", where);
  if (JsonString(json, "format", where) != kFormat ||
      JsonInteger(json, "version", where) != kVersion || num_storeys < 0 ||
      num_storeys > kMaxStoreys) {
    throw InvalidInputError(where, "is no evidence of this version",
                            "run 'enfilade evidence OUT' again");
  }
  std::vector<EvidenceGrids> storeys;
  for (size_t i = 0; i < static_cast<size_t>(num_storeys); ++i) {
    storeys.push_back(ReadGrids(StoreyFile(folder, i, ".bin")));
  }
  return storeys;
}

}  // namespace enfilade
