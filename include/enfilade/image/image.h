// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "enfilade/base/check.h"

namespace enfilade {

/// A dense picture: rows × cols pixels of `channels` interleaved values, row by row, no padding.
/// The centre of the top-left pixel is (0.5, 0.5).
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int rows, int cols, int channels = 1, T value = T())
      : rows_(rows),
        cols_(cols),
        channels_(channels),
        data_(NumValues(rows, cols, channels), value) {}

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] const std::vector<T>& data() const { return data_; }
  [[nodiscard]] std::vector<T>& data() { return data_; }

  /// Indices are not checked.
  [[nodiscard]] T& operator()(int row, int col, int channel = 0) {
    return data_[Index(row, col, channel)];
  }
  [[nodiscard]] const T& operator()(int row, int col, int channel = 0) const {
    return data_[Index(row, col, channel)];
  }
  /// The first value of a row; cols() · channels() values follow.
  [[nodiscard]] T* row(int r) { return data_.data() + Index(r, 0, 0); }
  [[nodiscard]] const T* row(int r) const { return data_.data() + Index(r, 0, 0); }

 private:
  static size_t NumValues(int rows, int cols, int channels) {
    ENFILADE_CHECK(rows >= 0 && cols >= 0 && channels >= 1);
    return static_cast<size_t>(rows) * static_cast<size_t>(cols) * static_cast<size_t>(channels);
  }
  [[nodiscard]] size_t Index(int row, int col, int channel) const {
    return (static_cast<size_t>(row) * static_cast<size_t>(cols_) + static_cast<size_t>(col)) *
               static_cast<size_t>(channels_) +
           static_cast<size_t>(channel);
  }

  int rows_ = 0;
  int cols_ = 0;
  int channels_ = 1;
  std::vector<T> data_;
};

using ImageU8 = Image<uint8_t>;
using ImageF = Image<float>;

}  // namespace enfilade
