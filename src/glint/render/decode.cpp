#include "glint/render/decode.h"

#include <algorithm>
#include <future>
#include <optional>
#include <utility>

#include "glint/image/error.h"
#include "glint/image/mipmaps.h"
#include "glint/render/environment_image.h"

namespace glint {
namespace {

bool readsMipLevels(const Scene& scene, int image) {
  const auto reads = [&](const std::optional<Texture>& t) {
    return t && t->image == image && t->sampler.mip != MipFilter::none;
  };
  return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
    return reads(m.colorTexture) || reads(m.emissionTexture) || reads(m.normalTexture);
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
      images[i] = task.get();
    } catch (const InputError& error) {
      scene.warnings.push_back(std::string(error.what()) + " (drawn without it)");
      for (Material& material : scene.materials) {
        if (material.colorTexture && material.colorTexture->image == i)
          material.colorTexture.reset();
        if (material.emissionTexture && material.emissionTexture->image == i)
          material.emissionTexture.reset();
        if (material.normalTexture && material.normalTexture->image == i)
          material.normalTexture.reset();
      }
    }
  }
  return images;
}

}  // namespace glint
