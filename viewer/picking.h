#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "camera_control.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// The first intersection of a ray with a scene, in double.
struct Hit {
  int instance = 0, mesh = 0, material = 0;
  Topology topology = Topology::triangles;
  std::size_t primitive = 0;    ///< its indices begin at cornersOf(topology) * primitive
  glm::dvec3 barycentric{0.0};  ///< weights of its corners
  double distance = 0.0;        ///< along the ray
  glm::dvec3 position{0.0};     ///< world space
  glm::dvec3 normal{0, 0, 1};   ///< the interpolated vertex normals, unit, world space; triangles
  bool backFace = false;
};

inline std::size_t cornersOf(Topology topology) {
  return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3;
}

/// Finds what a pixel shows: triangles in chunks with bounding boxes, tested in double, and points
/// and lines that pass within a pixel's width of the ray. Only faces that are not drawn (back faces
/// of one-sided materials) are passed through.
class Picker {
 public:
  explicit Picker(const Scene&);
  /// Call when these meshes have new vertices.
  void update(const Scene&, std::span<const int> meshes);
  std::optional<Hit> pick(const Scene&, const Ray&, bool twoSided) const;
  /// Everything that the ray meets, nearest first; without `normal`.
  std::vector<Hit> pickAll(const Scene&, const Ray&, bool twoSided) const;

 private:
  struct Chunk {
    glm::vec3 low, high;
  };
  /// Calls visit(hit) for hits nearer than `limit`, in no order; visit may lower `limit`.
  template <typename Visit>
  void forEachHit(const Scene&, const Ray&, bool twoSided, double& limit, Visit visit) const;
  static std::vector<Chunk> chunksOf(const Mesh&);

  std::vector<std::vector<Chunk>> chunks_;  // of each mesh
};

}  // namespace glint::viewer
