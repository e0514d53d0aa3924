// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "enfilade/image/image.h"
#include "enfilade/model/types.h"
#include "enfilade/structure/types.h"
#include "src/baselines/oriented_points.h"
#include "src/baselines/voxel_frame.h"

namespace enfilade {

/// The border of a volume's inside, made of planes across the axes that each lie where the samples
/// on them do.
///
/// A planar component is what hangs together of the border's faces in one plane, over edges and
/// corners. It moves along its normal to the mean offset of the samples that lie on its faces or
/// in front of or behind them within a voxel, weighted by how well their normals agree, by less
/// than half a voxel: so no component passes another one and the surface stays closed and free of
/// intersections.
class VoxelSurface {
 public:
  /// `parts` holds for each voxel 0 where it is outside, else the number of its part; requires what
  /// JoinVoxels guarantees. Cost O(voxels + samples).
  VoxelSurface(const VoxelFrame& frame, std::vector<uint16_t> parts,
               const std::vector<SurfaceSample>& samples);

  /// A face for each part of the border's planes that hangs together over edges and looks one way.
  /// Every edge is shared by two triangles. `room_id` is the part less 1.
  [[nodiscard]] BuildingModel Model(const std::vector<StoreyStructure>& storeys) const;

  /// The inside in the layer of voxels that holds the height z; holes of less than `min_hole_m2`
  /// are filled.
  [[nodiscard]] MultiPolygon2 Section(double z, double min_hole_m2) const;

 private:
  void FindComponents(int axis);
  void MoveComponents(const std::vector<SurfaceSample>& samples);
  void AddFaces(int axis, int place, const std::vector<StoreyStructure>& storeys,
                BuildingModel& model) const;
  [[nodiscard]] ImageU8 FacesIn(int axis, int place) const;
  [[nodiscard]] bool IsVertex(const Voxel& corner) const;
  [[nodiscard]] Eigen::Vector3d CornerPosition(const Voxel& corner) const;

  const VoxelFrame frame_;
  const std::vector<uint16_t> parts_;
  // Of the face below each voxel across each axis: its component, kNone where there is no face.
  std::array<std::vector<int32_t>, 3> component_;
  // Of the lower corner of each voxel: the component across each axis that has it, or kNone. There
  // is no more than one.
  std::array<std::vector<int32_t>, 3> corner_component_;
  std::array<std::vector<double>, 3> shift_m_;  // of each component
};

}  // namespace enfilade
