#include "glint/render/decode.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "glint/image/error.h"
#include "glint/image/mipmaps.h"
#include "glint/image/srgb.h"
#include "glint/image/task.h"
#include "glint/render/decode_plan.h"
#include "glint/render/environment_image.h"
#include "glint/render/normal_lengths.h"
#include "glint/render/opacity.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

using detail::DecodeJob;

std::atomic<std::uint64_t> givenLimit = 0;

glm::dvec4 texelAt(const ByteImage& image, int x, int y) {
  const std::uint8_t* t =
      &image.values[std::size_t(4) * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
  return {decodeSrgb8(t[0]), decodeSrgb8(t[1]), decodeSrgb8(t[2]), t[3] / 255.0};
}

// Bilinear at (x, y) in [0, 1], measured from the corner of the first texel.
glm::dvec4 valueAt(const ByteImage& image, double x, double y) {
  const auto corner = [](double at, int size, double& share) {
    const double place = std::clamp(at * size - 0.5, 0.0, size - 1.0);
    share = place - std::floor(place);
    return int(place);
  };
  double u = 0, v = 0;
  const int left = corner(x, image.width, u), top = corner(y, image.height, v);
  const int right = std::min(left + 1, image.width - 1), low = std::min(top + 1, image.height - 1);
  return glm::mix(glm::mix(texelAt(image, left, top), texelAt(image, right, top), u),
                  glm::mix(texelAt(image, left, low), texelAt(image, right, low), u), v);
}

std::uint8_t codeOf(double value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

/// Converts the texels of a picture as GlossPicture describes: to C and alpha if `made.isColor`,
/// otherwise to roughness (G), metallic (B) and reflectance (A), each rounded to the nearest code.
/// `other` is the second picture of the pair, read bilinearly where its size differs; null counts
/// as white.
void convertGlossPicture(ByteImage& picture, const ByteImage* other, const GlossPicture& made) {
  const bool sameSize = other && other->width == picture.width && other->height == picture.height;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::dvec4 own = texelAt(picture, x, y);
      glm::dvec4 beside(1);
      if (sameSize)
        beside = texelAt(*other, x, y);
      else if (other)
        beside = valueAt(*other, (x + 0.5) / picture.width, (y + 0.5) / picture.height);
      // Without a diffuse picture, the colours come from the specular-glossiness picture.
      const bool ownIsDiffuse = made.isColor && other;
      const glm::dvec4 diffuse = ownIsDiffuse ? own : made.isColor ? glm::dvec4(1) : beside;
      const glm::dvec4 gloss = ownIsDiffuse ? beside : own;
      SpecularGlossiness texel = made.factors;
      texel.diffuse *= glm::dvec3(diffuse);
      texel.specular *= glm::dvec3(gloss);
      texel.glossiness *= gloss.a;
      const MetalShare share = metalShare(texel);
      std::uint8_t* to =
          &picture.values[std::size_t(4) *
                          (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
      if (made.isColor) {
        const glm::dvec3 color =
            texel.diffuse + (glm::min(texel.specular, 1.0) - texel.diffuse) * share.metallic;
        for (int i = 0; i < 3; ++i) to[i] = encodeSrgb8(float(color[i]));
        to[3] = codeOf(diffuse.a);
      } else {
        to[1] = codeOf(1 - texel.glossiness);
        to[2] = codeOf(share.metallic);
        to[3] = codeOf(share.reflectance);
      }
    }
}

// Helper threads, counted for the whole process however many models are decoded at once: the
// calling thread works too, and takes helpers only while processors are free.
class Helpers {
 public:
  explicit Helpers(std::size_t wanted) {
    int left = free_;
    do {
      taken_ = std::min(int(std::min(wanted, std::size_t(1024))), left);
    } while (!free_.compare_exchange_weak(left, left - taken_));
  }
  ~Helpers() { free_ += taken_; }
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  int count() const { return taken_; }

 private:
  static inline std::atomic<int> free_ = std::max(1, int(std::thread::hardware_concurrency())) - 1;
  int taken_ = 0;
};

// The second picture that a gloss picture is made from, or nullptr.
const EncodedImage* otherOf(const Scene& scene, const EncodedImage& image) {
  return image.gloss && image.gloss->other >= 0 ? &scene.images[std::size_t(image.gloss->other)]
                                                : nullptr;
}

int neededHalvings(const TextureHeader& header) {
  int halvings = 0;
  while (std::max(header.width, header.height) >> halvings > maxTextureSide) ++halvings;
  return halvings;
}

// Decodes jobs in order, on several threads; a large one waits until the memory limit has room for
// it.
class Decoding {
 public:
  Decoding(const Scene& scene, const std::vector<DecodeJob>& jobs, std::uint64_t room)
      : scene_(scene), jobs_(jobs), room_(room), images_(jobs.size()), errors_(jobs.size()) {}

  void run() {
    const Helpers helpers(jobs_.empty() ? 0 : jobs_.size() - 1);
    std::vector<std::thread> threads;
    for (int i = 0; i < helpers.count(); ++i)
      if (!addWorker(threads, [this] { work(); })) break;
    work();
    for (std::thread& thread : threads) thread.join();
  }

  /// The picture of a job; rethrows what decoding threw.
  DecodedImage take(std::size_t job) {
    if (errors_[job]) std::rethrow_exception(errors_[job]);
    return std::move(images_[job]);
  }

 private:
  void work() {
    for (std::size_t i = 0; (i = next_++) < jobs_.size();) {
      const std::uint64_t bytes = jobs_[i].atWork();
      {
        std::unique_lock lock(mutex_);
        left_.wait(lock, [&] { return inUse_ == 0 || inUse_ + bytes <= room_; });
        inUse_ += bytes;
      }
      try {
        images_[i] = decode(jobs_[i]);
      } catch (...) {
        errors_[i] = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      inUse_ -= bytes;
      left_.notify_all();
    }
  }

  DecodedImage decode(const DecodeJob& job) const {
    const EncodedImage& image = scene_.images[std::size_t(job.image)];
    const bool areNumbers = image.isData && !image.gloss;
    DecodedImage decoded{
        decodeTexture(image.bytes, image.name, job.halvings, areNumbers), {}, false};
    if (image.gloss) {
      std::optional<ByteImage> other;
      if (const EncodedImage* beside = otherOf(scene_, image)) {
        const TextureHeader header = textureHeader(beside->bytes, beside->name);
        other = decodeTexture(beside->bytes, beside->name, neededHalvings(header));
      }
      convertGlossPicture(decoded.image, other ? &*other : nullptr, *image.gloss);
    }
    if (job.hasLevels) decoded.mipLevels = mipLevels(decoded.image, image.isData);
    if (job.needsNormalLengths) writeNormalLengths(decoded);
    decoded.hasNormalLengths = job.needsNormalLengths;
    return decoded;
  }

  const Scene& scene_;
  const std::vector<DecodeJob>& jobs_;
  const std::uint64_t room_;
  std::vector<DecodedImage> images_;
  std::vector<std::exception_ptr> errors_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::condition_variable left_;
  std::uint64_t inUse_ = 0;
};

void drawWithout(Scene& scene, int image, const InputError& error) {
  scene.warnings.push_back(std::string(error.what()) + " (drawn without it)");
  for (Material& material : scene.materials)
    for (std::optional<Texture>* texture : texturesOf(material))
      if (*texture && (*texture)->image == image) texture->reset();
}

// Warns of corrected texels. Drawing reports an environment picture that cannot be read.
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
                             " texels are negative, infinite or NaN: NaN and negative values count "
                             "as 0, values above 1e30 as 1e30");
}

}  // namespace

bool readsMipLevels(const Scene& scene, int image) {
  const auto reads = [&](const std::optional<Texture>& t) {
    return t && t->image == image && t->sampler.mip != MipFilter::none;
  };
  return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
    const auto textures = texturesOf(m);
    return std::ranges::any_of(textures, [&](const auto* texture) { return reads(*texture); });
  });
}

