// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/avi_writer.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

constexpr uint64_t kMaxBytes = (uint64_t{1} << 31) - 1;
constexpr uint32_t kHasIndex = 0x10, kKeyFrame = 0x10;
constexpr size_t kRiffHead = 12;  // "RIFF", length, "AVI "
constexpr size_t kListHead = 12;  // "LIST", length, type
constexpr size_t kChunkHead = 8;  // name, length
constexpr size_t kIndexEntry = 16;

// Little endian, as RIFF is.
std::string Bytes(uint32_t value, int count = 4) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  return bytes;
}

std::string Words(std::initializer_list<uint32_t> values) {
  std::string bytes;
  for (const uint32_t value : values) bytes += Bytes(value);
  return bytes;
}

std::string ChunkHead(std::string_view name, size_t size) {
  return std::string(name) + Bytes(static_cast<uint32_t>(size));
}

std::string Chunk(std::string_view name, const std::string& content) {
  return ChunkHead(name, content.size()) + content;
}

std::string ListHead(std::string_view type, size_t content_size) {
  return ChunkHead("LIST", content_size + type.size()) + std::string(type);
}

std::string List(std::string_view type, const std::string& content) {
  return ListHead(type, content.size()) + content;
}

// Everything before the frames. It is as long for any number of frames.
std::string Header(ImageSize size, uint32_t millihertz, size_t num_frames, size_t frames_size,
                   size_t largest_frame) {
  const auto width = static_cast<uint32_t>(size.width), height = static_cast<uint32_t>(size.height);
  const auto length = static_cast<uint32_t>(num_frames);
  const auto buffer = static_cast<uint32_t>(largest_frame);
  const auto frame_us = static_cast<uint32_t>(std::lround(1e9 / millihertz));
  const auto bytes_per_s =
      static_cast<uint32_t>(std::min(4e9, 1e-3 * millihertz * static_cast<double>(largest_frame)));
  // AVIMAINHEADER, AVISTREAMHEADER and BITMAPINFOHEADER of the AVI RIFF file reference.
  const std::string main =
      Words({frame_us, bytes_per_s, 0, kHasIndex, length, 0, 1, buffer, width, height, 0, 0, 0, 0});
  const std::string stream = "vidsMJPG" +
                             Words({0, 0, 0, 1000, millihertz, 0, length, buffer, 0xFFFFFFFFu, 0}) +
                             Bytes(0, 2) + Bytes(0, 2) + Bytes(width, 2) + Bytes(height, 2);
  const std::string format = Words({40, width, height}) + Bytes(1, 2) + Bytes(24, 2) + "MJPG" +
                             Words({3 * width * height, 0, 0, 0, 0});
  const std::string head = List(
      "hdrl", Chunk("avih", main) + List("strl", Chunk("strh", stream) + Chunk("strf", format)));
  const size_t index_size = kChunkHead + kIndexEntry * num_frames;
  const size_t riff_size =
      kRiffHead - kChunkHead + head.size() + kListHead + frames_size + index_size;
  return ChunkHead("RIFF", riff_size) + "AVI " + head + ListHead("movi", frames_size);
}

}  // namespace

AviWriter::AviWriter(const std::filesystem::path& path, ImageSize size, double frames_per_second)
    : path_(path),
      size_(size),
      millihertz_(static_cast<uint32_t>(std::max(1L, std::lround(1000 * frames_per_second)))),
      file_(path, std::ios::binary | std::ios::trunc) {
  Write(Header(size_, millihertz_, 0, 0, 0));
}

void AviWriter::AddFrame(std::string_view jpeg) {
  const size_t padded = jpeg.size() + jpeg.size() % 2;
  if (written_ + kChunkHead + padded + kChunkHead + kIndexEntry * (frames_.size() + 1) >
      kMaxBytes) {
    throw InvalidInputError("video",
                            "would be larger than the 2 GB that an AVI file holds after " +
                                std::to_string(frames_.size()) + " frames",
                            "give a smaller width, a lower quality or fewer frames per second");
  }
  // Offsets count from the list's type.
  const size_t list_start = Header(size_, millihertz_, 0, 0, 0).size() - 4;
  frames_.push_back(
      {static_cast<uint32_t>(written_ - list_start), static_cast<uint32_t>(jpeg.size())});
  Write(ChunkHead("00dc", jpeg.size()));
  Write(jpeg);
  if (padded > jpeg.size()) Write(std::string_view("\0", 1));
}

void AviWriter::Finish() {
  std::string index;
  size_t largest = 0;
  for (const Frame& frame : frames_) {
    index += "00dc" + Words({kKeyFrame, frame.offset, frame.size});
    largest = std::max<size_t>(largest, frame.size);
  }
  const size_t frames_size = written_ - Header(size_, millihertz_, 0, 0, 0).size();
  Write(Chunk("idx1", index));
  file_.seekp(0);
  Write(Header(size_, millihertz_, frames_.size(), frames_size, largest));
  file_.close();
  ThrowIfFailed();
}

void AviWriter::ThrowIfFailed() const {
  if (file_) return;
  throw IoError(path_.native(), "cannot be written",
                "check that the folder is writable and the disk has room");
}

void AviWriter::Write(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file_.flush();
  ThrowIfFailed();
  written_ += bytes.size();
}

}  // namespace enfilade
