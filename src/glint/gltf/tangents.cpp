#include "glint/gltf/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

#include "glint/gltf/normals.h"

namespace glint::gltf {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// `v` without its component along the unit vector `n`, of unit length; zero if nothing is left.
glm::dvec3 inPlane(const glm::dvec3& v, const glm::dvec3& n) {
  return direction(v - glm::dot(n, v) * n);
}

struct Face {
  std::array<std::uint32_t, 3> vertex{};                  ///< welded
  std::array<std::uint32_t, 3> across{none, none, none};  ///< the face across each edge
  std::array<std::uint32_t, 3> group{none, none, none};   ///< of each corner
  glm::dvec3 tangent{0.0};  ///< unit, where u increases; zero if the texture has no area
  bool preserving = false;  ///< the texture is not mirrored as (u, v)
  bool anyGroup = true;     ///< has no handedness of its own
};

struct Group {
  std::uint32_t vertex = 0;
  bool preserving = false;
  glm::dvec3 sum{0.0};
};

class TangentMaker {
 public:
  TangentMaker(Mesh& mesh, const std::vector<glm::vec2>& texcoords)
      : mesh_(mesh), texcoords_(texcoords) {}

  void run() {
    weld();
    makeFaces();
    joinFaces();
    makeGroups();
    sumGroups();
    assign();
  }

 private:
  glm::dvec3 position(std::uint32_t v) const { return glm::dvec3(mesh_.positions[v]); }
  glm::dvec3 normal(std::uint32_t v) const { return glm::dvec3(mesh_.normals[v]); }