void limitDecoding(std::uint64_t bytes) { givenLimit = bytes; }

std::uint64_t decodeLimit(std::uint64_t encoded) {
  return givenLimit > 0 ? givenLimit.load() : std::max(std::uint64_t(256) << 20, 128 * encoded);
}

DecodedImages decodeImages(Scene& scene, const Look& look) {
  tellOfEnvironment(scene, look);
  return decodeImages(scene, look, [](int, bool) { return false; });
}

bool needsNormalLengths(const EncodedImage& image, const Look& look) {
  return image.isNormalMap && look.specularAntialiasing == SpecularAntialiasing::toksvig;
}

DecodedImages decodeImages(Scene& scene, const Look& look, const IsPresent& present) {
  std::vector<DecodeJob> jobs;
  for (const int i : imagesRead(scene, look)) {
    const EncodedImage& image = scene.images[std::size_t(i)];
    if (present(i, needsNormalLengths(image, look))) continue;
    try {
      DecodeJob job{i,
                    image.name,
                    textureHeader(image.bytes, image.name),
                    image.bytes.size(),
                    readsMipLevels(scene, i),
                    needsNormalLengths(image, look),
                    0};
      if (const EncodedImage* other = otherOf(scene, image)) {
        const TextureHeader header = textureHeader(other->bytes, other->name);
        const std::uint64_t more = std::uint64_t(4) * header.width * header.height +
                                   std::max(header.work, header.reducedWork);
        job.header.work += more;
        job.header.reducedWork += more;
      }
      jobs.push_back(std::move(job));
    } catch (const InputError& error) {
      drawWithout(scene, i, error);
    }
  }
  const int useful = std::max({1024, 2 * look.resolution.x, 2 * look.resolution.y});
  std::uint64_t encoded = 0;
  for (const DecodeJob& job : jobs) encoded += job.encoded;
  const std::uint64_t limit = decodeLimit(encoded);
  for (std::string& warning : detail::planDecoding(jobs, limit, useful))
    scene.warnings.push_back(std::move(warning));
  Decoding decoding(scene, jobs, limit);
  decoding.run();
  DecodedImages images;
  for (std::size_t job = 0; job < jobs.size(); ++job) {
    const int i = jobs[job].image;
    try {
      const DecodedImage& decoded = images[i] = decoding.take(job);
      for (Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[std::size_t(mesh.material)];
        if (material.alphaMode == AlphaMode::blend && material.colorTexture &&
            material.colorTexture->image == i)
          mesh.opaqueTexels = texelsAreOpaque(mesh, *material.colorTexture, decoded.image);
      }
    } catch (const InputError& error) {
      images.erase(i);
      drawWithout(scene, i, error);
    }
  }
  return images;
}

}  // namespace glint
