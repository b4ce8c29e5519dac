#pragma once

#include <nlohmann/json_fwd.hpp>

#include "glint/stability/bench.h"

namespace glint::stability {

/// Curves of the current driver for the report's page: error over lambda near the peak for each
/// exponent, error and peak for exponents up to 1e6, the reflectance near the critical angle and as
/// n2/n1 nears 1, normals of every length, and all forms of lobe and reflectance together.
///
/// A list of plots {"title", "note", "x": {"label", "log"}, "y": {...}, "series": [{"name",
/// "points": [[x, y]...], "dots", "truth"}]}.
nlohmann::ordered_json plotsJson(Bench&);

}  // namespace glint::stability
