// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/stop_on_signal.h"

#include <atomic>
#include <csignal>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

std::atomic<RunContext*> stop_context = nullptr;
std::atomic<int> stop_signal = 0;
static_assert(std::atomic<RunContext*>::is_always_lock_free, "used in a signal handler");

extern "C" void HandleStopSignal(int number) {
  stop_signal.store(number);
  if (RunContext* context = stop_context.load()) context->RequestStop();
  std::signal(number, SIG_DFL);
}

}  // namespace

StopOnSignal::StopOnSignal(RunContext& context) {
  ENFILADE_CHECK(stop_context.exchange(&context) == nullptr);
  std::signal(SIGINT, HandleStopSignal);
  std::signal(SIGTERM, HandleStopSignal);
}

StopOnSignal::~StopOnSignal() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  stop_context.store(nullptr);
}

int StopSignal() { return stop_signal.load(); }

}  // namespace enfilade
