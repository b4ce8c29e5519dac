#include "glint/gltf/normals.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>

#include "glint/image/task.h"

namespace glint::gltf {
namespace {

/// Replaces a per-vertex array by one with a value per index.
template <typename Value>
void unshare(std::vector<Value>& values, const std::vector<std::uint32_t>& indices) {
  if (values.empty()) return;
  std::vector<Value> own(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) own[i] = values[indices[i]];
  values = std::move(own);
}

glm::dvec3 faceArea(const Mesh& mesh, std::size_t firstIndex) {
  const auto corner = [&](std::size_t k) { return mesh.positions[mesh.indices[firstIndex + k]]; };
  return areaVector(corner(0), corner(1), corner(2));
}

bool isZero(const glm::dvec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

}  // namespace

glm::dvec3 direction(const glm::dvec3& vector) {
  const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
  // Written so that NaN fails too; max() can lose one.
  if (!(largest > 0) || !std::isfinite(vector.x) || !std::isfinite(vector.y) ||
      !std::isfinite(vector.z)) {
    return glm::dvec3(0);
  }
  const glm::dvec3 scaled(vector.x / largest, vector.y / largest, vector.z / largest);
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 origin(a);
  return glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
}

void makeFlat(Mesh& mesh) {
  unshare(mesh.positions, mesh.indices);
  unshare(mesh.colors, mesh.indices);
  for (auto& set : mesh.texcoords) unshare(set, mesh.indices);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    mesh.indices[i] = static_cast<std::uint32_t>(i);
  }
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    glm::dvec3 normal = direction(faceArea(mesh, i));
    if (isZero(normal)) normal = {0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k) mesh.normals[i + k] = glm::vec3(normal);
  }
}

std::size_t normaliseEach(std::vector<glm::vec3>& normals) {
  std::size_t broken = 0;
  for (glm::vec3& normal : normals) {
    const glm::dvec3 unit = direction(glm::dvec3(normal));
    if (!(glm::dot(unit, unit) > 0.5)) ++broken;
    normal = glm::vec3(unit);
  }
  return broken;
}

std::size_t mendNormals(Mesh& mesh) {
  std::vector<std::uint32_t> broken;
  std::mutex adding;
  inStretches(mesh.normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::dvec3 unit = direction(glm::dvec3(mesh.normals[i]));
      mesh.normals[i] = glm::vec3(unit);
      if (!isZero(unit)) continue;
      const std::lock_guard lock(adding);
      broken.push_back(static_cast<std::uint32_t>(i));
    }
  });
  if (broken.empty()) return 0;

  struct Sum {
    glm::dvec3 area{0};   // of the adjacent faces
    double total = 0;     // of the areas' lengths
    glm::dvec3 first{0};  // the first face with an area
  };
  std::vector<std::uint32_t> slot(mesh.normals.size(), 0);
  for (std::size_t i = 0; i < broken.size(); ++i) {
    slot[broken[i]] = static_cast<std::uint32_t>(i) + 1;
  }
  std::vector<Sum> sums(broken.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = slot[mesh.indices[i + k]];
      if (at == 0) continue;
      const glm::dvec3 area = faceArea(mesh, i);
      Sum& sum = sums[at - 1];
      sum.area += area;
      sum.total += glm::length(area);
      if (isZero(sum.first)) sum.first = area;
    }
  }
  for (std::size_t i = 0; i < broken.size(); ++i) {
    // Opposite faces leave a remainder of rounding errors, each 2^-52 of the total.
    const Sum& sum = sums[i];
    const bool cancels = !(glm::length(sum.area) > 1e-12 * sum.total);
    glm::dvec3 normal = direction(cancels ? sum.first : sum.area);
    if (isZero(normal)) normal = {0, 0, 1};
    mesh.normals[broken[i]] = glm::vec3(normal);
  }
  return broken.size();
}

bool normalsMayCancel(const Mesh& mesh) {
  // Pairwise cosines above -0.4 make every mean longer than sqrt((1 - 2 * 0.4) / 3) = 0.25.
  std::atomic<bool> may = false;
  inStretches(mesh.indices.size() / 3, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end && !may; i += 3) {
      const glm::vec3 &a = mesh.normals[mesh.indices[i]], &b = mesh.normals[mesh.indices[i + 1]],
                      &c = mesh.normals[mesh.indices[i + 2]];
      if (std::min({glm::dot(a, b), glm::dot(b, c), glm::dot(c, a)}) < -0.4F) may = true;
    }
  });
  return may;
}

}  // namespace glint::gltf
