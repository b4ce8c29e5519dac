#pragma once

#include <string>

#include "glint/gl/context.h"
#include "glint/scene/look.h"
#include "glint/shading/costs.h"

namespace glint {

/// A table of costs and where it was measured.
struct CostFile {
  CostTable costs;
  GlStrings gl;
  double noise = 0;  ///< hundredths: costs closer together than this cannot be told apart
};

/// The JSON text of a file for `--cost-table`.
std::string costFileText(const CostFile&);

/// Reads such a file. Throws InputError if it is missing, is not JSON or has another version, or if
/// a cost is missing or invalid: "PATH: what: what to do".
CostFile readCostFile(const std::string& path);

/// The table by which a look's forms are chosen: that of its file, or the shipped one.
CostTable costTableFor(const Look&);

}  // namespace glint
