#include "glint/study/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace glint {
namespace {

constexpr double lowerQuarter = 0.25;

}  // namespace

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = std::clamp(q, 0.0, 1.0) * double(values.size() - 1);
  const auto below = values.begin() + std::ptrdiff_t(place);
  std::nth_element(values.begin(), below, values.end());
  const double rest = place - std::floor(place);
  if (rest == 0) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + rest * (above - *below);
}

Spread spreadOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  return {quantile(values, 0),    quantile(values, 0.25), quantile(values, 0.5),
          quantile(values, 0.75), quantile(values, 1),    values.size()};
}

QuartileSamples quartileSamples(std::span<const double> rounds) {
  QuartileSamples samples;
  if (rounds.empty()) return samples;
  std::vector<double> drawn(rounds.begin(), rounds.end());
  samples.value = quantile(drawn, lowerQuarter);
  std::mt19937 random(1);
  samples.drawn.resize(1000);
  for (double& each : samples.drawn) {
    for (double& value : drawn)
      value = rounds[std::size_t(std::uint64_t(random()) * rounds.size() >> 32)];
    each = quantile(drawn, lowerQuarter);
  }
  return samples;
}

TimeRatio timeRatio(const QuartileSamples& a, const QuartileSamples& b) {
  if (a.drawn.empty() || b.drawn.empty()) return {};
  std::vector<double> ratios(a.drawn.size());
  std::transform(a.drawn.begin(), a.drawn.end(), b.drawn.begin(), ratios.begin(), std::divides());
  return {a.value / b.value, quantile(ratios, 0.025), quantile(ratios, 0.975)};
}

TimeRatio timeRatio(std::span<const double> a, std::span<const double> b) {
  const std::size_t rounds = std::min(a.size(), b.size());
  return timeRatio(quartileSamples(a.first(rounds)), quartileSamples(b.first(rounds)));
}

TimeRatio quartileFunction(std::span<const std::span<const double>> times,
                           const std::function<double(std::span<const double>)>& function) {
  if (times.empty() || times[0].empty()) return {};
  const std::size_t rounds = times[0].size();
  std::vector<std::vector<double>> drawn;
  for (const std::span<const double> each : times) drawn.emplace_back(each.begin(), each.end());
  std::vector<double> quartiles(times.size());
  const auto value = [&] {
    for (std::size_t k = 0; k < times.size(); ++k) quartiles[k] = quantile(drawn[k], lowerQuarter);
    return function(quartiles);
  };
  TimeRatio ratio;
  ratio.value = value();
  std::mt19937 random(1);
  std::vector<double> values(1000);
  for (double& each : values) {
    for (std::size_t i = 0; i < rounds; ++i) {
      const auto from = std::size_t(std::uint64_t(random()) * rounds >> 32);
      for (std::size_t k = 0; k < times.size(); ++k) drawn[k][i] = times[k][from];
    }
    each = value();
  }
  ratio.low = quantile(values, 0.025);
  ratio.high = quantile(values, 0.975);
  return ratio;
}

}  // namespace glint
