#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "glint/image/texture.h"
#include "glint/scene/look.h"
#include "glint/scene/material_parameters.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// A texture of a material, as the panel describes it.
struct MaterialTexture {
  std::string name, drives;  ///< "base colour"; "multiplies color"
  int image = 0;             ///< of the scene
  unsigned gives = 0;        ///< parameters that it gives in place of numbers: bits of textured
  unsigned replaced = 0;     ///< those of them that the look has numbers for
  const SwitchedTexture* own = nullptr;  ///< it gives none, and is switched by its name
  bool isOff = false;
};

/// Those of a material of the scene's, under a look.
std::vector<MaterialTexture> materialTextures(const Scene&, const Look&, int material);

/// Switches a texture off or on again: what it gives by numbers that stand for it, see
/// MaterialTexture::gives, the others by their names.
void switchTexture(Look&, const Scene&, int material, const MaterialTexture&, bool on);

/// A picture of at most `side` pixels a side, RGBA, opaque; each pixel a mean of some texels.
struct Thumbnail {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};
Thumbnail thumbnailOf(const ByteImage&, int side);

}  // namespace glint::viewer
