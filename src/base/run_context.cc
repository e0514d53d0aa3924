// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/run_context.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using Clock = std::chrono::steady_clock;

// Counts finished bodies and tells the sink at most five times a second.
class ProgressCounter {
 public:
  ProgressCounter(ProgressSink* sink, std::string_view what, int64_t total)
      : sink_(what.empty() ? nullptr : sink), what_(what), total_(total), start_(Clock::now()) {}

  void Step() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (sink_ == nullptr) return;
    const auto now = Clock::now();
    if (done_ < total_ && now - last_report_ < std::chrono::milliseconds(200)) return;
    last_report_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    sink_->Report(what_, done_, total_,
                  elapsed * static_cast<double>(total_ - done_) / static_cast<double>(done_));
  }

 private:
  ProgressSink* sink_;
  std::string what_;
  int64_t total_;
  int64_t done_ = 0;
  Clock::time_point start_;
  Clock::time_point last_report_;
  std::mutex mutex_;
};

}  // namespace

RunContext::RunContext(int num_threads, uint64_t seed, int max_memory_mb)
    : num_threads_(num_threads > 0
                       ? num_threads
                       : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      seed_(seed),
      max_memory_mb_(max_memory_mb),
      log_(MakeNullLog()) {
  ENFILADE_CHECK(num_threads >= 0);
}

uint64_t RunContext::TaskSeed(uint64_t task_idx) const {
  uint64_t z = seed_ + (task_idx + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

void RunContext::CheckStop() const {
  if (stop_requested_.load(std::memory_order_relaxed)) throw StoppedError();
}

void ParallelFor(RunContext& context, std::string_view what, int64_t count,
                 const std::function<void(int64_t)>& body) {
  ENFILADE_CHECK(count >= 0);
  ProgressCounter progress(context.progress_sink(), what, count);
  std::atomic<int64_t> next{0};
  std::mutex error_mutex;
  std::exception_ptr error;
  int64_t error_idx = count;

  // Indices are handed out in order, so when one throws all lower ones were started and will end.
  const auto work = [&] {
    for (int64_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
      try {
        context.CheckStop();
        body(i);
        progress.Step();
      } catch (...) {
        const std::lock_guard lock(error_mutex);
        if (i < error_idx) {
          error_idx = i;
          error = std::current_exception();
        }
        next.store(count);
        return;
      }
    }
  };

  const int64_t num_workers = std::min<int64_t>(context.num_threads(), count);
  std::vector<std::jthread> workers;
  for (int64_t t = 1; t < num_workers; ++t) workers.emplace_back(work);
  work();
  workers.clear();  // joins
  if (error) std::rethrow_exception(error);
}

}  // namespace enfilade
