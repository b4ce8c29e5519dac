#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "glint/shading/fresnel.h"

namespace glint {

// The programs, the forms of the lobe and those of the reflectance: each has one name here, on the
// command line, in files and in the window, and one row, from which everything else is told.

/// The programs: `--shading`. `automatic` is a choice by error budget
/// (glint/budget/error_budget.h); drawn as it stands, phong.
enum class Shading { flat, gouraud, phong, blinnPhong, environment, automatic };

/// The forms of the lobe: `--highlight`. `none` is 0 everywhere, which is off by the whole lobe.
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
  bool perPixel;  ///< and not once for each face or vertex
  bool blinn;     ///< the lobe of Blinn-Phong; the others have Phong's
};

/// What a form of the lobe is: all of it but its GLSL (glsl/lobe.glsl).
struct HighlightRow {
  Highlight form;
  std::string_view name;
  /// The number behind its name is a power of two from leastGamma to mostGamma; 0: it has none.
  int leastGamma = 0, mostGamma = 0;
  bool wholePowers = false;  ///< only for exponents that isIntegerPower takes; others are exact
  /// Reads a table of the exponent's lobe (lobeTable in lobe.h): drawn as exact where the exponent
  /// varies from pixel to pixel. Gamma is the number of its steps.
  bool hasTable = false;
  bool atZero = false;       ///< draws the exponent 0 itself; other forms are drawn as exact there
  bool takesCosine = false;  ///< the shader's form is one of the cosine, not of lambda
  /// The form in GLSL, of x (lambda or the cosine), shape (a vec2), POWER (gamma, or the whole
  /// exponent) and TABLE (where its table begins).
  std::string_view glsl = {};
  /// What the shader is given as `shape`; null: the exponent.
  glm::dvec2 (*shape)(double alpha, int gamma) = nullptr;
  double (*value)(double lambda, double alpha, int gamma);
  /// The largest |value - exact| for alpha > 0.
  double (*formulaBound)(double alpha, int gamma) = nullptr;  ///< null: none
  /// How far the form itself rounds in single precision, beside its geometry (bounds.h).
  double (*rounding)(double alpha, int gamma);
  /// In hundredths of the exact lobe's (costs.h): one number; or by the binary logarithm of gamma
  /// over leastGamma; or, with wholePowers, by productsOf() the exponent.
  std::span<const double> costs = {};
  Highlight costsAs = form;  ///< the form whose costs these are

  bool hasGamma() const { return mostGamma > 0; }
};

/// What a reflectance is a function of, beside the cosine.
struct ReflectanceInput {
  double n1 = 1.0, n2 = 1.5;
  FresnelConstants constants;    ///< of n1 and n2
  double schlickExponent = 5.0;  ///< of Fresnel::schlick
  double rationalSlope = 0.0;    ///< the k of Fresnel::rational
};

struct ReflectanceCosts;

/// What a form of the reflectance is: all of it but its GLSL (glsl/fresnel.glsl).
struct FresnelRow {
  Fresnel form;
  std::string_view name;
  std::string_view glsl;  ///< of `cosine` and `boundary`
  double (*value)(double cosTheta, const ReflectanceInput&);
  bool approximate;  ///< by more than rounding
  /// How far the form itself rounds in single precision, beside its cosine (bounds.h).
  double (*rounding)(double n1, double n2, double schlickExponent);
  double ReflectanceCosts::*cost;
};

/// All rows, in the order of the enumeration.
std::span<const ShadingRow> shadingRows();
std::span<const HighlightRow> highlightRows();
std::span<const FresnelRow> fresnelRows();
const ShadingRow& row(Shading);
const HighlightRow& row(Highlight);
const FresnelRow& row(Fresnel);

/// Whether a program computes the lobe of Blinn-Phong; the others have Phong's.
bool usesBlinn(Shading);
/// Whether a program computes light for each pixel.
bool isPerPixel(Shading);

/// The constants of a form from n1 to n2; the slope is found for Fresnel::rational alone, as it
/// takes about 0.1 ms.
ReflectanceInput reflectanceInput(Fresnel, double n1, double n2, double schlickExponent = 5.0);

/// The reflectance in one of its forms.
double reflectance(Fresnel, double cosTheta, const ReflectanceInput&);

/// The lobe in one of its forms; gamma is read by the forms that have one.
double lobe(Highlight, int gamma, double lambda, double alpha);

}  // namespace glint
