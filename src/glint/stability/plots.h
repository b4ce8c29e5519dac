#pragma once

#include <nlohmann/json_fwd.hpp>

#include "glint/stability/bench.h"

namespace glint::stability {

/// Curves of the current driver for the report's page: error over lambda near the peak for each
/// exponent, error and peak over exponents to 1e6, the reflectance near the critical angle and for
/// n2/n1 to 1, normals of every length, and every form of lobe and reflectance over the others.
///
/// A list of plots {"title", "note", "x": {"label", "log"}, "y": {...}, "series": [{"name",
/// "points": [[x, y]...], "dots", "truth"}]}.
nlohmann::ordered_json plotsJson(Bench&);

}  // namespace glint::stability
