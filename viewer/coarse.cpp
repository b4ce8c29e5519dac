#include "coarse.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "picking.h"

#if GLINT_MESHOPT
#include <meshoptimizer.h>
#endif

namespace glint::viewer {
namespace {

#if GLINT_MESHOPT

constexpr std::size_t fewestPrimitives = 32;  // smaller meshes stay unchanged

// Keeps every n-th point or line, about `most` in all.
std::vector<std::uint32_t> thinned(const Mesh& mesh, std::size_t most) {
  const std::size_t corners = cornersOf(mesh.topology), count = mesh.indices.size() / corners;
  const std::size_t step = (count + most - 1) / most;
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < count; i += step)
    for (std::size_t k = 0; k < corners; ++k) kept.push_back(mesh.indices[corners * i + k]);
  return kept;
}

// Simplifying edge by edge takes seconds for millions of triangles, and does not get far if they
// are not connected. Clustering vertices is fast and always works, but is coarser. So clustering
// comes first and edge collapse continues from its result.
std::vector<std::uint32_t> simplified(const Mesh& mesh, std::size_t most) {
  constexpr float anyError = 1e9f;
  constexpr std::size_t left = 8;  // times the final count
  const auto clustered = [&](std::size_t count) {
    std::vector<std::uint32_t> kept(mesh.indices.size());
    kept.resize(meshopt_simplifySloppy(kept.data(), mesh.indices.data(), mesh.indices.size(),
                                       &mesh.positions[0].x, mesh.positions.size(),
                                       sizeof mesh.positions[0], 3 * count, anyError));
    return kept;
  };
  const bool many = mesh.indices.size() / 3 > left * most;
  const std::vector<std::uint32_t> from = many ? clustered(left * most) : mesh.indices;
  std::vector<std::uint32_t> kept(from.size());
  if (!from.empty())
    kept.resize(meshopt_simplify(kept.data(), from.data(), from.size(), &mesh.positions[0].x,
                                 mesh.positions.size(), sizeof mesh.positions[0],
                                 std::min(3 * most, from.size()), anyError, 0, nullptr));
  return kept.empty() || kept.size() / 3 > 2 * most ? clustered(most) : kept;
}

template <typename Value>
std::vector<Value> taken(const std::vector<Value>& values, const std::vector<std::uint32_t>& from) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(from.size());
  for (const std::uint32_t i : from) result.push_back(values[i]);
  return result;
}

// The mesh with only these indices and the vertices that they use.
Mesh withIndices(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t none = ~std::uint32_t(0);
  std::vector<std::uint32_t> from, place(mesh.positions.size(), none);
  Mesh less;
  less.indices.reserve(indices.size());
  for (const std::uint32_t i : indices) {
    if (place[i] == none) {
      place[i] = std::uint32_t(from.size());
      from.push_back(i);
    }
    less.indices.push_back(place[i]);
  }
  less.topology = mesh.topology;
  less.origin = mesh.origin;
  less.normalsMayCancel = mesh.normalsMayCancel;
  less.opaqueTexels = mesh.opaqueTexels;
  less.material = mesh.material;
  less.fileMesh = mesh.fileMesh;
  less.positions = taken(mesh.positions, from);
  less.normals = taken(mesh.normals, from);
  less.tangents = taken(mesh.tangents, from);
  less.colors = taken(mesh.colors, from);
  for (const auto& set : mesh.texcoords) less.texcoords.push_back(taken(set, from));
  return less;
}

#endif

// A light's contribution at a point that faces it, and its direction.
struct Arriving {
  glm::dvec3 light{0.0};
  glm::dvec3 way{0.0};   ///< unit, to the light; 0 if it has no direction
  double weakening = 1;  ///< its intensity was multiplied by this
};

