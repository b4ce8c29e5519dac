#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace glint::models {

/// A glTF material with Phong parameters in extras.glint. Its roughness is the one that the
/// conversion of docs/materials.md turns back into the same exponent: 2/r⁴ - 2 is four times
/// Phong's.
nlohmann::json material(const std::string& name, const nlohmann::json& phong,
                        const nlohmann::json& pbr);

/// A material that scatters and mirrors all light, as a plastic (metalness 0) or a metal (1).
nlohmann::json material(const std::string& name, const std::array<double, 3>& color,
                        double specular, double exponent, double metalness);

}  // namespace glint::models
