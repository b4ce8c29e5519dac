#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "glint/image/texture.h"
#include "glint/scene/look.h"
#include "glint/scene/material_parameters.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// A texture of a material, as the panel shows it.
struct MaterialTexture {
  std::string name, drives;              ///< "base colour"; "multiplies color"
  int image = 0;                         ///< index into the scene's images
  unsigned gives = 0;                    ///< parameters that it gives instead of numbers, as bits
  unsigned replaced = 0;                 ///< those of them for which the look has numbers
  const SwitchedTexture* own = nullptr;  ///< set if it gives no parameters: switched by its name
  bool isOff = false;
};

/// The textures of a material, under a look.
std::vector<MaterialTexture> materialTextures(const Scene&, const Look&, int material);

/// Switches a texture off or on: one that gives parameters by setting numbers in their place (see
/// MaterialTexture::gives), any other by its name.
void switchTexture(Look&, const Scene&, int material, const MaterialTexture&, bool on);

/// A small picture of at most `side` pixels a side, RGBA, opaque; each pixel is the mean of a few
/// texels.
struct Thumbnail {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};
Thumbnail thumbnailOf(const ByteImage&, int side);

}  // namespace glint::viewer
