#include "glint/reference/samples.h"

#include <algorithm>
#include <span>
#include <string>

#include "glint/image/error.h"

namespace glint::reference {
namespace {

// In sixteenths of a pixel.
constexpr glm::ivec2 two[] = {{4, 4}, {-4, -4}};
constexpr glm::ivec2 four[] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
constexpr glm::ivec2 eight[] = {{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
constexpr glm::ivec2 sixteen[] = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                                  {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                                  {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};

std::span<const glm::ivec2> patternOf(int count) {
  switch (count) {
    case 2:
      return two;
    case 4:
      return four;
    case 8:
      return eight;
    case 16:
      return sixteen;
    default:
      return {};
  }
}

}  // namespace

std::vector<glm::dvec2> samplePattern(const AntiAliasing& antiAliasing) {
  if (antiAliasing.mode != AntiAliasing::Mode::msaa || antiAliasing.count == 1) return {};
  const auto pattern = patternOf(antiAliasing.count);
  if (pattern.empty())
    throw InputError("--anti-aliasing msaa:" + std::to_string(antiAliasing.count) +
                     ": the reference draws msaa of 2, 4, 8 and 16 samples: give one of these, or "
                     "ssaa:N");
  std::vector<glm::dvec2> samples;
  for (const glm::ivec2& place : pattern) samples.push_back(glm::dvec2(place) / 16.0);
  return samples;
}

glm::dvec2 shadingPlace(const Primitive& p, const std::vector<glm::dvec2>& samples, double middleX,
                        double middleY) {
  if (samples.empty() || p.topology == Topology::points) return glm::dvec2(0.0);
  if (p.topology == Topology::lines) {
    const glm::dvec2 way = p.to - p.from;
    const double foot = glm::dot(glm::dvec2(middleX, middleY) - p.from, way) / glm::dot(way, way);
    return (std::clamp(foot, 0.0, 1.0) - foot) * way;
  }
  glm::dvec2 sum(0.0);
  std::size_t covered = 0;
  for (const glm::dvec2& sample : samples)
    if (covers(p, middleX + sample.x, middleY + sample.y)) {
      sum += sample;
      ++covered;
    }
  return covered > 0 && covered < samples.size() ? sum / double(covered) : glm::dvec2(0.0);
}

}  // namespace glint::reference
