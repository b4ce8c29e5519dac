#pragma once

#include <glm/glm.hpp>
#include <utility>

namespace glint {

// Converts glTF's physically based material to Phong's. Base colour becomes C and is left to the
// caller, as are transmission, alpha and emission.

/// The parameters of a glTF material, with glTF's defaults. Values out of range are clamped.
struct PbrParameters {
  double metallic = 1.0;        ///< [0, 1]
  double roughness = 1.0;       ///< [0, 1], perceptual: GGX's alpha is its square
  double ior = 1.5;             ///< KHR_materials_ior, >= 1; 0 means an infinite index
  double specularFactor = 1.0;  ///< KHR_materials_specular, [0, 1]
};

/// The same in Phong's parameters.
struct ConvertedParameters {
  double ambient = 1.0;    ///< m_a
  double diffuse = 1.0;    ///< m_d
  double specular = 0.0;   ///< m_s
  double exponent = 20.0;  ///< m_sp, Phong's alpha
  double metalness = 0.0;  ///< m_sm
  double ior = 1.5;        ///< n, [1, 1e3]
  double share = 0.0;      ///< of the arriving light that the highlight reflects, [0, 1]
};

/// The m_d of a metal.
inline constexpr double metalDiffuse = 0.6;

/// The smallest roughness with an exponent of its own; smaller values count as this.
inline constexpr double smallestRoughness = 0.1;

/// Phong's alpha = alpha' / 4 with Blinn's alpha' = 2 / r^4 - 2, for which the Blinn-Phong
/// distribution of normals has the width of Beckmann's with m = r^2 (Walter et al. 2007,
/// alpha' = 2 / m^2 - 2). r is clamped to [0.1, 1]: alpha in [0, 4999.5].
double exponentFromRoughness(double roughness);

/// The inverse: (2 / (4 alpha + 2))^(1/4), clamped to [0.1, 1].
double roughnessFromExponent(double exponent);

/// The m_s of the conversion, in [0, 1): the brightness of the highlight's peak for a material with
/// reflectance F0 at normal incidence and Phong exponent alpha = alpha' / 4.
///
/// The energy-normalised Blinn-Phong lobe F0 (alpha' + 8) / (8 pi) (N.H)^alpha', in units in which
/// a white diffuse surface sends 1, peaks at F0 (alpha' + 8) / 8 (Akenine-Moeller et al., Real-Time
/// Rendering). Of this, F0 is the peak of the uniform lobe alpha' = 0, which is diffuse light; the
/// excess is F0 alpha' / 8. A lobe of alpha < 1 ends at 90 degrees in a visible edge, so the excess
/// is multiplied by its share of the peak, alpha' / (alpha' + 8), once more:
///     x = F0 (alpha' / 8) alpha' / (alpha' + 8).
/// A picture's range ends at 1, so x is compressed to x / (1 + x): unchanged for a weak highlight,
/// and never brighter than white paper.
double highlightPeak(double f0, double exponent);

/// F0 = ((n-1)/(n+1))^2 specularFactor for a dielectric.
double dielectricReflectance(const PbrParameters& pbr);

/// The conversion. F0 = ((n-1)/(n+1))^2 specularFactor for dielectrics and 1 for metals, whose
/// highlight gets their colour through m_sm = metallic; m_s = highlightPeak; m_d = 1 for
/// dielectrics and 0.6 for metals, so that they keep their colour if there is no environment to
/// reflect. Both are interpolated by `metallic`, and so is the share, F0. m_a = 1.
ConvertedParameters convertPbr(const PbrParameters& pbr);

/// KHR_materials_pbrSpecularGlossiness, with its defaults. Linear RGB, [0, 1]; values out of range
/// are clamped.
struct SpecularGlossiness {
  glm::dvec3 diffuse{1.0};
  glm::dvec3 specular{1.0};  ///< reflectance at normal incidence
  double glossiness = 1.0;   ///< 1 - roughness
};

/// How metallic the material is, and its reflectance at normal incidence, both in [0, 1]; see
/// below.
struct MetalShare {
  double metallic = 0, reflectance = 0;
};
MetalShare metalShare(const SpecularGlossiness&);

/// The conversion to the notes' parameters, with C.
///
/// A material with less diffuse than specular colour is a metal with the share
/// mu = 1 - max(diffuse) / max(specular) (0 if specular is at most 0.04, as for every dielectric):
/// m_sm = mu, and C goes from `diffuse` to `specular` with it. The rest is convertPbr() with
/// metallic mu, roughness 1 - glossiness and the n whose reflectance at normal incidence is
/// max(specular). A dielectric's coloured highlight becomes white.
std::pair<ConvertedParameters, glm::dvec3> convertSpecularGlossiness(const SpecularGlossiness&);

}  // namespace glint
