#include "picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint::viewer {
namespace {

constexpr std::size_t chunkSize = 32;  // triangles

// Whether the point origin + t direction, 0 <= t < best, meets the box for some t.
bool meets(const glm::dvec3& origin, const glm::dvec3& inverse, const glm::vec3& low,
           const glm::vec3& high, double best) {
  double near = 0, far = best;
  for (int i = 0; i < 3; ++i) {
    if (std::isinf(inverse[i])) {
      if (origin[i] < double(low[i]) || origin[i] > double(high[i])) return false;
      continue;
    }
    double a = (double(low[i]) - origin[i]) * inverse[i];
    double b = (double(high[i]) - origin[i]) * inverse[i];
    if (a > b) std::swap(a, b);
    near = std::max(near, a);
    far = std::min(far, b);
  }
  return near <= far;
}

}  // namespace

Picker::Picker(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) chunks_.push_back(chunksOf(mesh));
}

void Picker::update(const Scene& scene, std::span<const int> meshes) {
  chunks_.resize(scene.meshes.size());
  for (const int mesh : meshes)
    chunks_[std::size_t(mesh)] = chunksOf(scene.meshes[std::size_t(mesh)]);
}

std::vector<Picker::Chunk> Picker::chunksOf(const Mesh& mesh) {
  std::vector<Chunk> chunks;
  if (mesh.topology != Topology::triangles) return chunks;
  const std::size_t size = 3 * chunkSize;
  for (std::size_t first = 0; first < mesh.indices.size(); first += size) {
    Chunk chunk{glm::vec3(std::numeric_limits<float>::infinity()),
                glm::vec3(-std::numeric_limits<float>::infinity())};
    const std::size_t end = std::min(first + size, mesh.indices.size());
    for (std::size_t i = first; i < end; ++i) {
      chunk.low = glm::min(chunk.low, mesh.positions[mesh.indices[i]]);
      chunk.high = glm::max(chunk.high, mesh.positions[mesh.indices[i]]);
    }
    chunks.push_back(chunk);
  }
  return chunks;
}

namespace {

// A hit on a point or line that passes within a pixel's width of the ray; world space.
std::optional<Hit> meetThin(const Scene& scene, const Instance& instance, std::size_t primitive,
                            const Ray& ray) {
  const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
  const std::size_t corners = cornersOf(mesh.topology);
  const auto corner = [&](std::size_t i) {
    const glm::dvec3 p(mesh.positions[mesh.indices[corners * primitive + i]]);
    return glm::dvec3(instance.world * glm::dvec4(p + mesh.origin, 1));
  };
  const glm::dvec3 from = corner(0), along = corners == 2 ? corner(1) - from : glm::dvec3(0.0);
  // The point on the line nearest to the ray: from + s along, ray at t.
  const glm::dvec3 across = along - ray.direction * glm::dot(along, ray.direction);
  const glm::dvec3 way = ray.origin - from;
  const double square = glm::dot(across, across);
  const double s = square > 0 ? std::clamp(glm::dot(way, across) / square, 0.0, 1.0) : 0;
  const glm::dvec3 place = from + s * along;
  const double t = glm::dot(place - ray.origin, ray.direction);
  if (!(t > 0) ||
      !(glm::length(ray.origin + t * ray.direction - place) <= ray.width + ray.spread * t))
    return {};
  Hit hit;
  hit.mesh = instance.mesh;
  hit.material = mesh.material;
  hit.topology = mesh.topology;
  hit.primitive = primitive;
  hit.barycentric = {1 - s, s, 0};
  hit.distance = t;
  hit.position = place;
  return hit;
}

}  // namespace

