// The Pareto front of a study and the rule for when times differ.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "glint/image/error.h"
#include "glint/study/front.h"
#include "glint/study/statistics.h"
#include "glint/study/study.h"

namespace glint {
namespace study_front_test {

using Times = std::vector<double>;

/// Frame times around a value, with a noise of a tenth.
Times framesOf(double milliseconds, unsigned seed, double noise = 0.1) {
  std::mt19937 random(seed);
  Times times(40);
  for (double& t : times)
    t = milliseconds * (1 + noise * (double(random()) / double(std::mt19937::max()) - 0.5));
  return times;
}

std::vector<int> membersOf(const std::vector<FrontPlace>& places) {
  std::vector<int> members;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].onFront) members.push_back(int(i));
  return members;
}

TEST(StudyStatistics, BootstrapIntervalHoldsTheRatioAndNarrowsWithTheNoise) {
  const TimeRatio wide = timeRatio(framesOf(5, 1, 0.4), framesOf(5, 2, 0.4)),
                  narrow = timeRatio(framesOf(5, 1), framesOf(5, 2));
  EXPECT_LT(wide.low, 1);
  EXPECT_GT(wide.high, 1);
  EXPECT_LT(narrow.high - narrow.low, (wide.high - wide.low) / 2);
  EXPECT_EQ(timeRatio(Times{3, 3, 3}, Times{3, 3, 3}).low, 1);
}

// About 95 of 100 intervals contain the true ratio; 80 would have a probability of 1e-8.
TEST(StudyStatistics, BootstrapIntervalCoversTheTrueRatio) {
  int covered = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const TimeRatio ratio = timeRatio(framesOf(1, seed), framesOf(1, seed + 1000));
    covered += ratio.low <= 1 && ratio.high >= 1;
  }
  EXPECT_GE(covered, 85);
}

TEST(StudyStatistics, RatioIsThatOfTheLowerQuartilesOfTheRoundsThatBothHave) {
  const Times a{2, 4, 6, 8, 10}, b{1, 2, 3, 4, 5, 0.1};
  EXPECT_DOUBLE_EQ(timeRatio(a, b).value, 4.0 / 2.0);
  EXPECT_EQ(timeRatio(a, a).low, 1);
  EXPECT_EQ(timeRatio(a, a).high, 1);
  EXPECT_EQ(timeRatio({}, a).value, 0);
}

// A machine that is interrupted in one frame of four, and one of six builds that is a third slower:
// these additions are excluded from the comparison.
TEST(StudyStatistics, RatioLeavesOutWhatIsAddedNowAndThen) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    Times a = framesOf(5, seed, 0.02), b = framesOf(5, seed + 100, 0.02);
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (i / 6 == 2) a[i] *= 1.33;
      if (random() % 4 == 0) a[i] += 2;
      if (random() % 4 == 0) b[i] += 2;
    }
    const TimeRatio ratio = timeRatio(a, b);
    EXPECT_NEAR(ratio.value, 1, 0.01) << seed;
    EXPECT_LT(ratio.high - ratio.low, 0.04) << seed;
  }
}

// About 190 of 200 intervals for noisy frames contain the true ratio; if each does with 95 %, fewer
// than 170 have a probability of 1e-7.
TEST(StudyStatistics, IntervalsOfRatiosHoldTheTrueOne) {
  int covered = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const TimeRatio ratio = timeRatio(framesOf(2, 2 * seed), framesOf(4, 2 * seed + 1));
    covered += ratio.low <= 0.5 && ratio.high >= 0.5;
  }
  EXPECT_GE(covered, 170);
}

// A machine that becomes slower half way affects both.
TEST(StudyStatistics, RatioBearsAChangeOfSpeed) {
  Times a = framesOf(5, 1, 0.02), b = framesOf(4, 2, 0.02);
  for (std::size_t i = a.size() / 2; i < a.size(); ++i) a[i] *= 1.25, b[i] *= 1.25;
  const TimeRatio ratio = timeRatio(a, b);
  EXPECT_NEAR(ratio.value, 1.25, 0.02);
  EXPECT_LT(ratio.high - ratio.low, 0.05);
}

