#pragma once

#include <glm/glm.hpp>

#include "glint/shading/forms.h"
#include "glint/shading/lobe.h"
#include "glint/shading/normalization.h"

namespace glint {

// The sum of light at a point, in linear light:
//
//     colour = C (m_a A + sum of diffuse) + S (sum of specular),
//     per light, where N.L > 0:  diffuse = m_d I N.L,  specular = m_s k I lobe,
//
// k = 1, or the factor in normalization.h.
//
// The terms that C multiplies and those that S multiplies are kept apart, so that flat and Gouraud
// shading can apply the colours per pixel. Values outside their range are clamped to it, NaN to the
// lower end; the result is finite for every input.

/// The numbers of a material that the sum uses, and the form of its lobe.
struct SumParameters {
  double ambient = 1.0;      ///< m_a, [0, 1e6]
  double diffuse = 1.0;      ///< m_d, [0, 1e6]
  double specular = 0.0;     ///< m_s, [0, 1e6]
  double exponent = 20.0;    ///< m_sp, Phong's alpha, [0, 1e6]
  double blinnFactor = 4.0;  ///< Blinn-Phong's alpha' is this times alpha, [0, 1e6]
  Highlight highlight = Highlight::exact;
  int gamma = 8;  ///< for the forms that have one: a power of two, [1, 64]
  Normalization normalization = Normalization::none;
};

/// The light from one source, or from all, to the viewer: colour = C matte + S specular.
struct LightTerms {
  glm::dvec3 matte{0.0};
  glm::dvec3 specular{0.0};

  LightTerms& operator+=(const LightTerms& other) {
    matte += other.matte;
    specular += other.specular;
    return *this;
  }
};

/// m_a A. `light` is the intensity of the ambient light, components [0, 1e30].
LightTerms ambientLight(const SumParameters& parameters, const glm::dvec3& light);

/// One light with Phong's lobe, max(R.V, 0)^alpha. N, L (to the light) and V (to the viewer) are
/// unit vectors in a common space; a zero L or N gives nothing, and a zero V no highlight.
/// Components of `intensity` are in [0, 1e30]. The result is zero unless N.L > 0; N.V does not
/// matter.
LightTerms phongLight(const SumParameters& parameters, const glm::dvec3& N, const glm::dvec3& L,
                      const glm::dvec3& V, const glm::dvec3& intensity);

/// One light with Blinn-Phong's lobe, max(N.H, 0)^(blinnFactor alpha); otherwise as phongLight.
LightTerms blinnPhongLight(const SumParameters& parameters, const glm::dvec3& N,
                           const glm::dvec3& L, const glm::dvec3& V, const glm::dvec3& intensity);

/// S = m_sm C + (1 - m_sm)(1, 1, 1); m_sm in [0, 1].
glm::dvec3 specularColor(const glm::dvec3& color, double metalness);

/// C matte + S specular.
glm::dvec3 sumColor(const LightTerms& terms, const glm::dvec3& color, double metalness);

/// The cone of a spot light: ((cosAngle - cosOuter) / (cosInner - cosOuter))^2, clamped to [0, 1]
/// before squaring (glTF's KHR_lights_punctual). cosAngle is the cosine between the direction in
/// which the light shines and the direction from the light to the point, -L. If cosInner is not
/// above cosOuter, the edge is hard: 1 inside the outer cone, 0 on it and outside.
double spotFalloff(double cosAngle, double cosInner, double cosOuter);

/// The fall-off of a glTF light with distance, max(min(1 - (d/range)^4, 1), 0) / d^2; a range of 0
/// or infinity means unlimited and leaves 1/d^2. d is clamped to >= 1e-6.
double distanceFalloff(double distance, double range);

}  // namespace glint
