#pragma once

// Random numbers for property tests: the same in every run.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/glm.hpp>
#include <random>

namespace glint::test {

/// The number of draws in a test: from the environment variable if it is set.
inline int drawsOf(const char* variable, int usual) {
  const char* more = std::getenv(variable);
  return more != nullptr ? std::max(std::atoi(more), 1) : usual;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double unit() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  double log(double low, double high) { return low * std::pow(high / low, unit()); }
  int below(int count) { return int(unit() * count); }
  bool coin() { return unit() < 0.5; }
  glm::dvec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(engine_), normal(engine_), normal(engine_)));
  }
  glm::dvec3 color() { return {unit(), unit(), unit()}; }

 protected:
  std::mt19937 engine_;
};

}  // namespace glint::test
