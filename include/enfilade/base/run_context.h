// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "enfilade/base/log.h"

namespace enfilade {

/// Receives the progress of named pieces of work; calls come from one thread at a time.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `seconds_left` is an estimate, negative while unknown. `done == total` closes the piece.
  virtual void Report(std::string_view what, int64_t done, int64_t total, double seconds_left) = 0;
};

/// What every stage is given besides its data: threads, seed, memory cap, log, progress, stop.
///
/// A default-constructed context runs on all cores, silently, with seed 0. Results never depend on
/// num_threads.
class RunContext {
 public:
  /// `num_threads` 0 means one per processor; `max_memory_mb` 0 means no cap.
  explicit RunContext(int num_threads = 0, uint64_t seed = 0, int max_memory_mb = 0);

  [[nodiscard]] int num_threads() const { return num_threads_; }
  [[nodiscard]] int max_memory_mb() const { return max_memory_mb_; }
  [[nodiscard]] uint64_t seed() const { return seed_; }
  /// Seed of the `task_idx`-th independent task: the same for any number of threads (SplitMix64).
  [[nodiscard]] uint64_t TaskSeed(uint64_t task_idx) const;

  [[nodiscard]] Log& log() const { return *log_; }
  void set_log(std::shared_ptr<Log> log) { log_ = std::move(log); }
  [[nodiscard]] ProgressSink* progress_sink() const { return progress_sink_.get(); }
  void set_progress_sink(std::shared_ptr<ProgressSink> sink) { progress_sink_ = std::move(sink); }

  /// Asks the run to stop; async-signal-safe. Stages notice at the next CheckStop.
  void RequestStop() { stop_requested_.store(true, std::memory_order_relaxed); }
  /// Throws StoppedError once RequestStop was called.
  void CheckStop() const;

 private:
  int num_threads_;
  uint64_t seed_;
  int max_memory_mb_;
  std::shared_ptr<Log> log_;
  std::shared_ptr<ProgressSink> progress_sink_;
  std::atomic<bool> stop_requested_{false};
};

/// Runs body(0) … body(count − 1), each once, on up to context.num_threads() threads; the order is
/// unspecified, so bodies write only to what belongs to their index. Reports progress under
/// `what` (none when empty) and honours stop between bodies. If bodies throw, no further ones are
/// started, and the exception of the lowest throwing index is rethrown after all threads ended:
/// the same one for any number of threads.
void ParallelFor(RunContext& context, std::string_view what, int64_t count,
                 const std::function<void(int64_t)>& body);

}  // namespace enfilade
