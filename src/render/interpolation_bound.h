#pragma once

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
/// in linear radiance; infinity where no bound is known.
///
/// flat: nothing where all normals of a face are its own and the lights are directional, and the
/// viewer too or there is no highlight; infinity otherwise.
///
/// gouraud, under directional lights, from the chord h between a triangle's vertex normals:
/// - diffuse: interpolation without renormalising shortens N.L by at most h^2/6 of itself; where
/// the
///   triangle spans the terminator the kink of max(N.L, 0) adds at most h/4.
/// - highlight: linear interpolation over a triangle is off by at most M/6 (the sum of w_i w_j is
/// at
///   most 1/3, times M/2), M the second derivative along an edge. With c = R.V, w how far N turns
///   along it and v how far V does, |c'| <= (2w + v) sin, |c''| <= (2w + v)^2 + (8w^2 + 2v^2 +
///   4h^3) sin, so that M <= alpha ((2w + v)^2 sup(c^(a-1) + (a-1) c^(a-2) sin^2) + (...)
///   sup(c^(a-1) sin)). For exponents of at least 2; below, the slope at c = 0 has a jump.
/// - the gate N.L > 0, where the highlight jumps: by at most its value there, (2h - L.V)^alpha over
///   all V.
double interpolationBound(const PlacedMesh&, Shading program);

}  // namespace glint
