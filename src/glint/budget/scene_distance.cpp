#include "glint/budget/scene_distance.h"

#include <algorithm>
#include <limits>

namespace glint {
namespace {

constexpr std::size_t runLength = 32;

double distanceToEdge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  const double square = glm::dot(way, way);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * way);
}

}  // namespace

double distanceToTriangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  const auto& [a, b, c] = t;
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double size = glm::length(n);
  const bool above = size > 0 && glm::dot(glm::cross(b - a, p - a), n) >= 0 &&
                     glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
                     glm::dot(glm::cross(a - c, p - c), n) >= 0;
  return above ? std::abs(glm::dot(p - a, n)) / size
               : std::min(
                     {distanceToEdge(p, a, b), distanceToEdge(p, b, c), distanceToEdge(p, c, a)});
}

SceneDistance::SceneDistance(const Scene& scene) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const std::size_t corners = mesh.topology == Topology::triangles ? 3
                                : mesh.topology == Topology::lines   ? 2
                                                                     : 1;
    std::vector<glm::dvec3> places;
    for (const glm::vec3& position : mesh.positions)
      places.emplace_back(instance.world * glm::dvec4(glm::dvec3(position) + mesh.origin, 1.0));
    // Lines and points are triangles without area.
    for (std::size_t i = 0; i + corners <= mesh.indices.size(); i += corners) {
      const auto corner = [&](std::size_t k) {
        return places[mesh.indices[i + std::min(k, corners - 1)]];
      };
      triangles_.push_back({corner(0), corner(1), corner(2)});
    }
  }
  for (std::size_t first = 0; first < triangles_.size(); first += runLength) {
    const std::size_t end = std::min(first + runLength, triangles_.size());
    Run run{first, end, triangles_[first][0], triangles_[first][0]};
    for (std::size_t i = first; i < end; ++i)
      for (const glm::dvec3& corner : triangles_[i]) {
        run.low = glm::min(run.low, corner);
        run.high = glm::max(run.high, corner);
      }
    runs_.push_back(run);
  }
}

double SceneDistance::to(const glm::dvec3& point) const {
  double least = std::numeric_limits<double>::infinity();
  if (runs_.empty()) return least;
  const auto away = [&](const Run& run) {
    const glm::dvec3 out = glm::max(glm::max(run.low - point, point - run.high), glm::dvec3(0.0));
    return glm::dot(out, out);
  };
  const auto look = [&](const Run& run) {
    for (std::size_t i = run.first; i < run.end; ++i)
      least = std::min(least, distanceToTriangle(point, triangles_[i]));
  };
  // The nearest box first, which leaves out most of the others.
  const Run& nearest = *std::ranges::min_element(runs_, {}, away);
  look(nearest);
  for (const Run& run : runs_)
    if (&run != &nearest && away(run) < least * least) look(run);
  return least;
}

}  // namespace glint
