#include "glint/gltf/mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <string>
#include <type_traits>

#include "glint/gltf/accessor.h"
#include "glint/gltf/normals.h"
#include "glint/gltf/tangents.h"
#include "glint/gltf/topology.h"
#include "glint/image/task.h"
#include "glint/scene/material_parameters.h"

namespace glint::gltf {
namespace {

/// A mesh farther from its origin than this, in units of its radius, is stored relative to its
/// centre.
constexpr double farAway = 8;

/// Whether `good` holds for all values; called in any order.
template <typename Value, typename Good>
bool allOf(const std::vector<Value>& values, const Good& good) {
  std::atomic<bool> all = true;
  inStretches(values.size(), [&](std::size_t begin, std::size_t end) {
    const auto first = values.begin() + std::ptrdiff_t(begin);
    if (all && !std::all_of(first, values.begin() + std::ptrdiff_t(end), good)) all = false;
  });
  return all;
}

template <typename Vector>
bool fitsFloat(const Vector& v) {
  for (int k = 0; k < Vector::length(); ++k)
    if (!std::isfinite(static_cast<float>(v[k]))) return false;
  return true;
}

class Builder {
 public:
  Builder(const Document& document, std::size_t mesh, std::size_t primitive, Budget& budget,
          Messages& messages)
      : document_(document),
        primitive_(document.model.meshes[mesh].primitives[primitive]),
        label_(named("meshes", mesh, document.model.meshes[mesh].name) + ", primitives[" +
               std::to_string(primitive) + "]"),
        budget_(budget),
        messages_(messages) {}

  std::optional<BuiltMesh> build(const Pose& pose, const std::vector<Material>& materials);

 private:
  using Attributes = std::map<std::string, int>;

  bool lacksData();
  bool readElements();
  template <typename Vector>
  std::vector<Vector> read(const Attributes& attributes, const std::string& name, int least,
                           int most, bool normalize = false, const Vector& fallback = Vector(0));
  template <typename Vector>
  void morph(const Pose& pose, const std::string& name, int least, int most,
             std::vector<Vector>& values, bool normalize = false);
  void applySkin(const Pose& pose, std::vector<glm::dvec3>& positions,
                 std::vector<glm::dvec3>& normals);
  template <typename Vector>
  void dropNonFinite(std::vector<Vector>& positions);
  template <typename Vector>
  void place(std::vector<Vector> positions);
  void readColors(const Pose& pose);
  void readTexcoords(const Pose& pose, const Material& material);
  void finishNormals();
  void readTangents(const Material& material, bool stale);
  void warn(const std::string& what) { messages_.warn(label_ + ": " + what); }
  [[noreturn]] void fail(const std::string& what) const { messages_.fail(label_ + ", " + what); }

