#include <algorithm>
#include <cstring>

#include "glint/image/decoders.h"

#if GLINT_WEBP
#include <webp/decode.h>
#endif

namespace glint::detail {

bool isWebp(std::span<const std::byte> bytes) {
  return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

TextureHeader webpHeader(std::span<const std::byte> bytes, const std::string& name) {
#if GLINT_WEBP
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                      &features) != VP8_STATUS_OK)
    throw InputError(printablePath(name) + ": the WebP is damaged: save or copy it again");
  // For lossless files (format 2) the library holds a second copy of the picture, for lossy ones
  // its alpha.
  const std::uint64_t pixels = std::uint64_t(features.width) * features.height;
  const std::uint64_t work = features.format == 1 ? (features.has_alpha ? pixels : 0) : 4 * pixels;
  return {features.width, features.height, work, work + 4 * pixels};
#else
  decodeWebp(bytes, name);
  return {};
#endif
}

ByteImage decodeWebp(std::span<const std::byte> bytes, const std::string& name) {
#if GLINT_WEBP
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  ByteImage image;
  // The format allows at most 16383 pixels a side.
  if (!WebPGetInfo(data, bytes.size(), &image.width, &image.height))
    throw InputError(printablePath(name) + ": the WebP is damaged: save or copy it again");
  checkSides(name, std::uint64_t(image.width), std::uint64_t(image.height));
  image.values.resize(std::size_t(4) * image.width * image.height);
  if (!WebPDecodeRGBAInto(data, bytes.size(), image.values.data(), image.values.size(),
                          4 * image.width))
    throw InputError(printablePath(name) + ": the WebP is damaged: save or copy it again");
  return image;
#else
  throw InputError(printablePath(name) +
                   ": WebP, which this build does not read: convert it to PNG or JPEG");
#endif
}

}  // namespace glint::detail