TEST(StudyFront, FasterMeansBeyondTheSpread) {
  const Times a = framesOf(10, 1), b = framesOf(9, 2), c = framesOf(5, 3);
  EXPECT_TRUE(isFaster(b, a, 0.01));
  EXPECT_FALSE(isFaster(b, a, 0.2));
  EXPECT_TRUE(isFaster(c, a, 0.2));
  EXPECT_FALSE(isFaster(a, a, 0));
  EXPECT_FALSE(isFaster({}, a, 0));
}

TEST(StudyFront, AllStepsOfAStaircaseAreOnIt) {
  const Times times[] = {framesOf(8, 1), framesOf(4, 2), framesOf(2, 3)};
  const FrontCandidate candidates[] = {{1e-6, times[0]}, {1e-3, times[1]}, {1e-1, times[2]}};
  EXPECT_EQ(membersOf(paretoFront(candidates, 0.05)), (std::vector{0, 1, 2}));
}

TEST(StudyFront, NamesWhoDominates) {
  const Times fast = framesOf(2, 1), slow = framesOf(4, 2);
  const FrontCandidate candidates[] = {{1e-2, slow}, {1e-3, fast}, {1e-4, slow}};
  const auto places = paretoFront(candidates, 0.05);
  EXPECT_EQ(membersOf(places), (std::vector{1, 2}));
  EXPECT_EQ(places[0].dominatedBy, 1);
}

TEST(StudyFront, ALargerErrorMustBePaidForByMoreThanNoise) {
  const Times a = framesOf(4.0, 1), b = framesOf(3.95, 2);
  const FrontCandidate candidates[] = {{1e-6, a}, {1e-3, b}};
  EXPECT_EQ(membersOf(paretoFront(candidates, 0.1)), (std::vector{0}));
}

// None is beyond the spread of its neighbour, but the last is beyond that of the first: it may be
// on the front, and so may those in between, but none is certain.
TEST(StudyFront, AChainOfSmallStepsHasItsBeginAlone) {
  const Times a = framesOf(4.0, 1, 0.01), b = framesOf(3.8, 2, 0.01), c = framesOf(3.5, 3, 0.01);
  const FrontCandidate candidates[] = {{1e-6, a}, {1e-5, b}, {1e-4, c}};
  const auto places = paretoFront(candidates, 0.09);
  EXPECT_EQ(membersOf(places), (std::vector{0}));
  EXPECT_EQ(places[1].dominatedBy, 0);
  EXPECT_EQ(places[2].dominatedBy, 1);
  EXPECT_FALSE(places[1].isSlower || places[2].isSlower);
}

// One that is dominated by a faster member, and one that cannot be distinguished from it in time.
TEST(StudyFront, SaysWhetherItCanBeTold) {
  const Times fast = framesOf(2, 1, 0.01), alike = framesOf(2.02, 2, 0.01),
              slow = framesOf(4, 3, 0.01);
  const FrontCandidate candidates[] = {{1e-6, fast}, {1e-3, alike}, {1e-2, slow}};
  const auto places = paretoFront(candidates, 0.05);
  EXPECT_EQ(membersOf(places), (std::vector{0}));
  EXPECT_FALSE(places[0].isSlower);
  EXPECT_FALSE(places[1].isSlower);
  EXPECT_TRUE(places[2].isSlower);
}

