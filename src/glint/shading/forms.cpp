#include "glint/shading/forms.h"

#include <algorithm>
#include <numbers>

#include "glint/shading/bounds.h"
#include "glint/shading/costs.h"
#include "glint/shading/lobe.h"

namespace glint {
namespace {

using rounding::u;

/// Rounding of a power by squaring.
double powerRounding(double power) { return (1.5 * power + 4.0) * u; }

// Rounding of pow: 1e-6 from the cosine of rounded vectors and 2^-21 log 2 from log2, each times
// alpha.
double powRounding(double alpha, int) { return 1e-6 + 1.4e-6 * alpha; }

// The cosine of rounded vectors is off by 1e-6, times a chord with a slope of at most alpha or, for
// an exponent below 1, of the first chord. Entries and the interpolation between them round by 4 u.
double tableRounding(double alpha, int steps) {
  return 1e-6 * std::max(alpha, std::pow(double(std::max(steps, 1)), 1.0 - alpha)) + 4.0 * u;
}

// The quotient q = top / bottom: 4 u of top, over a bottom of at least 2 (4 beta / (1 + beta) for
// beta < 1), and 9 u of itself, including the division's 5 u.
double padeRounding(double alpha, int gamma) {
  return gamma * 12.0 * u * std::max(1.0, 0.5 + 0.5 * gamma / std::max(alpha, 1e-9));
}

// The textbook's square under the root and its two differences lose digits in proportion to how
// small n2 - n1 is, and all of them from the denser side.
double textbookRounding(double n1, double n2, double) {
  return n2 > n1 ? std::min(1e-6 + 1e-7 / ((n2 - n1) / n1), 1.0) : 1.0;
}

constexpr ShadingRow shadings[] = {
    {Shading::flat, "flat", false, false},
    {Shading::gouraud, "gouraud", false, false},
    {Shading::phong, "phong", true, false},
    {Shading::blinnPhong, "blinn-phong", true, true},
    {Shading::environment, "environment", true, true},
    {Shading::automatic, "auto", true, false},
};

// The costs of the forms, as defined in costs.h; they ship with the project.
constexpr double exactCosts[] = {100};
constexpr double powCosts[] = {68};
constexpr double integerCosts[] = {22, 23, 24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35};
constexpr double lyonCosts[] = {22, 24, 26, 27, 28, 29, 30};
constexpr double lyonCrossCosts[] = {26, 27, 28, 29, 30, 32, 33};
constexpr double padeCosts[] = {29, 30, 31, 32, 33, 35, 38};
constexpr double gaussianCosts[] = {34};
constexpr double tableCosts[] = {90, 90, 90, 90, 90, 90, 90};

// Missing initialisers are intentional: a row lists what differs from the defaults.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
constexpr HighlightRow highlights[] = {
    {.form = Highlight::exact,
     .name = "exact",
     .atZero = true,
     .glsl = "lobeExact(x, shape.x)",
     .value = [](double x, double alpha, int) { return lobeExact(x, alpha); },
     .rounding = [](double, int) { return 1e-6; },
     .costs = exactCosts},
    {.form = Highlight::pow,
     .name = "pow",
     .atZero = true,
     .takesCosine = true,
     .glsl = "lobePow(x, shape.x)",
     .value = [](double x, double alpha, int) { return lobePow(1.0 - x, alpha); },
     .rounding = powRounding,
     .costs = powCosts},
    {.form = Highlight::integer,
     .name = "integer",
     .wholePowers = true,
     .glsl = "lobeInteger(x, POWER)",
     .value = [](double x, double alpha, int) { return lobeInteger(x, alpha); },
     .rounding = [](double alpha, int) { return powerRounding(alpha); },
     .costs = integerCosts},
    {.form = Highlight::lyon,
     .name = "lyon",
     .leastGamma = 1,
     .mostGamma = 64,
     .glsl = "lobeLyon(x, shape.x, POWER)",
     .shape = [](double alpha, int gamma) { return glm::dvec2(alpha / gamma, 0); },
     .value = lyon,
     .formulaBound = lyonBound,
     .rounding = [](double, int gamma) { return powerRounding(gamma); },
     .costs = lyonCosts},
    {.form = Highlight::lyonTuned,  // lyon with another constant
     .name = "lyon-tuned",
     .leastGamma = 1,
     .mostGamma = 64,
     .glsl = "lobeLyon(x, shape.x, POWER)",
     .shape = [](double alpha, int gamma) { return glm::dvec2(tunedSlope(alpha, gamma), 0); },
     .value = lyonTuned,
     .formulaBound = lyonTunedBound,
     .rounding = [](double, int gamma) { return powerRounding(gamma); },
     .costsAs = Highlight::lyon},
    {.form = Highlight::lyonCross,
     .name = "lyon-cross",
     .leastGamma = 1,
     .mostGamma = 64,
     .glsl = "lobeLyonCross(x, shape.x, POWER)",
     .shape = [](double alpha, int gamma) { return glm::dvec2(0.5 * alpha / gamma, 0); },
     .value = lyonCross,
     .formulaBound = lyonCrossBound,
     .rounding = [](double, int gamma) { return powerRounding(gamma); },
     .costs = lyonCrossCosts},
    {.form = Highlight::pade,
     .name = "pade",
     .leastGamma = 1,
     .mostGamma = 64,
     .glsl = "lobePade(x, shape.x, shape.y, POWER)",
     .shape = [](double alpha,
                 int gamma) { return glm::dvec2(1 + alpha / gamma, alpha / gamma - 1); },
     .value = pade,
     .formulaBound = padeBound,
     .rounding = padeRounding,
     .costs = padeCosts},
    {.form = Highlight::gaussian,
     .name = "gaussian",
     .glsl = "lobeGaussian(x, shape.x)",
     .shape = [](double alpha,
                 int) { return glm::dvec2((alpha + gaussianShift) / std::numbers::ln2, 0); },
     .value = [](double x, double alpha, int) { return gaussian(x, alpha); },
     .formulaBound = [](double alpha, int) { return gaussianBound(alpha); },
     .rounding = [](double, int) { return 6.5 * u; },
     .costs = gaussianCosts},
    {.form = Highlight::table,
     .name = "table",
     .leastGamma = 16,
     .mostGamma = 1024,
     .hasTable = true,
     .takesCosine = true,
     .glsl = "lobeTable(x, TABLE, POWER)",
     .value = [](double x, double alpha, int steps) { return lobeTable(1.0 - x, alpha, steps); },
     .formulaBound = tableBound,
     .rounding = tableRounding,
     .costs = tableCosts},
    {.form = Highlight::none,
     .name = "none",
     .atZero = true,
     .value = [](double, double, int) { return 0.0; },
     .formulaBound = [](double, int) { return 1.0; },
     .rounding = [](double, int) { return 0.0; }},
};
#pragma GCC diagnostic pop

constexpr auto usualRounding = [](double, double, double) { return 1e-6; };

constexpr FresnelRow fresnels[] = {
    {Fresnel::exact, "exact", "fresnelExact(cosine, boundary)",
     [](double c, const ReflectanceInput& i) { return fresnelExact(c, i.constants); }, false,
     usualRounding, &ReflectanceCosts::exact},
    {Fresnel::textbook, "textbook", "fresnelTextbook(cosine, boundary)",
     [](double c, const ReflectanceInput& i) { return fresnelTextbook(c, i.n1, i.n2); }, false,
     textbookRounding, &ReflectanceCosts::textbook},
    {Fresnel::schlick, "schlick",
     "fresnelSchlick(cosine, boundary, material.normalReflectance, frame.schlickExponent)",
     [](double c, const ReflectanceInput& i) { return schlick(c, i.constants, i.schlickExponent); },
     true, [](double, double, double) { return 1e-6 + 3.4e-7 * 5.0; }, &ReflectanceCosts::schlick},
    {Fresnel::schlickExp2, "schlick-exp2",
     "fresnelSchlickExp2(cosine, boundary, material.normalReflectance)",
     [](double c, const ReflectanceInput& i) { return schlickExp2(c, i.constants); }, true,
     usualRounding, &ReflectanceCosts::schlickExp2},
    {Fresnel::rational, "rational",
     "fresnelRational(cosine, boundary, material.normalReflectance, material.rationalSlope)",
     [](double c, const ReflectanceInput& i) {
       return schlickRational(c, i.constants, i.rationalSlope);
     },
     true, [](double, double, double) { return 1.5e-6; }, &ReflectanceCosts::rational},
};

}  // namespace

std::span<const ShadingRow> shadingRows() { return shadings; }
std::span<const HighlightRow> highlightRows() { return highlights; }
std::span<const FresnelRow> fresnelRows() { return fresnels; }
const ShadingRow& row(Shading shading) { return shadings[std::size_t(shading)]; }
const HighlightRow& row(Highlight form) { return highlights[std::size_t(form)]; }
const FresnelRow& row(Fresnel form) { return fresnels[std::size_t(form)]; }

bool usesBlinn(Shading shading) { return row(shading).blinn; }
bool isPerPixel(Shading shading) { return row(shading).perPixel; }

ReflectanceInput reflectanceInput(Fresnel form, double n1, double n2, double schlickExponent) {
  return {n1, n2, fresnelConstants(n1, n2), schlickExponent,
          form == Fresnel::rational ? rationalMinimax(n1, n2) : 0.0};
}

double reflectance(Fresnel form, double cosTheta, const ReflectanceInput& input) {
  return row(form).value(cosTheta, input);
}

double lobe(Highlight form, int gamma, double lambda, double alpha) {
  return row(form).value(lambda, alpha, gamma);
}

}  // namespace glint
