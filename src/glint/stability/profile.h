#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/stability/bench.h"

namespace glint::stability {

/// How exact one feature of the driver is, apart from glint.
struct Quality {
  std::string name;      ///< "exp2"
  std::string measured;  ///< over which inputs, against what
  std::string result;    ///< in words and numbers
  std::string required;  ///< what GLSL or OpenGL specifies
  std::string verdict;   ///< "as required", "worse than required", "not stated: ..."
  std::string touches;   ///< which of glint's figures it affects, and which not
  bool weak = false;     ///< worse than specified, or too inexact to rely on
  double absolute = -1;  ///< largest error in the value's unit; negative where that says nothing
  double ulp = -1;       ///< likewise in float spacings
};

/// Measures the current context's driver. GLSL 3.30 specifies no precisions; those of GLSL 4.10 and
/// later (section "Range and Precision"), which all of today's drivers offer, are taken instead.
std::vector<Quality> measureProfile(Bench&);

/// One line for each, with the weak ones marked.
std::string profileText(const std::vector<Quality>&);

nlohmann::ordered_json profileJson(const std::vector<Quality>&);

}  // namespace glint::stability
