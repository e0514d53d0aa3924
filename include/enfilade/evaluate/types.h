// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

namespace enfilade {

/// Figures under the keys of docs/evaluation.md; none where one cannot be computed.
using MetricReport = std::map<std::string, std::optional<double>>;

}  // namespace enfilade
