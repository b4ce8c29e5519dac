#include "glint/image/texture.h"

#include <new>
#include <utility>

#include "glint/image/decoders.h"
#include "glint/image/row_reducer.h"

namespace glint {

bool canDecodeWebp() { return GLINT_WEBP; }

namespace {

InputError tooLarge(const std::string& name) {
  return InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
}

InputError unknownFormat(const std::string& name) {
  return InputError(printablePath(name) + ": neither PNG nor JPEG: convert it to one of them");
}

ByteImage decodePng(std::span<const std::byte> bytes, const std::string& name, int halvings,
                    bool isData) {
  detail::PngReader reader(bytes, name);
  if (halvings > 0) {
    RowReducer reducer(reader.width(), reader.height(), halvings, isData);
    reader.decodeRows([&](const std::uint8_t* row) { reducer.add(row); });
    return reducer.take();
  }
  ByteImage image;
  image.width = reader.width();
  image.height = reader.height();
  image.values.reserve(detail::withRoomForLevels(std::size_t(4) * image.width * image.height));
  reader.decode(image.values);
  return image;
}

ByteImage reduced(const ByteImage& image, int halvings, bool isData) {
  RowReducer reducer(image.width, image.height, halvings, isData);
  for (int y = 0; y < image.height; ++y)
    reducer.add(image.values.data() + std::size_t(4) * image.width * y);
  return reducer.take();
}

}  // namespace

TextureHeader textureHeader(std::span<const std::byte> bytes, const std::string& name) {
  try {
    if (detail::isJpeg(bytes)) return detail::jpegHeader(bytes, name);
    if (detail::isWebp(bytes)) return detail::webpHeader(bytes, name);
    if (detail::isPng(bytes)) {
      const detail::PngReader reader(bytes, name);
      const std::uint64_t all = std::uint64_t(4) * reader.width() * reader.height();
      return {reader.width(), reader.height(), all, reader.isInterlaced() ? all : 0};
    }
  } catch (const std::bad_alloc&) {
    throw tooLarge(name);
  }
  throw unknownFormat(name);
}

ByteImage decodeTexture(std::span<const std::byte> bytes, const std::string& name, int halvings,
                        bool isData) {
  try {
    if (detail::isJpeg(bytes)) return detail::decodeJpeg(bytes, name, halvings, isData);
    if (detail::isPng(bytes)) return decodePng(bytes, name, halvings, isData);
    if (detail::isWebp(bytes)) {
      ByteImage whole = detail::decodeWebp(bytes, name);
      return halvings > 0 ? reduced(whole, halvings, isData) : std::move(whole);
    }
  } catch (const std::bad_alloc&) {
    throw tooLarge(name);
  }
  throw unknownFormat(name);
}

}  // namespace glint
