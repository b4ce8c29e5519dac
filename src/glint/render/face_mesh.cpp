#include "glint/render/face_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace glint {

FaceMesh makeFaceMesh(const Mesh& mesh) {
  FaceMesh faces;
  const std::size_t count = mesh.positions.size();
  faces.source.resize(count);
  for (std::size_t i = 0; i < count; ++i) faces.source[i] = std::uint32_t(i);
  faces.normals.assign(count, glm::vec3(0, 0, 1));
  faces.centers.assign(count, glm::vec3(0));
  faces.indices.reserve(mesh.indices.size());
  std::vector<bool> taken(count, false);

  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<std::uint32_t, 3> t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    for (int turn = 0; turn < 2 && taken[t[2]]; ++turn)
      std::rotate(t.begin(), t.begin() + 1, t.end());
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double size = std::max({std::abs(cross.x), std::abs(cross.y), std::abs(cross.z)});
    const glm::vec3 normal =
        size > 0 ? glm::vec3(glm::normalize(cross / size)) : mesh.normals[t[2]];
    const glm::vec3 center((a + b + c) / 3.0);
    if (taken[t[2]]) {  // all three are taken: a copy carries this face
      faces.source.push_back(t[2]);
      t[2] = std::uint32_t(faces.source.size() - 1);
      faces.normals.push_back(normal);
      faces.centers.push_back(center);
    } else {
      taken[t[2]] = true;
      faces.normals[t[2]] = normal;
      faces.centers[t[2]] = center;
    }
    faces.indices.insert(faces.indices.end(), t.begin(), t.end());
  }
  return faces;
}

}  // namespace glint
