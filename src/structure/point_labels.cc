// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/point_labels.h"

#include "enfilade/evidence/point_labels.h"

namespace enfilade {

std::vector<SurfaceLabel> LabelPoints(const Scene& scene, const Structure& structure) {
  std::vector<SurfaceLabel> labels;
  labels.reserve(scene.points.size());
  for (const ScenePoint& point : scene.points) {
    if (point.view_idx.empty()) {
      labels.push_back(SurfaceLabel::kOther);
      continue;
    }
    // The home is the world turned about z: heights and slopes are the same.
    const View& view = scene.views[static_cast<size_t>(point.view_idx.front())];
    const StoreyStructure& storey = structure.storeys[static_cast<size_t>(view.storey_idx)];
    labels.push_back(LabelOfPoint(point, storey.floor_z, storey.ceiling_z));
  }
  return labels;
}

}  // namespace enfilade
