#include "glint/study/half_forms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glint/scene/look_text.h"
#include "glint/shading/half.h"
#include "glint/shading/lobe.h"
#include "glint/study/format.h"

namespace glint {
namespace {

constexpr double largestTried = 0x1p20;
constexpr double level = 1.0 / 255;
constexpr std::uint16_t bitsOfOne = 0x3c00, bitsOfTwo = 0x4000;

Half most(Half a, Half b) { return std::max(a.value(), b.value()); }
Half exp2Of(Half x) { return std::exp2(x.value()); }
Half log2Of(Half x) { return std::log2(x.value()); }

/// log1m of lobe.glsl.
Half log1mOf(Half x) {
  if (x.value() > 0.5) return log2Of(1 - x) * std::numbers::ln2;
  const Half s = x / (2 - x), t = s * s;
  const Half series =
      1 + t * (1.0 / 3 + t * (0.2 + t * (1.0 / 7 + t * (1.0 / 9 + t * (1.0 / 11)))));
  return -2 * s * series;
}

/// powerOf of lobe.glsl.
Half powerIn(Half x, int power) {
  Half p = (power & 1) != 0 ? x : Half(1), s = x;
  for (int bit = 2; bit <= power; bit *= 2) {
    s = s * s;
    if ((power & bit) != 0) p = p * s;
  }
  return p;
}

Half formIn(Highlight form, int gamma, Half x, double alpha) {
  const auto shape = row(form).shape;
  const glm::dvec2 constants = shape ? shape(alpha, gamma) : glm::dvec2(alpha);
  const Half a = constants.x, b = constants.y;
  switch (form) {
    case Highlight::exact:
      return x.value() < 1 ? exp2Of(1.44269504089 * a * log1mOf(x)) : Half(0);
    case Highlight::pow:
      return x.value() > 0 ? exp2Of(a * log2Of(std::min(x.value(), 1.0))) : Half(0);
    case Highlight::integer:
      return powerIn(most(1 - x, 0), gamma);
    case Highlight::lyon:
    case Highlight::lyonTuned:
      return powerIn(most(1 - a * x, 0), gamma);
    case Highlight::lyonCross:
      return x.value() < 1 ? powerIn(most(1 - a * (x * (2 - x)), 0), gamma) : Half(0);
    case Highlight::pade: {
      const Half top = 2 - a * x;
      return top.value() > 0 ? powerIn(top / (2 + b * x), gamma) : Half(0);
    }
    case Highlight::gaussian:
      return exp2Of(-1 * a * x);
    case Highlight::table: {
      const Half place = std::clamp(x.value(), 0.0, 1.0) * gamma;
      const int below = std::min(int(place.value()), gamma - 1);
      const Half share = place - below;
      return (1 - share) * Half(lobeTableEntry(below, alpha, gamma)) +
             share * Half(lobeTableEntry(below + 1, alpha, gamma));
    }
    case Highlight::none:
      break;
  }
  return 0;
}

/// The forms of the table.
std::vector<HighlightForm> tableForms() {
  std::vector<HighlightForm> forms;
  for (const HighlightRow& each : highlightRows()) {
    if (each.form == Highlight::none) continue;
    if (!each.hasGamma()) forms.emplace_back(each.form);
    for (const int step : {4, 16, 64})  // 16, 64 and 256 for tables
      if (each.hasGamma()) forms.emplace_back(each.form, step * std::max(each.leastGamma / 4, 1));
  }
  return forms;
}

}  // namespace

double lobeInHalf(Highlight form, int gamma, double input, double alpha) {
  return formIn(form, gamma, input, alpha).value();
}

HalfError halfErrorOf(Highlight form, int gamma, double alpha) {
  const bool cosine = row(form).takesCosine;
  HalfError worst;
  const auto exact = [&](double lambda) {
    return lambda < 0 ? 1.0 : lobe(Highlight::exact, 1, std::min(lambda, 2.0), alpha);
  };
  const int power = form == Highlight::integer ? int(alpha) : gamma;
  // The values that round to an input lie between the midpoints to its neighbours. The exact lobe
  // falls over them, so that it is farthest from the drawn value at one of the two.
  struct Place {
    double lambda, exact;
  };
  const auto placeAt = [&](double input) {
    const double lambda = std::clamp(cosine ? 1 - input : input, 0.0, 2.0);
    return Place{lambda, exact(lambda)};
  };
  Place low = placeAt(0);
  for (int bits = 0; bits <= (cosine ? bitsOfOne : bitsOfTwo); ++bits) {
    const double input = halfValue(std::uint16_t(bits));
    const Place high = placeAt(0.5 * (input + halfValue(std::uint16_t(bits + 1))));
    const double drawn = lobeInHalf(form, power, input, alpha);
    for (const Place& at : {low, high}) {
      const double error = std::abs(drawn - at.exact);
      if (!(error <= worst.half)) worst.half = error, worst.lambda = at.lambda;
    }
    const double own = lobe(form, std::max(gamma, 1), high.lambda, alpha);
    worst.formula = std::max(worst.formula, std::abs(own - high.exact));
    low = high;
  }
  return worst;
}

double holdsUpTo(Highlight form, int gamma) {
  double reached = 0;
  const bool whole = row(form).wholePowers;
  for (int i = 0;; ++i) {
    const double alpha = whole ? i + 1 : std::exp2(i / 2.0);
    if (alpha > (whole ? 128 : largestTried)) break;
    const HalfError error = halfErrorOf(form, gamma, alpha);
    if (!(error.half <= error.formula + level)) break;
    reached = alpha;
  }
  return reached;
}

std::string halfTable() {
  constexpr double exponents[] = {5, 20, 100, 1000, 10000};
  std::string table = "| form | adds at most 1/255 up to α |";
  for (const double alpha : exponents) table += formatted(" %g |", alpha);
  table += "\n|---|---|";
  for (std::size_t i = 0; i < std::size(exponents); ++i) table += "---|";
  for (const HighlightForm& form : tableForms()) {
    const double holds = holdsUpTo(form.form, form.gamma);
    const bool all = row(form.form).wholePowers ? holds >= 128 : holds >= largestTried;
    table += "\n| `" + highlightText(form) + "` | " +
             (all ? std::string("all") : formatted("%.0f", std::floor(holds))) + " |";
    for (const double alpha : exponents) {
      if (row(form.form).wholePowers && !isIntegerPower(alpha)) {
        table += " - |";
        continue;
      }
      const HalfError error = halfErrorOf(form.form, form.gamma, alpha);
      const bool isExact = error.formula < 1e-12;  // except for rounding in double
      table += formatted(" %.1e (", error.half) +
               (isExact ? "0" : formatted("%.1e", error.formula)) + ") |";
    }
  }
  return table + "\n";
}

}  // namespace glint
