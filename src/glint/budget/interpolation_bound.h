#pragma once

#include <limits>
#include <vector>

#include "glint/render/variant.h"
#include "glint/scene/camera.h"
#include "glint/scene/scene.h"

namespace glint {

/// A mesh as it is placed and lit.
struct PlacedMesh {
  const Scene& scene;
  const Mesh& mesh;
  const glm::dmat4& world;
  const Material& material;  ///< as the look has edited it
  const Look& look;
  const Camera& camera;
  const std::vector<Light>& lights;  ///< those of intensities above 0
  const Variant& variant;
};

/// A bound of how far the exact sum of `flat` or `gouraud` is from that of `phong` at any point of
/// the mesh, in linear radiance. Infinity where no bound is known: where textures give parameters,
/// with a normal map or specular anti-aliasing (only `phong` has them), where a light that weakens
/// with the square of the distance may touch a triangle, and for `flat` where the normals of a face
/// are not its own. Holds for lights of every kind and exponents from 0 on. It is the largest, over
/// the triangles that show, of the sum over the lights of the following terms.
///
/// Let a point of a triangle have the weights b_i and f be a function of position P and normal n,
/// both linear over the triangle, N = n / |n|. Gouraud shading shows sum b_i f_i instead of f.
///
/// 1. If f'' <= M e^2 along every path of length e in P and n, Taylor towards the corners gives
///    |sum b_i f_i - f| <= M/2 sum b_i e_i^2. Here sum b_i e_i^2 = sum over pairs of b_i b_j
///    e_ij^2, at most a third of the longest edge's square. So the error is at most 1/6 of f''
///    along a path as long as the longest edge E in position and as the longest chord h in normal.
///    The same identity gives |n|^2 >= 1 - h^2/3, and d^2 >= min d_i^2 - E^2/3 for the distance d
///    to a light or the eye.
/// 2. Along such a path N turns by w <= h/|n|. L, to a light at a point, turns by l <= E/d, with
///    |L''| <= (2/sqrt 3) l^2, of which at most l^2 is tangential; V, to the eye, likewise by v.
///    N'' has a tangential part whose mean over the corners is at most 1.58 (h/|n|)^3 (relative to
///    the 1/3 of 1.).
/// 3. diffuse: (n.L)'' <= 2hl + |L''|. N.L is n.L / |n|, above n.L by 1 - |n| of itself. Where N.L
///    changes sign, the kink of max(N.L, 0) adds at most pq/(p + q), with p and -q its largest and
///    least value at the corners. The kink makes Gouraud too bright, the missing renormalising too
///    dark, so that the larger of the two counts.
/// 4. highlight: let c = R.V, with R'' and V'' as above, and let R and V turn by r + v <= s = 2w +
///    l + v. Then |c'| <= s sin and -s^2 - t sin <= c'' <= s^2 (1 - c)/2 + t sin with t <= 2w^2 +
///    4wl + l^2 + v^2 + 3.16 (h/|n|)^3. For an exponent a of at least 2, (c^a)'' <= a s^2
///    max(c^(a-1), (1 - c) c^(a-1)/2 + (a-1) c^(a-2) sin^2) + a t c^(a-1) sin. Below 2, c^a has a
///    Hoelder continuous derivative: the error is at most a (s^2 + t)/6 + (s^2/3)^(a/2), and below
///    1 only the last term. The error is never more than the largest highlight on the triangle.
///    That follows from the smallest angle between R and V, which is at least the smallest one at a
///    corner less 2s/3, and at least the one at any corner less s.
/// 5. The gate N.L > 0, where the highlight jumps: lit points lack the part of unlit corners, unlit
///    points get that of lit corners.
/// 6. A light's own change enters by (fg)'' = f''g + 2f'g' + fg''. 1/d^2 has the derivatives 2E/d^3
///    and 6E^2/d^4, its window -d^2/range^4 in all 2dE/range^4 and 2E^2/range^4. A spot's ramp has
///    those of -L.axis (l times the sine of its angle, |L''|) over the range of cosines, and is
///    squared. The ramp ends with a kink: it counts up to its end, and its error beyond is added.
///    Where a light's range ends on the triangle, all that the light brings there counts.
/// 7. flat shows f at the centroid, at most 2/3 of an edge away: 2/3 of f', and all of the
///    highlight where the gate closes. With directional lights and a constant direction to the
///    viewer nothing changes over a face.
///
/// If the bound is above `enough`, any value above `enough` may be returned: the search stops
/// early.
double interpolationBound(const PlacedMesh&, Shading program,
                          double enough = std::numeric_limits<double>::infinity());

}  // namespace glint
