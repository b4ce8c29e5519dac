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
  const Material& material;  ///< edited
  const Look& look;
  const Camera& camera;
  const std::vector<Light>& lights;  ///< those of intensities above 0
  const Variant& variant;
};

/// How far the exact sum of `flat` or `gouraud` is from that of `phong` at any point of the mesh,
/// in linear radiance; infinity where no bound is known: where textures give parameters, with a
/// normal map, which `phong` alone
/// reads, where a light that weakens with the square of the distance may touch a triangle, and for
/// `flat` where the normals of a face are not its own. For lights of every kind and exponents from
/// 0 on. It is the largest over the triangles that show of the sum over the lights, light by light
/// of what follows.
///
/// Let a point of a triangle have the weights b_i and f be a function of position P and normal n,
/// both linear over the triangle, N = n / |n|. Gouraud shading shows sum b_i f_i in place of f.
///
/// 1. With f'' <= M e^2 along every way of length e in P and n, by Taylor towards the corners
///    |sum b_i f_i - f| <= M/2 sum b_i e_i^2, and sum b_i e_i^2 = sum over pairs of b_i b_j e_ij^2,
///    at most a third of the longest edge's square. So the error is at most 1/6 of what f'' is for
///    a way as long as the longest edge E in position, and as the longest chord h in normal. The
///    same identity gives |n|^2 >= 1 - h^2/3, and for the distance d to a light or the eye d^2 >=
///    min d_i^2 - E^2/3.
/// 2. Along such a way N turns by w <= h/|n|; L, to a light at a point, by l <= E/d, with |L''| <=
///    (2/sqrt 3) l^2 of which at most l^2 lies tangential; V, to the eye, likewise by v. N'' has a
///    tangential part whose mean over the corners is at most 1.58 (h/|n|)^3 (to the 1/3 of 1.).
/// 3. diffuse: (n.L)'' <= 2hl + |L''|; N.L is n.L / |n|, above it by 1 - |n| of itself. Where N.L
///    changes sign the kink of max(N.L, 0) adds at most pq/(p + q), p and -q its largest and least
///    value at the corners: what Gouraud shows too much, while renormalising shows in it too
///    little, so that the larger of both counts.
/// 4. highlight: with c = R.V, R'' and V'' as above, r + v <= s = 2w + l + v how far R and V turn,
///    |c'| <= s sin and -s^2 - t sin <= c'' <= s^2 (1 - c)/2 + t sin with t <= 2w^2 + 4wl + l^2 +
///    v^2 + 3.16 (h/|n|)^3. For an exponent a of at least 2, (c^a)'' <= a s^2 max(c^(a-1), (1 - c)
///    c^(a-1)/2 + (a-1) c^(a-2) sin^2) + a t c^(a-1) sin. Below, c^a is differentiable with a
///    Hoelder derivative: the error is at most a (s^2 + t)/6 + (s^2/3)^(a/2), and under 1 the last
///    alone. It is never more than the largest highlight on the triangle, from how near R and V
///    come: not nearer than at some corner less 2s/3, nor than at any corner less s.
/// 5. The gate N.L > 0, where the highlight jumps: open points lack what closed corners have,
///    closed ones get what open corners have.
/// 6. A light's own change multiplies as (fg)'' = f''g + 2f'g' + fg'': 1/d^2 has the derivatives
///    2E/d^3 and 6E^2/d^4, its window -d^2/range^4 in all 2dE/range^4 and 2E^2/range^4, a spot's
///    ramp those of -L.axis (l times the sine of its angle, |L''|) over the range of cosines,
///    squared. Where it ends, with a kink, it counts up to there, and what it is too large or too
///    small by beyond adds. Where a range ends on the triangle, all that the light brings there
///    counts.
/// 7. flat shows f of the centroid, at most 2/3 of an edge away: 2/3 of f', and all of the
///    highlight where the gate closes. With directional lights and viewer nothing changes.
///
/// Above `enough` any value above it may be given: what is known to be too much is not looked at
/// further.
double interpolationBound(const PlacedMesh&, Shading program,
                          double enough = std::numeric_limits<double>::infinity());

}  // namespace glint
