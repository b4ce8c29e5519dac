#include "glint/shading/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace glint {
namespace {

using rounding::u;

constexpr double vectorError = 6.5e-7;  // in D

// The error of the dot product c of rounded unit vectors: the length of each is off by 2.5 u (half
// of a dot product's error, the root and the division), which is multiplied by c, and its
// components by u each; the three products and two sums add 3 u of rounding.
double cosineError(double c) { return 5.0 * u * (1.0 + c); }

// ---- Lobes -----------------------------------------------------------------------------------
//
// With f = (1 - x)^a the lobe and g a form, the difference g - f is stationary where log(-g') =
// log(-f'). s = log(g'/f') vanishes there, and s' is a quotient whose numerator has one root in x,
// apart from a root at 0 for Pade (below, form by form). So s has at most one extremum inside,
// hence at most two roots, one on each side of it; bisection finds them. The ends count too: the
// point where g is cut off (x = 1 / beta), after which the difference is -f, and x = 1, after which
// it is g; both fall from there.

struct Difference {
  double alpha, beta;
  int gamma;
  Highlight form;

  double base(double x) const {
    return form == Highlight::pade ? (2.0 - (1.0 + beta) * x) / (2.0 + (beta - 1.0) * x)
                                   : 1.0 - beta * x;
  }
  double logForm(double x) const {
    if (form == Highlight::gaussian) return -beta * x;
    if (form == Highlight::pade)
      return gamma * (std::log1p(-0.5 * (1.0 + beta) * x) - std::log1p(0.5 * (beta - 1.0) * x));
    return gamma * std::log1p(-beta * x);
  }
  // f (exp(log g - log f) - 1) keeps its digits where the two are nearly equal.
  double at(double x) const {
    if (x >= 1.0) return std::exp(logForm(x));
    const double logExact = alpha * std::log1p(-x);
    if (form != Highlight::gaussian && base(x) <= 0.0) return std::exp(logExact);
    const double above = logForm(x) - logExact;
    return above > 1.0 ? std::exp(logExact + above) - std::exp(logExact)
                       : std::abs(std::exp(logExact) * std::expm1(above));
  }
  // s, log(g'/f').
  double slopes(double x) const {
    const double exact = (alpha - 1.0) * std::log1p(-x);
    switch (form) {
      case Highlight::gaussian:  // g' = -beta exp(-beta x)
        return std::log(beta / alpha) - beta * x - exact;
      case Highlight::pade:  // g' = -4 a top^(gamma - 1) / bottom^(gamma + 1)
        return (gamma - 1) * std::log1p(-0.5 * (1.0 + beta) * x) -
               (gamma + 1) * std::log1p(0.5 * (beta - 1.0) * x) - exact;
      default:  // g' = -gamma beta (1 - beta x)^(gamma - 1)
        return std::log(gamma * beta / alpha) + (gamma - 1) * std::log1p(-beta * x) - exact;
    }
  }
  // The root of s' between 0 and the end, or a value outside if there is none.
  double extremum() const {
    switch (form) {
      case Highlight::gaussian:  // -beta + (a - 1) / (1 - x)
        return 1.0 - (alpha - 1.0) / beta;
      case Highlight::pade: {
        // -(g - 1) p / t - (g + 1) m / b + (a - 1) / (1 - x) with p = 1 + beta, m = beta - 1,
        // t = 2 - p x, b = 2 + m x: multiplied by t b (1 - x), a quadratic in x without constant
        // term.
        const double p = 1.0 + beta, m = beta - 1.0, g = gamma;
        const double linear =
            -(g - 1) * p * (m - 2) + (g + 1) * m * (p + 2) + (alpha - 1) * 2 * (m - p);
        const double square = (g - 1) * p * m - (g + 1) * m * p - (alpha - 1) * p * m;
        return square != 0.0 ? -linear / square : -1.0;
      }
      default: {  // -(g - 1) beta / (1 - beta x) + (a - 1) / (1 - x)
        const double scale = beta * (alpha - gamma);
        return scale != 0.0 ? ((alpha - 1.0) - (gamma - 1) * beta) / scale : -1.0;
      }
    }
  }
};

// The largest difference between `low` and `high`, where s has at most one root.
double largestBetween(const Difference& d, double low, double high) {
  double largest = std::max(d.at(low), d.at(high));
  const bool rises = d.slopes(low) < d.slopes(high);
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((d.slopes(middle) < 0.0) == rises ? low : high) = middle;
    largest = std::max(largest, d.at(middle));
  }
  return largest;
}

