#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <span>

#include "glint/image/texture.h"
#include "glint/scene/scene.h"

namespace glint::reference {

/// A texture sampled by GL's rules (OpenGL 3.3, section 3.8) in double. Texels are decoded from
/// sRGB one by one, before filtering; alpha is linear. The level of detail is log2 of the longest
/// of the footprint's steps, in texels of the full size. Above 0 the texture is minified, whatever
/// the filters (GL 3.3 moves the switch to 0.5 for some of them; this does not).
///
/// The smaller levels are those of the picture's definition (glint/image/mipmaps.h), rounded to 8
/// bits as the driver gets them, so that this rounding is part of the texture, not an error of
/// filtering. Without them the full size is used for every level.
class TextureSampler {
 public:
  /// The pixels must outlive it. An empty picture samples as white.
  /// `isData`: texels are numbers, not sRGB.
  TextureSampler(const ByteImage& base, std::span<const ByteImage> smaller, const Sampler&,
                 bool isData = false);

  /// Linear RGB and alpha at `at`, which changes by `steps` between neighbouring pixels.
  glm::dvec4 sample(const glm::dvec2& at, std::initializer_list<glm::dvec2> steps) const;

  /// The same with the level of detail given.
  glm::dvec4 sampleLevel(const glm::dvec2& at, double levelOfDetail) const;

 private:
  glm::dvec4 fetch(const ByteImage& level, double x, double y) const;
  glm::dvec4 filter(int level, Filter, const glm::dvec2& at) const;
  const ByteImage& level(int i) const;

  const ByteImage* base_;
  std::span<const ByteImage> smaller_;
  Sampler sampler_;
  bool isData_ = false;
};

}  // namespace glint::reference
