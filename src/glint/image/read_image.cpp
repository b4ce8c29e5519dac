#include "glint/image/read_image.h"

#include <algorithm>
#include <new>
#include <utility>

#include "glint/image/decoders.h"
#include "glint/image/picture_layers.h"
#include "glint/image/row_window.h"
#include "glint/image/stored_image.h"

namespace glint {
namespace {

constexpr std::size_t maxPixels = std::size_t(1) << 27;  // 2 GiB of floats

thread_local const PictureLimit* standingLimit = nullptr;

StoredImage decodePng(std::span<const std::byte> bytes, const std::string& name,
                      std::size_t heldBytes) {
  detail::PngReader reader(bytes, name);
  detail::checkSize(name, reader.width(), reader.height());
  StoredImage image;
  image.width = reader.width();
  image.height = reader.height();
  const int depth = reader.bitDepth() == 16 ? 16 : 8;
  if (depth == 8 && !reader.hasAlpha()) image.channels = 3;
  if (depth == 16) image.values.emplace<1>();
  const std::size_t row = std::size_t(image.channels) * image.width * (depth / 8);
  if (!reader.isInterlaced() && row * image.height > heldBytes) {
    const auto start = [=, channels = image.channels]() -> detail::RowWindow::Next {
      const auto again = std::make_shared<detail::PngReader>(bytes, name);
      again->beginRows(channels, depth);
      return [again](std::byte* out) { again->nextRow(out); };
    };
    image.window = std::make_shared<detail::RowWindow>(row, image.height, start);
  } else if (depth == 16) {
    reader.decode(std::get<1>(image.values));
  } else if (image.channels == 4) {
    reader.decode(std::get<0>(image.values));
  } else {
    reader.decodeOpaque(std::get<0>(image.values));
  }
  image.text = reader.text();
  return image;
}

StoredImage stored(ByteImage image) {
  return {image.width, image.height, 4, std::move(image.values)};
}

/// Decodes a file of a format that holds one picture.
StoredImage decodeOne(std::span<const std::byte> bytes, const std::string& name,
                      std::vector<std::string>& skipped, std::size_t heldBytes = SIZE_MAX) {
  if (detail::isPng(bytes)) return decodePng(bytes, name, heldBytes);
  if (detail::isJpeg(bytes)) return stored(detail::decodeJpeg(bytes, name));
  if (detail::isWebp(bytes)) return stored(detail::decodeWebp(bytes, name));
  if (detail::isPfm(bytes)) return detail::decodePfm(bytes, name);
  if (detail::isHdr(bytes)) return detail::decodeHdr(bytes, name);
  if (detail::isTiff(bytes)) return detail::decodeTiff(bytes, name, skipped, heldBytes);
  if (detail::isPnm(bytes) || detail::isBmp(bytes) || detail::isTga(bytes))
    return detail::decodeSimple(bytes, name, heldBytes);
  throw InputError(
      printablePath(name) +
      ": neither PNG, JPEG, WebP, EXR, HDR, PFM, TIFF, PPM, BMP nor TGA: convert it to "
      "one of them");
}

[[noreturn]] void refuseLayer(const std::string& name, const std::string& layer) {
  throw InputError(printablePath(name) + ": only OpenEXR has layers: leave out the layer '" +
                   printablePath(layer) + "'");
}

}  // namespace

PictureLimit::PictureLimit(std::uint64_t pixels, std::string advice)
    : pixels_(pixels), advice_(std::move(advice)), outer_(standingLimit) {
  standingLimit = this;
}

PictureLimit::~PictureLimit() { standingLimit = outer_; }

void detail::checkSides(const std::string& name, std::uint64_t width, std::uint64_t height) {
  const bool sides = width <= maxSide && height <= maxSide;
  if (sides &&
      width * height <= (standingLimit ? std::min(standingLimit->pixels(), maxArea) : maxArea))
    return;
  const std::string what = printablePath(name) + ": " + std::to_string(width) + " x " +
                           std::to_string(height) + " pixels are too many: ";
  if (standingLimit && sides) throw InputError(what + standingLimit->advice());
  throw InputError(what + "at most " + std::to_string(sides ? maxArea : std::uint64_t(maxSide)) +
                   (sides ? " in total" : " per side"));
}

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
    if (!layer.empty()) refuseLayer(name, layer);
    std::vector<std::string> skipped;
    StoredImage image = decodeOne(bytes, name, skipped);
    image.unfollowed.merge(detail::unfollowedIn(bytes));
    return image;
  } catch (const std::bad_alloc&) {
    throw InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
  }
}

PictureLayers decodePictureLayers(std::span<const std::byte> bytes, const std::string& name,
                                  const std::string& wanted, std::size_t heldBytes) {
  try {
    if (detail::isExr(bytes)) return detail::decodeExrLayers(bytes, name, wanted);
    if (wanted != "all" && wanted != "main") refuseLayer(name, wanted);
    PictureLayers read;
    PictureLayer& layer = read.layers.emplace_back();
    layer.image = decodeOne(bytes, name, read.skipped, heldBytes);
    layer.image.unfollowed.merge(detail::unfollowedIn(bytes));
    return read;
  } catch (const std::bad_alloc&) {
    throw InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
  }
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
