// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "enfilade/image/codec.h"

namespace enfilade {

/// Writes a motion-JPEG video: one stream in an AVI 1.0 file whose frames are JPEG files byte for
/// byte, so that players take it and `ffmpeg -c:v copy` gives the same files back. Same frames,
/// same bytes. The file is whole only after Finish; call it within WriteFileAtomic.
class AviWriter {
 public:
  /// The rate is rounded to thousandths of a frame per second. Throws IoError.
  AviWriter(const std::filesystem::path& path, ImageSize size, double frames_per_second);

  /// Throws IoError, and InvalidInputError where the file would pass 2 GB: many readers take no
  /// more.
  void AddFrame(std::string_view jpeg);

  /// Writes the index and the lengths that the header left open. Throws IoError.
  void Finish();

 private:
  struct Frame {
    uint32_t offset = 0, size = 0;
  };

  void Write(std::string_view bytes);
  void ThrowIfFailed() const;

  std::filesystem::path path_;
  ImageSize size_;
  uint32_t millihertz_;
  std::ofstream file_;
  uint64_t written_ = 0;
  std::vector<Frame> frames_;
};

}  // namespace enfilade
