#pragma once

#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"

namespace glint {

// What the forms cost beside each other, in hundredths of what the exact lobe costs: time per pixel
// and light of a lobe, per pixel of a reflectance. Measured once and shipped, so that the choice by
// --max-error is the same on every machine; docs/approximations.md says how, and how to repeat it.

double lobeCost(LobeForm form, int gamma);
/// Of going on to lights of another form, once a pixel: one more loop.
inline constexpr double lobeChangeCost = 5;
double fresnelCost(FresnelForm form, double schlickExponent);

}  // namespace glint
