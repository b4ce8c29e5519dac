#pragma once

#include <ImfHeader.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace glint::detail {

/// How many bytes one of the file can become, at most.
std::uint64_t largestExpansion(Imf::Compression);

/// The attributes that are texts, without the part's own name and type.
std::map<std::string, std::string> textOf(const Imf::Header&);

/// Whether colours are said to be of other primaries or another white than sRGB's.
bool hasOtherPrimaries(const Imf::Header&);
std::string primariesText(const Imf::Header&);

/// The library makes room for an attribute of two gigabytes before it finds that the file ends:
/// false where one is said to be longer than what is left.
bool attributesFit(std::span<const std::byte> bytes);

}  // namespace glint::detail
