#include "glint/reference/raster.h"

#include <limits>

namespace glint::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A vertex in window and clip space; both are linear between two vertices.
struct Corner {
  glm::dvec3 window;
  double depth;
  double toNear() const { return window.z - depth; }  // >= 0 beyond the near plane
  double toFar() const { return depth; }              // >= 0 before the far plane
};

Corner mix(const Corner& a, const Corner& b, double t) {
  return {a.window + t * (b.window - a.window), a.depth + t * (b.depth - a.depth)};
}

void include(Primitive& p, const glm::dvec3& window) {
  const glm::dvec2 place = glm::dvec2(window) / window.z;
  p.low = glm::min(p.low, place);
  p.high = glm::max(p.high, place);
}

// The box around the part beyond the near plane; false if there is none.
bool findBounds(Primitive& p, const std::array<Corner, 3>& corners) {
  p.low = glm::dvec2(infinity);
  p.high = glm::dvec2(-infinity);
  bool allInside = true;
  for (const Corner& c : corners) allInside = allInside && c.toNear() >= 0 && c.window.z > 0;
  if (allInside) {
    for (const Corner& c : corners) include(p, c.window);
    return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.toNear() >= 0 && a.window.z > 0) include(p, a.window);
    if ((a.toNear() >= 0) != (b.toNear() >= 0)) {
      const Corner cut = mix(a, b, a.toNear() / (a.toNear() - b.toNear()));
      if (cut.window.z > 0) include(p, cut.window);
    }
  }
  return p.low.x <= p.high.x;
}

bool makeTriangle(Primitive& p, const std::array<Corner, 3>& c, const Item& item) {
  for (std::size_t i = 0; i < 3; ++i)
    p.edges[i] = glm::cross(c[(i + 1) % 3].window, c[(i + 2) % 3].window);
  const double size = glm::dot(c[0].window, p.edges[0]);
  if (!(std::abs(size) > 0) || !std::isfinite(size)) return false;
  p.front = (size > 0) != item.mirrored;
  if (item.faces == FaceSide::front && !p.front) return false;
  if (size < 0)
    for (glm::dvec3& edge : p.edges) edge = -edge;
  p.scale = 1 / std::abs(size);
  return findBounds(p, c);
}

// Narrows [low, high] to where f0 + t (f1 - f0) >= 0; false if nowhere.
bool cut(double f0, double f1, double& low, double& high) {
  if (f0 < 0 && f1 < 0) return false;
  if (f0 < 0) low = std::max(low, f0 / (f0 - f1));
  if (f1 < 0) high = std::min(high, f0 / (f0 - f1));
  return low <= high;
}

bool makeLine(Primitive& p, const Corner& a, const Corner& b) {
  double low = 0, high = 1;
  if (!cut(a.toNear(), b.toNear(), low, high) || !cut(a.toFar(), b.toFar(), low, high))
    return false;
  const Corner first = mix(a, b, low), last = mix(a, b, high);
  if (!(first.window.z > 0) || !(last.window.z > 0)) return false;
  p.from = glm::dvec2(first.window) / first.window.z;
  p.to = glm::dvec2(last.window) / last.window.z;
  p.low = glm::min(p.from, p.to) - p.width / 2;
  p.high = glm::max(p.from, p.to) + p.width / 2;
  // t, the position along the line on the screen, as a function of (x, y, 1). All fragments of a
  // column (of a row, if steep) have the values of the line there, as GL prefers for wide lines
  // (OpenGL 3.3, 3.5.2.1); those of a rectangle have the values at their foot on the line.
  const glm::dvec2 way = p.to - p.from;
  const double square = glm::dot(way, way);
  const glm::dvec2 across = isSteep(p) ? glm::dvec2(0, 1) : glm::dvec2(1, 0);
  const glm::dvec2 slope = p.multisampled ? way / square : across / glm::dot(way, across);
  const glm::dvec3 t(slope, -glm::dot(slope, p.from));
  const glm::dvec3 begin = (glm::dvec3(0, 0, 1) - t) / first.window.z, end = t / last.window.z;
  p.edges[0] = begin * (1 - low) + end * (1 - high);
  p.edges[1] = begin * low + end * high;
  return square > 0;
}

bool makePoint(Primitive& p, const Corner& a) {
  if (a.toNear() < 0 || a.toFar() < 0 || !(a.window.z > 0)) return false;
  p.from = p.to = glm::dvec2(a.window) / a.window.z;
  p.low = p.from - p.width / 2;
  p.high = p.from + p.width / 2;
  p.edges[0] = {0, 0, 1 / a.window.z};
  return true;
}

std::size_t cornersOf(Topology topology) {
  return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3;
}

}  // namespace

