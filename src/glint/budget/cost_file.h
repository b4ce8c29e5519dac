#pragma once

#include <string>

#include "glint/gl/context.h"
#include "glint/scene/look.h"
#include "glint/shading/costs.h"

namespace glint {

/// A table of costs with where it was measured.
struct CostFile {
  CostTable costs;
  GlStrings gl;
  double noise = 0;  ///< hundredths: costs nearer to each other could not be told apart
};

/// The JSON text of a file for `--cost-table`.
std::string costFileText(const CostFile&);

/// Reads such a file. Throws InputError if it is missing, no JSON, of another version, or if a cost
/// is missing or none: "PATH: what: what to do".
CostFile readCostFile(const std::string& path);

/// The table that a look's choice goes by: that of its file, or the shipped one.
CostTable costTableFor(const Look&);

}  // namespace glint
