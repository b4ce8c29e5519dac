#pragma once

#include <span>
#include <string_view>

#include "glint/scene/scene.h"

namespace glint::viewer {

/// A material from the classic published tables, or one described here.
struct Preset {
  std::string_view name;
  std::string_view group;                 ///< metals, stones, plastics, rubbers, other
  bool classic = true;                    ///< false: not from the table
  glm::dvec3 ambient, diffuse, specular;  ///< from the table, as shown on a screen
  double shininess = 0;                   ///< from the table: OpenGL's exponent / 128
  double ior = 1.5;
  bool metal = false;
};

/// The table of "teapots.c" (Mark J. Kilgard, Silicon Graphics 1994, with the OpenGL samples),
/// which is derived from the material file of SGI's Lightmodel. Indices of refraction from the
/// usual tables of minerals, and a few more materials, were added.
std::span<const Preset> presets();

/// A preset as Phong parameters. OpenGL's light model is Blinn-Phong in display values:
/// C = diffuse, decoded from sRGB to linear light like the others, and m_d = 1. m_a, and m_s with
/// m_sm, are least-squares fits of ambient = m_a C and specular = m_s (m_sm C + 1 - m_sm), with
/// m_sm = 1 for metals. OpenGL's exponent applies to N.H: m_sp = 128 shininess / 4.
ShadingParameters presetParameters(const Preset&);

}  // namespace glint::viewer
