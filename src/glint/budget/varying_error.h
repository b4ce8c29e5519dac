#pragma once

#include "glint/render/tiles.h"
#include "glint/scene/camera.h"
#include "glint/scene/scene.h"

namespace glint {

/// What a driver's interpolation of normals and positions in single precision may be off by on a
/// mesh, at most on any triangle that shows.
struct VaryingError {
  double normalTurn = 0;  ///< of the unit normal at a pixel, radians
  double place = 0;       ///< of the position in eye space, relative to its distance from the eye
};

/// For pixels of the layout's tiles. Drivers interpolate q = a / w as a plane over the tile, q0 + x
/// dq/dx + y dq/dy from its corner on. With D how far q differs between the corners of a triangle,
/// L its longest side and h its least height in pixels, G the true slope of q and R the tile's
/// diagonal:
///
///  - the slopes are off by three roundings of D / h each (differences, products, the division by
///  the
///    area, which is off by L / h of its own): 6 u D L / h within the triangle;
///  - the value at the tile's corner, and that at the pixel, are sums of three terms as large as q
///  and
///    (R + L) G: together 3 u q + 6 u (R + L) G.
///
/// q itself is off by two roundings, and a by those of the vertex stage (a product with a matrix: 8
/// u). All of it is multiplied by w again, at most the largest of the corners'. What 1 / w is off
/// by all components have in common: no normal turns by it, but positions move along their rays. A
/// normal that interpolation has shortened to |n| turns by 1 / |n| times what its end moves.
///
/// Needles do not count: triangles that are less than a pixel high and more than eight times as
/// long. What a pixel shows of one is an edge, and drivers are off by L / h there.
VaryingError varyingError(const Mesh&, const glm::dmat4& world, bool twoSided, const Camera&,
                          glm::ivec2 resolution, const TileLayout&);

}  // namespace glint
