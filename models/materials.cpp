#include "materials.h"

#include <cmath>

namespace glint::models {

using nlohmann::json;

json material(const std::string& name, const json& phong, const json& pbr) {
  return {{"name", name}, {"pbrMetallicRoughness", pbr}, {"extras", {{"glint", phong}}}};
}

json material(const std::string& name, const std::array<double, 3>& color, double specular,
              double exponent, double metalness) {
  // Square roots are rounded correctly everywhere, other powers are not.
  const double roughness = std::sqrt(std::sqrt(2.0 / (4.0 * exponent + 2.0)));
  return material(name,
                  {{"ambient", 1},
                   {"diffuse", 0.8 - 0.4 * metalness},
                   {"specular", specular},
                   {"exponent", exponent},
                   {"metalness", metalness},
                   {"ior", 1.5},
                   {"color", color}},
                  {{"baseColorFactor", {color[0], color[1], color[2], 1}},
                   {"metallicFactor", metalness},
                   {"roughnessFactor", std::round(roughness * 1e4) / 1e4}});
}

}  // namespace glint::models