  const Document& document_;
  const tinygltf::Primitive& primitive_;
  const std::string label_;
  Budget& budget_;
  Messages& messages_;
  std::size_t vertexCount_ = 0;  ///< of the file's accessors
  VertexList list_;              ///< the vertices of the file that are drawn
  BuiltMesh built_;
};

template <typename Vector>
std::vector<Vector> Builder::read(const Attributes& attributes, const std::string& name, int least,
                                  int most, bool normalize, const Vector& fallback) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return {};
  AccessorView view =
      openAccessor(document_, found->second, label_ + " " + name, budget_, messages_);
  if (view.components < least || view.components > most) {
    fail(name + " must have " + std::to_string(least) +
         (most > least ? " or " + std::to_string(most) : "") + " components per vertex, not " +
         std::to_string(view.components));
  }
  if (view.count < vertexCount_) {
    fail(name + " has " + std::to_string(view.count) + " entries for " +
         std::to_string(vertexCount_) + " vertices");
  }
  if (name.starts_with("JOINTS_")) view.normalized = false;
  budget_.read(list_.count);
  return gather<Vector>(view, list_, normalize, fallback);
}

/// Whether some data are in a buffer without a location; nothing can then be drawn.
bool Builder::lacksData() {
  std::vector<int> accessors;
  if (primitive_.indices >= 0) accessors.push_back(primitive_.indices);
  const auto add = [&](const Attributes& all) {
    for (const auto& [name, accessor] : all) accessors.push_back(accessor);
  };
  add(primitive_.attributes);
  std::ranges::for_each(primitive_.targets, add);
  for (const int accessor : accessors) {
    const int buffer = document_.absentBufferOf(accessor);
    if (buffer < 0) continue;
    warn("lies in buffers[" + std::to_string(buffer) +
         "], which has neither a uri nor a binary GLB chunk, and is not drawn");
    return true;
  }
  return false;
}

bool Builder::readElements() {
  if (lacksData()) return false;
  const auto position = primitive_.attributes.find("POSITION");
  if (position == primitive_.attributes.end()) {
    warn("has no POSITION and is not drawn");
    return false;
  }
  vertexCount_ = document_.model.accessors[static_cast<std::size_t>(position->second)].count;

  std::vector<std::uint32_t> indices;
  if (primitive_.indices >= 0) {
    const AccessorView view =
        openAccessor(document_, primitive_.indices, label_ + " indices", budget_, messages_);
    budget_.read(view.count);
    indices = readIndices(view);
    if (!allOf(indices, [&](std::uint32_t i) { return i < vertexCount_; })) {
      const auto at = std::ranges::find_if(indices, [&](auto i) { return i >= vertexCount_; });
      fail("index " + std::to_string(at - indices.begin()) + " is " + std::to_string(*at) +
           ", but there are only " + std::to_string(vertexCount_) + " vertices");
    }
  } else {
    budget_.read(vertexCount_);
    indices.resize(vertexCount_);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  Elements elements = listElements(primitive_.mode, std::move(indices));
  if (elements.rest > 0) {
    warn("has " + std::to_string(elements.rest) +
         " trailing vertices that do not complete a line or triangle, ignored");
  }
  built_.mesh.topology = elements.topology;
  built_.mesh.indices = std::move(elements.indices);
  if (built_.mesh.indices.empty()) return false;
  list_ = useVertices(built_.mesh.indices, vertexCount_);
  budget_.keep(list_.count);
  return true;
}

template <typename Vector>
void Builder::morph(const Pose& pose, const std::string& name, int least, int most,
                    std::vector<Vector>& values, bool normalize) {
  using Real = typename Vector::value_type;
  const std::size_t count = std::min(pose.weights.size(), primitive_.targets.size());
  for (std::size_t t = 0; t < count && !values.empty(); ++t) {
    if (pose.weights[t] == 0) continue;
    const auto deltas = read<Vector>(primitive_.targets[t], name, least, most, normalize);
    for (std::size_t i = 0; i < deltas.size(); ++i) {
      values[i] += static_cast<Real>(pose.weights[t]) * deltas[i];
    }
  }
}

void Builder::applySkin(const Pose& pose, std::vector<glm::dvec3>& positions,
                        std::vector<glm::dvec3>& normals) {
  Bindings bindings;
  for (int set = 0; set < 8; ++set) {
    const std::string number = std::to_string(set);
    auto joints = read<glm::dvec4>(primitive_.attributes, "JOINTS_" + number, 4, 4);
    auto weights = read<glm::dvec4>(primitive_.attributes, "WEIGHTS_" + number, 4, 4, true);
    if (joints.empty() || weights.empty()) break;
    bindings.joints.push_back(std::move(joints));
    bindings.weights.push_back(std::move(weights));
  }
  const SkinResult result = skin(bindings, pose.joints, positions, normals);
  if (result.badJoint) {
    fail("a vertex is bound to a joint beyond the " + std::to_string(pose.joints.size()) +
         " of its skin");
  }
  if (result.badWeights > 0) {
    warn(std::to_string(result.badWeights) +
         " vertices have joint weights that are negative, not finite or of sum 0, corrected");
  }
  auto& indices = built_.mesh.indices;
  if (result.mirrored && built_.mesh.topology == Topology::triangles) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      std::swap(indices[i + 1], indices[i + 2]);
  }
}

template <typename Vector>
void Builder::dropNonFinite(std::vector<Vector>& positions) {
  if (allOf(positions, fitsFloat<Vector>)) return;
  auto& indices = built_.mesh.indices;
  const std::size_t corners = cornersOf(built_.mesh.topology);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < indices.size(); i += corners) {
    bool whole = true;
    for (std::size_t k = 0; k < corners; ++k) whole = whole && fitsFloat(positions[indices[i + k]]);
    if (!whole) continue;
    for (std::size_t k = 0; k < corners; ++k) indices[kept++] = indices[i + k];
  }
  const char* const kind = corners == 1 ? "points" : corners == 2 ? "lines" : "triangles";
  warn(std::to_string((indices.size() - kept) / corners) + " of " +
       std::to_string(indices.size() / corners) + " " + kind +
       " have a non-finite position and are left out");
  indices.resize(kept);