template <typename Visit>
void Picker::forEachHit(const Scene& scene, const Ray& ray, bool twoSided, double& limit,
                        Visit visit) const {
  for (std::size_t n = 0; n < scene.instances.size(); ++n) {
    const Instance& instance = scene.instances[n];
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    if (mesh.topology != Topology::triangles) {
      const std::size_t count = mesh.indices.size() / cornersOf(mesh.topology);
      for (std::size_t i = 0; i < count; ++i) {
        auto hit = meetThin(scene, instance, i, ray);
        if (!hit || !(hit->distance < limit)) continue;
        hit->instance = int(n);
        visit(*hit);
      }
      continue;
    }
    const auto& chunks = chunks_[std::size_t(instance.mesh)];
    const glm::dmat3 linear(instance.world);
    const double determinant = glm::determinant(linear);
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) continue;
    const bool both = twoSided || scene.materials[std::size_t(mesh.material)].doubleSided;
    // In the mesh's own space, t is the same.
    const glm::dmat3 inverse = glm::inverse(linear);
    const glm::dvec3 origin = inverse * (ray.origin - glm::dvec3(instance.world[3])) - mesh.origin;
    const glm::dvec3 direction = inverse * ray.direction;
    const glm::dvec3 reciprocal = 1.0 / direction;
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      if (!meets(origin, reciprocal, chunks[c].low, chunks[c].high, limit)) continue;
      const std::size_t last = std::min((c + 1) * chunkSize, mesh.indices.size() / 3);
      for (std::size_t t = c * chunkSize; t < last; ++t) {
        const glm::dvec3 p0(mesh.positions[mesh.indices[3 * t]]);
        const glm::dvec3 e1 = glm::dvec3(mesh.positions[mesh.indices[3 * t + 1]]) - p0;
        const glm::dvec3 e2 = glm::dvec3(mesh.positions[mesh.indices[3 * t + 2]]) - p0;
        // Moeller and Trumbore 1997.
        const glm::dvec3 p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        if (!(std::abs(det) > 0)) continue;
        const glm::dvec3 s = origin - p0;
        const double u = glm::dot(s, p) / det;
        if (!(u >= 0 && u <= 1)) continue;
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(direction, q) / det;
        if (!(v >= 0 && u + v <= 1)) continue;
        const double distance = glm::dot(e2, q) / det;
        if (!(distance > 0 && distance < limit)) continue;
        // In mesh space, where mirroring an instance does not exchange its faces.
        const bool back = det < 0;
        if (back && !both) continue;
        Hit hit;
        hit.instance = int(n);
        hit.mesh = instance.mesh;
        hit.material = mesh.material;
        hit.primitive = t;
        hit.barycentric = {1 - u - v, u, v};
        hit.distance = distance;
        hit.position = ray.origin + ray.direction * distance;
        hit.backFace = back;
        visit(hit);
      }
    }
  }
}

std::vector<Hit> Picker::pickAll(const Scene& scene, const Ray& ray, bool twoSided) const {
  std::vector<Hit> hits;
  double limit = std::numeric_limits<double>::infinity();
  forEachHit(scene, ray, twoSided, limit, [&](const Hit& hit) { hits.push_back(hit); });
  std::ranges::stable_sort(hits, {}, &Hit::distance);
  return hits;
}

std::optional<Hit> Picker::pick(const Scene& scene, const Ray& ray, bool twoSided) const {
  std::optional<Hit> best;
  double nearest = std::numeric_limits<double>::infinity();
  forEachHit(scene, ray, twoSided, nearest, [&](const Hit& hit) {
    nearest = hit.distance;
    best = hit;
  });
  if (best && best->topology == Topology::triangles) {
    const Mesh& mesh = scene.meshes[std::size_t(best->mesh)];
    const glm::dmat3 linear(scene.instances[std::size_t(best->instance)].world);
    const glm::dmat3 normals = glm::transpose(glm::inverse(linear));
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t index = mesh.indices[3 * best->primitive + std::size_t(i)];
      // Normalised per vertex, then interpolated, as the shaders do.
      sum += best->barycentric[i] * glm::normalize(normals * glm::dvec3(mesh.normals[index]));
    }
    const double length = glm::length(sum);
    if (length > 0) best->normal = sum / length;
  }
  return best;
}

}  // namespace glint::viewer