Footprint Primitive::footprint(double x, double y) const {
  Footprint f;
  f.vertex = vertex;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = edges[std::size_t(i)] * scale;
    f.weights[i] = at(edges[std::size_t(i)], x, y) * scale;
    f.dx[i] = edge.x;
    f.dy[i] = edge.y;
  }
  // The weights times w add up to 1 except for rounding, which a tiny triangle magnifies.
  f.depth = glm::dot(f.weights, vertexDepth) / glm::dot(f.weights, vertexW);
  return f;
}

Footprint Primitive::fragment(int column, int row, int rows, const glm::dvec2& place) const {
  const auto middleOf = [rows](int y) { return rows - y - 0.5; };
  Footprint f = footprint(column + 0.5 + place.x, middleOf(row) + place.y);
  // Squares of 2x2 pixels begin at the picture's lower left.
  const int below = (rows - 1 - row) % 2 == 0 ? row - 1 : row + 1;
  const int columns[] = {column, column ^ 1}, lines[] = {row, below};
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k)
      f.square[i][k] =
          at(edges[std::size_t(k)], columns[i % 2] + 0.5, middleOf(lines[i / 2])) * scale;
  return f;
}

std::size_t primitiveCount(const Mesh& mesh) {
  return mesh.indices.size() / cornersOf(mesh.topology);
}

std::optional<Primitive> makePrimitive(const Item& item, const Vertices& vertices,
                                       std::uint32_t number) {
  Primitive p;
  p.topology = item.mesh->topology;
  p.width = item.thickness;
  p.multisampled = item.multisampled;
  const std::size_t count = cornersOf(p.topology);
  std::array<Corner, 3> corners{};
  for (std::size_t i = 0; i < count; ++i) {
    p.vertex[i] = item.mesh->indices[count * number + i];
    corners[i] = {vertices.window[p.vertex[i]], vertices.depth[p.vertex[i]]};
    p.vertexDepth[int(i)] = corners[i].depth;
    p.vertexW[int(i)] = corners[i].window.z;
  }
  const bool made = p.topology == Topology::triangles ? makeTriangle(p, corners, item)
                    : p.topology == Topology::lines   ? makeLine(p, corners[0], corners[1])
                                                      : makePoint(p, corners[0]);
  if (!made) return std::nullopt;
  return p;
}

std::array<glm::dvec3, 4> outlineOf(const Primitive& p) {
  if (p.topology == Topology::points) {
    const glm::dvec2 low = p.from - p.width / 2, high = p.from + p.width / 2;
    return {glm::dvec3(1, 0, -low.x), {-1, 0, high.x}, {0, 1, -low.y}, {0, -1, high.y}};
  }
  const glm::dvec2 along = glm::normalize(p.to - p.from), left(-along.y, along.x);
  const auto edge = [](const glm::dvec2& inwards, const glm::dvec2& through) {
    return glm::dvec3(inwards, -glm::dot(inwards, through));
  };
  return {edge(along, p.from), edge(-along, p.to), edge(left, p.from - left * (p.width / 2)),
          edge(-left, p.from + left * (p.width / 2))};
}

Columns columnsAt(const Primitive& p, std::span<const glm::dvec3> edges, double y, int width) {
  double low = p.low.x - 1, high = p.high.x;
  for (const glm::dvec3& edge : edges) {
    // One extra column on either side: each sample is tested anyway.
    if (edge.x > 0)
      low = std::max(low, -(edge.y * y + edge.z) / edge.x - 1.5);
    else if (edge.x < 0)
      high = std::min(high, -(edge.y * y + edge.z) / edge.x + 0.5);
  }
  return {int(std::clamp(std::floor(low), 0.0, double(width))),
          int(std::clamp(std::floor(high), -1.0, double(width - 1)))};
}

std::optional<int> lineSample(const Primitive& line, int along) {
  const bool steep = isSteep(line);
  const auto turned = [steep](const glm::dvec2& v) { return steep ? glm::dvec2(v.y, v.x) : v; };
  const glm::dvec2 from = turned(line.from), to = turned(line.to);
  const double center = along + 0.5, t = (center - from.x) / (to.x - from.x);
  const double height = from.y + t * (to.y - from.y);
  if (!(std::abs(height) < 1e9)) return std::nullopt;
  // The first of the samples within half of a width of the line. Where samples lie on both edges,
  // the lower edge owns them if it is a left or a bottom one (ownsEdge).
  const bool ownsLower = steep || (to.y - from.y) / (to.x - from.x) <= 0;
  const auto lowest = [&](double width) {
    const double edge = height - width / 2 - 0.5;
    return ownsLower ? std::ceil(edge) : std::floor(edge) + 1;
  };
  const double next = lowest(1) + 0.5;
  const auto inDiamond = [&](const glm::dvec2& v) {
    return std::abs(v.x - center) + std::abs(v.y - next) < 0.5;
  };
  const bool begins = t >= 0 || inDiamond(from);
  const bool leaves = t < 1 && !inDiamond(to);
  if (!begins || !leaves) return std::nullopt;
  return int(lowest(line.width));
}

}  // namespace glint::reference