  const VertexList rest = useVertices(indices, positions.size());
  select(positions, rest);
  select(built_.mesh.normals, rest);
  if (rest.all) return;
  if (list_.all) {
    list_ = rest;
  } else {
    select(list_.ids, rest);
    list_.count = rest.count;
  }
}

template <typename Vector>
void Builder::place(std::vector<Vector> positions) {
  Vector low = positions.front(), high = low;
  std::mutex joining;
  inStretches(positions.size(), [&](std::size_t begin, std::size_t end) {
    Vector least = positions[begin], most = least;
    for (std::size_t i = begin + 1; i < end; ++i) {
      least = glm::min(least, positions[i]);
      most = glm::max(most, positions[i]);
    }
    const std::lock_guard lock(joining);
    low = glm::min(low, least);
    high = glm::max(high, most);
  });
  const glm::dvec3 centre = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
  glm::dvec3& origin = built_.mesh.origin;
  const double radius = glm::length(0.5 * (glm::dvec3(high) - glm::dvec3(low)));
  if (glm::length(centre) > farAway * radius) origin = centre;
  auto& stored = built_.mesh.positions;
  if constexpr (std::is_same_v<Vector, glm::vec3>) {
    if (origin == glm::dvec3(0)) {
      stored = std::move(positions);
      return;
    }
  }
  stored.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    stored[i] = glm::vec3(glm::dvec3(positions[i]) - origin);
}

void Builder::readColors(const Pose& pose) {
  auto& colors = built_.mesh.colors;
  colors = read<glm::vec4>(primitive_.attributes, "COLOR_0", 3, 4, true, glm::vec4(1));
  morph(pose, "COLOR_0", 3, 4, colors, true);
  bool finite = true;
  for (glm::vec4& color : colors) {
    for (int k = 0; k < 4; ++k) {
      const bool good = std::isfinite(color[k]);
      finite = finite && good;
      color[k] = good ? std::clamp(color[k], 0.0f, 1.0f) : 1.0f;
    }
  }
  if (!finite) warn("has vertex colours that are not finite, replaced by 1");
}

void Builder::readTexcoords(const Pose& pose, const Material& material) {
  for (const std::optional<Texture>* each : texturesOf(material)) {
    if (!*each) continue;
    const auto set = static_cast<std::size_t>((*each)->texcoord);
    auto& sets = built_.mesh.texcoords;
    if (set < sets.size() && !sets[set].empty()) continue;
    const std::string name = "TEXCOORD_" + std::to_string(set);
    auto values = read<glm::vec2>(primitive_.attributes, name, 2, 2);
    if (values.empty()) {
      warn("has no " + name + ", which its material uses, so it is drawn without that texture");
      continue;
    }
    morph(pose, name, 2, 2, values);
    bool finite = true;
    for (glm::vec2& value : values) {
      if (fitsFloat(value)) continue;
      finite = false;
      value = glm::vec2(0);
    }
    if (!finite) warn(name + " has values that are not finite, replaced by 0");
    if (sets.size() <= set) sets.resize(set + 1);
    sets[set] = std::move(values);
  }
}

