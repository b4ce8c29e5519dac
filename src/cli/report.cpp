#include "report.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"

namespace glint {

using Json = nlohmann::ordered_json;

Json variantsJson(const Scene& scene, const DrawList& list, const Look& given) {
  const Look look = withFileLights(scene, given);
  std::map<Variant, const DrawItem*> firsts;
  std::map<Variant, std::vector<std::string>> materials;
  for (const DrawItem& item : list.items) {
    firsts.emplace(item.variant, &item);
    auto& names = materials[item.variant];
    const std::string name = materialKey(scene.materials[std::size_t(item.material)]);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  Json all = Json::array();
  for (const auto& [variant, item] : firsts) {
    const Material material = editedMaterial(scene.materials[std::size_t(item->material)], look);
    Json reasons = Json::object();
    for (const FeatureReason& r : reasonsFor(variant, scene.meshes[std::size_t(item->mesh)],
                                             material, look, list.camera.orthographic))
      reasons[r.feature] = r.reason;
    all.push_back({{"program", variant.unlit ? "unlit" : shadingName(variant.program)},
                   {"features", featureNames(variant)},
                   {"reasons", reasons},
                   {"materials", materials[variant]}});
  }
  return all;
}

Json choiceJson(const ResolvedLook& resolved, const Look& asked) {
  Json json = Json::object();
  if (asked.maxError) {
    json["max-error"] = *errorBudget(asked);
    if (asked.maxErrorInCodes) json["codes"] = *asked.maxError;
    json["costs"] = asked.costTable.empty() ? "shipped" : asked.costTable;
  }
  json["bound"] = resolved.bound;
  json["shading"] = shadingName(resolved.look.shading);
  if (!resolved.programReason.empty()) json["reason"] = resolved.programReason;
  json["materials"] = Json::array();
  for (const FormChoice& c : resolved.choices) {
    Json one{{"material", c.material}};
    if (c.specular) one["highlight"] = highlightText(c.highlight);
    if (c.dielectric) one["fresnel"] = fresnelText(c.fresnel);
    one["bound"] = c.bound;
    one["lobe"] = c.lobe;
    one["reflectance"] = c.reflectance;
    one["interpolation"] = c.interpolation;
    one["rounding"] = c.rounding;
    one["cost"] = c.cost;
    one["exactCost"] = c.exactCost;
    one["reason"] = c.reason;
    json["materials"].push_back(one);
  }
  return json;
}

std::size_t triangleCount(const Scene& scene, const DrawList& list) {
  std::size_t count = 0;
  for (const DrawItem& item : list.items) {
    const Mesh& mesh = scene.meshes[std::size_t(item.mesh)];
    if (mesh.topology == Topology::triangles) count += mesh.indices.size() / 3;
  }
  return count;
}

}  // namespace glint
