#pragma once

#include <string>
#include <vector>

#include "glint/shading/forms.h"

// How much accuracy the forms of the lobe lose in half floats, which phones and browsers compute
// with (mediump).
namespace glint {

/// A form as in glsl/lobe.glsl, with every number and every operation in half precision, powers and
/// logarithms correctly rounded. `input` is lambda, or the cosine for the forms that take it; gamma
/// as in HighlightForm, for `integer` the whole exponent.
double lobeInHalf(Highlight form, int gamma, double input, double alpha);

/// The largest errors of a form against the exact lobe.
struct HalfError {
  double formula = 0;  ///< of the form itself, in double
  double half = 0;     ///< of the form in half floats, its input rounded to the nearest half
  double lambda = 0;   ///< where `half` occurs
};

/// Over all lambda in [0, 2]: every half is tried as the input, against the exact lobe over all
/// values that round to it.
HalfError halfErrorOf(Highlight form, int gamma, double alpha);

/// The largest exponent up to which half floats add at most 1/255 to the error of the form itself,
/// at every exponent tried from 1 on: two per octave up to 2^20; for `integer`, the whole ones up
/// to 128. 0 if they add more already at 1.
double holdsUpTo(Highlight form, int gamma);

/// The table of docs/approximations.md, in Markdown.
std::string halfTable();

}  // namespace glint
