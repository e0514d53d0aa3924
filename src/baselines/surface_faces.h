// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/model/types.h"
#include "enfilade/structure/types.h"
#include "src/baselines/mesh_section.h"

namespace enfilade {

/// Sets the face's normal and, from it and the face's vertices, its kind and storey: within 45° of
/// level it is a floor or a ceiling, and it belongs to the storey whose floor and ceiling its mean
/// height lies between or nearest to.
void Describe(const Eigen::Vector3d& normal, const std::vector<StoreyStructure>& storeys,
              ModelFace& face);

/// A face for each triangle that has an area.
[[nodiscard]] BuildingModel ModelOf(const TriangleMesh& mesh,
                                    const std::vector<StoreyStructure>& storeys);

}  // namespace enfilade
