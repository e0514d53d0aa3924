// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {

/// Geometry from JSON values. Each throws InvalidInputError, blaming `what` in file `where`, for a
/// value of another shape or type or a number that is not finite.
[[nodiscard]] double NumberFromJson(const nlohmann::json& value, const std::string& where,
                                    const std::string& what);
[[nodiscard]] Eigen::Vector2d Vector2FromJson(const nlohmann::json& value, const std::string& where,
                                              const std::string& what);
[[nodiscard]] Ring2 RingFromJson(const nlohmann::json& value, const std::string& where,
                                 const std::string& what);

[[nodiscard]] Eigen::Vector3d Vector3FromJson(const nlohmann::json& value, const std::string& where,
                                              const std::string& what);

/// A 4×4 homogeneous matrix of four rows or of 16 numbers row by row. The rotation part is made
/// orthonormal; see CheckedRotation.
[[nodiscard]] Rigid3 Rigid3FromJson(const nlohmann::json& value, const std::string& where,
                                    const std::string& what);

/// The rotation nearest to `m`. Throws InvalidInputError when an entry is not finite, the matrix
/// is further than 1e-2 from orthonormal (max norm of mᵀm − 1) or it mirrors.
[[nodiscard]] Eigen::Matrix3d CheckedRotation(const Eigen::Matrix3d& m, const std::string& where,
                                              const std::string& what);

/// A name of enum E as EnumNames gives it. Throws InvalidInputError naming those that are known.
template <typename E>
[[nodiscard]] E EnumFromName(const std::string& name, const std::string& where,
                             const std::string& what) {
  const auto names = EnumNames(E{});
  std::string known;
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<E>(i);
    known += (i > 0 ? ", " : "") + std::string(names[i]);
  }
  throw InvalidInputError(where, what + " is '" + name + "'", "make it one of " + known);
}

template <typename E>
[[nodiscard]] std::string EnumToName(E value) {
  return std::string(EnumNames(E{})[static_cast<size_t>(value)]);
}

}  // namespace enfilade
