#pragma once

#include <array>
#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// What a pixel's value is: the picture's radiance, or what went into it, so that the error of a
/// picture can be split into that of interpolation, of texture filtering and of shading.
enum class PixelOutput {
  radiance,
  position,  ///< xyz: eye space, w: 1
  normal,  ///< xyz: as interpolated, before renormalising; w: 1 on a front face, -1 on a back face
  color,   ///< C of the pixel and alpha: factor, vertex colour and texture
  emission,       ///< rgb, w: 1
  depth,          ///< x: the depth buffer's value, y: 1 / w of clip space
  shadingNormal,  ///< xyz: eye space, unit, turned as shading turns it; w: 1
  ids,            ///< xyz: three numbers of the draw (MaterialBlock::emission), w: 1
  // Parts of what the program environment shows; alpha as in the picture:
  sum,         ///< (1 - t) times the sum over the lights, plus emission
  reflection,  ///< F E(reflect), where there are neither lights nor ambient light
  refraction,  ///< t (1 - F) C E(refract), likewise
};

/// What a shader contains: the program and only the features that the scene needs. Equal variants
/// share one GLSL program. A pure function of scene and look; needs no GL.
struct Variant {
  Shading program = Shading::phong;
  bool unlit = false;  ///< no light: unlit materials, and points and lines without normals (these
                       ///< add emission to their colour)
  int directionalLights = 0, pointLights = 0, spotLights = 0;
  bool lightFalloff = false;  ///< points and spots weaken with distance
  bool diffuse = false;       ///< some light and m_d > 0
  bool specular = false;      ///< some light and m_s > 0
  /// The form in use, `exact` unless specular; for `integer`, gamma is the exponent.
  HighlightForm highlight;
  bool specularAntialiasing = false;  ///< the exponent is filtered, pixel by pixel
  bool toksvig = false;               ///< from the normal map's levels, not from how normals turn
  /// A form for dimmer lights: it applies from one light of each type up to where the next form
  /// begins.
  struct Dimmer {
    HighlightForm form;
    int directional = 0, point = 0, spot = 0;  ///< the first such light of each type
    auto operator<=>(const Dimmer&) const = default;
  };
  std::vector<Dimmer> dimmer;    ///< at most HighlightForms::mostDimmer
  bool constantView = false;     ///< one direction to the viewer: H, V and L + V once per draw
  bool unevenScale = false;      ///< normals need renormalising per vertex
  bool pixelPosition = false;    ///< per-pixel programs read the interpolated position
  bool vanishingNormal = false;  ///< interpolated normals may cancel
  bool twoSided = false;         ///< back faces are drawn, lit from their side
  bool vertexColors = false, colorTexture = false;
  bool normalTexture = false;  ///< per-pixel programs where light or environment reads the normal
  bool emission = false, emissionTexture = false;
  bool alphaMask = false, alphaBlend = false;
  /// The samplers of the textures that are read: colour, emission, normals, then the four parameter
  /// textures in their order.
  std::array<Sampler, 7> samplers{};
  /// The parameters that the program reads from textures, as bits of namespace textured, and the
  /// textures that give them.
  unsigned textured = 0;
  bool metallicRoughnessTexture = false, occlusionTexture = false;
  bool specularTexture = false, transmissionTexture = false;
  /// Where each of those is looked up: an index into parameterPlaces(), or -1 for the colour
  /// texture's coordinates.
  std::array<int, 4> parameterPlaces{};
  int parameterPlaceCount = 0;  ///< size of parameterPlaces(), 0 if none is read
  /// The highlight is normalised in the shader, since a texture gives what the factor depends on;
  /// otherwise the material's numbers include the factor.
  bool normalized = false;
  Normalization normalization = Normalization::none;  ///< the one that the shader computes
  // Only for the program environment:
  Environment environment = Environment::studio;
  Fresnel fresnel = Fresnel::exact;
  bool schlickFifth = false;  ///< Schlick's exponent is 5: products instead of pow
  bool dielectric = false, metal = false, refraction = false;
  bool denserSide = false;    ///< some side that shows is seen from the denser medium
  bool multisampled = false;  ///< shaded where the triangle covers samples
  PixelOutput output = PixelOutput::radiance;

  /// Remove what only shading, or only the picture itself, reads.
  void dropParameterTextures();
  void dropEmission();

  auto operator<=>(const Variant&) const = default;
};

/// A feature that a variant has or lacks, and why.
struct FeatureReason {
  std::string feature;
  bool present = false;
  std::string reason;
};

/// The variant of one mesh under one world transform, with the material as the look has edited it.
/// `orthographic`: whether the camera in use is.
Variant variantFor(const Mesh&, const Material&, const glm::dmat4& world, const Look&,
                   bool orthographic);

/// The textures of a material's parameters, in the order of Variant::parameterPlaces.
std::array<const std::optional<Texture>*, 4> parameterTexturesOf(const Material&);

/// Which of a material's parameters (bits of namespace textured) come from textures on this mesh,
/// which may lack the coordinates.
unsigned texturedOn(const Mesh&, const Material&);

/// The distinct texture coordinates of the parameter textures: for each, the first texture that
/// uses them.
std::vector<const Texture*> parameterPlaces(const Material&);

/// The program that draws a look; phong if that is still `automatic`.
Shading programOf(const Look&);

/// The forms that draw a material's highlight: those asked for, except that `integer` becomes
/// `exact` where the exponent is not a whole number from 1 to 128, and every form except `pow` and
/// `none` does where the exponent is 0. An exponent that comes from a texture, or is filtered, does
/// not count as a whole number and has no table; where it is 0 the forms are exact, pixel by pixel.
/// For `integer`, gamma is the exponent.
HighlightForms highlightOf(const Material&, const Look&);

/// Whether a look widens a material's highlight, pixel by pixel.
bool filtersHighlights(const Material&, const Look&);

/// The form of a material's reflectance.
Fresnel fresnelOf(const Material&, const Look&);

/// The variant that writes an attribute of the same pixels; only per-pixel programs have normals
/// and positions.
Variant attributeVariant(Variant, PixelOutput);

/// Why a variant is as it is, in the order of features().
std::vector<FeatureReason> reasonsFor(const Variant&, const Mesh&, const Material&, const Look&,
                                      bool orthographic);

/// The number of rows of four entries in a form's table (HighlightRow::hasTable), 0 if it has none;
/// and in the tables of all forms of a variant.
int lobeTableRows(const HighlightForm&);
int lobeTableRows(const Variant&);

/// The names of the features that a variant has.
std::vector<std::string> featureNames(const Variant&);

/// The lights of a look: those given, or the default one, or none. Those of a file are in the look
/// that withFileLights() returns; every function here takes that look.
std::vector<Light> lightsOf(const Look&);

/// The lights that shine, as indices of `lights`: the brightest first, by the largest channel of
/// the intensity; equally bright ones in the order given.
std::vector<std::size_t> shiningLights(const std::vector<Light>& lights);

/// Whether a 3x3 transform is a rotation (with or without mirroring) times one scale, to 1e-6.
bool isSimilarity(const glm::dmat3&);

}  // namespace glint
