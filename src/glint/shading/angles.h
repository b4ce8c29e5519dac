#pragma once

#include <numbers>

namespace glint {

inline constexpr double radians = std::numbers::pi / 180;  ///< per degree

}  // namespace glint
