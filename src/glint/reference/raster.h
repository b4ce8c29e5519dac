#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "glint/reference/scene.h"

// GL's rasterisation in double, without snapping vertices to a subpixel grid: a driver that snaps
// to 1/256 of a pixel covers other samples where an edge passes closer to a centre than that.
//
// Points and lines are one pixel of the picture wide, whatever its anti-aliasing (glTF 2.0, 3.9.7):
// as many samples of the grid as `ssaa` has in a row.
namespace glint::reference {

/// Where a sample lies in its primitive: the vertices' weights divided by w (they add up to 1 / w,
/// so that an attribute is their weighted mean), and their change from sample to sample.
struct Footprint {
  std::array<std::uint32_t, 3> vertex{};
  glm::dvec3 weights{0.0}, dx{0.0}, dy{0.0};
  /// The weights at the centres of the four pixels of the 2x2 square over which GL takes
  /// differences: the pixel itself, its neighbours in x, in y, and in both. Only
  /// Primitive::fragment() sets them.
  std::array<glm::dvec3, 4> square{};
  double depth = 0;  ///< 1 at the near plane, 0 at the far one
};

/// A point, line or triangle prepared for rasterisation. Triangles are rasterised in homogeneous
/// coordinates (Olano and Greer 1997): the three edge functions hold even where w changes sign, so
/// that nothing is clipped except by the depth of each sample.
struct Primitive {
  Topology topology = Topology::triangles;
  std::array<std::uint32_t, 3> vertex{};
  std::array<glm::dvec3, 3> edges{};  ///< weights * size as functions of (x, y, 1)
  double scale = 1;                   ///< 1 / size
  glm::dvec3 vertexDepth{0.0}, vertexW{0.0};
  bool front = true;               ///< triangles: the front side is seen
  glm::dvec2 low{0.0}, high{0.0};  ///< around all samples that it may cover
  glm::dvec2 from{0.0}, to{0.0};   ///< lines and points: the ends, within the depth range
  double width = 1;                ///< lines and points: in samples of the grid
  bool multisampled = false;       ///< lines are rectangles, with ends at right angles

  Footprint footprint(double x, double y) const;

  /// The footprint of a fragment in the pixel (column, row from the top) of a picture of `rows`
  /// rows, shaded at `place` from the pixel's centre.
  Footprint fragment(int column, int row, int rows, const glm::dvec2& place) const;
};

/// Nothing if it is culled, has no area or length, or lies entirely in front of the near plane or,
/// for lines and points, beyond the far plane.
std::optional<Primitive> makePrimitive(const Item& item, const Vertices& vertices,
                                       std::uint32_t number);

std::size_t primitiveCount(const Mesh& mesh);

/// Whether a sample on an edge belongs to the triangle on the side where the edge's function is
/// positive. GL leaves that to the driver, as long as one of the two triangles gets it. Here: left
/// edges, and horizontal edges at the bottom (their inside is above), as in llvmpipe's framebuffer
/// objects: its top-left rule counts rows as they lie in memory, bottom first.
inline bool ownsEdge(const glm::dvec3& edge) { return edge.x > 0 || (edge.x == 0 && edge.y > 0); }

inline double at(const glm::dvec3& f, double x, double y) { return f.x * x + f.y * y + f.z; }

/// Whether a convex polygon, given by its edges' functions, covers the place (x, y).
template <std::size_t count>
bool covers(const std::array<glm::dvec3, count>& edges, double x, double y) {
  for (const glm::dvec3& edge : edges) {
    const double e = at(edge, x, y);
    if (!(e > 0 || (e == 0 && ownsEdge(edge)))) return false;
  }
  return true;
}

/// Whether a triangle covers the place (x, y).
inline bool covers(const Primitive& p, double x, double y) { return covers(p.edges, x, y); }

/// The edges of what a point covers, a square about its place, or a multisampled line: the
/// rectangle of its width between its ends (OpenGL 3.3, 3.4.1 and 3.5.4).
std::array<glm::dvec3, 4> outlineOf(const Primitive& pointOrLine);

/// The first and the last column whose samples the polygon may cover in the row at height y.
struct Columns {
  int first, last;
};
Columns columnsAt(const Primitive&, std::span<const glm::dvec3> edges, double y, int width);

/// The lowest row of a line's fragments in this column (for a steep line, the first column of those
/// in this row), if it has any: as many as the line is wide, those within half of its width above
/// and below it. Whether it has any is decided by GL's diamond-exit rule for a line of width 1: the
/// sample next to the line counts unless the line begins beyond its centre and outside its diamond,
/// or ends inside its diamond.
std::optional<int> lineSample(const Primitive& line, int along);
inline bool isSteep(const Primitive& line) {
  return std::abs(line.to.y - line.from.y) > std::abs(line.to.x - line.from.x);
}

/// Calls visit(column, row) for each sample covered, rows counted from the top, in [firstRow,
/// endRow); row by row, lines along their length. `sample` is the place in each pixel, from its
/// centre.
template <typename Visit>
void forEachSample(const Primitive& p, const glm::ivec2& grid, int firstRow, int endRow,
                   const glm::dvec2& sample, Visit visit) {
  const auto place = [](double x, int low, int high) {  // floor, within [low, high]
    return int(std::clamp(std::floor(x), double(low), double(high)));
  };
  const int top = place(grid.y - p.high.y - 1, firstRow, endRow);
  const int bottom = place(grid.y - p.low.y + 1, firstRow - 1, endRow - 1);
  if (p.topology == Topology::lines && !p.multisampled) {
    const bool steep = isSteep(p);
    const int first = steep ? top : place(p.low.x - 1, 0, grid.x);
    const int last = steep ? bottom : place(p.high.x + 1, -1, grid.x - 1);
    for (int i = first; i <= last; ++i) {
      const auto across = lineSample(p, steep ? grid.y - 1 - i : i);
      if (!across) continue;
      for (int k = *across; k < *across + int(p.width); ++k) {
        const int column = steep ? k : i, row = steep ? i : grid.y - 1 - k;
        if (column >= 0 && column < grid.x && row >= firstRow && row < endRow) visit(column, row);
      }
    }
    return;
  }
  const auto fill = [&](const auto& edges) {
    for (int row = top; row <= bottom; ++row) {
      const double y = grid.y - row - 0.5;
      const Columns columns = columnsAt(p, edges, y + sample.y, grid.x);
      for (int column = columns.first; column <= columns.last; ++column)
        if (covers(edges, column + 0.5 + sample.x, y + sample.y)) visit(column, row);
    }
  };
  if (p.topology == Topology::triangles)
    fill(p.edges);
  else
    fill(outlineOf(p));
}

}  // namespace glint::reference
