#include "glint/image/texture.h"

#include <new>

#include "glint/image/decoders.h"

namespace glint {

bool canDecodeWebp() { return GLINT_WEBP; }

ByteImage decodeTexture(std::span<const std::byte> bytes, const std::string& name) {
  try {
    if (detail::isJpeg(bytes)) return detail::decodeJpeg(bytes, name);
    if (detail::isWebp(bytes)) return detail::decodeWebp(bytes, name);
    if (detail::isPng(bytes)) {
      detail::PngReader reader(bytes, name);
      ByteImage image;
      image.width = reader.width();
      image.height = reader.height();
      reader.decode(image.values);
      return image;
    }
  } catch (const std::bad_alloc&) {
    throw InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
  }
  throw InputError(printablePath(name) + ": neither PNG nor JPEG: convert it to one of them");
}

}  // namespace glint
