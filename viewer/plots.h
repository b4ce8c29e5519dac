#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "glint/scene/look.h"

namespace glint::viewer {

/// Points of a curve with increasing x.
struct Curve {
  std::vector<glm::dvec2> points;
};

/// The chosen curve minus the exact one, which must have the same x.
Curve difference(const Curve& chosen, const Curve& exact);

/// The parameters of a lobe other than directions.
struct LobeInput {
  double exponent = 20, blinnFactor = 4;
  bool blinn = false;
  HighlightForm highlight;
};

/// The lobe in the plane of incidence.
struct LobePlot {
  double incidence = 0;  ///< of the light, degrees from the normal
  Curve exact, chosen;   ///< lobe over the viewer's angle from the normal, [-90, 90] degrees; the
                         ///< mirror direction is at +incidence
  double largestDifference = 0;  ///< between the two
  double halfWidth = 0;          ///< degrees from the peak to where the lobe is 1/2; 0: nowhere
};

LobePlot lobePlot(const LobeInput&, double incidenceDegrees);

/// The lobe as a surface around the lit point: the direction to the viewer times the lobe there, in
/// the chosen form. N is z, the light is in the plane y = 0 at x < 0.
struct LobeSurface {
  std::size_t columns = 0;  ///< per row; the last repeats the first
  /// Rows around the mirror direction, outwards to where the exact lobe is 1 % or the horizon cuts
  /// it off; the points of the last row are all 0.
  std::vector<glm::dvec3> points;
};

LobeSurface lobeSurface(const LobeInput&, double incidenceDegrees);

/// Reflectance over the angle of incidence, [0, 90] degrees.
struct FresnelPlot {
  Curve exact, chosen, perpendicular, parallel;
  double brewster = 0;             ///< degrees
  std::optional<double> critical;  ///< degrees; empty unless n1 > n2
  double normalIncidence = 0;      ///< R(0)
  double largestDifference = 0;    ///< between exact and chosen
};

FresnelPlot fresnelPlot(Fresnel form, double n1, double n2, double schlickExponent);

/// The exponent alpha' that gives Blinn-Phong a highlight as wide as Phong's with alpha, over the
/// angle of incidence, [0, 85] degrees: alpha'/alpha for equal width at half the peak, in the plane
/// of incidence and across it. Small highlights give 4 in the plane and 4 cos^2 across it.
struct WidthPlot {
  Curve inPlane, across;
};

WidthPlot widthPlot(double exponent);

}  // namespace glint::viewer
