// How a study measures times: the clocks, alternation, batches, without GL.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

#include "glint/study/frame_times.h"

namespace glint {
namespace study_times_test {

using Draws = std::vector<std::function<void()>>;

/// No GPU.
struct NoTimer : GpuTimer {
  bool works() const override { return false; }
  void begin() override {}
  void end() override {}
  double milliseconds() override { return 0; }
};

/// A GPU whose time is what draws add to it, reported in whole steps of a running clock, like a
/// counter: a reading may be off by a step.
struct FakeTimer : GpuTimer {
  explicit FakeTimer(double step) : step(step) {}
  bool works() const override { return true; }
  void begin() override { from = std::floor(now / step); }
  void end() override { to = std::floor(now / step); }
  double milliseconds() override { return (to - from) * step; }
  double step, now = 0.0123, from = 0, to = 0;
};

/// Computes until the thread has used this much CPU time.
void work(double milliseconds) {
  const auto run = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
  };
  const double start = run();
  while (run() - start < milliseconds) {
  }
}

// CPU time covers every thread, and is independent of other work on the machine; a frame that waits
// takes none.
TEST(StudyTimes, CpuTimeIsOfAllThreadsAndOfWorkAlone) {
  const Draws draws{[] { work(20); },
                    [] {
                      std::thread other([] { work(20); });
                      work(20);
                      other.join();
                    },
                    [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }};
  NoTimer timer;
  const auto times = timeInTurn(draws, [] {}, timer, {1, 9, false, {}, {}});
  const auto least = [](const std::vector<double>& all) {
    return *std::min_element(all.begin(), all.end());
  };
  for (const FrameTimes& each : times) {
    EXPECT_EQ(each.wall.size(), 9u);
    EXPECT_EQ(each.cpu.size(), 9u);
    EXPECT_TRUE(each.query.empty());
  }
  EXPECT_NEAR(least(times[0].cpu), 20, 1);
  EXPECT_NEAR(least(times[1].cpu), 40, 2);
  EXPECT_LT(least(times[2].cpu), 1);
  EXPECT_GE(least(times[2].wall), 20);
}

// A timer with steps of a fiftieth of a frame, or of twenty frames: batches are enlarged until the
// step is lost in the noise. Each reading is off by at most a step, and frame times differ by a
// hundredth, as real ones do.
TEST(StudyTimes, BatchesAreAsLongAsTheGpusTimerNeeds) {
  constexpr double frames[] = {0.05, 0.0503};
  for (const double step : {1e-6, 0.001, 1.0}) {
    FakeTimer timer(step);
    int drawn = 0;
    Draws draws;
    for (const double each : frames)
      draws.push_back([&, each] {
        timer.now += each * (drawn % 3 == 0 ? 0.99 : 1.005);
        ++drawn;
      });
    const auto times = timeInTurn(draws, [] {}, timer, {10, 20, true, {}, {}});
    for (std::size_t i = 0; i < 2; ++i) {
      const double most = times[i].batch == 1000 ? step / (1000 * frames[i]) : 2 * timerShare;
      for (const double t : times[i].query) EXPECT_NEAR(t / frames[i], 1, most + 0.01) << step;
    }
    if (step < 1e-5) {
      EXPECT_EQ(drawn, 2 * 30);  // fine enough already
    } else {
      EXPECT_GE(times[0].batch, 10) << step;
    }
  }
}

// A timer that is not the deciding clock changes nothing.
TEST(StudyTimes, WithoutAGpuAFrameIsMeasuredByItself) {
  FakeTimer timer(1.0);
  const Draws draws{[&] { timer.now += 0.05; }};
  const auto times = timeInTurn(draws, [] {}, timer, {2, 3, false, {}, {}});
  EXPECT_EQ(times[0].batch, 1);
  EXPECT_EQ(times[0].query.size(), 3u);
}

TEST(StudyTimes, StopsWithWholeRounds) {
  NoTimer timer;
  int drawn = 0;
  const Draws draws{[&] { ++drawn; }, [&] { ++drawn; }};
  const auto times =
      timeInTurn(draws, [] {}, timer, {0, 100, false, [&] { return drawn >= 5; }, {}});
  EXPECT_EQ(times[0].wall.size(), 2u);
  EXPECT_EQ(times[1].cpu.size(), 2u);
}

TEST(StudyTimes, KnowsDriversThatDrawOnTheCpu) {
  EXPECT_TRUE(drawsOnCpu("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(drawsOnCpu("Google SwiftShader"));
  EXPECT_TRUE(drawsOnCpu("softpipe"));
  EXPECT_FALSE(drawsOnCpu("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
  EXPECT_FALSE(drawsOnCpu("NVIDIA H200/PCIe/SSE2"));
}

}  // namespace study_times_test
}  // namespace glint
