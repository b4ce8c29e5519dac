#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "glint/image/image.h"
#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "picking.h"

namespace glint {

/// One light at a point.
struct LightProbe {
  std::string name;
  glm::dvec3 L{0.0};  ///< unit, to the light, world space
  double nl = 0, rv = 0, nh = 0;
  glm::dvec3 diffuse{0.0};   ///< C m_d I N.L
  glm::dvec3 specular{0.0};  ///< S m_s I lobe
};

/// One pixel: what the window shows, and the same by the formulas in double.
struct Probe {
  glm::ivec2 pixel{0};
  std::optional<Hit> hit;     ///< empty: the background
  glm::dvec3 N{0.0}, V{0.0};  ///< unit, world space
  double nv = 0;
  double reflectance = 0;  ///< R(theta) at N.V, exact, from the look's medium into the material
  glm::dvec3 ambient{0.0}, emission{0.0}, reflection{0.0};
  std::vector<LightProbe> lights;
  glm::vec3 shown{0};  ///< linear, from the framebuffer, before exposure
  int code[3] = {0, 0, 0};
  bool computed = false;  ///< the members below say something
  glm::dvec3 expected{0.0};
  int expectedCode[3] = {0, 0, 0};
  double ulps[3] = {0, 0, 0};  ///< shown - expected in units of the last place of a float there
  std::string remark;          ///< why not computed, or what the comparison leaves out
};

/// `look` has the resolution of `linear`. The surface is found by a ray through the pixel's centre.
Probe probePixel(const Scene&, const Bounds&, const Picker&, const Look& look, const Image& linear,
                 glm::ivec2 pixel);

}  // namespace glint
