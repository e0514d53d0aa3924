// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/scan_tile.h"

namespace enfilade {
namespace {

struct Portable {
  static constexpr int kWords = 64, kLanes = 4, kRows = 2, kVectors = 2;

  template <typename Vector>
  static Vector MultiplyAdd(Vector sum, Vector a, Vector b) {
    return sum + (a & 0xFFFF) * (b & 0xFFFF) + (a >> 16) * (b >> 16);
  }
};

}  // namespace

const DescriptorKernel& PortableDescriptorKernel() {
  static constexpr DescriptorKernel kKernel = KernelOf<Portable>("portable");
  return kKernel;
}

}  // namespace enfilade
