#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// Why a parameter of a look, or of a material, has no effect on the picture with the rest of the
/// look as it is; empty if it may have one. The scene may be null.
std::string withoutEffect(const Look&, const Scene*, std::string_view parameter);

/// A difference between two looks, in words.
struct Difference {
  std::string what, a, b;  ///< "exponent of Gold", "80", "20"; "-" if a look leaves it open
};

/// All differences between two looks, with the materials' parameters one by one; the resolution is
/// left out.
std::vector<Difference> differences(const Look& a, const Look& b);

/// A value of a Difference for display: "not set" instead of "-".
std::string valueText(const std::string& value);

/// One look compared with the other: the first `most` differences, in one line.
std::string sideText(const std::vector<Difference>&, bool a, std::size_t most = 2);

}  // namespace glint::viewer