Arriving arrivingOf(const Light& light, const Bounds& bounds, const Camera& camera) {
  const auto unit = [](const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
  };
  Arriving a;
  switch (light.type) {
    case Light::Type::directional:
      a.way = unit(light.direction);
      break;
    case Light::Type::camera:
      a.way = camera.axes * unit(light.direction);
      break;
    case Light::Type::point:
    case Light::Type::spot: {
      const glm::dvec3 way = light.position - bounds.center;
      a.way = unit(way);
      // For a light inside the model, the surface is about a model radius away.
      const double square = std::max(glm::dot(way, way), bounds.radius * bounds.radius);
      if (light.fallsOff && square > 0) a.weakening = 1 / square;
      break;
    }
  }
  a.light = light.intensity * a.weakening;
  return a;
}

}  // namespace

std::size_t primitivesDrawn(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    count += mesh.indices.size() / cornersOf(mesh.topology);
  }
  return count;
}

#if GLINT_MESHOPT

std::optional<Scene> coarseScene(const Scene& scene, std::size_t triangles,
                                 const std::atomic<bool>& stop) {
  const std::size_t drawn = primitivesDrawn(scene);
  const double share = drawn > 0 ? double(triangles) / double(drawn) : 1;
  Scene coarse;
  coarse.name = scene.name;
  coarse.instances = scene.instances;
  coarse.objects = scene.objects;
  coarse.materials = scene.materials;
  coarse.cameras = scene.cameras;
  coarse.lights = scene.lights;
  coarse.lightScale = scene.lightScale;
  for (const EncodedImage& image : scene.images)
    coarse.images.push_back({image.name, {}, image.isData, image.gloss});
  for (const Mesh& mesh : scene.meshes) {
    if (stop) return {};
    const std::size_t count = mesh.indices.size() / cornersOf(mesh.topology);
    const std::size_t most = std::max(std::size_t(share * double(count)), fewestPrimitives);
    if (most >= count) {
      coarse.meshes.push_back(mesh);
      continue;
    }
    const std::vector<std::uint32_t> indices =
        mesh.topology == Topology::triangles ? simplified(mesh, most) : thinned(mesh, most);
    coarse.meshes.push_back(indices.empty() ? mesh : withIndices(mesh, indices));
  }
  return coarse;
}

#else

std::optional<Scene> coarseScene(const Scene&, std::size_t, const std::atomic<bool>&) { return {}; }

#endif

Look withFewerLights(const Scene& scene, const Bounds& bounds, const Look& look, std::size_t most) {
  Look all = withFileLights(scene, look);
  if (!all.light || all.light->size() <= most) return look;
  const std::vector<std::size_t> shining = shiningLights(*all.light);
  if (shining.size() <= most) return look;
  const Camera camera = cameraFor(scene, bounds, look);
  std::vector<Light> lights;
  std::vector<Arriving> arriving;
  for (const std::size_t i : shining) {
    lights.push_back((*all.light)[i]);
    arriving.push_back(arrivingOf(lights.back(), bounds, camera));
  }
  // For each light, the nearest selected light by direction.
  std::vector<std::size_t> nearest(lights.size(), 0);
  std::vector<double> cosine(lights.size(), -1);  // 1 for selected ones
  std::vector<std::size_t> taken;
  while (taken.size() < most) {
    std::size_t next = lights.size();  // not selected yet; there are more than `most` lights
    double best = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const glm::dvec3& l = arriving[i].light;
      const double gain = std::max({l.r, l.g, l.b}) * (1 - cosine[i]);
      if (cosine[i] < 2 && (next == lights.size() || gain > best)) {
        best = gain;
        next = i;
      }
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const double here = glm::dot(arriving[i].way, arriving[next].way);
      if (here <= cosine[i] && !taken.empty()) continue;
      cosine[i] = here;
      nearest[i] = taken.size();
    }
    cosine[next] = 2;  // never selected again
    nearest[next] = taken.size();
    taken.push_back(next);
  }
  std::vector<Light> fewer;
  for (const std::size_t i : taken) fewer.push_back(lights[i]);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::size_t at = nearest[i];
    if (taken[at] != i) fewer[at].intensity += arriving[i].light / arriving[taken[at]].weakening;
  }
  all.light = std::move(fewer);
  return all;
}

}  // namespace glint::viewer