// A certain dominator is named before one that may be faster, and the fastest of those.
TEST(StudyFront, NamesTheFastestOfThoseThatAreFaster) {
  const Times slow = framesOf(4, 1, 0.01), alike = framesOf(4.01, 2, 0.01),
              fast = framesOf(3, 3, 0.01), fastest = framesOf(2, 4, 0.01);
  const FrontCandidate candidates[] = {{1e-6, alike}, {1e-5, fast}, {1e-4, fastest}, {1e-3, slow}};
  const auto places = paretoFront(candidates, 0.05);
  EXPECT_EQ(places[3].dominatedBy, 2);
  EXPECT_TRUE(places[3].isSlower);
}

TEST(StudyFront, OfTheSameErrorTheFasterStands) {
  const Times slow = framesOf(4, 1), fast = framesOf(2, 2);
  const FrontCandidate candidates[] = {{1.00e-6, slow}, {1.02e-6, fast}, {1.01e-6, slow}};
  const auto places = paretoFront(candidates, 0.05);
  EXPECT_EQ(membersOf(places), (std::vector{1}));
  for (const int i : {0, 2}) {
    EXPECT_EQ(places[std::size_t(i)].dominatedBy, 1);
    EXPECT_TRUE(places[std::size_t(i)].isSlower);
  }
}

// A variant drawn again under another name does not displace the original.
TEST(StudyFront, WhatIsNoRivalTakesNoPlace) {
  const double errors[] = {1e-6, 1e-3, 1e-3}, times[] = {4, 2, 2};
  const auto places = paretoFront(
      errors, [&](int a, int b) { return times[a] < times[b]; }, [](int i) { return i < 2; });
  EXPECT_EQ(membersOf(places), (std::vector{0, 1}));
  EXPECT_EQ(places[2].dominatedBy, 1);
  EXPECT_FALSE(places[2].isSlower);
}

/// A run on a shared machine: every round is slowed by other work, one frame in five is late, and
/// one of six builds of each program may be slower by a quarter.
std::vector<Times> runOf(const std::vector<double>& milliseconds, unsigned seed, double noise) {
  std::mt19937 random(seed);
  const auto unit = [&] { return double(random()) / double(std::mt19937::max()); };
  std::vector<double> load(60);
  for (double& l : load) l = 1 + 3 * noise * unit();
  std::vector<Times> runs;
  for (const double t : milliseconds) {
    Times& times = runs.emplace_back();
    std::array<double, 6> builds;
    for (double& build : builds) build = unit() < 0.05 ? 1.25 : 1;
    for (std::size_t i = 0; i < load.size(); ++i)
      times.push_back(t * load[i] * builds[i / 10] * (1 + noise * unit()) *
                      (unit() < 0.2 ? 1 + 4 * noise * unit() : 1));
  }
  return runs;
}

/// For two runs of the same candidates: how many are certainly on the front in one and certainly
/// dominated in the other, how many have the same status, and how many are decided at all.
struct Agreement {
  int contradictions = 0, alike = 0, told = 0, all = 0;
};

// 40 candidates, with steps from zero to a tenth of a frame, once on an idle and once on a busy
// machine: what is certain in one run is never contradicted by the other.
TEST(StudyFront, TwoRunsNeverContradictEachOther) {
  Agreement agreement;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::vector<double> milliseconds, errors;
    for (int i = 0; i < 40; ++i) {
      milliseconds.push_back(10 - 5 * double(random()) / double(std::mt19937::max()));
      errors.push_back(std::pow(10, -7 + 6.0 * double(random()) / double(std::mt19937::max())));
    }
    std::vector<double> withControls = milliseconds;
    withControls.insert(withControls.end(), {milliseconds[0], milliseconds[20], milliseconds[39]});
    const auto placesOf = [&](unsigned run, double noise) {
      const std::vector<Times> times = runOf(withControls, run, noise);
      const std::vector<TimeRatio> controls{timeRatio(times[40], times[0]),
                                            timeRatio(times[41], times[20]),
                                            timeRatio(times[42], times[39])};
      std::vector<FrontCandidate> candidates;
      for (std::size_t i = 0; i < errors.size(); ++i) candidates.push_back({errors[i], times[i]});
      return paretoFront(candidates, spreadOfControls(controls));
    };
    const auto quiet = placesOf(2 * seed + 1000, 0.01), busy = placesOf(2 * seed + 1001, 0.06);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const FrontPlace &a = quiet[i], &b = busy[i];
      agreement.contradictions += (a.onFront && b.isSlower) || (b.onFront && a.isSlower);
      agreement.alike += a.onFront == b.onFront && a.isSlower == b.isSlower;
      agreement.told += a.onFront || a.isSlower;
      ++agreement.all;
    }
  }
  EXPECT_EQ(agreement.contradictions, 0);
  // And many of them are decided.
  EXPECT_GT(agreement.told, agreement.all / 2);
  EXPECT_GT(agreement.alike, agreement.all / 2);
}

