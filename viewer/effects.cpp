#include "effects.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"
#include "light_edit.h"

namespace glint::viewer {
namespace {

using Json = nlohmann::ordered_json;

bool isOneOf(std::string_view name, std::initializer_list<std::string_view> any) {
  return std::ranges::find(any, name) != any.end();
}

// Whether a form with Schlick's exponent may be used.
bool usesSchlick(const Look& look) {
  const auto schlick = [](Fresnel form) {
    return form == Fresnel::schlick || form == Fresnel::schlickExp2;
  };
  if (look.maxError || schlick(look.fresnel)) return true;
  return std::ranges::any_of(look.material, [&](const auto& each) {
    return each.second.fresnel && schlick(*each.second.fresnel);
  });
}

std::string shown(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_number()) return numberText(value.get<double>());
  if (value.is_array()) {
    std::string all;
    for (const Json& each : value) all += (all.empty() ? "" : ", ") + shown(each);
    return all;
  }
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  return text;
}

std::string spaced(std::string name) {
  std::ranges::replace(name, '-', ' ');
  return name;
}

}  // namespace

std::string withoutEffect(const Look& look, const Scene* scene, std::string_view name) {
  const bool environment = look.shading == Shading::environment;
  const bool background = look.environmentBackground && !look.noBackground;
  const bool own = !look.hdriFile.empty();
  if (isOneOf(name, {"fresnel", "medium-ior", "schlick-exponent", "ior", "transmission"}) &&
      !environment)
    return "only the program environment uses it: choose that as shading";
  if (name == "schlick-exponent" && !usesSchlick(look))
    return "only Schlick's forms have it: choose one as fresnel";
  if (isOneOf(name, {"environment", "hdri-file", "environment-rotation"}) && !environment &&
      !background)
    return "nothing shows the environment: choose the program environment, or tick environment "
           "background";
  if (name == "environment" && own) return "the hdri file replaces it: clear that";
  if (name == "environment-rotation" && !own && look.environment == Environment::white)
    return "the white environment is the same all around";
  if (isOneOf(name, {"environment-background", "background-color"}) && look.noBackground)
    return "the background is transparent: untick no background";
  if (name == "background-color" && look.environmentBackground)
    return "the environment is shown there: untick environment background";
  if (name == "blinn-factor" && look.shading != Shading::automatic && !usesBlinn(look.shading))
    return "the lobe is Phong's: choose blinn-phong or environment as shading";
  if (name == "light-scale" && !lightsAreTheFiles(scene, look))
    return scene && scene->lights.empty() ? "the model's file has no lights"
                                          : "the lights are not the file's";
  if (name == "specular-antialiasing" && !isPerPixel(look.shading))
    return "light is computed per face or vertex: choose a per-pixel program as shading";
  if (isOneOf(name, {"highlight", "specular-antialiasing", "normalization"}) && look.noLights)
    return "there are no lights: untick no lights";
  if (name == "camera-direction" && look.cameraPosition && look.cameraFocalPoint)
    return "position and focal point determine it";
  if (name == "camera-zoom-factor" && look.cameraPosition) return "the position determines it";
  if (name == "animation-time" && scene && scene->animations.empty())
    return "the file has no animation";
  return {};
}

std::vector<Difference> differences(const Look& a, const Look& b) {
  std::vector<Difference> all;
  for (const Parameter& p : lookParameters()) {
    if (p.name == "resolution") continue;
    const Json va = p.save(a), vb = p.save(b);
    if (va == vb) continue;
    if (p.name != "material") {
      all.push_back({spaced(p.name), shown(va), shown(vb)});
      continue;
    }
    std::set<std::string> names;
    for (const Json* side : {&va, &vb})
      if (side->is_object())
        for (const auto& [name, edit] : side->items()) names.insert(name);
    const auto in = [](const Json& side, const std::string& name) {
      return side.is_object() && side.contains(name) ? side[name] : Json::object();
    };
    for (const std::string& name : names) {
      const Json ea = in(va, name), eb = in(vb, name);
      std::set<std::string> keys;
      for (const Json* edit : {&ea, &eb})
        for (const auto& [key, value] : edit->items()) keys.insert(key);
      for (const std::string& key : keys) {
        const Json x = ea.contains(key) ? ea[key] : Json(), y = eb.contains(key) ? eb[key] : Json();
        if (x != y)
          all.push_back(
              {key + " of " + (name.empty() ? "all materials" : name), shown(x), shown(y)});
      }
    }
  }
  return all;
}

std::string valueText(const std::string& value) { return value == "-" ? "not set" : value; }

std::string sideText(const std::vector<Difference>& all, bool a, std::size_t most) {
  if (all.empty()) return "the same look";
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), most); ++i) {
    const std::string& value = a ? all[i].a : all[i].b;
    text += (i > 0 ? ", " : "") + all[i].what + " " + valueText(value);
  }
  if (all.size() > most)
    text += (most > 0 ? ", and " : "") + std::to_string(all.size() - most) +
            (most > 0 ? " more" : " differences");
  return text;
}

}  // namespace glint::viewer
