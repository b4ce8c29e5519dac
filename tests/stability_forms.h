#pragma once

// The forms that the suite of hard cases is run with.

#include <string>
#include <vector>

#include "glint/options/parameters.h"

namespace glint::test {

inline Look formsOf(const char* highlight, const char* fresnel) {
  Look forms;
  setParameter(forms, "highlight", highlight);
  setParameter(forms, "fresnel", fresnel);
  return forms;
}

/// Cases that the textbook's forms fail. By section: C1 and C5, the peak, which the dot product of
/// rounded vectors misses; D3 and D4, the power at large exponents; K3 and K4, nearly equal
/// indices; P10 searches what D3 and D4 sample.
inline const std::vector<std::string> textbookFailures{"C1", "C5", "D3", "D4", "K3", "K4", "P10"};

}  // namespace glint::test
