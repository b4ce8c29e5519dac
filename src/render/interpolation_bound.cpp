#include "interpolation_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/shading/safe.h"

namespace glint {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// The transform of normals: cofactors, the sign of a mirror taken out.
glm::dmat3 normalTransform(const glm::dmat3& m) {
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(m[i][j]));
  if (!(size > 0)) return glm::dmat3(1.0);
  const glm::dmat3 n = m * (1 / size);
  const glm::dmat3 c(glm::cross(n[1], n[2]), glm::cross(n[2], n[0]), glm::cross(n[0], n[1]));
  return glm::dot(n[0], c[0]) < 0 ? -1.0 * c : c;
}

// sup over c in (0, 1] of c^(a-1) + (a-1) c^(a-2) (1 - c^2), and of c^(a-1) sqrt(1 - c^2), for a of
// at least 2. With x = a (1 - c) both vary by less than a percent from one sample to the next.
struct Steepness {
  double bend = 1, slope = 0;
  explicit Steepness(double a) {
    for (int i = 0; i <= 1000; ++i) {
      const double c = 1 - std::min(8.0 / a, 1.0) * i / 1000;
      const double sin2 = std::max(1 - c * c, 0.0);
      bend = std::max(bend, std::pow(c, a - 1) + (a - 1) * std::pow(c, a - 2) * sin2);
      slope = std::max(slope, std::pow(c, a - 1) * std::sqrt(sin2));
    }
    bend *= 1.01;
    slope *= 1.01;
  }
};

// The largest cosine between the way to a light and the ways from the eye to the mesh's points:
// -L.V, whose power the highlight has where N.L = 0.
double largestBackward(const PlacedMesh& p, const glm::dvec3& toLight,
                       const std::vector<glm::dvec3>& points) {
  if (p.variant.constantView) return -glm::dot(toLight, p.camera.axes[2]);
  glm::dvec3 middle(0.0);
  double radius = 0;
  for (const glm::dvec3& each : points) middle += each / double(points.size());
  for (const glm::dvec3& each : points) radius = std::max(radius, glm::length(each - middle));
  const double distance = glm::length(middle);
  if (!(distance > radius)) return 1.0;
  const double between = std::acos(std::clamp(glm::dot(toLight, middle) / distance, -1.0, 1.0));
  return std::cos(std::max(between - std::asin(radius / distance), 0.0));
}

}  // namespace

double interpolationBound(const PlacedMesh& p, Shading program) {
  const Variant& v = p.variant;
  if (v.directionalLights + v.pointLights + v.spotLights == 0) return 0;
  if (v.pointLights + v.spotLights > 0) return unbounded;
  if (program == Shading::flat && v.specular && !v.constantView) return unbounded;
  const Mesh& mesh = p.mesh;
  const glm::dmat3 linear(p.world), normals = normalTransform(linear);
  std::vector<glm::dvec3> turned, points;
  for (const glm::vec3& n : mesh.normals) turned.push_back(safeNormalize(normals * glm::dvec3(n)));
  for (const glm::vec3& x : mesh.positions)
    points.push_back(linear * (glm::dvec3(x) + mesh.origin) + glm::dvec3(p.world[3]) -
                     p.camera.eye);
  const ShadingParameters& m = p.material.shading;
  const double alpha = m.exponent;
  if (program == Shading::gouraud && v.specular && alpha < 2) return unbounded;
  const Steepness steepness(std::max(alpha, 2.0));

  double chord = 0, bend = 0, offFace = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t k[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    double h = 0, edge = 0, near = unbounded;
    for (int j = 0; j < 3; ++j) {
      h = std::max(h, glm::length(turned[k[j]] - turned[k[(j + 1) % 3]]));
      edge = std::max(edge, glm::length(points[k[j]] - points[k[(j + 1) % 3]]));
      near = std::min(near, glm::length(points[k[j]]));
    }
    chord = std::max(chord, h);
    if (program == Shading::flat) {
      glm::dvec3 face =
          safeNormalize(glm::cross(points[k[1]] - points[k[0]], points[k[2]] - points[k[0]]));
      if (glm::determinant(linear) < 0) face = -face;
      for (const std::uint32_t each : k)
        offFace = std::max(offFace, glm::length(turned[each] - face));
      continue;
    }
    if (h > 0.5) return unbounded;
    const double w = h / (1 - h * h / 3);
    double along = 0;
    if (!v.constantView) {
      if (!(near > 2 * edge)) return unbounded;
      along = edge / (near - edge);
    }
    const double both = 2 * w + along;
    bend = std::max(bend, both * both * steepness.bend +
                              (8 * w * w + 2 * along * along + 4 * h * h * h) * steepness.slope);
  }

  glm::vec4 most(1);
  if (v.vertexColors) {
    most = glm::vec4(0);
    for (const glm::vec4& color : mesh.colors) most = glm::max(most, color);
  }
  const glm::dvec3 C = m.color * glm::dvec3(most), S = m.metalness * C + (1 - m.metalness);
  double error = 0;
  for (const Light& light : p.lights) {
    const double diffuse = v.diffuse ? m.diffuse * largest(C * light.intensity) : 0.0;
    const double specular = v.specular ? m.specular * largest(S * light.intensity) : 0.0;
    if (program == Shading::flat) {
      if (offFace > 1e-6) return unbounded;
      error += diffuse * offFace + specular * std::min(1.5 * std::sqrt(alpha) * offFace, 1.0);
      continue;
    }
    const glm::dvec3 toLight = safeNormalize(
        light.type == Light::Type::camera ? p.camera.axes * light.direction : light.direction);
    error += diffuse * (chord / 4 + chord * chord / 6);
    if (!(specular > 0)) continue;
    const double backward = largestBackward(p, toLight, points) + 2 * chord;
    const double jump = backward > 0 ? std::pow(std::min(backward, 1.0), alpha) : 0.0;
    error += specular * std::min(alpha * bend / 6 + jump, 1.0);
    // The driver interpolates what is carried: a few roundings of it.
    error += 4e-6 * (diffuse + specular);
  }
  return error;
}

}  // namespace glint
