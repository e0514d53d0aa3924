// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/types.h"

#include "enfilade/geometry/angles.h"

namespace enfilade {

double AzimuthOfColumn(int column, int num_columns) {
  return 2 * kPi * (column + 0.5) / num_columns - kPi;
}

}  // namespace enfilade
