#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "glint/shading/fresnel.h"

namespace glint {

// The programs and the forms of the lobe and the reflectance. Each has one name, used here, on the
// command line, in files and in the window, and one row, from which everything else follows.

/// The programs: `--shading`. `automatic` is a choice by error budget
/// (glint/budget/error_budget.h); if drawn unresolved, it is phong.
enum class Shading { flat, gouraud, phong, blinnPhong, environment, automatic };

/// The forms of the lobe: `--highlight`. `none` is 0 everywhere; its error is the whole lobe.
enum class Highlight {
  exact,
  pow,
  integer,
  lyon,
  lyonTuned,
  lyonCross,
  pade,
  gaussian,
  table,
  none
};

/// The forms of the reflectance: `--fresnel`.
enum class Fresnel { exact, textbook, schlick, schlickExp2, rational };

/// Where light is computed, and with which lobe.
struct ShadingRow {
  Shading shading;
  std::string_view name;
  bool perPixel;  ///< rather than once per face or vertex
  bool blinn;     ///< uses Blinn-Phong's lobe; the others use Phong's
};

/// A form of the lobe: everything except its GLSL functions (glsl/lobe.glsl).
struct HighlightRow {
  Highlight form;
  std::string_view name;
  /// The number after its name is a power of two in [leastGamma, mostGamma]; 0: no number.
  int leastGamma = 0, mostGamma = 0;
  bool wholePowers = false;  ///< only for exponents that isIntegerPower accepts; others are exact
  /// Uses a table of the exponent's lobe (lobeTable in lobe.h): drawn as exact if the exponent
  /// varies from pixel to pixel. Gamma is the number of steps.
  bool hasTable = false;
  bool atZero = false;       ///< handles exponent 0 itself; other forms are drawn as exact there
  bool takesCosine = false;  ///< the shader's form is a function of the cosine, not of lambda
  /// The form in GLSL, in terms of x (lambda or the cosine), shape (a vec2), POWER (gamma, or the
  /// whole exponent) and TABLE (the offset of its table).
  std::string_view glsl = {};
  /// Computes the shader's `shape`; null: the exponent.
  glm::dvec2 (*shape)(double alpha, int gamma) = nullptr;
  double (*value)(double lambda, double alpha, int gamma);
  /// The largest |value - exact| for alpha > 0.
  double (*formulaBound)(double alpha, int gamma) = nullptr;  ///< null: none
  /// The form's own rounding error in single precision, without that of its geometry (bounds.h).
  double (*rounding)(double alpha, int gamma);
  /// In hundredths of the exact lobe's (costs.h): one number; or by the binary logarithm of gamma /
  /// leastGamma; or, with wholePowers, by productsOf() the exponent.
  std::span<const double> costs = {};
  Highlight costsAs = form;  ///< the form whose costs these are

  bool hasGamma() const { return mostGamma > 0; }
};

/// The inputs of a reflectance, apart from the cosine.
struct ReflectanceInput {
  double n1 = 1.0, n2 = 1.5;
  FresnelConstants constants;    ///< for n1 and n2
  double schlickExponent = 5.0;  ///< for Fresnel::schlick
  double rationalSlope = 0.0;    ///< the k of Fresnel::rational
};

struct ReflectanceCosts;

/// A form of the reflectance: everything except its GLSL functions (glsl/fresnel.glsl).
struct FresnelRow {
  Fresnel form;
  std::string_view name;
  std::string_view glsl;  ///< in terms of `cosine` and `boundary`
  double (*value)(double cosTheta, const ReflectanceInput&);
  bool approximate;  ///< differs from exact by more than rounding
  /// The form's own rounding error in single precision, without that of its cosine (bounds.h).
  double (*rounding)(double n1, double n2, double schlickExponent);
  double ReflectanceCosts::*cost;
};

/// All rows, in the order of the enumerators.
std::span<const ShadingRow> shadingRows();
std::span<const HighlightRow> highlightRows();
std::span<const FresnelRow> fresnelRows();
const ShadingRow& row(Shading);
const HighlightRow& row(Highlight);
const FresnelRow& row(Fresnel);

/// Whether a program uses the Blinn-Phong lobe; the others use Phong's.
bool usesBlinn(Shading);
/// Whether a program computes light per pixel.
bool isPerPixel(Shading);

/// The constants of a form from n1 to n2. The slope is computed only for Fresnel::rational, as it
/// takes about 0.1 ms.
ReflectanceInput reflectanceInput(Fresnel, double n1, double n2, double schlickExponent = 5.0);

/// The reflectance in one of its forms.
double reflectance(Fresnel, double cosTheta, const ReflectanceInput&);

/// The lobe in one of its forms; gamma is ignored by forms that have none.
double lobe(Highlight, int gamma, double lambda, double alpha);

}  // namespace glint
