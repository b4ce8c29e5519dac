#include "glint/image/picture_format.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "glint/image/decoders.h"

namespace glint {
namespace {

using Id = PictureFormat::Id;

#if GLINT_WEBP
constexpr bool writesWebp = true;
#else
constexpr bool writesWebp = false;
#endif

//       name    endings             written     float  alpha  text   needs a file
constexpr PictureFormat formats[] = {
    {Id::png, "PNG", {".png"}, true, false, true, true, false},
    {Id::jpeg, "JPEG", {".jpg", ".jpeg"}, true, false, false, false, false},
    {Id::webp, "WebP", {".webp"}, writesWebp, false, true, false, false},
    {Id::exr, "OpenEXR", {".exr"}, true, true, true, true, true},
    {Id::pfm, "PFM", {".pfm"}, true, true, false, false, true},
    {Id::raw, "raw", {}, true, true, true, false, false},
    {Id::hdr, "Radiance HDR", {".hdr"}, false, true, false, false, false},
    {Id::tiff, "TIFF", {".tif", ".tiff"}, false, false, true, false, false},
    {Id::pnm, "PPM", {".ppm", ".pgm"}, false, false, false, false, false},
    {Id::bmp, "BMP", {".bmp"}, false, false, false, false, false},
    {Id::tga, "TGA", {".tga"}, false, false, true, false, false},
};

std::string lower(std::string_view text) {
  std::string all(text);
  for (char& letter : all)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return all;
}

}  // namespace

std::span<const PictureFormat> pictureFormats() { return formats; }

const PictureFormat& pictureFormat(PictureFormat::Id id) {
  return *std::ranges::find(formats, id, &PictureFormat::id);
}

const PictureFormat* pictureFormatOf(std::string_view path) {
  const auto dot = path.find_last_of("./");
  if (dot == std::string_view::npos || path[dot] != '.') return nullptr;
  const std::string ending = lower(path.substr(dot));
  for (const PictureFormat& each : formats)
    if (ending == each.endings[0] || ending == each.endings[1]) return &each;
  return nullptr;
}

const PictureFormat* pictureFormatIn(std::span<const std::byte> bytes) {
  using Test = bool (*)(std::span<const std::byte>);
  constexpr std::pair<Test, Id> tests[] = {{detail::isPng, Id::png},   {detail::isJpeg, Id::jpeg},
                                           {detail::isWebp, Id::webp}, {detail::isExr, Id::exr},
                                           {detail::isPfm, Id::pfm},   {detail::isHdr, Id::hdr},
                                           {detail::isTiff, Id::tiff}, {detail::isPnm, Id::pnm},
                                           {detail::isBmp, Id::bmp},   {detail::isTga, Id::tga}};
  for (const auto& [is, id] : tests)
    if (is(bytes)) return &pictureFormat(id);
  return nullptr;
}

const PictureFormat* pictureFormatNamed(std::string_view name) {
  const std::string wanted = lower(name);
  for (const PictureFormat& each : formats)
    if (wanted == lower(each.name)) return &each;
  return pictureFormatOf("." + wanted);
}

std::string writtenEndings() {
  std::string text;
  const PictureFormat* last = nullptr;
  const auto add = [&](const PictureFormat* each, const char* before) {
    text += (text.empty() ? "" : before) + std::string(each->endings[0]);
  };
  for (const PictureFormat& each : formats) {
    if (!each.isWritten || each.endings[0].empty()) continue;
    if (last) add(last, ", ");
    last = &each;
  }
  add(last, " or ");
  return text;
}

}  // namespace glint
