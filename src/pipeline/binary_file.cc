// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/pipeline/binary_file.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {

BinaryReader::BinaryReader(const std::filesystem::path& path, std::string_view magic,
                           uint32_t version)
    : where_(path.native()), bytes_(ReadFile(path)) {
  if (!std::string_view(bytes_).starts_with(magic)) Fail("is no file of this program");
  position_ = magic.size();
  if (Get<uint32_t>() != version) Fail("was written by another version of this program");
}

int BinaryReader::GetSize(int max) {
  const auto size = Get<int32_t>();
  if (size < 0 || size > max) Fail("has the impossible size " + std::to_string(size));
  return size;
}

void BinaryReader::GetFiniteArray(std::span<float> values) {
  GetArray(values);
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); })) {
    Fail("holds a value that is not finite");
  }
}

double BinaryReader::GetFinite() {
  const auto value = Get<double>();
  if (!std::isfinite(value)) Fail("holds a value that is not finite");
  return value;
}

void BinaryReader::Require(uint64_t num_bytes) const {
  if (bytes_.size() - position_ < num_bytes) Fail("is truncated");
}

void BinaryReader::Finish() const {
  if (position_ != bytes_.size()) Fail("is longer than its sizes say");
}

const char* BinaryReader::Take(size_t num_bytes) {
  Require(num_bytes);
  const char* start = bytes_.data() + position_;
  position_ += num_bytes;
  return start;
}

void BinaryReader::Fail(const std::string& problem) const {
  throw InvalidInputError(where_, problem, "run the stage that writes it again");
}

}  // namespace enfilade
