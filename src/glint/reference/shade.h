#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/render/environment_image.h"
#include "glint/shading/environment_map.h"
#include "glint/shading/forms.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/normalization.h"
#include "glint/shading/specular_filter.h"

// The shading of the reference renderer: double precision, using only the formulas of
// src/glint/shading. Everything is in eye space: the eye at the origin, looking along -Z.
namespace glint::reference {

struct Light {
  enum class Type { directional, point, spot };
  Type type = Type::directional;
  glm::dvec3 place{0.0};  ///< directional: unit, to the light; otherwise its position
  glm::dvec3 axis{0.0};   ///< spot: unit, along its axis
  double cosInner = 1.0, cosOuter = 0.0;
  bool fallsOff = false;  ///< `intensity` is that at distance 1; no light beyond `range`
  double range = 0.0;     ///< 0: unlimited
  glm::dvec3 intensity{1.0};
  int number = 0;  ///< its index in lightsOf(look)
  int rank = 0;    ///< its index in shiningLights()
};

/// What a picture's pixels have in common.
struct Frame {
  std::vector<Light> lights;
  glm::dvec3 ambientLight{0.0};
  bool constantView = false;  ///< the viewer is towards +Z everywhere: orthographic or infinite
  BuiltinEnvironment environment = BuiltinEnvironment::studio;
  const EnvironmentImage* image = nullptr;  ///< replaces `environment`, if set
  glm::dmat3 environmentFromEye{1.0};
};

/// Which part of the radiance a surface shows.
enum class Part { all, sum, reflection, refraction };

/// The numbers of a material at one point of its surface.
struct Numbers {
  double ambient = 1, diffuse = 1, specular = 0, exponent = 20, metalness = 0, transmission = 0;
};

/// A material under a look.
struct Surface {
  Shading program = Shading::phong;
  bool unlit = false;
  bool twoSided = false;  ///< the normal is turned on back faces
  /// The forms of the lobe, each for the lights from a rank on.
  struct Lobe {
    Highlight form = Highlight::exact;
    int gamma = 8;  ///< only for forms that have one
    int from = 0;
  };
  std::vector<Lobe> lobes{Lobe{}};
  Fresnel fresnel = Fresnel::exact;
  Numbers numbers;  ///< where no texture gives them
  Normalization normalization = Normalization::none;
  SpecularAntialiasing filter = SpecularAntialiasing::none;  ///< only for per-pixel programs
  double blinnFactor = 4, schlickExponent = 5;
  double ior = 1.5, mediumIor = 1;
  FresnelSides sides;        ///< of ior and mediumIor
  double rationalSlope = 0;  ///< k of Fresnel::rational
  Part part = Part::all;     ///< `sum` includes emission
};

/// The inputs of shading at one point: any error of a pixel that is not in these is shading error.
struct Attributes {
  int item = -1;                ///< of the draw list; -1 where there is nothing
  std::uint32_t primitive = 0;  ///< triangle, line or point of the item's mesh
  bool front = true;            ///< the side that is seen
  glm::dvec3 barycentrics{0.0};
  double depth = 0;  ///< 1 at the near plane, 0 at the far one
  /// Triangles: the distance from the sample to the nearest edge, in samples. A driver that snaps
  /// vertices to 1/256 of a sample may place samples closer than that on the other side.
  double edgeDistance = 0;
  glm::dvec3 position{0.0};    ///< interpolated
  glm::dvec3 normal{0.0};      ///< interpolated, neither renormalised nor turned
  glm::dvec3 faceNormal{0.0};  ///< unit, of the front side
  glm::dvec4 base{1.0};        ///< C and alpha: material, vertex colour and texture
  glm::dvec3 emission{0.0};    ///< material and texture
  Numbers numbers;             ///< material and textures; flat and gouraud read only the metalness
  /// The spread of the normals that the normal map's texel covers: the root of their variance. Set
  /// if Surface::filter is toksvig.
  double normalWidth = 0;
  /// Position and normal at the centres of the four pixels of the 2x2 square over which GL takes
  /// differences: this one, its neighbours in x, in y and in both. Set where the environment is a
  /// picture or Surface::filter is kaplanyan.
  struct Place {
    glm::dvec3 position{0.0}, normal{0.0};
  };
  std::array<Place, 4> square{};
  /// flat and gouraud: the light carried from face or vertices that C and that S multiply.
  glm::dvec3 matte{0.0}, specular{0.0};
};

/// The parts of a pixel's radiance.
struct Terms {
  glm::dvec3 matte{0.0}, specular{0.0};  ///< the light that C and that S multiply
  glm::dvec3 sum{0.0};                   ///< C matte + S specular
  glm::dvec3 reflection{0.0};            ///< F E(reflect)
  glm::dvec3 refraction{0.0};            ///< t (1 - F) C E(refract)
  double transparency = 0;               ///< t: 1 - t of the sum is left
  /// (1 - t) sum + reflection + refraction + emission; if unlit C + emission.
  glm::dvec3 radiance{0.0};
};

/// The environment's radiance from a direction in eye space, as the mean over `spread` radians
/// where it is a picture.
glm::dvec3 environmentToward(const Frame& frame, const glm::dvec3& direction, double spread);

/// Unit, to the viewer; +Z at the eye itself.
glm::dvec3 toViewer(const Frame& frame, const glm::dvec3& position);

/// The light at a point with unit normal; sets `matte` and `specular` of the result. Flat shading
/// and Gouraud shading use Phong's lobe.
Terms lightAt(const Frame& frame, const Surface& surface, const Numbers& numbers,
              const glm::dvec3& position, const glm::dvec3& normal);

/// Evaluates the surface's program. The attributes may come from the reference's own rasterisation
/// or from a GL driver's interpolation.
Terms shade(const Frame& frame, const Surface& surface, const Attributes& attributes);

/// The normal that shading uses: `normal` renormalised, the face's where it all but vanishes
/// (squared length at most 1e-6), turned on back faces of two-sided surfaces.
glm::dvec3 shadingNormal(const Surface& surface, const Attributes& attributes);

}  // namespace glint::reference
