#pragma once

#include <glm/glm.hpp>

namespace glint::viewer {

/// The colours of the window's texts and their backgrounds: sRGB, [0, 1].
namespace theme {
inline constexpr glm::dvec3 text{1, 1, 1}, dim{0.68, 0.68, 0.70}, edited{1, 0.8, 0.45},
    key{0.95, 0.78, 0.4}, error{1, 0.6, 0.55}, hovered{1, 0.84, 0.47};
inline constexpr glm::dvec3 window{0.13, 0.13, 0.135}, popup{0.16, 0.16, 0.166},
    frame{0.20, 0.20, 0.208}, frameHovered{0.26, 0.26, 0.27}, frameActive{0.30, 0.30, 0.312},
    wrongFrame{0.42, 0.07, 0.07}, button{0.25, 0.25, 0.26}, buttonHovered{0.33, 0.33, 0.343},
    edge{0.46, 0.46, 0.475}, accent{0.20, 0.40, 0.70}, bright{0.24, 0.46, 0.78},
    header{0.24, 0.24, 0.25}, headerHovered{0.31, 0.31, 0.322}, menu{0.17, 0.17, 0.177};
/// For slider grabs and checkmarks, which have no text on them. `edge` also surrounds fields, boxes
/// and unchecked radio buttons.
inline constexpr glm::dvec3 mark{0.34, 0.58, 0.92};
}  // namespace theme

}  // namespace glint::viewer