  /// Replaces vertices equal in position, normal and coordinates by the first of them.
  void weld() {
    struct Key {
      std::array<float, 8> values;
    };
    std::vector<Key> keys(mesh_.positions.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const glm::vec3 &p = mesh_.positions[i], &n = mesh_.normals[i];
      // Adding 0 makes -0 and 0 the same.
      keys[i].values = {p.x + 0.0f,
                        p.y + 0.0f,
                        p.z + 0.0f,
                        n.x + 0.0f,
                        n.y + 0.0f,
                        n.z + 0.0f,
                        texcoords_[i].x + 0.0f,
                        texcoords_[i].y + 0.0f};
    }
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const int c = std::memcmp(&keys[a], &keys[b], sizeof(Key));
      return c != 0 ? c < 0 : a < b;
    });
    welded_.resize(keys.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool same =
          i > 0 && std::memcmp(&keys[order[i]], &keys[order[i - 1]], sizeof(Key)) == 0;
      welded_[order[i]] = same ? welded_[order[i - 1]] : order[i];
    }
  }

  void makeFaces() {
    faces_.resize(mesh_.indices.size() / 3);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      Face& face = faces_[f];
      for (std::size_t k = 0; k < 3; ++k) face.vertex[k] = welded_[mesh_.indices[3 * f + k]];
      const auto& v = face.vertex;
      const glm::dvec3 p1 = position(v[1]) - position(v[0]), p2 = position(v[2]) - position(v[0]);
      const glm::dvec2 t0(texcoords_[v[0]]);
      const glm::dvec2 t1 = glm::dvec2(texcoords_[v[1]]) - t0,
                       t2 = glm::dvec2(texcoords_[v[2]]) - t0;
      const double area = t1.x * t2.y - t1.y * t2.x;
      face.preserving = area > 0;
      if (!(std::abs(area) > 1e-37)) continue;
      face.tangent = direction((area > 0 ? 1.0 : -1.0) * (t2.y * p1 - t1.y * p2));
      face.anyGroup = face.tangent == glm::dvec3(0.0);
    }
  }

  /// Each edge joins two faces that run along it in opposite directions; if more than two share it,
  /// the unpaired ones stay open.
  void joinFaces() {
    struct Edge {
      std::uint32_t low, high, face;
      std::uint8_t edge;
      bool forward;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::uint8_t k = 0; k < 3; ++k) {
        const std::uint32_t a = faces_[f].vertex[k], b = faces_[f].vertex[(k + 1) % 3];
        if (a != b) edges.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
      }
    }
    std::ranges::sort(edges, {},
                      [](const Edge& e) { return std::tuple(e.low, e.high, e.face, e.edge); });
    std::vector<const Edge*> ahead, back;
    for (std::size_t i = 0; i < edges.size();) {
      ahead.clear();
      back.clear();
      std::size_t end = i;
      for (;
           end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high;
           ++end) {
        (edges[end].forward ? ahead : back).push_back(&edges[end]);
      }
      for (std::size_t k = 0; k < std::min(ahead.size(), back.size()); ++k) {
        faces_[ahead[k]->face].across[ahead[k]->edge] = back[k]->face;
        faces_[back[k]->face].across[back[k]->edge] = ahead[k]->face;
      }
      i = end;
    }
  }

  std::size_t cornerOf(const Face& face, std::uint32_t vertex) const {
    return face.vertex[0] == vertex ? 0 : face.vertex[1] == vertex ? 1 : 2;
  }

  /// Walks from each corner around its vertex, as far as edges and handedness allow.
  void makeGroups() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (faces_[f].anyGroup || faces_[f].group[k] != none) continue;
        const auto number = static_cast<std::uint32_t>(groups_.size());
        const std::uint32_t vertex = faces_[f].vertex[k];
        groups_.push_back({vertex, faces_[f].preserving, {}});
        open.assign(1, f);
        while (!open.empty()) {
          Face& face = faces_[open.back()];
          open.pop_back();
          const std::size_t corner = cornerOf(face, vertex);
          if (face.group[corner] != none) continue;
          if (face.anyGroup && face.group == std::array{none, none, none})
            face.preserving = groups_[number].preserving;
          if (face.preserving != groups_[number].preserving) continue;
          face.group[corner] = number;
          for (const std::size_t edge : {corner, (corner + 2) % 3}) {
            if (face.across[edge] != none) open.push_back(face.across[edge]);
          }
        }
      }
    }
  }

  void sumGroups() {
    for (const Face& face : faces_) {
      if (face.anyGroup) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = face.vertex[k];
        const glm::dvec3 n = normal(v);
        const glm::dvec3 a = inPlane(position(face.vertex[(k + 1) % 3]) - position(v), n);
        const glm::dvec3 b = inPlane(position(face.vertex[(k + 2) % 3]) - position(v), n);
        const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
        groups_[face.group[k]].sum += angle * inPlane(face.tangent, n);
      }
    }
  }

  glm::vec4 tangentOf(std::uint32_t vertex, std::uint32_t group) const {
    const glm::dvec3 n = normal(vertex);
    glm::dvec3 t(0.0);
    if (group != none) t = inPlane(groups_[group].sum, n);
    if (t == glm::dvec3(0.0))
      t = inPlane(std::abs(n.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n);
    const bool preserving = group != none && groups_[group].preserving;
    return {glm::vec3(t), preserving ? -1.0f : 1.0f};
  }

  /// Gives each vertex its tangent; each further group at a vertex gets a copy of the vertex.
  void assign() {
    const std::size_t count = mesh_.positions.size();
    mesh_.tangents.assign(count, glm::vec4(0));
    std::vector<std::uint32_t> groupOf(count, none);
    std::vector<bool> used(count, false);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
    const auto duplicate = [](auto& values, std::uint32_t from) {
      if (values.empty()) return;
      const auto value = values[from];
      values.push_back(value);
    };
    for (std::size_t i = 0; i < 3 * faces_.size(); ++i) {
      std::uint32_t& index = mesh_.indices[i];
      const std::uint32_t group = faces_[i / 3].group[i % 3];
      if (!used[index]) {
        used[index] = true;
        groupOf[index] = group;
        mesh_.tangents[index] = tangentOf(index, group);
        continue;
      }
      if (groupOf[index] == group) continue;
      const auto [copy, isNew] =
          copies.try_emplace({index, group}, std::uint32_t(mesh_.positions.size()));
      if (isNew) {
        duplicate(mesh_.positions, index);
        duplicate(mesh_.normals, index);
        duplicate(mesh_.colors, index);
        for (auto& set : mesh_.texcoords) duplicate(set, index);
        mesh_.tangents.push_back(tangentOf(index, group));
      }
      index = copy->second;
    }
  }

  Mesh& mesh_;
  const std::vector<glm::vec2> texcoords_;  ///< a copy: the mesh's own grow with its vertices
  std::vector<std::uint32_t> welded_;
  std::vector<Face> faces_;
  std::vector<Group> groups_;
};

}  // namespace

void makeTangents(Mesh& mesh, const std::vector<glm::vec2>& texcoords) {
  TangentMaker(mesh, texcoords).run();
}

}  // namespace glint::gltf
