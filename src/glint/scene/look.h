#pragma once

#include <compare>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "glint/shading/forms.h"
#include "glint/shading/normalization.h"
#include "glint/shading/specular_filter.h"

namespace glint {

enum class Viewer { local, infinite };
/// `image` is the picture that `hdriFile` names; it cannot be chosen by name.
enum class Environment { studio, sky, white, image };

/// A form of the lobe (glint/shading/lobe.h) with its gamma.
struct HighlightForm {
  Highlight form = Highlight::exact;
  int gamma = 0;  ///< of lyon, lyonTuned, lyonCross and pade: a power of two, [1, 64]; otherwise 0
  constexpr HighlightForm(Highlight f = Highlight::exact, int g = 0) : form(f), gamma(g) {}
  auto operator<=>(const HighlightForm&) const = default;
};

/// The forms with which a picture's lights draw their highlights: `brightest` for the brightest
/// lights, and possibly less exact and cheaper forms for dimmer ones. Lights are indexed in the
/// order of shiningLights().
struct HighlightForms {
  struct Dimmer {
    HighlightForm form;
    int from = 0;  ///< index of the first light with this form; ascending
    auto operator<=>(const Dimmer&) const = default;
  };
  static constexpr std::size_t mostDimmer = 3;
  HighlightForm brightest;
  std::vector<Dimmer> dimmer;  ///< at most mostDimmer
  HighlightForms(HighlightForm form = {}) : brightest(form) {}
  HighlightForms(Highlight form, int gamma = 0) : brightest(form, gamma) {}
  /// The form for the light at this index.
  HighlightForm of(int light) const {
    HighlightForm form = brightest;
    for (const Dimmer& each : dimmer)
      if (light >= each.from) form = each.form;
    return form;
  }
  /// Sets the form for lights from index `from` on, which must not be less than those added before.
  void add(HighlightForm form, int from) {
    if (of(from) != form) dimmer.push_back({form, from});
  }
  bool operator==(const HighlightForms&) const = default;
};

/// The most lights a picture may have; a uniform block of GL's minimum size holds them.
inline constexpr std::size_t maxLights = 128;

/// A light from `--light` or from a model file. Intensities are linear.
struct Light {
  enum class Type { directional, point, spot, camera };
  Type type = Type::directional;
  glm::dvec3 position{0.0};   ///< world; point and spot
  glm::dvec3 direction{0.0};  ///< directional: TO the light (L), world;
                              ///< camera: likewise, eye space; spot: along the beam
  double innerAngle = 0.0;    ///< degrees from the spot's axis: full intensity inside
  double outerAngle = 45.0;   ///< degrees from the spot's axis: zero outside
  glm::dvec3 intensity{1.0};  ///< I_m, linear RGB, components [0, 1e6]
  /// Point and spot: `intensity` is the value at a distance of one world unit and falls off with
  /// the square of the distance, to 0 at `range` (world units; 0 for unlimited).
  bool fallsOff = false;
  double range = 0.0;
  bool operator==(const Light&) const = default;
};

struct AntiAliasing {
  enum class Mode { none, msaa, ssaa };
  Mode mode = Mode::msaa;
  int count = 4;  ///< msaa: samples a pixel; ssaa: count x count samples a pixel
  bool operator==(const AntiAliasing&) const = default;
};

/// What `--material` changes in a material; empty members leave the model's values.
struct MaterialEdit {
  std::optional<double> ambient, diffuse, specular, exponent, metalness, ior, transmission;
  std::optional<glm::dvec3> color;  ///< linear
  std::optional<HighlightForms> highlight = {};
  std::optional<Fresnel> fresnel = {};
  std::optional<bool> colorTexture = {}, normalTexture = {}, emissionTexture = {};  ///< in use
  bool operator==(const MaterialEdit&) const = default;
};

/// The axis that points up in a model's file.
enum class UpAxis { plusX, minusX, plusY, minusY, plusZ, minusZ };

/// The limits of Look::cameraViewAngle, degrees: those of a camera of a file are within them but
/// for the last millionth.
inline constexpr double smallestViewAngle = 1e-9, largestViewAngle = 179.999999;

/// How a scene is viewed: every option that affects a picture, as a value. The table in
/// parameters.h gives the name, unit, range, default and help of each.
struct Look {
  Shading shading = Shading::phong;
  HighlightForms highlight;
  Fresnel fresnel = Fresnel::exact;
  /// The error that the choice of forms may cause, in linear radiance or in codes of an 8-bit
  /// picture; read only by errorBudget().
  std::optional<double> maxError;
  bool maxErrorInCodes = false;
  std::string costTable;  ///< the cost file for that choice; empty: the shipped costs
  double blinnFactor = 4.0;
  Normalization normalization = Normalization::none;
  double schlickExponent = 5.0;
  std::map<std::string, MaterialEdit> material;  ///< by key, see material_key.h

  glm::dvec3 ambientLight{0.1};
  std::optional<std::vector<Light>> light;  ///< empty: the default light
  bool noLights = false;
  std::optional<double> lightScale;  ///< of the file's lights; empty: measured (lights.h)
  Viewer viewer = Viewer::local;
  double mediumIor = 1.0;
  Environment environment = Environment::studio;
  std::string hdriFile;              ///< a picture that replaces the environment; may be empty
  double environmentRotation = 0.0;  ///< degrees about +Y
  bool environmentBackground = false;
  bool twoSided = false;

  std::optional<glm::dvec3> cameraPosition, cameraFocalPoint, cameraDirection;
  std::optional<glm::dvec3> cameraViewUp;
  std::optional<double> cameraViewAngle;  ///< degrees, vertical; within the limits above
  /// A lens in pixels of the picture, instead of the view angle: horizontal and vertical focal
  /// length, then the principal point from the picture's top left corner, where the first pixel's
  /// centre is at (0.5, 0.5). Not for parallel projections.
  std::optional<glm::dvec4> cameraIntrinsics;
  double cameraAzimuthAngle = 0.0, cameraElevationAngle = 0.0;  ///< degrees
  double cameraZoomFactor = 0.9;
  bool cameraOrthographic = false;
  std::optional<int> cameraIndex;
  std::optional<double> animationTime;  ///< seconds; empty: the file's rest pose
  std::string animation;                ///< name, number or "all"; empty: the first
  std::string scene;                    ///< of the file, name or number; empty: the file's default
  std::string variant;                  ///< of the file's materials, by name; empty: the default
  UpAxis up = UpAxis::plusY;
  std::optional<glm::dvec2> clippingRange;  ///< near, far; world units

  glm::ivec2 resolution{1024, 1024};
  AntiAliasing antiAliasing;
  SpecularAntialiasing specularAntialiasing = SpecularAntialiasing::none;
  glm::dvec3 backgroundColor{0.033104766570885055};  ///< linear; #333333
  bool noBackground = false;
  double exposure = 0.0;  ///< EV: the picture is multiplied by 2^exposure before encoding

  bool operator==(const Look&) const = default;
};

/// The model's surroundings: the look's picture if it names one.
inline Environment environmentOf(const Look& look) {
  return look.hdriFile.empty() ? look.environment : Environment::image;
}

}  // namespace glint
