#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "glint/image/image.h"
#include "glint/render/draw_list.h"
#include "glint/render/gpu_scene.h"
#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "picking.h"

namespace glint::viewer {

/// One light at a point.
struct LightProbe {
  std::string name;
  glm::dvec3 L{0.0};  ///< unit, to the light, world space
  double nl = 0, rv = 0, nh = 0;
  glm::dvec3 diffuse{0.0};   ///< C m_d I N.L
  glm::dvec3 specular{0.0};  ///< S m_s I lobe
};

/// One pixel: the value in the window, and the same by the reference's formulas in double. The
/// terms are those of the frontmost surface.
struct Probe {
  glm::ivec2 pixel{0};
  char side = 'A';                 ///< if two looks are compared, the one visible there
  std::optional<glm::vec3> other;  ///< the other look's value, linear, before exposure
  std::optional<Hit> hit;          ///< empty: the background
  int layers = 0;                  ///< surfaces visible through one another
  glm::dvec3 N{0.0}, V{0.0};       ///< unit, world space
  double nv = 0;
  double reflectance = 0;  ///< R(theta) at N.V, exact, from the look's medium into the material
  glm::dvec3 color{0.0};   ///< C including textures and vertex colours
  double alpha = 1;
  glm::dvec3 ambient{0.0}, emission{0.0};
  bool environment = false;  ///< whether the three below are set
  glm::dvec3 reflection{0.0}, refraction{0.0};
  double transparency = 0;  ///< ambient, diffuse and specular light scale with 1 - this
  std::vector<LightProbe> lights;
  glm::vec3 shown{0};  ///< linear, from the framebuffer, before exposure
  int code[3] = {0, 0, 0};
  /// The GL program's value at the pixel's centre, without anti-aliasing; empty if not drawn.
  std::optional<glm::vec3> center;
  glm::dvec3 expected{0.0};  ///< the reference's value there
  int expectedCode[3] = {0, 0, 0};
  double ulps[3] = {0, 0, 0};  ///< center - expected, in float ulps at that value
  std::string remark;          ///< what the comparison leaves out; empty if nothing
};

/// The scene that a probe examines.
struct ProbeScene {
  const Scene& scene;
  const DecodedImages& images;
  const Bounds& bounds;
  const Picker& picker;
  const DrawList& list;  ///< of the picture: the blending order
};

/// `look` is that of `shown`; `plain` is the same picture without anti-aliasing, or null. The
/// surfaces are found with a ray through the pixel's centre, and the reference draws only those;
/// points and lines count where they cover the pixel.
Probe probePixel(const ProbeScene&, const Look& look, const Image& shown, const Image* plain,
                 glm::ivec2 pixel);

/// The whole probe as JSON, for copying.
std::string probeText(const Scene&, const Probe&);

}  // namespace glint::viewer
