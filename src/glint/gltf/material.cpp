#include "glint/gltf/material.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/pbr_conversion.h"

namespace glint::gltf {
namespace {

constexpr double largestFactor = 1e6;

void takeConverted(Material& material, const ConvertedParameters& c, const glm::dvec3& color) {
  material.shading = {c.ambient, c.diffuse, c.specular, c.exponent, c.metalness, c.ior, color, 0};
  material.highlightShare = c.share;
}

/// Applies `extras.glint`: its numbers replace textures. It is the user's own text, so no fault in
/// it is an error.
void readExtras(const Json& material, const std::string& label, Material& edited,
                Messages& messages) {
  ShadingParameters& shading = edited.shading;
  const auto extras = material.find("extras");
  if (extras == material.end() || !extras->is_object()) return;
  const auto glint = extras->find("glint");
  if (glint == extras->end()) return;
  const std::string place = label + " extras.glint";
  if (!glint->is_object()) {
    messages.warn(place + " is not an object and is ignored");
    return;
  }
  const auto take = [&](const std::string& name, const Json& from, double& to, double least,
                        double most) {
    if (!from.is_number()) {
      messages.warn(place + "." + name + " is not a number and is ignored");
      return;
    }
    const double value = from.get<double>();
    to = std::clamp(value, least, most);
    if (to != value) {
      messages.warn(place + "." + name + " is out of range, " + Json(to).dump() + " is used");
    }
  };
  std::optional<double> share;
  for (auto it = glint->begin(); it != glint->end(); ++it) {
    const std::string name = printable(it.key(), 40);
    if (it.key() == "color") {
      if (!it->is_array() || it->size() != 3) {
        messages.warn(place + ".color is not three numbers and is ignored");
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        take("color", (*it)[k], shading.color[static_cast<int>(k)], 0, largestFactor);
      }
      continue;
    }
    if (it.key() == shareKey) {
      double value = 0;
      take(name, *it, value, 0, 1);
      if (it->is_number()) share = value;
      continue;
    }
    const auto switches = switchedTextures();
    const auto texture =
        std::ranges::find(switches, std::string_view(it.key()), &SwitchedTexture::name);
    if (texture != switches.end()) {
      if (!it->is_boolean())
        messages.warn(place + "." + name + " is neither true nor false and is ignored");
      else if (!it->get<bool>())
        edited.switchedOff |= texture->bit;
      continue;
    }
    const auto keys = materialParameters();
    const auto key = std::ranges::find(keys, std::string_view(it.key()), &MaterialParameter::name);
    if (key == keys.end()) {
      messages.warn(
          std::string(place).append(".").append(name).append(" is not known and is ignored"));
    } else {
      take(name, *it, shading.*key->value, key->min, key->max);
      if (it->is_number()) edited.textured &= ~key->textured;
      if (it->is_number() && key->value == &ShadingParameters::specular)
        edited.highlightShare.reset();
    }
  }
  if (share) edited.highlightShare = share;
}

/// A colour from the file: `count` numbers clamped to [0, 1e6], or `fallback`.
glm::dvec4 readColor(Cursor from, std::size_t count, const glm::dvec4& fallback) {
  from.checkNumbers(count);
  glm::dvec4 color = fallback;
  for (std::size_t k = 0; from.exists() && k < count; ++k) {
    color[static_cast<int>(k)] = std::clamp(from.item(k).number(0), 0.0, largestFactor);
  }
  return color;
}

double unit(Cursor from, double fallback) { return std::clamp(from.number(fallback), 0.0, 1.0); }

/// Records the unsupported parts of supported extensions.
void readUnused(Cursor extensions, Material& material) {
  const Cursor specular = extensions.member("KHR_materials_specular");
  if (readColor(specular.member("specularColorFactor"), 3, glm::dvec4(1)) !=
          glm::dvec4(1, 1, 1, 1) ||
      specular.member("specularColorTexture").exists())
    material.unusedProperties.emplace_back("the colour of KHR_materials_specular");
}

/// Reads textures that supply parameters; only sets bits for parameters that they can change. A
/// specular-glossiness material has no `pbr`.
void readParameterTextures(Cursor from, const std::optional<PbrParameters>& pbr, Material& material,
                           TextureReader& textures) {
  const Cursor extensions = from.member("extensions");
  if (extensions.member("KHR_materials_unlit").exists()) return;
  ParameterTextures& to = material.parameterTextures;
  const Cursor occlusion = from.member("occlusionTexture");
  to.occlusionStrength = unit(occlusion.member("strength"), 1);
  const auto take = [&](std::optional<Texture>& texture, Cursor info, unsigned bits) {
    if (bits == 0) return;
    texture = textures.read(info, TextureUse::numbers);
    if (texture) material.textured |= bits;
  };
  take(to.occlusion, occlusion, to.occlusionStrength > 0 ? unsigned(textured::ambient) : 0u);
  take(to.transmission,
       extensions.member("KHR_materials_transmission").member("transmissionTexture"),
       material.shading.transmission > 0 ? unsigned(textured::transmission) : 0u);
  if (!pbr) return;
  to.metallic = pbr->metallic;
  to.roughness = pbr->roughness;
  to.reflectance = dielectricReflectance(*pbr);
  const bool metals = pbr->metallic > 0, gloss = pbr->roughness > smallestRoughness;
  take(to.metallicRoughness, from.member("pbrMetallicRoughness").member("metallicRoughnessTexture"),
       (metals ? textured::metalness | textured::diffuse | textured::specular : 0u) |
           (gloss ? textured::exponent | textured::specular : 0u));
  take(to.specular, extensions.member("KHR_materials_specular").member("specularTexture"),
       to.reflectance > 0 ? unsigned(textured::specular) : 0u);
}

/// Makes the textures for a converted specular-glossiness material from its own.
void readGlossTexture(Cursor from, const SpecularGlossiness& gloss, Material& material,
                      TextureReader& textures, Messages& messages) {
  const Cursor map = from.member("specularGlossinessTexture");
  const std::optional<Texture> specular = textures.read(map);
  if (!specular) return;
  std::optional<Texture>& diffuse = material.colorTexture;
  const bool together = !diffuse || (diffuse->texcoord == specular->texcoord &&
                                     diffuse->transform == specular->transform);
  if (!together)
    messages.warn(
        map.path() +
        " and the diffuseTexture use different coordinates: metals get no colour from it");
  const int diffuseImage = diffuse && together ? diffuse->image : -1;
  const Texture numbers = textures.glossTexture(*specular, {false, diffuseImage, gloss});
  if (together) {
    diffuse = textures.glossTexture(diffuse ? *diffuse : *specular,
                                    {true, diffuse ? specular->image : -1, gloss});
    material.shading.color = glm::dvec3(1);
  }
  ParameterTextures& to = material.parameterTextures;
  to.metallicRoughness = to.specular = numbers;
  to.metallic = to.roughness = to.reflectance = 1;
  material.shading.metalness = 1;  // at most
  material.textured |=
      textured::metalness | textured::diffuse | textured::specular | textured::exponent;
}

/// Metallic and roughness next to this extension are a fallback for other viewers.
void readSpecularGlossiness(Cursor from, Material& material, TextureReader& textures,
                            Messages& messages) {
  SpecularGlossiness gloss;
  const glm::dvec4 diffuse = readColor(from.member("diffuseFactor"), 4, glm::dvec4(1));
  gloss.diffuse = glm::dvec3(diffuse);
  gloss.specular = glm::dvec3(readColor(from.member("specularFactor"), 3, glm::dvec4(1)));
  gloss.glossiness = unit(from.member("glossinessFactor"), 1);
  const bool textured = from.member("specularGlossinessTexture").exists();
  SpecularGlossiness numbers = gloss;
  if (textured) {
    // If the texture cannot be read, typical values of dielectrics and medium gloss are the best
    // guess.
    numbers.specular *= 0.04;
    numbers.glossiness *= 0.5;
  }
  const auto [converted, color] = convertSpecularGlossiness(numbers);
  takeConverted(material, converted, color);
  material.alpha = std::min(diffuse.a, 1.0);
  material.colorTexture = textures.read(from.member("diffuseTexture"));
  // An unlit material shows its diffuse colour and does not need the rest.
  if (textured && !material.unlit) readGlossTexture(from, gloss, material, textures, messages);
}

Material readMaterial(Cursor from, TextureReader& textures, Messages& messages) {
  Material material;
  from.checkObject();
  material.name = from.name();
  const Cursor pbr = from.member("pbrMetallicRoughness");
  const Cursor extensions = from.member("extensions");

  const double metallic = unit(pbr.member("metallicFactor"), 1);
  const double roughness = unit(pbr.member("roughnessFactor"), 1);
  const double ior = extensions.member("KHR_materials_ior").member("ior").number(1.5);
  const Cursor specular = extensions.member("KHR_materials_specular").member("specularFactor");
  const PbrParameters numbers{metallic, roughness, ior, unit(specular, 1)};
  const glm::dvec4 color = readColor(pbr.member("baseColorFactor"), 4, glm::dvec4(1));
  takeConverted(material, convertPbr(numbers), glm::dvec3(color));
  material.alpha = std::min(color.a, 1.0);
  material.colorTexture = textures.read(pbr.member("baseColorTexture"));

  material.unlit = extensions.member("KHR_materials_unlit").exists();
  const Cursor gloss = extensions.member("KHR_materials_pbrSpecularGlossiness");
  if (gloss.exists()) readSpecularGlossiness(gloss, material, textures, messages);

  const double strength =
      extensions.member("KHR_materials_emissive_strength").member("emissiveStrength").number(1);
  const glm::dvec4 emission = readColor(from.member("emissiveFactor"), 3, glm::dvec4(0));
  material.emission = glm::clamp(glm::dvec3(emission) * std::clamp(strength, 0.0, largestFactor),
                                 0.0, largestFactor);
  // A texture multiplied by zero need not be read.
  if (material.emission != glm::dvec3(0)) {
    material.emissionTexture = textures.read(from.member("emissiveTexture"));
  }
  if (const Cursor normal = from.member("normalTexture"); normal.exists()) {
    material.normalTexture = textures.read(normal, TextureUse::normals);
    material.normalScale =
        std::clamp(normal.member("scale").number(1), -largestFactor, largestFactor);
  }
  material.shading.transmission =
      unit(extensions.member("KHR_materials_transmission").member("transmissionFactor"), 0);
  readUnused(extensions, material);
  material.doubleSided = from.member("doubleSided").boolean(false);
  material.alphaCutoff = std::max(from.member("alphaCutoff").number(0.5), 0.0);
  const std::string mode = from.member("alphaMode").text("OPAQUE");
  if (mode == "MASK") {
    material.alphaMode = AlphaMode::mask;
  } else if (mode == "BLEND") {
    material.alphaMode = AlphaMode::blend;
  } else if (mode != "OPAQUE") {
    messages.warn(from.path() + " has the unknown alphaMode \"" + printable(mode, 20) +
                  "\", drawn as OPAQUE");
  }
  readParameterTextures(from, gloss.exists() ? std::nullopt : std::optional(numbers), material,
                        textures);
  readExtras(from.json(), from.path(), material, messages);
  return material;
}

}  // namespace

std::vector<Material> readMaterials(Document& document, TextureReader& textures,
                                    Messages& messages) {
  std::vector<Material> materials;
  for (const Cursor from : Cursor(document.json, messages).member("materials")) {
    Material& material = materials.emplace_back(readMaterial(from, textures, messages));
    // Every material needs a name so that it can be edited.
    if (material.name.empty()) material.name = "#" + std::to_string(materials.size() - 1);
  }
  Material& standard = materials.emplace_back();
  standard.name = "#default";
  takeConverted(standard, convertPbr({}), glm::dvec3(1));
  countMaterials(materials);
  return materials;
}

}  // namespace glint::gltf
