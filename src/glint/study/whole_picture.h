#pragma once

#include <string>
#include <vector>

#include "glint/study/frame_times.h"
#include "glint/study/picture_error.h"

// A second truth: the exact picture averaged over pixels, not at one sample a pixel. Against it a
// picture shows its whole error: of form, interpolation, driver and aliasing.
namespace glint {

/// The exact form of a model in double, N x N samples a pixel averaged.
struct WholeTruth {
  Shading model = Shading::phong;
  int samples = 0;   ///< N
  Image picture;     ///< premultiplied, without background; empty if it was stopped
  PictureError own;  ///< of N/2 x N/2 samples against it: more than its own error
};

/// The error against a WholeTruth, in linear light before exposure.
struct WholeError {
  PictureError inside;   ///< over the mask's pixels, where a surface covers all of a pixel
  PictureError picture;  ///< over all pixels that truth or picture covers, outlines too
};

/// `samples` must be even.
WholeTruth wholeTruthOf(const StudyScene& scene, const Look& look, Shading model, int samples,
                        const StudyMask& mask, const Stop& stop);

WholeError wholeErrorOf(const WholeTruth& truth, const Image& drawn, const StudyMask& mask,
                        double exposureScale);

/// A way of drawing a model, with or without a treatment of aliasing.
struct StudyWay {
  std::string name;  ///< "phong exact kaplanyan msaa:4"
  Shading model = Shading::phong;
  Look look;
  WholeError error;
  FrameTimes times;
};

/// For each model: the exact lobe and two cheap ones (environment only the exact one) with each
/// --specular-antialiasing that changes the scene; the exact one with msaa:4, likewise, and with
/// ssaa:2. Errors and times are not set.
std::vector<StudyWay> studyWays(const StudyScene& scene, const Look& look);

}  // namespace glint
