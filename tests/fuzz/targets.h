#pragma once

// Every function that reads bytes or text from outside, as a function of bytes. Refusing is fine;
// crashing, hanging and any exception other than InputError are not.

#include <cstddef>
#include <span>
#include <string_view>

namespace glint::test {

struct FuzzTarget {
  std::string_view name;
  void (*run)(std::span<const std::byte> bytes);
};

/// gltf, png, jpeg, webp, exr, hdr, pfm, tiff, simple (PPM, PGM, BMP, TGA), look, material, light,
/// list and costs.
std::span<const FuzzTarget> fuzzTargets();

}  // namespace glint::test