// Steps larger than the spread are found in every run.
TEST(StudyFront, LargeStepsAreTheSameInEveryRun) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<Times> times;
    const double milliseconds[] = {9, 9.5, 6, 7, 3, 3.6};
    for (unsigned i = 0; i < 6; ++i)
      times.push_back(framesOf(milliseconds[i], 100 * seed + i, 0.05));
    std::vector<FrontCandidate> candidates;
    for (unsigned i = 0; i < 6; ++i) candidates.push_back({std::pow(10.0, int(i) - 6), times[i]});
    const std::vector<TimeRatio> controls{timeRatio(framesOf(6, seed + 5000, 0.05), times[2])};
    const auto places = paretoFront(candidates, spreadOfControls(controls));
    EXPECT_EQ(membersOf(places), (std::vector{0, 2, 4})) << seed;
    EXPECT_TRUE(places[3].isSlower && places[5].isSlower) << seed;
  }
}

TEST(StudyFront, SpreadIsTheFarEndOfTheControls) {
  const std::vector<TimeRatio> ratios{{1.0, 0.99, 1.02}, {0.95, 0.9, 1.01}, {}};
  EXPECT_DOUBLE_EQ(spreadOfControls(ratios), 1 - 0.9);
  EXPECT_EQ(spreadOfControls({}), 0);
}

// Beyond the limit nothing is concluded, and a clock that would work is named.
TEST(StudyFront, IsNotMadeBeyondTheLimit) {
  std::array<ClockNoise, frameClocks> noise;
  noise[0].spread = 0.39;
  noise[1].spread = 0.015;
  EXPECT_EQ(whyNoFront(noise, FrameClock::cpu, 0.1), "");
  const std::string why = whyNoFront(noise, FrameClock::wall, 0.1);
  EXPECT_NE(
      why.find("in wall time, one program measured twice differs from itself by up to 39.0 %"),
      std::string::npos)
      << why;
  EXPECT_NE(why.find("In CPU time it is 1.5 %: use --clock cpu"), std::string::npos) << why;
  noise[1].spread = 0.53;
  EXPECT_NE(whyNoFront(noise, FrameClock::wall, 0.1).find("with more --repetitions"),
            std::string::npos);
  EXPECT_EQ(whyNoFront(noise, FrameClock::wall, 0.4), "");
}

TEST(StudyFront, IsDecidedByTheClockThatTheDriverHas) {
  EXPECT_EQ(clockFor({}, "llvmpipe (LLVM 15.0.6, 256 bits)", true), FrameClock::wall);
  EXPECT_EQ(clockFor({}, "Mesa Intel(R) UHD Graphics", true), FrameClock::gpu);
  EXPECT_EQ(clockFor({}, "Mesa Intel(R) UHD Graphics", false), FrameClock::wall);
  EXPECT_EQ(clockFor(FrameClock::cpu, "llvmpipe", true), FrameClock::cpu);
  EXPECT_THROW(clockFor(FrameClock::gpu, "llvmpipe", true), InputError);
  EXPECT_THROW(clockFor(FrameClock::gpu, "a GPU", false), InputError);
}

}  // namespace study_front_test
}  // namespace glint
