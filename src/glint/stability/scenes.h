#pragma once

#include <cstddef>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

// Scenes and files that cases build: small, with every number known.
namespace glint::stability {

/// A square in the plane z = 0, seen from +Z, whose four normals are `normal`.
Mesh square(const glm::dvec3& normal = {0, 0, 1}, float half = 2);

/// The unit sphere by longitude and latitude, with exact normals.
Mesh sphere(int around, int down);

/// Triangles, three positions each, with the normal +Z.
Mesh triangles(std::vector<glm::vec3> positions);

/// Twelve thin ones, one above the other, each `step` further to the right.
Mesh thinTriangles(float step);

/// A lumpy thing without symmetry, smooth normals; and what it is painted with.
Mesh pebble();
Material paint();

/// One mesh with one material at one place.
Scene sceneOf(Mesh mesh, Material material = {}, const glm::dmat4& world = glm::dmat4(1));

Material unlitMaterial(const glm::dvec3& color);

/// The look with a parallel view along -`toViewer` at the origin, 2 units high, of `pixels` x
/// `pixels`: every pixel has the same V.
Look parallel(Look look, const glm::dvec3& toViewer = {0, 0, 1}, int pixels = 8);

Light directional(const glm::dvec3& toLight, const glm::dvec3& intensity = glm::dvec3(1));

/// At the origin; the angles in degrees.
Light spotAlong(const glm::dvec3& direction, double innerAngle, double outerAngle);
glm::dmat4 translation(const glm::dvec3& t);
glm::dmat4 scaling(const glm::dvec3& s);
/// About a fixed generic axis; radians.
glm::dmat4 rotation(double angle);

/// Random directions, uniform on the sphere, the same on every machine.
std::vector<glm::dvec3> randomDirections(std::size_t count, unsigned seed);

/// Random numbers, the same on every machine and with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : state_(seed * 2654435761u + 1) {}
  double unit();
  int below(int n) { return int(unit() * n); }
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  unsigned long long state_;
};

}  // namespace glint::stability
