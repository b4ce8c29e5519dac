#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace glint::models {

/// A glTF material whose Phong parameters stand in extras.glint. The roughness beside them is the
/// one that the conversion of docs/materials.md takes back to the same exponent: 2/r⁴ - 2 is four
/// times Phong's.
nlohmann::json material(const std::string& name, const nlohmann::json& phong,
                        const nlohmann::json& pbr);

/// One with all the light that a plastic (metalness 0) or a metal (1) scatters and mirrors.
nlohmann::json material(const std::string& name, const std::array<double, 3>& color,
                        double specular, double exponent, double metalness);

}  // namespace glint::models
