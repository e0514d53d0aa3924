// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/voxel_joints.h"

#include <array>

namespace enfilade {
namespace {

// Eight voxels round a corner, bit x + 2y + 4z each.
using Block = uint8_t;

constexpr int kCorners = 8;

bool IsSet(Block block, int corner) { return ((block >> corner) & 1) != 0; }
Block With(Block block, int corner) { return static_cast<Block>(block | (1 << corner)); }

// The four corners of a block's layer across an axis, in the order of two bits.
int CornerOf(int axis, int layer, int place) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return (layer << axis) | ((place & 1) << u) | ((place >> 1) << v);
}

// 0 and 3 are set and 1 and 2 are not, or the other way round.
bool IsDiagonal(const std::array<bool, 4>& four) {
  return four[0] == four[3] && four[1] == four[2] && four[0] != four[1];
}

Block JoinEdges(Block block) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int layer = 0; layer < 2; ++layer) {
      std::array<bool, 4> four{};
      for (int k = 0; k < 4; ++k)
        four[static_cast<size_t>(k)] = IsSet(block, CornerOf(axis, layer, k));
      if (IsDiagonal(four)) return With(block, CornerOf(axis, layer, four[0] ? 1 : 0));
    }
  }
  return block;
}

// Two voxels at opposite corners that are the only ones, or the only ones missing.
Block JoinCorners(Block block) {
  for (int corner = 0; corner < kCorners / 2; ++corner) {
    const auto two = static_cast<Block>((1 << corner) | (1 << (kCorners - 1 - corner)));
    if (block == two) return With(block, corner ^ 1);
    if (block == static_cast<Block>(~two)) return With(block, corner);
  }
  return block;
}

// Faces of the border across an axis that touch at the corner: takes both away.
Block JoinFaces(Block block) {
  for (int axis = 0; axis < 3; ++axis) {
    std::array<bool, 4> is_face{};
    for (int k = 0; k < 4; ++k) {
      is_face[static_cast<size_t>(k)] =
          IsSet(block, CornerOf(axis, 0, k)) != IsSet(block, CornerOf(axis, 1, k));
    }
    if (!IsDiagonal(is_face)) continue;
    for (int k = 0; k < 4; ++k) {
      if (!is_face[static_cast<size_t>(k)]) continue;
      block = With(With(block, CornerOf(axis, 0, k)), CornerOf(axis, 1, k));
    }
    return block;
  }
  return block;
}

std::array<Block, 256> MakeJoined() {
  std::array<Block, 256> joined{};
  for (int start = 0; start < 256; ++start) {
    auto block = static_cast<Block>(start);
    for (Block last = 0; last != block;) {
      last = block;
      block = JoinFaces(JoinCorners(JoinEdges(block)));
    }
    joined[static_cast<size_t>(start)] = block;
  }
  return joined;
}

}  // namespace

void JoinVoxels(const VoxelFrame& frame, std::vector<uint8_t>& inside) {
  const std::array<Block, 256> joined = MakeJoined();
  std::array<size_t, kCorners> offsets{};
  for (int corner = 0; corner < kCorners; ++corner) {
    offsets[static_cast<size_t>(corner)] =
        frame.Index({corner & 1, (corner >> 1) & 1, corner >> 2});
  }
  // A voxel that is set may touch another one at a corner that was passed already.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (Voxel v{}; v[2] + 1 < frame.size[2]; ++v[2]) {
      for (v[1] = 0; v[1] + 1 < frame.size[1]; ++v[1]) {
        for (v[0] = 0; v[0] + 1 < frame.size[0]; ++v[0]) {
          const size_t first = frame.Index(v);
          Block block = 0;
          for (int corner = 0; corner < kCorners; ++corner) {
            if (inside[first + offsets[static_cast<size_t>(corner)]] != 0)
              block = With(block, corner);
          }
          const Block wanted = joined[block];
          if (wanted == block) continue;
          has_changed = true;
          for (int corner = 0; corner < kCorners; ++corner) {
            if (IsSet(wanted, corner)) inside[first + offsets[static_cast<size_t>(corner)]] = 1;
          }
        }
      }
    }
  }
}

}  // namespace enfilade
