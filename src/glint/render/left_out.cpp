#include "glint/render/left_out.h"

#include <map>

#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

// What the variants of a material's meshes read between them.
struct Use {
  bool color = false, emission = false, normal = false, lit = false;
  bool metallicRoughness = false, occlusion = false, specular = false, transmission = false;

  void add(const Variant& v) {
    color |= v.colorTexture;
    emission |= v.emissionTexture;
    normal |= v.normalTexture;
    lit |= !v.unlit;
    metallicRoughness |= v.metallicRoughnessTexture;
    occlusion |= v.occlusionTexture;
    specular |= v.specularTexture;
    transmission |= v.transmissionTexture;
  }
};

void addMaterial(std::vector<LeftOut>& all, const Material& material, const Use& use,
                 Shading program) {
  const auto add = [&](std::string what, std::string reason, bool shows) {
    all.push_back({material.name, std::move(what), std::move(reason), shows});
  };
  for (const std::string& property : material.unusedProperties)
    add(property, "no program supports it", true);
  if (!use.lit) {
    if (material.normalTexture || material.emissionTexture)
      add("the textures of its light", "it is unlit", false);
    return;
  }
  const ParameterTextures& t = material.parameterTextures;
  const bool perFace = program == Shading::flat || program == Shading::gouraud;
  if (material.normalTexture && !use.normal)
    add("the normal texture",
        perFace ? std::string("the program ") + (program == Shading::flat ? "flat" : "gouraud") +
                      " has one normal a " + (program == Shading::flat ? "face" : "vertex") +
                      ": use --shading phong"
                : "nothing reads the normal",
        perFace);
  const bool transmits = material.shading.transmission > 0;
  if (transmits && program != Shading::environment)
    add("transmission", "only --shading environment shows transmission", true);
  const char* const nothing = "its parameters are set, or nothing uses them";
  if (t.metallicRoughness && !use.metallicRoughness)
    add("the metallic-roughness texture", nothing, false);
  if (t.occlusion && !use.occlusion) add("the occlusion texture", nothing, false);
  if (t.specular && !use.specular) add("the specular texture", nothing, false);
  if (t.transmission && !use.transmission && !(transmits && program != Shading::environment))
    add("the transmission texture", nothing, false);
}

}  // namespace

std::vector<LeftOut> leftOut(const Scene& scene, const Look& given) {
  const Look look = withFileLights(scene, given);
  std::map<int, Use> uses;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material material = editedMaterial(scene.materials[std::size_t(mesh.material)], look);
    uses[mesh.material].add(variantFor(mesh, material, instance.world, look, false));
  }
  std::vector<LeftOut> all;
  for (const auto& [index, use] : uses)
    addMaterial(all, editedMaterial(scene.materials[std::size_t(index)], look), use,
                programOf(look));
  return all;
}

std::string leftOutText(const LeftOut& item) {
  return "material '" + item.material + "': " + item.what + " is not used: " + item.reason;
}

}  // namespace glint
