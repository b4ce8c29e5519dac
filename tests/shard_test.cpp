// How the work of a list is divided.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "cli/model_list.h"

namespace glint::shard_test {

// The cost of each shard; fails if a model is in no shard or in two.
std::vector<double> loadsOf(const std::vector<double>& costs, std::size_t of) {
  std::vector<double> loads;
  std::vector<int> times(costs.size(), 0);
  for (std::size_t k = 1; k <= of; ++k) {
    const std::vector<bool> members = membersOf({k, of}, costs);
    double load = 0;
    for (std::size_t i = 0; i < costs.size(); ++i) {
      times[i] += members[i];
      load += members[i] ? costs[i] : 0;
    }
    loads.push_back(load);
  }
  for (const int each : times) EXPECT_EQ(each, 1);
  return loads;
}

TEST(Shards, OfEqualCostsAreEveryNth) {
  const std::vector<bool> members = membersOf({2, 3}, std::vector<double>(8, 5.0));
  for (std::size_t i = 0; i < members.size(); ++i) EXPECT_EQ(members[i], i % 3 == 1);
}

TEST(Shards, OneLargeModelIsNotTheWholeRun) {
  std::vector<double> costs(80, 1.0);
  costs[8] = 10;  // every 8th would give the first shard 19, the others 10
  for (const double load : loadsOf(costs, 8)) EXPECT_LE(load, 12);
}

TEST(Shards, AreNearTheBestPossible) {
  std::mt19937 random(5);
  std::lognormal_distribution<double> size(0, 2);
  for (int round = 0; round < 100; ++round) {
    std::vector<double> costs(1 + random() % 300);
    for (double& cost : costs) cost = size(random);
    const std::size_t of = 1 + random() % 12;
    double sum = 0, largest = 0;
    for (const double cost : costs) {
      sum += cost;
      largest = std::max(largest, cost);
    }
    const auto loads = loadsOf(costs, of);
    if (largest * double(costs.size()) <= 2 * sum) continue;  // every N-th
    // Graham's bound of 1966 for items assigned in any order.
    const double most = sum / double(of) + largest * (1 - 1 / double(of));
    EXPECT_LE(*std::ranges::max_element(loads), most * (1 + 1e-12));
  }
}

TEST(Shards, MoreThanModelsLeaveSomeEmpty) {
  const auto loads = loadsOf({1, 100, 1}, 7);
  EXPECT_EQ(std::ranges::count(loads, 0.0), 4);
}

}  // namespace glint::shard_test
