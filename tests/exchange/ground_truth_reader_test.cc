// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ground_truth_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/geometry/angles.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {}  // namespace
}  // namespace enfilade
