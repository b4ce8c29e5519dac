#pragma once

#include <nlohmann/json_fwd.hpp>

#include "glint/budget/error_budget.h"
#include "glint/render/draw_list.h"

namespace glint {

/// The shader variants of a picture with their features, reasons and materials, as `render --json`
/// and `info` report them.
nlohmann::ordered_json variantsJson(const Scene&, const DrawList&, const Look&);

/// What --max-error and --shading auto chose for `asked`, with bounds and reasons.
nlohmann::ordered_json choiceJson(const ResolvedLook&, const Look& asked);

/// Triangles drawn, counting each instance.
std::size_t triangleCount(const Scene&, const DrawList&);

}  // namespace glint
