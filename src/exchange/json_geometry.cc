// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/json_geometry.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

constexpr double kRotationTolerance = 1e-2;

[[noreturn]] void ThrowShape(const std::string& where, const std::string& what,
                             const std::string& wanted) {
  throw InvalidInputError(where, what + " is not " + wanted, "check that the file is complete");
}

Eigen::Matrix4d Matrix4FromJson(const Json& value, const std::string& where,
                                const std::string& what) {
  const bool is_nested = value.is_array() && value.size() == 4;
  if (!value.is_array() || (!is_nested && value.size() != 16)) {
    ThrowShape(where, what, "a matrix of 4 × 4 numbers");
  }
  Eigen::Matrix4d matrix;
  for (size_t row = 0; row < 4; ++row) {
    if (is_nested && (!value[row].is_array() || value[row].size() != 4)) {
      ThrowShape(where, what, "a matrix of 4 × 4 numbers");
    }
    for (size_t col = 0; col < 4; ++col) {
      const Json& entry = is_nested ? value[row][col] : value[4 * row + col];
      matrix(static_cast<int>(row), static_cast<int>(col)) = NumberFromJson(entry, where, what);
    }
  }
  return matrix;
}

}  // namespace

double NumberFromJson(const Json& value, const std::string& where, const std::string& what) {
  if (!value.is_number()) ThrowShape(where, what, "a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) ThrowShape(where, what, "finite");
  return number;
}

Eigen::Vector2d Vector2FromJson(const Json& value, const std::string& where,
                                const std::string& what) {
  if (!value.is_array() || value.size() != 2) ThrowShape(where, what, "a pair of numbers");
  return {NumberFromJson(value[0], where, what), NumberFromJson(value[1], where, what)};
}

Eigen::Vector3d Vector3FromJson(const Json& value, const std::string& where,
                                const std::string& what) {
  if (!value.is_array() || value.size() != 3) ThrowShape(where, what, "three numbers");
  return {NumberFromJson(value[0], where, what), NumberFromJson(value[1], where, what),
          NumberFromJson(value[2], where, what)};
}

Ring2 RingFromJson(const Json& value, const std::string& where, const std::string& what) {
  if (!value.is_array()) ThrowShape(where, what, "a list of points");
  Ring2 ring;
  ring.reserve(value.size());
  for (const Json& point : value) ring.push_back(Vector2FromJson(point, where, what));
  return ring;
}

Rigid3 Rigid3FromJson(const Json& value, const std::string& where, const std::string& what) {
  const Eigen::Matrix4d matrix = Matrix4FromJson(value, where, what);
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-6) {
    throw InvalidInputError(where, what + " is no rigid transform: its last row is not 0 0 0 1",
                            "give the matrix row by row");
  }
  return {CheckedRotation(matrix.topLeftCorner<3, 3>(), where, what),
          matrix.topRightCorner<3, 1>()};
}

Eigen::Matrix3d CheckedRotation(const Eigen::Matrix3d& m, const std::string& where,
                                const std::string& what) {
  if (!m.allFinite()) ThrowShape(where, what, "finite");
  const double error = (m.transpose() * m - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kRotationTolerance)) {
    throw InvalidInputError(where, what + " is no rotation: its columns are not orthonormal",
                            "check the pose, a scale or shear may be mixed in");
  }
  if (m.determinant() < 0) {
    throw InvalidInputError(where, what + " mirrors: its determinant is negative",
                            "check the axes, the frame must be right-handed");
  }
  return NearestRotation(m);
}

}  // namespace enfilade
