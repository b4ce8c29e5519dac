#include "glint/image/read_image.h"

#include <new>

#include "glint/image/decoders.h"
#include "glint/image/stored_image.h"

namespace glint {
namespace {

constexpr std::size_t maxPixels = std::size_t(1) << 27;  // 2 GiB of floats

StoredImage decodePng(std::span<const std::byte> bytes, const std::string& name) {
  detail::PngReader reader(bytes, name);
  detail::checkSize(name, reader.width(), reader.height());
  StoredImage image;
  image.width = reader.width();
  image.height = reader.height();
  if (reader.bitDepth() == 16) {
    reader.decode(image.values.emplace<1>());
  } else if (reader.hasAlpha()) {
    reader.decode(image.values.emplace<0>());
  } else {
    image.channels = 3;
    reader.decodeOpaque(image.values.emplace<0>());
  }
  image.text = reader.text();
  return image;
}

StoredImage fromJpeg(std::span<const std::byte> bytes, const std::string& name) {
  ByteImage jpeg = detail::decodeJpeg(bytes, name);
  return {jpeg.width, jpeg.height, 4, std::move(jpeg.values)};
}

}  // namespace

void detail::checkSize(const std::string& name, std::uint64_t width, std::uint64_t height) {
  checkSides(name, width, height);
  if (width * height <= maxPixels) return;
  throw InputError(printablePath(name) + ": " + std::to_string(width) + " x " +
                   std::to_string(height) + " pixels are too many: give a smaller picture");
}

StoredImage decodeStoredImage(std::span<const std::byte> bytes, const std::string& name,
                              const std::string& layer) {
  try {
    if (detail::isExr(bytes)) return detail::decodeExr(bytes, name, layer);
    if (!layer.empty()) {
      throw InputError(printablePath(name) + ": only OpenEXR has layers: leave out the layer '" +
                       printablePath(layer) + "'");
    }
    if (detail::isPng(bytes)) return decodePng(bytes, name);
    if (detail::isJpeg(bytes)) return fromJpeg(bytes, name);
    if (detail::isPfm(bytes)) return detail::decodePfm(bytes, name);
    if (detail::isHdr(bytes)) return detail::decodeHdr(bytes, name);
  } catch (const std::bad_alloc&) {
    throw InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
  }
  throw InputError(printablePath(name) +
                   ": neither PNG, JPEG, EXR, HDR nor PFM: convert it to one of them");
}

StoredImage readStoredImage(const std::string& path, const std::string& layer) {
  return decodeStoredImage(readFile(path), path, layer);
}

Image decodeImage(std::span<const std::byte> bytes, const std::string& name,
                  const std::string& layer) {
  try {
    StoredImage stored = decodeStoredImage(bytes, name, layer);
    Image image{stored.width, stored.height, {}, std::move(stored.text)};
    if (stored.channels == 4 && !stored.isEncoded()) {
      image.values = std::move(std::get<2>(stored.values));
    } else {
      image.values.resize(std::size_t(4) * stored.width * stored.height);
      stored.linearRows(0, stored.height, image.values.data());
    }
    return image;
  } catch (const std::bad_alloc&) {
    throw InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
  }
}

Image readImage(const std::string& path, const std::string& layer) {
  return decodeImage(readFile(path), path, layer);
}

bool mayHoldText(std::span<const std::byte> bytes) {
  return detail::isPng(bytes) || detail::isExr(bytes);
}

std::map<std::string, std::string> pictureTextIn(std::span<const std::byte> bytes,
                                                 const std::string& name) {
  if (detail::isPng(bytes)) return detail::PngReader(bytes, name).text();
  if (detail::isExr(bytes)) return detail::exrText(bytes, name);
  return {};
}

std::map<std::string, std::string> readPictureText(const std::string& path) {
  return pictureTextIn(readFile(path, Noted::no), path);
}

}  // namespace glint