double largestDifference(const Difference& d) {
  if (!(d.beta > 0.0)) return 1.0;
  // The end of the form: from there to 1 only the exact lobe is left.
  double end = 1.0;
  if (d.form == Highlight::pade) end = std::min(2.0 / (1.0 + d.beta), 1.0);
  if (d.form == Highlight::lyon) end = std::min(1.0 / d.beta, 1.0);
  double largest = end < 1.0 ? std::pow(1.0 - end, d.alpha) : 0.0;
  if (end == 1.0) largest = std::max(largest, d.at(1.0));  // the leak past 90 degrees
  const double inside = end * (1.0 - 1e-15), between = d.extremum();
  if (between > 0.0 && between < inside)
    return std::max({largest, largestBetween(d, 0.0, between), largestBetween(d, between, inside)});
  return std::max(largest, largestBetween(d, 0.0, inside));
}

// ---- Reflectances ----------------------------------------------------------------------------

struct Reflectance {
  Fresnel form;
  ReflectanceInput input;  // from the thinner side: reciprocity gives the other

  double approximate(double c) const { return reflectance(form, c, input); }
};

// Bounds |approximate - exact| over [low, high]. The approximations fall with c, and so does
// R_perp; R_par falls down to Brewster's angle (c = 1 / sqrt(n^2 + 1)) and rises after it.
// Subdivides until the bound is within a quarter of the largest error seen.
struct Subdivision {
  const Reflectance& r;
  double brewster, largest;

  void cover(double low, double high, const PolarizedReflectance& atLow,
             const PolarizedReflectance& atHigh, double approximateLow, double approximateHigh,
             int depth) {
    const bool bends = low < brewster && brewster < high;
    const double parallelLeast = bends ? 0.0 : std::min(atLow.parallel, atHigh.parallel);
    const double least = 0.5 * (atHigh.perpendicular + parallelLeast);
    const double most = 0.5 * (atLow.perpendicular + std::max(atLow.parallel, atHigh.parallel));
    const double here = std::max(approximateLow - least, most - approximateHigh);
    if (here <= 1.25 * largest) return;
    if (depth == 0) {
      largest = here;
      return;
    }
    const double middle = 0.5 * (low + high);
    const PolarizedReflectance exact = fresnelPolarized(middle, r.input.constants);
    const double approximate = r.approximate(middle);
    largest =
        std::max(largest, std::abs(approximate - 0.5 * (exact.perpendicular + exact.parallel)));
    cover(low, middle, atLow, exact, approximateLow, approximate, depth - 1);
    cover(middle, high, exact, atHigh, approximate, approximateHigh, depth - 1);
  }
};

// Depth 48 is a cell of 4e-15, and no index in [1e-3, 1e3] has smaller features.
constexpr int deepest = 48;

}  // namespace

double lyonBound(double alpha, int gamma) {
  return largestDifference({alpha, alpha / gamma, gamma, Highlight::lyon});
}

double lyonTunedBound(double alpha, int gamma) {
  return largestDifference({alpha, tunedSlope(alpha, gamma), gamma, Highlight::lyon});
}

double lyonCrossBound(double alpha, int gamma) {
  // With y = x (2 - x) in [0, 1], 1 - y = (1 - x)^2: lyon of alpha / 2, gated.
  return largestDifference({0.5 * alpha, 0.5 * alpha / gamma, gamma, Highlight::lyon});
}

double padeBound(double alpha, int gamma) {
  return largestDifference({alpha, alpha / gamma, gamma, Highlight::pade});
}

double gaussianBound(double alpha) {
  return largestDifference({alpha, alpha + gaussianShift, 1, Highlight::gaussian});
}

// Between entries h = 1 / steps apart, the error of the chord is the mean of |f''| = a |a - 1|
// x^(a - 2) weighted by a kernel that is the same in each step (Peano). So the error is largest in
// the step where |f''| is largest: the last one for a >= 2, otherwise the first one, where f'' is
// unbounded at 0. In a step from b to c the chord with slope m is farthest away where f' = m.
double tableBound(double alpha, int steps) {
  const double h = 1.0 / std::max(steps, 1);
  if (alpha == 1.0) return 0.0;
  if (alpha < 2.0)  // at s h in the first step, s = a^(-1 / (a - 1)): h^a |s - s^a|
    return std::pow(h, alpha) * std::abs(1.0 - 1.0 / alpha) *
           std::exp(-std::log(alpha) / (alpha - 1.0));
  // 1 - (1 - h)^a, and how far the lobe is below 1 where its slope is the chord's, without
  // cancellation.
  const double fall = -std::expm1(alpha * std::log1p(-h)), slope = fall / h;
  const double logAway = std::log(slope / alpha) / (alpha - 1.0);  // of that cosine, negative
  return std::max(-std::expm1(alpha * logAway) + slope * std::expm1(logAway), 0.0);
}

double lobeFormulaBound(Highlight form, int gamma, double alpha) {
  const HighlightRow& of = row(form);
  // At exponent 0 every form is 1, or is drawn as the exact one.
  if (!of.formulaBound || (!(alpha > 0.0) && !of.atZero)) return 0.0;
  return of.formulaBound(alpha, gamma);
}

