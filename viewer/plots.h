#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "glint/scene/look.h"

namespace glint::viewer {

/// Points of a curve; x rises.
struct Curve {
  std::vector<glm::dvec2> points;
};

/// The chosen curve less the exact one, which have the same x.
Curve difference(const Curve& chosen, const Curve& exact);

/// What a lobe is a function of, beside directions.
struct LobeInput {
  double exponent = 20, blinnFactor = 4;
  bool blinn = false;
  HighlightForm highlight;
};

/// The lobe in the plane of incidence.
struct LobePlot {
  double incidence = 0;  ///< of the light, degrees from the normal
  Curve exact, chosen;   ///< lobe over the viewer's angle from the normal, [-90, 90] degrees; the
                         ///< mirror direction lies at +incidence
  double largestDifference = 0;  ///< of the two
  double halfWidth = 0;          ///< degrees from the peak to where the lobe is a half; 0: nowhere
};

LobePlot lobePlot(const LobeInput&, double incidenceDegrees);

/// The lobe as a surface around the point that is lit: the way to the viewer times the lobe there,
/// in the form chosen. N is z, the light lies in the plane y = 0 at x < 0.
struct LobeSurface {
  std::size_t columns = 0;  ///< of a row; the last one is the first one again
  /// Rows around the mirror direction, from there outwards to where the exact lobe is 1 % or the
  /// horizon ends it; in the last one all are 0.
  std::vector<glm::dvec3> points;
};

LobeSurface lobeSurface(const LobeInput&, double incidenceDegrees);

/// Reflectance over the angle of incidence, [0, 90] degrees.
struct FresnelPlot {
  Curve exact, chosen, perpendicular, parallel;
  double brewster = 0;             ///< degrees
  std::optional<double> critical;  ///< degrees; empty unless n1 > n2
  double normalIncidence = 0;      ///< R(0)
  double largestDifference = 0;    ///< of exact and chosen
};

FresnelPlot fresnelPlot(Fresnel form, double n1, double n2, double schlickExponent);

/// Which exponent alpha' gives Blinn-Phong a highlight as wide as Phong's with alpha, over the
/// angle of incidence, [0, 85] degrees: alpha'/alpha for equal width at half the peak, in the plane
/// of incidence and across it. Small highlights give 4 in the plane and 4 cos^2 across it.
struct WidthPlot {
  Curve inPlane, across;
};

WidthPlot widthPlot(double exponent);

}  // namespace glint::viewer
