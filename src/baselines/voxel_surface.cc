// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/voxel_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/floorplan/cells.h"
#include "enfilade/geometry/triangulate.h"
#include "src/baselines/cell_outline.h"
#include "src/baselines/surface_faces.h"
#include "src/baselines/voxel_votes.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int32_t kNone = -1;
constexpr uint8_t kInsideAbove = 1, kInsideBelow = 2;
// So that components of neighbouring planes cannot meet.
constexpr double kMaxShift = 0.49;  // in voxels

// Faces across an axis lie in planes of rows and columns, whose axes follow it in turn.
int ColAxis(int axis) { return (axis + 1) % 3; }
int RowAxis(int axis) { return (axis + 2) % 3; }

Voxel VoxelIn(int axis, int place, int row, int col) {
  Voxel voxel{};
  voxel[static_cast<size_t>(axis)] = place;
  voxel[static_cast<size_t>(RowAxis(axis))] = row;
  voxel[static_cast<size_t>(ColAxis(axis))] = col;
  return voxel;
}

// Sets of cells that hang together over sides and corners.
std::vector<CellSet> TouchingCells(ImageU8 cells) {
  std::vector<CellSet> sets;
  for (int first = 0; first < static_cast<int>(cells.data().size()); ++first) {
    if (cells.data()[static_cast<size_t>(first)] == 0) continue;
    CellSet set = {first};
    cells.data()[static_cast<size_t>(first)] = 0;
    for (size_t i = 0; i < set.size(); ++i) {
      const int row = set[i] / cells.cols(), col = set[i] % cells.cols();
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, cells.rows() - 1); ++r) {
        for (int c = std::max(col - 1, 0); c <= std::min(col + 1, cells.cols() - 1); ++c) {
          if (std::exchange(cells(r, c), uint8_t{0}) != 0) set.push_back(r * cells.cols() + c);
        }
      }
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

// The outline of a set, traced in no more of the plane than it needs.
CellOutline OutlineOf(const CellSet& set, int cols) {
  int min_row = set[0] / cols, max_row = min_row, min_col = set[0] % cols, max_col = min_col;
  for (const int cell : set) {
    min_row = std::min(min_row, cell / cols);
    max_row = std::max(max_row, cell / cols);
    min_col = std::min(min_col, cell % cols);
    max_col = std::max(max_col, cell % cols);
  }
  const int num_cols = max_col - min_col + 1;
  CellSet moved;
  for (const int cell : set)
    moved.push_back((cell / cols - min_row) * num_cols + cell % cols - min_col);
  CellOutline outline = TraceOutline(max_row - min_row + 1, num_cols, moved);
  const auto move_back = [&](std::vector<GridVertex>& ring) {
    for (GridVertex& vertex : ring) vertex = {vertex.row + min_row, vertex.col + min_col};
  };
  move_back(outline.outer);
  for (std::vector<GridVertex>& hole : outline.holes) move_back(hole);
  return outline;
}

// All vertices of the grid that a ring passes, from one turn to the next.
std::vector<GridVertex> EveryStep(const std::vector<GridVertex>& ring) {
  std::vector<GridVertex> steps;
  for (size_t i = 0; i < ring.size(); ++i) {
    const GridVertex &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const int num_steps = std::abs(b.row - a.row) + std::abs(b.col - a.col);
    for (int k = 0; k < num_steps; ++k) {
      steps.push_back(
          {a.row + (b.row - a.row) * k / num_steps, a.col + (b.col - a.col) * k / num_steps});
    }
  }
  return steps;
}

}  // namespace

VoxelSurface::VoxelSurface(const VoxelFrame& frame, std::vector<uint16_t> parts,
                           const std::vector<SurfaceSample>& samples)
    : frame_(frame), parts_(std::move(parts)) {
  for (int axis = 0; axis < 3; ++axis) FindComponents(axis);
  MoveComponents(samples);
}

// The border's faces across an axis, below the voxels at this place along it.
ImageU8 VoxelSurface::FacesIn(int axis, int place) const {
  ImageU8 faces(frame_.size[static_cast<size_t>(RowAxis(axis))],
                frame_.size[static_cast<size_t>(ColAxis(axis))]);
  const size_t first = frame_.Index(VoxelIn(axis, place, 0, 0)), stride = frame_.Stride(axis);
  const size_t row_stride = frame_.Stride(RowAxis(axis)), col_stride = frame_.Stride(ColAxis(axis));
  for (int row = 0; row < faces.rows(); ++row) {
    for (int col = 0; col < faces.cols(); ++col) {
      const size_t above =
          first + static_cast<size_t>(row) * row_stride + static_cast<size_t>(col) * col_stride;
      const bool is_above = parts_[above] != 0, is_below = parts_[above - stride] != 0;
      if (is_above != is_below) faces(row, col) = is_above ? kInsideAbove : kInsideBelow;
    }
  }
  return faces;
}

void VoxelSurface::FindComponents(int axis) {
  const size_t a = static_cast<size_t>(axis);
  component_[a].assign(frame_.NumVoxels(), kNone);
  corner_component_[a].assign(frame_.NumVoxels(), kNone);
  for (int place = 1; place < frame_.size[a]; ++place) {
    const ImageU8 faces = FacesIn(axis, place);
    for (const CellSet& set : TouchingCells(faces)) {
      const auto component = static_cast<int32_t>(shift_m_[a].size());
      shift_m_[a].push_back(0);
      for (const int cell : set) {
        const int row = cell / faces.cols(), col = cell % faces.cols();
        component_[a][frame_.Index(VoxelIn(axis, place, row, col))] = component;
        for (const int r : {row, row + 1}) {
          for (const int c : {col, col + 1})
            corner_component_[a][frame_.Index(VoxelIn(axis, place, r, c))] = component;
        }
      }
    }
  }
}

