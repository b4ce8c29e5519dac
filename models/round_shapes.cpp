#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "circle.h"
#include "mesh.h"

namespace glint::models {
namespace {

/// Two triangles for the quadrilateral whose corners are given counter-clockwise from outside.
void addQuad(std::vector<std::uint32_t>& indices, std::uint32_t a, std::uint32_t b, std::uint32_t c,
             std::uint32_t d) {
  indices.insert(indices.end(), {a, b, c, a, c, d});
}

using Face = std::array<std::uint32_t, 3>;

/// The 20 triangles of the icosahedron's twelve vertices: every three mutual neighbours, ordered
/// counter-clockwise seen from outside.
std::vector<Face> icosahedronFaces(const std::vector<glm::dvec3>& points) {
  // Neighbours have the dot product 1/sqrt(5), for all others it is at most -1/sqrt(5).
  const auto areNeighbours = [&](std::uint32_t a, std::uint32_t b) {
    return glm::dot(points[a], points[b]) > 0.0;
  };
  std::vector<Face> faces;
  for (std::uint32_t a = 0; a < points.size(); ++a) {
    for (std::uint32_t b = a + 1; b < points.size(); ++b) {
      for (std::uint32_t c = b + 1; c < points.size(); ++c) {
        if (!areNeighbours(a, b) || !areNeighbours(b, c) || !areNeighbours(c, a)) {
          continue;
        }
        const bool seenFromOutside = glm::dot(glm::cross(points[a], points[b]), points[c]) > 0.0;
        faces.push_back(seenFromOutside ? Face{a, b, c} : Face{a, c, b});
      }
    }
  }
  return faces;
}

/// Vertices at edge midpoints, moved onto the sphere; each edge is divided once.
class Midpoints {
 public:
  explicit Midpoints(std::vector<glm::dvec3>& points) : points_(points) {}

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [entry, isNew] =
        known_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points_.size()));
    if (isNew) {
      points_.push_back(glm::normalize(points_[a] + points_[b]));
    }
    return entry->second;
  }

 private:
  std::vector<glm::dvec3>& points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_;
};

/// A rotation without symmetry, from the quaternion (9, 2, 5, 1) / sqrt(111): rational, so that its
/// entries are exact to one rounding. Among 108 small quaternions this one keeps the vertices of
/// level 6 farthest from the axes (0.007; edges are 0.017 long) and 1.2e-5 off the coordinate
/// planes.
glm::dvec3 turned(const glm::dvec3& p) {
  return glm::dvec3(59 * p.x + 2 * p.y + 94 * p.z, 38 * p.x + 101 * p.y - 26 * p.z,
                    -86 * p.x + 46 * p.y + 53 * p.z) /
         111.0;
}

}  // namespace

Mesh sphere(int around, int down) {
  Mesh mesh;
  const auto add = [&](const glm::dvec3& position, const glm::dvec2& texcoord) {
    mesh.positions.emplace_back(position);
    mesh.texcoords.emplace_back(texcoord);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  const auto at = [&](int row, int column) {
    const glm::dvec2 fromPole = onCircle(row, 2 * down);
    const glm::dvec2 fromSeam = onCircle(column, around);
    return glm::dvec3(-fromPole.y * fromSeam.y, fromPole.x, -fromPole.y * fromSeam.x);
  };

  const std::uint32_t rowLength = around + 1;  // the seam's vertices are stored twice: u is 0 and 1
  for (int row = 1; row < down; ++row) {
    for (int column = 0; column <= around; ++column) {
      add(at(row, column), {double(column) / around, double(row) / down});
    }
  }
  for (int row = 0; row + 2 < down; ++row) {
    for (std::uint32_t column = 0; column + 1 < rowLength; ++column) {
      const std::uint32_t a = row * rowLength + column;
      addQuad(mesh.indices, a, a + rowLength, a + rowLength + 1, a + 1);
    }
  }
  // Each triangle at a pole has its own pole vertex, with u at the triangle's middle.
  const std::uint32_t lastRow = (down - 2) * rowLength;
  for (std::uint32_t column = 0; column + 1 < rowLength; ++column) {
    const double u = (column + 0.5) / around;
    const std::uint32_t north = add({0, 1, 0}, {u, 0});
    mesh.indices.insert(mesh.indices.end(), {north, column, column + 1});
    const std::uint32_t south = add({0, -1, 0}, {u, 1});
    mesh.indices.insert(mesh.indices.end(), {south, lastRow + column + 1, lastRow + column});
  }
  return mesh;
}

Mesh torus(double major, double minor, int around, int along) {
  Mesh mesh;
  for (int i = 0; i < around; ++i) {
    const glm::dvec2 outward = onCircle(i, around);
    for (int j = 0; j < along; ++j) {
      const glm::dvec2 small = onCircle(j, along);
      const double distance = major + minor * small.x;
      mesh.positions.emplace_back(distance * outward.x, minor * small.y, distance * outward.y);
      mesh.normals.emplace_back(small.x * outward.x, small.y, small.x * outward.y);
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * along + j % along);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      addQuad(mesh.indices, index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j));
    }
  }
  return mesh;
}

Mesh icosphere(int level) {
  // Three golden rectangles; the faces go counter-clockwise from outside.
  const double golden = std::numbers::phi;
  std::vector<glm::dvec3> points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      points.push_back(glm::normalize(glm::dvec3(a, b, 0)));
      points.push_back(glm::normalize(glm::dvec3(0, a, b)));
      points.push_back(glm::normalize(glm::dvec3(b, 0, a)));
    }
  }
  std::vector<Face> faces = icosahedronFaces(points);

  Midpoints midpoints(points);
  for (int i = 0; i < level; ++i) {
    std::vector<Face> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = midpoints.between(a, b);
      const std::uint32_t bc = midpoints.between(b, c);
      const std::uint32_t ca = midpoints.between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }

  Mesh mesh;
  for (const glm::dvec3& point : points) {
    mesh.positions.emplace_back(turned(point));
  }
  for (const auto& face : faces) {
    mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
  }
  return mesh;
}

}  // namespace glint::models