double fresnelFormulaBound(Fresnel form, double n1, double n2, double exponent) {
  if (n1 == n2 || !row(form).approximate) return 0.0;
  const Reflectance r{form, reflectanceInput(form, std::min(n1, n2), std::max(n1, n2), exponent)};
  const FresnelConstants& constants = r.input.constants;
  Subdivision s{r, 1.0 / std::sqrt(constants.nSquaredPlus1), 1e-9};
  // A first scan, so that little needs subdividing: half of the angles lie within the scale on
  // which R falls.
  const double scale = std::sqrt(constants.e) / constants.nSquaredPlus1;
  for (int i = 0; i < 256; ++i) {
    const double t = (i + 0.5) / 256, c = scale * t / (1.0 - t + scale * t);
    s.largest = std::max(s.largest, std::abs(r.approximate(c) - fresnelExact(c, constants)));
  }
  // At 0 both are 1, and so are their limits from the right (for exponent 0 the form is 1
  // everywhere).
  s.cover(0.0, 1.0, {1.0, 1.0}, fresnelPolarized(1.0, constants), 1.0, r.approximate(1.0), deepest);
  return std::min(1.25 * s.largest, 1.0);
}

double lobeTurnBound(double alpha, bool blinn, double turn) {
  const double off = blinn ? 8.0 * turn : turn;
  // The steepest slope of (1 - t^2/2)^a is at t^2 = 1 / (a - 1/2), or at the end, t^2 = 2, where
  // the lobe of an exponent below 1 falls with infinite slope: y^a changes by at most (dy)^a.
  double geometry = 0.0;
  if (alpha >= 1.0) {
    const double t2 = 1.0 / (alpha - 0.5);
    geometry = off * alpha * std::sqrt(t2) * std::pow(1.0 - 0.5 * t2, alpha - 1.0);
  } else {
    geometry = std::pow(std::numbers::sqrt2 * off, std::max(alpha, 0.0)) + off;
  }
  return geometry;
}

double lobeRoundingBound(Highlight form, int gamma, double alpha, bool blinn) {
  if (form == Highlight::none) return 0.0;
  return std::min(lobeTurnBound(alpha, blinn, vectorError) + row(form).rounding(alpha, gamma), 1.0);
}

double fresnelRoundingBound(Fresnel form, double n1, double n2, double exponent) {
  if (n1 == n2) return 0.0;
  // `steep` is 0 from the thinner side: grazing incidence. R falls from there but, for large
  // indices, soon rises again. Within the distance of one rounding error its maximum and minimum
  // are compared; beyond it, its slope changes by less than a tenth from one sample to the next.
  const double steep = criticalCosine(n1, n2), error = cosineError(steep);
  const double from = std::max(steep + criticalRing(n1, n2) - error, steep);
  const auto after = [&](double way) {
    const double c = std::min(from + way, 1.0);
    return c > steep ? fresnelExact(c, n1, n2) : 1.0;
  };
  double highest = after(0.0), least = highest;
  for (double way = error; way > 1e-4 * error; way *= 0.9) {
    highest = std::max(highest, after(way));
    least = std::min(least, after(way));
  }
  double geometry = 1.02 * (highest - least);
  for (double way = 0.5 * error; from + way < 1.0; way *= 1.1)
    geometry = std::max(geometry, 1.1 * std::abs(after(way + error) - after(way)));
  return std::min(geometry + row(form).rounding(n1, n2, exponent), 1.0);
}

double criticalRing(double n1, double n2) {
  return n1 > n2 ? std::min(1e-5, 0.01 * (1.0 - criticalCosine(n1, n2))) : 0.0;
}

double largestRadiance(BuiltinEnvironment environment) {
  // The maxima from a search over all directions, which the test repeats: 2.24 and 2.94.
  switch (environment) {
    case BuiltinEnvironment::white:
      return 1.0;
    case BuiltinEnvironment::sky:
      return 2.3;
    case BuiltinEnvironment::studio:
      return 3.0;
  }
  return 1.0;
}

double steepestRadiance(BuiltinEnvironment environment) {
  // A smoothstep of width w has a slope of up to 1.5 / w: 31.5 for the studio's strip of 2.1 with
  // edges of 0.1, where its other axis and the room behind it are flat. The sun's disc, 1.2 over
  // half the squared distance from 0.002 to 0.01, reaches 25.3 at a distance of 0.114, where its
  // glow adds 2.9. A search finds 31.4 and 28.3, which the test repeats.
  switch (environment) {
    case BuiltinEnvironment::white:
      return 0.0;
    case BuiltinEnvironment::sky:
      return 29.0;
    case BuiltinEnvironment::studio:
      return 32.0;
  }
  return 0.0;
}

}  // namespace glint
