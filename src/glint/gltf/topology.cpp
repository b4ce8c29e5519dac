#include "glint/gltf/topology.h"

#include <algorithm>
#include <numeric>

namespace glint::gltf {
namespace {

enum Mode { points, lines, lineLoop, lineStrip, triangles, triangleStrip, triangleFan };

/// Removes elements that use a vertex twice, in place.
void dropDegenerate(std::vector<std::uint32_t>& indices, std::size_t corners) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < indices.size(); i += corners) {
    const std::uint32_t* v = &indices[i];
    if (v[0] == v[1] || (corners == 3 && (v[1] == v[2] || v[2] == v[0]))) continue;
    if (kept != i) std::copy(v, v + corners, indices.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += corners;
  }
  indices.resize(kept);
}

}  // namespace

Elements listElements(int mode, std::vector<std::uint32_t> v) {
  Elements elements;
  elements.topology = mode == points      ? Topology::points
                      : mode <= lineStrip ? Topology::lines
                                          : Topology::triangles;
  const std::size_t corners = cornersOf(elements.topology);
  const std::size_t count = v.size();
  auto& out = elements.indices;
  if (mode == points || mode == lines || mode == triangles) {
    elements.rest = count % corners;
    out = std::move(v);
    out.resize(count - elements.rest);
  } else if (count < corners) {
    elements.rest = count;
  } else {
    out.reserve(count * corners);
    if (mode == lineLoop || mode == lineStrip) {
      for (std::size_t i = 0; i + 1 < count; ++i) out.insert(out.end(), {v[i], v[i + 1]});
      if (mode == lineLoop) out.insert(out.end(), {v[count - 1], v[0]});
    }
    for (std::size_t i = 0; mode == triangleStrip && i + 2 < count; ++i) {
      out.insert(out.end(), {v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]});
    }
    for (std::size_t i = 0; mode == triangleFan && i + 2 < count; ++i) {
      out.insert(out.end(), {v[i + 1], v[i + 2], v[0]});
    }
  }
  if (corners > 1) dropDegenerate(out, corners);
  return elements;
}

VertexList useVertices(std::vector<std::uint32_t>& indices, std::size_t vertexCount) {
  VertexList list;
  if (vertexCount / 8 > indices.size()) {
    list.all = false;
    list.ids = indices;
    std::ranges::sort(list.ids);
    // This library's std::ranges::unique does not compile with Clang 14.
    list.ids.erase(std::unique(list.ids.begin(), list.ids.end()), list.ids.end());
    for (std::uint32_t& index : indices) {
      index =
          static_cast<std::uint32_t>(std::ranges::lower_bound(list.ids, index) - list.ids.begin());
    }
    list.count = list.ids.size();
    return list;
  }
  std::vector<std::uint8_t> isUsed(vertexCount, 0);
  for (const std::uint32_t index : indices) isUsed[index] = 1;
  list.count = std::accumulate(isUsed.begin(), isUsed.end(), std::size_t(0));
  list.all = list.count == vertexCount;
  if (list.all) return list;
  std::vector<std::uint32_t> place(vertexCount, 0);
  list.ids.reserve(list.count);
  for (std::uint32_t i = 0; i < vertexCount; ++i) {
    if (isUsed[i] == 0) continue;
    place[i] = static_cast<std::uint32_t>(list.ids.size());
    list.ids.push_back(i);
  }
  for (std::uint32_t& index : indices) index = place[index];
  return list;
}

}  // namespace glint::gltf
