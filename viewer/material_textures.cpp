#include "material_textures.h"

#include <algorithm>

#include "glint/scene/material_parameters.h"
#include "materials.h"

namespace glint::viewer {
namespace {

std::string namesOf(unsigned bits) {
  std::string all;
  for (const MaterialParameter& p : materialParameters())
    if (bits & p.textured) all += (all.empty() ? "" : ", ") + std::string(p.name);
  return all;
}

}  // namespace

std::vector<MaterialTexture> materialTextures(const Scene& scene, const Look& look, int index) {
  std::vector<MaterialTexture> all;
  if (index < 0) return all;
  const Material& material = scene.materials[std::size_t(index)];
  const Material edited = editedMaterial(material, look);
  const unsigned left = edited.textured;
  const auto add = [&](const std::optional<Texture>& texture, const char* name,
                       const std::string& drives, unsigned bits = 0) {
    if (!texture) return;
    const unsigned gives = material.textured & bits;
    if (bits != 0 && gives == 0) return;  // none of its parameters is used here
    MaterialTexture& told = all.emplace_back();
    told.name = name;
    told.drives = bits == 0 ? drives : "gives " + namesOf(gives);
    told.image = texture->image;
    told.gives = gives;
    told.replaced = gives & ~left;
    told.isOff = gives != 0 && told.replaced == gives;
    for (const SwitchedTexture& own : switchedTextures()) {
      if (&(material.*own.texture) != &texture) continue;
      told.own = &own;
      told.isOff = (edited.switchedOff & own.bit) != 0;
    }
  };
  const ParameterTextures& p = material.parameterTextures;
  add(material.colorTexture, "base colour", "multiplies color and alpha");
  add(material.normalTexture, "normal", "turns N");
  add(material.emissionTexture, "emission", "adds light of its own");
  add(p.metallicRoughness, "metallic, roughness", {},
      textured::exponent | textured::metalness | textured::diffuse | textured::specular);
  add(p.occlusion, "occlusion", {}, textured::ambient);
  add(p.specular, "specular", {}, textured::specular);
  add(p.transmission, "transmission", {}, textured::transmission);
  return all;
}

void switchTexture(Look& look, const Scene& scene, int index, const MaterialTexture& texture,
                   bool on) {
  const std::string key = materialKey(scene, index);
  if (texture.own) {
    if (on == ((scene.materials[std::size_t(index)].switchedOff & texture.own->bit) == 0))
      resetTexture(look, key, *texture.own);
    else
      look.material[key].*texture.own->edit = on;
    return;
  }
  const ShadingParameters now = effectiveParameters(scene, look, index);
  for (const MaterialParameter& p : materialParameters()) {
    if (!(p.textured & texture.gives)) continue;
    if (on)
      resetParameter(look, key, p);
    else if (p.textured & ~texture.replaced)
      look.material[key].*p.edit = now.*p.value;
  }
}

Thumbnail thumbnailOf(const ByteImage& image, int side) {
  Thumbnail small;
  if (image.width < 1 || image.height < 1 || image.channels < 1) return small;
  const int longer = std::max(image.width, image.height), most = std::min(longer, side);
  small.width = std::max(1, image.width * most / longer);
  small.height = std::max(1, image.height * most / longer);
  small.rgba.assign(std::size_t(4) * std::size_t(small.width) * std::size_t(small.height), 255);
  constexpr int samples = 4;  // per side
  const std::size_t channels = std::size_t(image.channels);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      int sum[3] = {0, 0, 0};
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
          const auto at = [](int place, int sample, int from, int to) {
            const double share = (place + (sample + 0.5) / samples) / from;
            return std::size_t(std::min(int(share * to), to - 1));
          };
          const std::size_t column = at(x, i, small.width, image.width);
          const std::size_t row = at(y, j, small.height, image.height);
          const std::uint8_t* texel =
              image.values.data() + channels * (std::size_t(image.width) * row + column);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += texel[channels < 3 ? 0 : c];
        }
      std::uint8_t* out =
          small.rgba.data() + 4 * (std::size_t(small.width) * std::size_t(y) + std::size_t(x));
      for (int c = 0; c < 3; ++c) out[c] = std::uint8_t(sum[c] / (samples * samples));
    }
  return small;
}

}  // namespace glint::viewer
