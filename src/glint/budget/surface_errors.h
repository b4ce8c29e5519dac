#pragma once

#include <map>
#include <string>
#include <vector>

#include "glint/budget/cost_file.h"
#include "glint/budget/form_choice.h"
#include "glint/render/variant.h"
#include "glint/scene/camera.h"
#include "glint/scene/lights.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// How bright an environment is and how fast it changes with direction. An environment picture
/// changes with its filtering, which the bound does not cover.
struct Surroundings {
  double radiance = 0, steep = 0;
};

/// What all surfaces have in common.
struct LitScene {
  Look given;
  Look look;  ///< with the lights of the file
  Camera camera;
  std::vector<glint::Light> lights;
  LightReach reach;
  /// How far rounding turns the direction to each light, and to the viewer; radians.
  std::vector<double> turns;
  double viewTurn = 0;
  double spotTurn = 0;        ///< as spotSteepness, each term times the turn of its light
  double spotSteepness = 0;   ///< the sum over spots of intensity times the slope of the ramp
  Surroundings surroundings;  ///< only for the program environment
  bool blinn = false;
  CostTable costs;
};

LitScene litSceneFor(const Scene&, const Bounds&, const Look&);

/// What the bounds need to know about the surfaces of one material name.
struct SurfaceErrors {
  FormNeeds needs;
  double interpolation = 0;  ///< of shading once per face or vertex
  double rounding = 0;       ///< except that of lobes and reflectances
  double radiance = 0;       ///< the most that such a surface shows
};

using ErrorsByMaterial = std::map<std::string, SurfaceErrors>;

/// The numbers of the material; where textures give them, the largest that they can give. m_s
/// includes its normalization, which grows with the exponent.
ShadingParameters brightestNumbers(const Material&, const Variant&, const Look&);

/// Adds a mesh drawn with a material.
void addSurface(SurfaceErrors&, const LitScene&, const Material&, const Mesh&, const Variant&);

/// Adds the rounding of blending. Blended layers are averaged, so that errors of shading do not
/// grow. Each layer rounds alpha, its complement, two products and a sum, and alpha itself is
/// interpolated: within 8 u of the brightest surface. There are no more layers than triangles.
void addBlending(ErrorsByMaterial&, std::size_t triangles, const Look&);

}  // namespace glint
