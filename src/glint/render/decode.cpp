#include "glint/render/decode.h"

#include <algorithm>
#include <future>
#include <optional>
#include <utility>

#include "glint/image/error.h"
#include "glint/image/mipmaps.h"
#include "glint/render/environment_image.h"
#include "glint/render/opacity.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

bool readsMipLevels(const Scene& scene, int image) {
  const auto reads = [&](const std::optional<Texture>& t) {
    return t && t->image == image && t->sampler.mip != MipFilter::none;
  };
  return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
    const auto textures = texturesOf(m);
    return std::ranges::any_of(textures, [&](const auto* texture) { return reads(*texture); });
  });
}

// Of a picture of the environment that cannot be read, drawing tells.
void tellOfEnvironment(Scene& scene, const Look& look) {
  std::shared_ptr<const EnvironmentImage> image;
  try {
    image = environmentImageFor(look);
  } catch (const InputError&) {
    return;
  }
  if (image && image->corrected > 0)
    scene.warnings.push_back("--hdri-file: " + image->name + ": " +
                             std::to_string(image->corrected) +
                             " texels are negative, infinite or not numbers: NaN and negative "
                             "values count as 0, values above 1e30 as 1e30");
}

}  // namespace

DecodedImages decodeImages(Scene& scene, const Look& look) {
  tellOfEnvironment(scene, look);
  return decodeImages(scene, look, [](int) { return false; });
}

DecodedImages decodeImages(Scene& scene, const Look& look,
                           const std::function<bool(int image)>& present) {
  std::vector<std::pair<int, std::future<DecodedImage>>> tasks;
  for (int i : imagesRead(scene, look)) {
    if (present(i)) continue;
    tasks.emplace_back(i, std::async(std::launch::async, [&scene, i] {
                         const EncodedImage& image = scene.images[std::size_t(i)];
                         DecodedImage decoded{decodeTexture(image.bytes, image.name), {}};
                         if (readsMipLevels(scene, i))
                           decoded.mipLevels = mipLevels(decoded.image, image.isData);
                         return decoded;
                       }));
  }
  DecodedImages images;
  for (auto& [i, task] : tasks) {
    try {
      const DecodedImage& decoded = images[i] = task.get();
      for (Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[std::size_t(mesh.material)];
        if (material.alphaMode == AlphaMode::blend && material.colorTexture &&
            material.colorTexture->image == i)
          mesh.opaqueTexels = texelsAreOpaque(mesh, *material.colorTexture, decoded.image);
      }
    } catch (const InputError& error) {
      scene.warnings.push_back(std::string(error.what()) + " (drawn without it)");
      for (Material& material : scene.materials)
        for (std::optional<Texture>* texture : texturesOf(material))
          if (*texture && (*texture)->image == i) texture->reset();
    }
  }
  return images;
}

}  // namespace glint
