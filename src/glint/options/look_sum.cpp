#include <algorithm>

#include "glint/budget/cost_file.h"
#include "glint/image/error.h"
#include "glint/image/read_files.h"
#include "glint/options/parameters.h"
#include "glint/scene/material_key.h"

namespace glint {
namespace {

using GivenOptions = std::vector<std::pair<std::string, std::string>>;

/// Clears in `edit` what `by` sets.
void clearEdit(MaterialEdit& edit, const MaterialEdit& by) {
  forEachEdit([&](auto part) {
    if (by.*part) (edit.*part).reset();
  });
}

void checkContradictions(const GivenOptions& options) {
  const auto given = [&](const char* name) {
    return std::ranges::any_of(options, [&](const auto& each) { return each.first == name; });
  };
  for (const auto& [one, other] :
       {std::pair("light", "no-lights"), std::pair("camera-intrinsics", "camera-view-angle"),
        std::pair("camera-intrinsics", "camera-orthographic")})
    if (given(one) && given(other))
      throw InputError("--" + std::string(one) + " and --" + other + ": give one of them");
}

}  // namespace

void mergeMaterials(Look& look, const Look& options) {
  const auto all = options.material.find("");
  if (all != options.material.end())
    for (auto& [key, edit] : look.material) clearEdit(edit, all->second);
  for (const auto& [key, from] : options.material) {
    // An edit of all materials with a name overrides the look's edits of individual ones.
    for (auto& [other, edit] : look.material)
      if (!key.empty() && other.starts_with(key + "#")) clearEdit(edit, from);
    mergeEdit(look.material[key], from);
  }
  std::erase_if(look.material, [](const auto& each) { return each.second == MaterialEdit{}; });
}

Look lookFrom(const GivenOptions& options, const Look& defaults) {
  Look look = defaults, materials;
  for (const auto& [name, text] : options)
    if (name == "look") readLookFile(look, text);
  checkContradictions(options);
  bool lit = false;
  for (const auto& [name, text] : options) {
    if (name == "look") continue;
    if (name == "light" && !lit) {  // replaces the look file's lights or no-lights
      look.light.reset();
      look.noLights = false;
      lit = true;
    }
    if (name == "environment") look.hdriFile.clear();
    setParameter(name == "material" ? materials : look, name, text);
  }
  mergeMaterials(look, materials);
  if (!look.hdriFile.empty()) noteReadFile(look.hdriFile);
  costTableFor(look);  // reports a broken table at once, even if nothing is chosen
  return look;
}

}  // namespace glint
