#include "lathe.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "circle.h"

namespace glint::models {

void Profile::add(const Point& point) {
  // Where pieces join smoothly, their common point is stored once.
  if (!points_.empty() && glm::distance(points_.back().position, point.position) < 1e-9 &&
      glm::distance(points_.back().normal, point.normal) < 1e-9) {
    return;
  }
  points_.push_back(point);
}

void Profile::arc(glm::dvec2 center, double radius, int from, int to, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const glm::dvec2 outward = onCircle(from * steps + (to - from) * i, 360 * steps);
    add({center + radius * outward, to < from ? outward : -outward});
  }
}

void Profile::grooves(glm::dvec2 center, double radius, int from, int to, int waves, double depth) {
  const int stepsPerWave = 8;
  const int steps = waves * stepsPerWave;
  const double angle = (to - from) / 360.0 * 2.0 * std::numbers::pi;
  for (int i = 0; i <= steps; ++i) {
    const glm::dvec2 outward = onCircle(from * steps + (to - from) * i, 360 * steps);
    const glm::dvec2 wave = onCircle(i, stepsPerWave);
    // In polar coordinates the normal of r(t) is r e_r - r' e_t, where r' is dr/dt.
    const double r = radius - depth * (1.0 - wave.x) / 2.0;
    const double slope = -depth * wave.y / 2.0 * waves * 2.0 * std::numbers::pi / angle;
    const glm::dvec2 along(-outward.y, outward.x);
    add({center + r * outward, glm::normalize(r * outward - slope * along)});
  }
}

void Profile::line(glm::dvec2 start, glm::dvec2 end, int steps) {
  const glm::dvec2 way = glm::normalize(end - start);
  for (int i = 0; i <= steps; ++i) {
    add({start + double(i) / steps * (end - start), {-way.y, way.x}});
  }
}

void Profile::lift(double height) {
  for (Point& point : points_) {
    point.position.y += height;
  }
}

Mesh lathe(const Profile& profile, int around) {
  Mesh mesh;
  const auto& points = profile.points();
  const auto isOnAxis = [&](std::size_t row) { return std::abs(points[row].position.x) < 1e-9; };
  std::vector<std::uint32_t> firstOfRow;
  for (std::size_t row = 0; row < points.size(); ++row) {
    const auto& [position, normal] = points[row];
    firstOfRow.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    for (int i = 0; i < (isOnAxis(row) ? 1 : around); ++i) {
      const glm::dvec2 outward = isOnAxis(row) ? glm::dvec2(0.0) : onCircle(i, around);
      mesh.positions.emplace_back(position.x * outward.x, position.y, position.x * outward.y);
      mesh.normals.emplace_back(normal.x * outward.x, normal.y, normal.x * outward.y);
    }
  }
  const auto index = [&](std::size_t row, int i) {
    return firstOfRow[row] + (isOnAxis(row) ? 0u : static_cast<std::uint32_t>(i % around));
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) {
      mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
  };
  for (std::size_t row = 0; row + 1 < points.size(); ++row) {
    // Two points at the same place are a crease: the surface has a different normal on each side.
    if (glm::distance(points[row].position, points[row + 1].position) < 1e-9) continue;
    for (int i = 0; i < around; ++i) {
      triangle(index(row, i), index(row, i + 1), index(row + 1, i + 1));
      triangle(index(row, i), index(row + 1, i + 1), index(row + 1, i));
    }
  }
  return mesh;
}

}  // namespace glint::models
