#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// Why a parameter of a look, or a number of a material, changes nothing in the picture as the rest
/// of the look stands; empty where it may. The scene may be null.
std::string withoutEffect(const Look&, const Scene*, std::string_view parameter);

/// Something that two looks say differently, in words.
struct Difference {
  std::string what, a, b;  ///< "exponent of Gold", "80", "20"; "-" where a look leaves it open
};

/// All that is different in two pictures of two looks, the materials' numbers one by one; the size
/// of the picture is left out.
std::vector<Difference> differences(const Look& a, const Look& b);

/// A value of a Difference for people: "not set" in place of "-".
std::string valueText(const std::string& value);

/// What one of two looks is, beside the other: the first `most` differences, for one line.
std::string sideText(const std::vector<Difference>&, bool a, std::size_t most = 2);

}  // namespace glint::viewer
