#pragma once

#include <ImfHeader.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace glint::detail {

/// The most bytes that one byte of the file can expand to.
std::uint64_t largestExpansion(Imf::Compression);

/// The string attributes, except for the part's own name and type.
std::map<std::string, std::string> textOf(const Imf::Header&);

/// Whether the header names primaries or a white point other than sRGB's.
bool hasOtherPrimaries(const Imf::Header&);
std::string primariesText(const Imf::Header&);

/// The library allocates up to two gigabytes for an attribute before it finds that the file ends:
/// returns false if an attribute claims to be longer than the rest of the file.
bool attributesFit(std::span<const std::byte> bytes);

}  // namespace glint::detail
