#include <cmath>

#include "circle.h"
#include "mesh.h"

namespace glint::models {

Mesh torusKnot(double major, double minor, double thickness, int along, int around) {
  const int turnsAboutAxis = 2;
  const int turnsOfCircle = 3;
  Mesh mesh;
  for (int i = 0; i < along; ++i) {
    const glm::dvec2 p = onCircle(turnsAboutAxis * i, along);
    const glm::dvec2 q = onCircle(turnsOfCircle * i, along);
    const double distance = major + minor * q.x;
    const glm::dvec3 middle(distance * p.x, minor * q.y, distance * p.y);
    const glm::dvec3 tangent = glm::normalize(
        glm::dvec3(-turnsOfCircle * minor * q.y * p.x - turnsAboutAxis * distance * p.y,
                   turnsOfCircle * minor * q.x,
                   -turnsOfCircle * minor * q.y * p.y + turnsAboutAxis * distance * p.x));
    // The curve lies on a torus, whose normal is perpendicular to it and has the curve's period.
    const glm::dvec3 up(q.x * p.x, q.y, q.x * p.y);
    const glm::dvec3 side = glm::cross(up, tangent);
    for (int j = 0; j < around; ++j) {
      const glm::dvec2 small = onCircle(j, around);
      const glm::dvec3 normal = small.x * up + small.y * side;
      mesh.positions.emplace_back(middle + thickness * normal);
      mesh.normals.emplace_back(normal);
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % along) * around + j % around);
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const auto a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  }
  return mesh;
}

}  // namespace glint::models
