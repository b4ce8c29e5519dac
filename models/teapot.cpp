#include <array>
#include <cassert>

#include "mesh.h"
#include "teapot_patches.h"

namespace glint::models {
namespace {

struct SurfacePoint {
  glm::dvec3 position;
  glm::dvec3 normal;  ///< unit length, pointing out of the pot
};

/// Cubic Bernstein polynomials at t in [0, 1].
std::array<double, 4> weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

/// Their derivatives.
std::array<double, 4> weightSlopes(double t) {
  const double s = 1.0 - t;
  return {-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t};
}

glm::dvec3 blend(const int (&patch)[16], const std::array<double, 4>& u,
                 const std::array<double, 4>& v) {
  glm::dvec3 sum{0.0};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double(&point)[3] = teapotPoints[patch[4 * i + j] - 1];
      sum += u[i] * v[j] * glm::dvec3(point[0], point[1], point[2]);
    }
  }
  return sum;
}

SurfacePoint evaluate(const int (&patch)[16], double u, double v) {
  const glm::dvec3 alongU = blend(patch, weightSlopes(u), weights(v));
  glm::dvec3 alongV = blend(patch, weights(u), weightSlopes(v));
  // At the poles of lid and bottom the row u = 0 is one point and S_v is zero. Near it, S_v is
  // u S_uv to first order, so S_uv gives the limit of the normal's direction.
  if (glm::length(alongV) < 1e-12) {
    alongV = blend(patch, weightSlopes(u), weightSlopes(v));
  }
  return {blend(patch, weights(u), weights(v)), glm::normalize(glm::cross(alongV, alongU))};
}

/// The vertices so far; points that differ only by rounding are merged.
class Vertices {
 public:
  explicit Vertices(Mesh& mesh) : mesh_(mesh) {}

  std::uint32_t add(const SurfacePoint& point) {
    // Where patches meet, their points agree up to rounding (1e-15), and so do their normals: the
    // published surface has no crease. All other points are farther apart than this.
    constexpr double tolerance = 1e-6;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (glm::distance(points_[i].position, point.position) < tolerance &&
          glm::distance(points_[i].normal, point.normal) < tolerance) {
        return static_cast<std::uint32_t>(i);
      }
    }
    points_.push_back(point);
    // From +Z up to +Y up, and from a height of 3.15 to 1.5.
    constexpr double scale = 1.5 / 3.15;
    mesh_.positions.emplace_back(scale * point.position.x, scale * point.position.z,
                                 -scale * point.position.y);
    mesh_.normals.emplace_back(point.normal.x, point.normal.z, -point.normal.y);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

 private:
  Mesh& mesh_;
  std::vector<SurfacePoint> points_;
};

}  // namespace

Mesh teapot(int steps) {
  assert(steps > 0);
  Mesh mesh;
  Vertices vertices(mesh);
  const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) {  // at a pole, half of the triangles are degenerate
      mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
  };
  for (const auto& patch : teapotPatches) {
    std::vector<std::uint32_t> above;
    for (int i = 0; i <= steps; ++i) {
      std::vector<std::uint32_t> row;
      for (int j = 0; j <= steps; ++j) {
        row.push_back(vertices.add(evaluate(patch, double(i) / steps, double(j) / steps)));
      }
      for (int j = 0; i > 0 && j < steps; ++j) {
        addTriangle(above[j], above[j + 1], row[j + 1]);
        addTriangle(above[j], row[j + 1], row[j]);
      }
      above = row;
    }
  }
  return mesh;
}

}  // namespace glint::models
