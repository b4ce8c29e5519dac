#include "plots.h"

#include <algorithm>
#include <cmath>

#include "glint/shading/angles.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"

namespace glint::viewer {
namespace {

glm::dvec3 at(double degrees) {
  return {std::sin(degrees * radians), 0, std::cos(degrees * radians)};
}

// log of a lobe of exponent 1: lobe = exp(alpha * this); -infinity where the lobe is 0.
double logOf(double lambda) { return lambda < 1 ? std::log1p(-lambda) : -INFINITY; }

}  // namespace

Curve difference(const Curve& chosen, const Curve& exact) {
  Curve d;
  for (std::size_t i = 0; i < std::min(chosen.points.size(), exact.points.size()); ++i)
    d.points.emplace_back(exact.points[i].x, chosen.points[i].y - exact.points[i].y);
  return d;
}

LobePlot lobePlot(const LobeInput& input, double incidence) {
  LobePlot plot;
  plot.incidence = incidence;
  const glm::dvec3 N(0, 0, 1), L = at(-incidence);
  // Samples are denser near the peak, where a large exponent concentrates the lobe.
  std::vector<double> angles;
  for (int i = -180; i <= 180; ++i) angles.push_back(i * 0.5);
  for (double d = 0.25; d > 1e-4; d *= 0.8)
    for (const double angle : {incidence - 4 * d, incidence + 4 * d})
      if (angle > -90 && angle < 90) angles.push_back(angle);
  angles.push_back(incidence);
  std::sort(angles.begin(), angles.end());
  const double alpha = input.blinn ? input.blinnFactor * input.exponent : input.exponent;
  for (const double angle : angles) {
    const glm::dvec3 V = at(angle);
    const double lambda = input.blinn ? blinnLambda(N, L, V) : phongLambda(N, L, V);
    const double exact = lobeExact(lambda, alpha);
    const double chosen = lobe(input.highlight.form, input.highlight.gamma, lambda, alpha);
    plot.exact.points.emplace_back(angle, exact);
    plot.chosen.points.emplace_back(angle, chosen);
    plot.largestDifference = std::max(plot.largestDifference, std::abs(exact - chosen));
  }
  // cos^alpha(d) = 1/2, where d is the angle between R and V (Phong) or N and H (half as large).
  if (alpha > 1e-9) {
    const double d = std::acos(std::exp2(-1 / alpha)) / radians;
    plot.halfWidth = std::min(input.blinn ? 2 * d : d, 180.0);
  }
  return plot;
}

LobeSurface lobeSurface(const LobeInput& input, double incidence) {
  constexpr int rows = 20, columns = 40;
  const glm::dvec3 N(0, 0, 1), L = at(-incidence), R = at(incidence);
  const glm::dvec3 side(0, 1, 0), up = glm::cross(R, side);
  const double alpha = input.blinn ? input.blinnFactor * input.exponent : input.exponent;
  // The angle between R and V where cos^alpha is 1 %; in the plane it is twice that of N and H.
  const double d = alpha > 0 ? std::acos(std::pow(0.01, 1 / alpha)) : 90 * radians;
  const double reach = std::min(input.blinn ? 2 * d : d, 180 * radians);
  LobeSurface surface;
  surface.columns = columns + 1;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double around = 360 * radians * j / columns;
      const glm::dvec3 to = side * std::cos(around) + up * std::sin(around);
      const double horizon = std::atan2(R.z, -to.z);  // where R cos + to sin has z = 0
      const double away = std::min(reach, horizon) * i / rows;
      glm::dvec3 V = R * std::cos(away) + to * std::sin(away);
      V.z = std::max(V.z, 0.0);
      const double lambda = input.blinn ? blinnLambda(N, L, V) : phongLambda(N, L, V);
      surface.points.push_back(V *
                               lobe(input.highlight.form, input.highlight.gamma, lambda, alpha));
    }
  // Close the surface at its rim.
  surface.points.insert(surface.points.end(), columns + 1, glm::dvec3(0.0));
  return surface;
}

FresnelPlot fresnelPlot(Fresnel form, double n1, double n2, double schlickExponent) {
  FresnelPlot plot;
  std::vector<double> angles;
  for (int i = 0; i <= 180; ++i) angles.push_back(i * 0.5);
  plot.brewster = brewsterAngle(n1, n2) / radians;
  if (n1 > n2) {
    plot.critical = std::acos(criticalCosine(n1, n2)) / radians;
    for (double d = 1; d > 1e-3; d /= 2) angles.push_back(std::max(*plot.critical - d, 0.0));
    angles.push_back(*plot.critical);
    std::sort(angles.begin(), angles.end());
  }
  const ReflectanceInput input = reflectanceInput(form, n1, n2, schlickExponent);
  for (const double angle : angles) {
    const double c = angle == 90 ? 0 : std::cos(angle * radians);
    const PolarizedReflectance r = fresnelPolarized(c, n1, n2);
    const double exact = fresnelExact(c, n1, n2);
    const double chosen = reflectance(form, c, input);
    plot.exact.points.emplace_back(angle, exact);
    plot.chosen.points.emplace_back(angle, chosen);
    plot.perpendicular.points.emplace_back(angle, r.perpendicular);
    plot.parallel.points.emplace_back(angle, r.parallel);
    plot.largestDifference = std::max(plot.largestDifference, std::abs(exact - chosen));
  }
  plot.normalIncidence = fresnelExact(1, n1, n2);
  return plot;
}

WidthPlot widthPlot(double exponent) {
  WidthPlot plot;
  const glm::dvec3 N(0, 0, 1);
  // Phong's half width: (R.V)^alpha = 1/2.
  const double width = std::acos(std::exp2(-1 / std::max(exponent, 0.05)));
  for (double incidence = 0; incidence <= 85; incidence += 1) {
    const glm::dvec3 L = at(-incidence), R = at(incidence);
    const auto ratio = [&](const glm::dvec3& V) {
      const double blinn = logOf(blinnLambda(N, L, V)), phong = logOf(phongLambda(N, L, V));
      return phong / blinn;
    };
    plot.inPlane.points.emplace_back(incidence, ratio(at(incidence - width / radians)));
    const glm::dvec3 side(0, 1, 0);
    plot.across.points.emplace_back(incidence, ratio(R * std::cos(width) + side * std::sin(width)));
  }
  return plot;
}

}  // namespace glint::viewer
