#pragma once

#include <glm/glm.hpp>

namespace glint {

// The built-in environments: radiance in linear light that arrives from a direction d in world
// space, +Y up. They are analytic, using only polynomials of direction cosines, so that single
// precision evaluates them to 1e-5 (measured: 6.5e-6) and nothing in them is sharper than a pixel
// of a small picture.
//
// The formulas, shared with GLSL: d = (x, y, z) is normalised first, s(a, b, t) is smoothstep,
// mix(a, b, t) = a + (b - a) t. The constants are in the structs below.
//
//     white   E = 1
//
//     sky     h    = max(1 - max(y, 0), 0)^3
//             air  = mix(zenith, horizon, h)
//             g    = max(d.sun, 0)
//             glow = wide g^8 + narrow g^64 + disc (1 - s(discInner, discOuter, |d - sun|^2 / 2))
//             E    = mix(ground, air + glow sunColor, s(-edge, edge, y))
//             where ground = mix(groundHorizon, groundNadir, max(-y, 0))
//
//     studio  E    = mix(floor, wall + backdrop max(-z, 0)^2, s(floorLow, floorHigh, y))
//                  + ceiling s(0, 1, y) + bounce max(-y, 0)^2
//                  + sum over the three box lights of color box(d)
//             box  = s(0, 0.3, d.axis) f(d.right, halfWidth) f(d.up, halfHeight)
//             f(p, h) = 1 - s(h - soft, h + soft, |p|)

enum class BuiltinEnvironment { white, sky, studio };

/// A soft-edged rectangle of light. axis, right and up are orthonormal; the half extents are
/// direction cosines along right and up, and the edges are 2 soft wide.
struct BoxLight {
  glm::dvec3 axis, right, up;
  double halfWidth, halfHeight, soft;
  glm::dvec3 color;
};

struct SkyConstants {
  glm::dvec3 zenith{0.14, 0.32, 0.70};
  glm::dvec3 horizon{0.82, 0.90, 0.98};
  glm::dvec3 groundHorizon{0.46, 0.42, 0.36};
  glm::dvec3 groundNadir{0.26, 0.22, 0.18};
  double edge = 0.05;
  glm::dvec3 sun{0.48, 0.64, 0.60};  ///< unit
  glm::dvec3 sunColor{1.0, 0.90, 0.74};
  double wide = 0.30;
  double narrow = 0.55;
  double disc = 1.2;
  double discInner = 0.002;  ///< in 1 - d.sun: 3.6 degrees
  double discOuter = 0.010;  ///< 8.1 degrees
};

struct StudioConstants {
  double floor = 0.07;
  double wall = 0.24;
  double backdrop = 0.45;
  double floorLow = -0.22;
  double floorHigh = 0.06;
  double ceiling = 0.30;
  glm::dvec3 bounce{0.26, 0.24, 0.21};
  BoxLight lights[3] = {
      // overhead, leaning to the front
      {{0.0, 0.96, 0.28}, {1.0, 0.0, 0.0}, {0.0, 0.28, -0.96}, 0.5, 0.24, 0.1, {2.4, 2.4, 2.4}},
      // the key box, front left
      {{-0.768, 0.28, 0.576},
       {0.6, 0.0, 0.8},
       {0.224, 0.96, -0.168},
       0.2,
       0.3,
       0.06,
       {2.2, 2.3, 2.45}},
      // the strip, right
      {{0.9216, 0.28, 0.2688},
       {0.28, 0.0, -0.96},
       {-0.2688, 0.96, -0.0784},
       0.09,
       0.42,
       0.05,
       {2.1, 1.95, 1.75}},
  };
};

inline constexpr SkyConstants skyConstants{};
inline constexpr StudioConstants studioConstants{};

/// E(direction); the direction need not be a unit vector. A zero or non-finite direction counts as
/// the zero vector, for which the formulas above also give a finite value.
glm::dvec3 environmentRadiance(BuiltinEnvironment environment, const glm::dvec3& direction);

}  // namespace glint
