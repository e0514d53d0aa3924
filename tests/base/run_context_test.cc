// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/run_context.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

class RecordingSink final : public ProgressSink {
 public:
  struct Call {
    std::string what;
    int64_t done, total;
    double seconds_left;
  };
  std::vector<Call> calls;

  void Report(std::string_view what, int64_t done, int64_t total, double seconds_left) override {
    calls.push_back({std::string(what), done, total, seconds_left});
  }
};

TEST(RunContext, ThreadsDefaultToTheProcessors) {
  EXPECT_GE(RunContext().num_threads(), 1);
  EXPECT_EQ(RunContext(3).num_threads(), 3);
  EXPECT_THROW(RunContext(-1), std::logic_error);
}

TEST(RunContext, TaskSeedsAreFixedAndDistinct) {
  // SplitMix64 with state 0 (Steele, Lea, Flood 2014; first outputs of the reference code).
  const RunContext context(1, 0);
  EXPECT_EQ(context.TaskSeed(0), 0xE220A8397B1DCDAFu);
  EXPECT_EQ(context.TaskSeed(1), 0x6E789E6AA1B965F4u);
  std::set<uint64_t> seeds;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    for (uint64_t task = 0; task < 100; ++task) seeds.insert(RunContext(1, seed).TaskSeed(task));
  }
  EXPECT_EQ(seeds.size(), 1000);
  EXPECT_EQ(RunContext(1, 7).TaskSeed(5), RunContext(8, 7).TaskSeed(5));
}

TEST(ParallelFor, RunsEveryIndexOnce) {
  for (const int num_threads : {1, 2, 7}) {
    RunContext context(num_threads);
    std::vector<std::atomic<int>> counts(1000);
    ParallelFor(context, "", 1000, [&](int64_t i) { ++counts[static_cast<size_t>(i)]; });
    for (const auto& count : counts) EXPECT_EQ(count, 1);
  }
}

TEST(ParallelFor, NothingToDo) {
  RunContext context(4);
  ParallelFor(context, "none", 0, [](int64_t) { FAIL(); });
  EXPECT_THROW(ParallelFor(context, "none", -1, [](int64_t) {}), std::logic_error);
}

TEST(ParallelFor, SameResultForAnyNumberOfThreads) {
  const auto run = [](int num_threads) {
    RunContext context(num_threads, 42);
    std::vector<uint64_t> values(500);
    ParallelFor(context, "", 500, [&](int64_t i) {
      values[static_cast<size_t>(i)] = context.TaskSeed(static_cast<uint64_t>(i));
    });
    return values;
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_EQ(run(1), run(5));
}

TEST(ParallelFor, RethrowsTheLowestThrowingIndex) {
  // The lowest bad index sleeps, so that higher ones throw first.
  for (int repeat = 0; repeat < 20; ++repeat) {
    RunContext context(4);
    try {
      ParallelFor(context, "", 100, [](int64_t i) {
        if (i == 5) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (i >= 5) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "5");
    }
  }
}

TEST(ParallelFor, StartsNoMoreAfterAnException) {
  RunContext context(1);
  int num_run = 0;
  EXPECT_THROW(ParallelFor(context, "", 100,
                           [&](int64_t i) {
                             ++num_run;
                             if (i == 3) throw std::runtime_error("x");
                           }),
               std::runtime_error);
  EXPECT_EQ(num_run, 4);
}

TEST(ParallelFor, StopsBetweenBodies) {
  RunContext context(2);
  std::atomic<int> num_run{0};
  EXPECT_THROW(ParallelFor(context, "", 100000,
                           [&](int64_t i) {
                             ++num_run;
                             if (i == 10) context.RequestStop();
                           }),
               StoppedError);
  EXPECT_LT(num_run, 100000);
  EXPECT_THROW(context.CheckStop(), StoppedError);
}

TEST(ParallelFor, MayBeNested) {
  RunContext context(3);
  std::atomic<int> sum{0};
  ParallelFor(context, "", 4, [&](int64_t) {
    ParallelFor(context, "", 5, [&](int64_t j) { sum += static_cast<int>(j); });
  });
  EXPECT_EQ(sum, 40);
}

TEST(ParallelFor, ReportsProgressInOrderAndCloses) {
  RunContext context(4);
  const auto sink = std::make_shared<RecordingSink>();
  context.set_progress_sink(sink);
  ParallelFor(context, "columns", 300, [](int64_t) {});
  ASSERT_FALSE(sink->calls.empty());
  for (size_t i = 1; i < sink->calls.size(); ++i) {
    EXPECT_GT(sink->calls[i].done, sink->calls[i - 1].done);
  }
  EXPECT_EQ(sink->calls.back().what, "columns");
  EXPECT_EQ(sink->calls.back().done, 300);
  EXPECT_EQ(sink->calls.back().total, 300);
  EXPECT_EQ(sink->calls.back().seconds_left, 0);
}

TEST(ParallelFor, QuietWithoutName) {
  RunContext context(2);
  const auto sink = std::make_shared<RecordingSink>();
  context.set_progress_sink(sink);
  ParallelFor(context, "", 10, [](int64_t) {});
  EXPECT_TRUE(sink->calls.empty());
}

TEST(ParallelFor, ThrowingSinkIsReported) {
  class ThrowingSink final : public ProgressSink {
    void Report(std::string_view, int64_t, int64_t, double) override {
      throw std::runtime_error("sink");
    }
  };
  RunContext context(4);
  context.set_progress_sink(std::make_shared<ThrowingSink>());
  EXPECT_THROW(ParallelFor(context, "x", 50, [](int64_t) {}), std::runtime_error);
}

}  // namespace
}  // namespace enfilade
