// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "enfilade/base/log.h"
#include "enfilade/base/run_context.h"

namespace enfilade {

/// Where a command talks to: messages and progress on standard error, results on standard output.
struct Console {
  std::shared_ptr<Log> log;
  std::shared_ptr<ProgressSink> progress;
};

/// On a terminal progress is one line that is rewritten; elsewhere it is a plain line every ten
/// seconds; with LogFormat::kJson both messages and progress are one JSON object a line.
[[nodiscard]] Console MakeConsole(LogFormat format);

}  // namespace enfilade