void VoxelSurface::MoveComponents(const std::vector<SurfaceSample>& samples) {
  std::array<std::vector<double>, 3> weight;
  for (size_t a = 0; a < 3; ++a) weight[a].assign(shift_m_[a].size(), 0);
  for (const SurfaceSample& sample : samples) {
    const SampleFace face = FaceOf(frame_, sample);
    const size_t a = static_cast<size_t>(face.axis);
    const double along = sample.normal[face.axis];
    const int beyond = face.gap_m < 0 ? -1 : 1;
    for (const int step : {0, beyond, -beyond}) {
      Voxel above = face.above;
      above[a] += step;
      const double gap_m = face.gap_m - step * frame_.voxel_m;
      if (!frame_.IsInside(above) || std::abs(gap_m) > frame_.voxel_m) continue;
      const int32_t component = component_[a][frame_.Index(above)];
      if (component == kNone || (parts_[frame_.Index(above)] != 0) != (along > 0)) continue;
      shift_m_[a][static_cast<size_t>(component)] += std::abs(along) * gap_m;
      weight[a][static_cast<size_t>(component)] += std::abs(along);
      break;
    }
  }
  const double limit_m = kMaxShift * frame_.voxel_m;
  for (size_t a = 0; a < 3; ++a) {
    for (size_t i = 0; i < weight[a].size(); ++i) {
      if (weight[a][i] > 0)
        shift_m_[a][i] = std::clamp(shift_m_[a][i] / weight[a][i], -limit_m, limit_m);
    }
  }
}

// Where planes across all three axes meet: faces turn there, or others beside them do.
bool VoxelSurface::IsVertex(const Voxel& corner) const {
  const size_t i = frame_.Index(corner);
  return corner_component_[0][i] != kNone && corner_component_[1][i] != kNone &&
         corner_component_[2][i] != kNone;
}

Vector3d VoxelSurface::CornerPosition(const Voxel& corner) const {
  Vector3d position = frame_.origin;
  for (size_t a = 0; a < 3; ++a) {
    const int32_t component = corner_component_[a][frame_.Index(corner)];
    position[static_cast<int>(a)] +=
        corner[a] * frame_.voxel_m +
        (component == kNone ? 0 : shift_m_[a][static_cast<size_t>(component)]);
  }
  return position;
}

void VoxelSurface::AddFaces(int axis, int place, const std::vector<StoreyStructure>& storeys,
                            BuildingModel& model) const {
  const ImageU8 faces = FacesIn(axis, place);
  for (const CellSet& set : ConnectedCells(faces)) {
    const CellOutline outline = OutlineOf(set, faces.cols());
    ModelFace face;
    const auto ring_of = [&](const std::vector<GridVertex>& grid_ring) {
      Ring2 ring;
      for (const GridVertex& vertex : EveryStep(grid_ring)) {
        const Voxel corner = VoxelIn(axis, place, vertex.row, vertex.col);
        if (!IsVertex(corner)) continue;
        const Vector3d position = CornerPosition(corner);
        face.vertices.push_back(position);
        ring.push_back({position[ColAxis(axis)], position[RowAxis(axis)]});
      }
      return ring;
    };
    Polygon2 polygon{ring_of(outline.outer), {}};
    for (const std::vector<GridVertex>& hole : outline.holes)
      polygon.holes.push_back(ring_of(hole));
    face.triangles = Triangulate(polygon).triangles;

    const bool is_above = faces.data()[static_cast<size_t>(set[0])] == kInsideAbove;
    if (!is_above) {
      for (std::array<int, 3>& triangle : face.triangles) std::swap(triangle[1], triangle[2]);
    }
    Voxel inside = VoxelIn(axis, place, set[0] / faces.cols(), set[0] % faces.cols());
    if (!is_above) --inside[static_cast<size_t>(axis)];
    face.room_id = parts_[frame_.Index(inside)] - 1;
    Describe((is_above ? 1.0 : -1.0) * Vector3d::Unit(axis), storeys, face);
    model.faces.push_back(std::move(face));
  }
}

BuildingModel VoxelSurface::Model(const std::vector<StoreyStructure>& storeys) const {
  BuildingModel model;
  for (int axis = 0; axis < 3; ++axis) {
    for (int place = 1; place < frame_.size[static_cast<size_t>(axis)]; ++place)
      AddFaces(axis, place, storeys, model);
  }
  return model;
}

MultiPolygon2 VoxelSurface::Section(double z, double min_hole_m2) const {
  MultiPolygon2 section;
  const int layer = frame_.VoxelAt({0, 0, z})[2];
  if (layer < 0 || layer >= frame_.size[2]) return section;
  ImageU8 inside(frame_.size[1], frame_.size[0]);
  const size_t first = frame_.Index({0, 0, layer});
  for (size_t i = 0; i < inside.data().size(); ++i) inside.data()[i] = parts_[first + i] != 0;
  FillSmallHoles(CellsOf(min_hole_m2, frame_.voxel_m), inside);
  const auto ring_of = [&](const std::vector<GridVertex>& grid_ring) {
    Ring2 ring;
    for (const GridVertex& vertex : grid_ring)
      ring.push_back(CornerPosition({vertex.col, vertex.row, layer}).head<2>());
    return ring;
  };
  for (const CellSet& set : ConnectedCells(inside)) {
    const CellOutline outline = OutlineOf(set, inside.cols());
    Polygon2 polygon{ring_of(outline.outer), {}};
    for (const std::vector<GridVertex>& hole : outline.holes)
      polygon.holes.push_back(ring_of(hole));
    section.push_back(std::move(polygon));
  }
  return section;
}

}  // namespace enfilade
