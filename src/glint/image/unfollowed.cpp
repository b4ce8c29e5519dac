#include <algorithm>
#include <cstdio>
#include <string_view>

#include "glint/image/decoders.h"

namespace glint::detail {
namespace {

using Bytes = std::span<const std::byte>;
using Facts = std::map<std::string, std::string>;

std::uint32_t number(Bytes bytes, std::size_t at, int size, bool little = false) {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i) {
    const std::size_t from = at + std::size_t(little ? size - 1 - i : i);
    value = value << 8 | std::uint32_t(from < bytes.size() ? bytes[from] : std::byte(0));
  }
  return value;
}

std::string_view textOf(Bytes bytes, std::size_t at, std::size_t size) {
  at = std::min(at, bytes.size());
  return {reinterpret_cast<const char*>(bytes.data()) + at, std::min(size, bytes.size() - at)};
}

/// A profile's own name is in its "desc" tag; those of sRGB profiles all contain the word.
bool isSrgbProfile(std::string_view profile) {
  return profile.find("sRGB") != std::string_view::npos ||
         profile.find(std::string_view("s\0R\0G\0B", 7)) != std::string_view::npos;
}

void addOrientation(Bytes exif, Facts& facts) {
  const int orientation = exifOrientation(exif);
  if (orientation != 1) facts["EXIF orientation"] = std::to_string(orientation);
}

void addProfile(std::string_view name, std::string_view profile, Facts& facts) {
  if (!isSrgbProfile(profile)) facts["ICC profile"] = std::string(name);
}

/// Reads a PNG's chunks before its pixels (PNG, third edition, section 11.3).
Facts ofPng(Bytes bytes) {
  Facts facts;
  bool isSrgb = false;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t size = number(bytes, at, 4), data = at + 8;
    const std::string_view kind = textOf(bytes, at + 4, 4);
    if (kind == "IDAT" || size > bytes.size()) break;
    const auto value = [&](std::size_t i) { return number(bytes, data + 4 * i, 4); };
    if (kind == "sRGB") isSrgb = true;
    if (kind == "gAMA" && (value(0) < 45000 || value(0) > 46000)) {
      char text[32];
      std::snprintf(text, sizeof text, "%.5g", value(0) / 1e5);
      facts["gAMA"] = text;
    }
    if (kind == "cHRM") {
      constexpr std::uint32_t srgb[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
      for (std::size_t i = 0; i < 8; ++i)
        if (value(i) + 200 < srgb[i] || value(i) > srgb[i] + 200) facts["cHRM"] = "other primaries";
    }
    if (kind == "cICP") {
      std::string codes;
      for (std::size_t i = 0; i < 4; ++i)
        codes += (i ? "/" : "") + std::to_string(number(bytes, data + i, 1));
      if (codes != "1/13/0/1") facts["cICP"] = codes;
    }
    if (kind == "iCCP") {
      // The profile is compressed; its name comes first, uncompressed.
      const std::string_view name = textOf(bytes, data, size).substr(0, 79);
      const std::string word(name.substr(0, name.find('\0')));
      addProfile(word, word, facts);
    }
    if (kind == "eXIf")
      addOrientation(bytes.subspan(data, std::min(size, bytes.size() - data)), facts);
    at = data + size + 4;
  }
  // The sRGB chunk overrides all other colour information except cICP.
  if (isSrgb)
    for (const char* name : {"gAMA", "cHRM", "ICC profile"}) facts.erase(name);
  return facts;
}

/// Reads a JPEG's segments before its first scan.
Facts ofJpeg(Bytes bytes) {
  Facts facts;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    const std::uint32_t marker = number(bytes, at, 2);
    if (marker == 0xffff) {
      ++at;
      continue;
    }
    const std::size_t size = number(bytes, at + 2, 2), data = at + 4;
    if (marker < 0xffc0 || marker == 0xffda || size < 2) break;
    const std::string_view text = textOf(bytes, data, size - 2);
    if (marker == 0xffe1 && text.starts_with(std::string_view("Exif\0\0", 6)))
      addOrientation(Bytes(reinterpret_cast<const std::byte*>(text.data()) + 6, text.size() - 6),
                     facts);
    if (marker == 0xffe2 && text.starts_with("ICC_PROFILE")) addProfile("", text, facts);
    at += 2 + size;
  }
  return facts;
}

/// Reads a WebP's chunks.
Facts ofWebp(Bytes bytes) {
  Facts facts;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string_view kind = textOf(bytes, at, 4);
    const std::size_t size = number(bytes, at + 4, 4, true);
    const std::string_view data = textOf(bytes, at + 8, size);
    if (kind == "ICCP") addProfile("", data, facts);
    if (kind == "EXIF")
      addOrientation(Bytes(reinterpret_cast<const std::byte*>(data.data()), data.size()), facts);
    at += 8 + size + (size & 1);
  }
  return facts;
}

}  // namespace

int exifOrientation(Bytes exif) {
  const std::string_view order = textOf(exif, 0, 2);
  if (order != "II" && order != "MM") return 1;
  const bool little = order == "II";
  const std::size_t directory = number(exif, 4, 4, little);
  const std::uint32_t count = number(exif, directory, 2, little);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + std::size_t(12) * i;
    if (entry + 12 > exif.size()) break;
    if (number(exif, entry, 2, little) == 0x112) {
      const int value = int(number(exif, entry + 8, 2, little));
      return value >= 1 && value <= 8 ? value : 1;
    }
  }
  return 1;
}

Facts unfollowedIn(Bytes bytes) {
  if (isPng(bytes)) return ofPng(bytes);
  if (isJpeg(bytes)) return ofJpeg(bytes);
  if (isWebp(bytes)) return ofWebp(bytes);
  return {};
}

}  // namespace glint::detail
