#pragma once

#include <string>

#include "glint/study/study.h"

// What the files and tables of a report share.
namespace glint {

/// "wall time", "CPU time", "GPU time".
const char* clockWords(FrameClock clock);

/// "0.930 (0.910 to 0.950)": a ratio with its 95 % interval.
std::string ratioText(const TimeRatio& ratio);

/// 0 for no times.
double medianOf(const std::vector<double>& times);

/// Nanoseconds, by the clock that decides, that a frame takes above the empty one, per pixel that
/// the model covers.
double perPixel(const StudyResult& r, const FrameTimes& times);

/// Null if there is none.
const StudyFront* frontOf(const StudyResult& r, Shading model, const std::string& metric);
const StudyFront* wayFrontOf(const StudyResult& r, Shading model);

/// A variant's place on a front, or null.
const FrontPlace* placeOf(const StudyFront* front, std::size_t variant);

/// The name of the variant that dominates a place, or that it cannot be told from.
std::string dominator(const StudyResult& r, const StudyFront& front, const FrontPlace& place);

/// "on the front"; "by X" if X dominates it; "undecided against X" if it cannot be told which is
/// faster; empty without a place. For variants and for ways.
std::string placeWords(const StudyResult& r, const StudyFront* front, std::size_t variant);
std::string wayPlaceWords(const StudyResult& r, std::size_t way);

}  // namespace glint
