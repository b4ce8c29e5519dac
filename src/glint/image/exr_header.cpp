#include "glint/image/exr_header.h"

#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace glint::detail {

std::uint64_t largestExpansion(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
      return 1;
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
      return 1032 * 64;  // one deflated coefficient per block of 8 x 8
    default:
      return 1032;  // deflate's; the others expand less
  }
}

std::map<std::string, std::string> textOf(const Imf::Header& header) {
  std::map<std::string, std::string> all;
  for (auto i = header.begin(); i != header.end(); ++i) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
    if (text && std::strcmp(i.name(), "name") != 0 && std::strcmp(i.name(), "type") != 0)
      all[i.name()] = text->value();
  }
  return all;
}

bool hasOtherPrimaries(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return false;
  const Imf::Chromaticities c = Imf::chromaticities(header), srgb;
  const auto far = [](const Imath::V2f& a, const Imath::V2f& b) {
    return (a - b).length() > 2e-3f;
  };
  return far(c.red, srgb.red) || far(c.green, srgb.green) || far(c.blue, srgb.blue) ||
         far(c.white, srgb.white);
}

std::string primariesText(const Imf::Header& header) {
  const Imf::Chromaticities c = Imf::chromaticities(header);
  char text[160];
  std::snprintf(text, sizeof text, "red %.4g,%.4g green %.4g,%.4g blue %.4g,%.4g white %.4g,%.4g",
                double(c.red.x), double(c.red.y), double(c.green.x), double(c.green.y),
                double(c.blue.x), double(c.blue.y), double(c.white.x), double(c.white.y));
  return text;
}

bool attributesFit(std::span<const std::byte> bytes) {
  std::size_t at = 8;  // magic and version
  const bool hasParts = bytes.size() > 5 && (bytes[5] & std::byte(0x10)) != std::byte(0);
  const auto endOfText = [&] {
    while (at < bytes.size() && bytes[at] != std::byte(0)) ++at;
    return ++at <= bytes.size();
  };
  for (std::size_t header = at; at < bytes.size();) {
    if (bytes[at] == std::byte(0)) {  // end of a header; after several, an empty one
      if (!hasParts || at == header) return true;
      header = ++at;
      continue;
    }
    if (!endOfText() || !endOfText() || bytes.size() - at < 4) return false;
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size |= std::uint32_t(bytes[at + i]) << (8 * i);
    at += 4;
    if (size > bytes.size() - at) return false;
    at += size;
  }
  return false;
}

}  // namespace glint::detail