void Builder::finishNormals() {
  Mesh& mesh = built_.mesh;
  if (mesh.topology != Topology::triangles) {
    const std::size_t broken = normaliseEach(mesh.normals);
    if (broken == 0) return;
    warn(std::to_string(broken) + " of " + std::to_string(mesh.normals.size()) +
         " normals are zero or not finite: drawn unlit");
    mesh.normals.clear();
    return;
  }
  if (mesh.normals.empty()) {
    budget_.keep(mesh.indices.size());
    makeFlat(mesh);
  } else if (const std::size_t mended = mendNormals(mesh); mended > 0) {
    warn(std::to_string(mended) + " of " + std::to_string(mesh.normals.size()) +
         " normals are zero or not finite, replaced by the faces' normals");
  }
  mesh.normalsMayCancel = normalsMayCancel(mesh);
}

/// Reads the file's tangents, or generates them if it has none or they no longer fit the vertices.
void Builder::readTangents(const Material& material, bool stale) {
  Mesh& mesh = built_.mesh;
  if (!material.normalTexture || mesh.topology != Topology::triangles) return;
  const auto set = static_cast<std::size_t>(material.normalTexture->texcoord);
  if (set >= mesh.texcoords.size() || mesh.texcoords[set].empty()) return;
  if (!stale) mesh.tangents = read<glm::vec4>(primitive_.attributes, "TANGENT", 4, 4, true);
  bool good = !mesh.tangents.empty();
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    glm::vec4& tangent = mesh.tangents[i];
    const glm::dvec3 unit = direction(glm::dvec3(tangent));
    good = good && glm::dot(unit, unit) > 0.5 && std::abs(tangent.w) > 0.5f;
    tangent = glm::vec4(glm::vec3(unit), tangent.w < 0 ? -1.0f : 1.0f);
  }
  if (good) return;
  if (!mesh.tangents.empty()) warn("has tangents of length 0 or without handedness, recomputed");
  budget_.keep(mesh.indices.size());
  std::vector<glm::vec2> places = mesh.texcoords[set];
  for (glm::vec2& place : places)
    place = glm::vec2(material.normalTexture->transform * glm::dvec3(place, 1));
  makeTangents(mesh, places);
}

std::optional<BuiltMesh> Builder::build(const Pose& pose, const std::vector<Material>& materials) {
  if (!readElements()) return std::nullopt;
  Mesh& mesh = built_.mesh;
  const Attributes& attributes = primitive_.attributes;
  mesh.material = primitive_.material >= 0 ? primitive_.material : int(materials.size()) - 1;

  built_.skinned =
      !pose.joints.empty() && attributes.contains("JOINTS_0") && attributes.contains("WEIGHTS_0");
  const auto finish = [&](auto positions) {
    dropNonFinite(positions);
    if (!mesh.indices.empty()) place(std::move(positions));
  };
  const bool posed = built_.skinned || (pose.morphs() && !primitive_.targets.empty());
  if (posed) {
    auto positions = read<glm::dvec3>(attributes, "POSITION", 3, 3);
    auto normals = read<glm::dvec3>(attributes, "NORMAL", 3, 3);
    morph(pose, "POSITION", 3, 3, positions);
    morph(pose, "NORMAL", 3, 3, normals);
    if (built_.skinned) applySkin(pose, positions, normals);
    mesh.normals.resize(normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) mesh.normals[i] = direction(normals[i]);
    finish(std::move(positions));
  } else {
    auto positions = read<glm::vec3>(attributes, "POSITION", 3, 3);
    mesh.normals = read<glm::vec3>(attributes, "NORMAL", 3, 3);
    finish(std::move(positions));
  }
  if (mesh.indices.empty()) return std::nullopt;
  readColors(pose);
  const Material& material = materials[static_cast<std::size_t>(mesh.material)];
  readTexcoords(pose, material);
  const bool flat = mesh.normals.empty();
  finishNormals();
  readTangents(material, posed || flat);
  return std::move(built_);
}

}  // namespace

std::optional<BuiltMesh> buildMesh(const Document& document, std::size_t mesh,
                                   std::size_t primitive, const Pose& pose,
                                   const std::vector<Material>& materials, Budget& budget,
                                   Messages& messages) {
  return Builder(document, mesh, primitive, budget, messages).build(pose, materials);
}

}  // namespace glint::gltf
