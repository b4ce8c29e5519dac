#include "glint/render/gloss_picture.h"

#include <algorithm>
#include <cmath>

#include "glint/image/srgb.h"

namespace glint {
namespace {

glm::dvec4 texelAt(const ByteImage& image, int x, int y) {
  const std::uint8_t* t =
      &image.values[std::size_t(4) * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
  return {decodeSrgb8(t[0]), decodeSrgb8(t[1]), decodeSrgb8(t[2]), t[3] / 255.0};
}

// Bilinear at (x, y) in [0, 1], measured from the corner of the first texel.
glm::dvec4 valueAt(const ByteImage& image, double x, double y) {
  const auto corner = [](double at, int size, double& share) {
    const double place = std::clamp(at * size - 0.5, 0.0, size - 1.0);
    share = place - std::floor(place);
    return int(place);
  };
  double u = 0, v = 0;
  const int left = corner(x, image.width, u), top = corner(y, image.height, v);
  const int right = std::min(left + 1, image.width - 1), low = std::min(top + 1, image.height - 1);
  return glm::mix(glm::mix(texelAt(image, left, top), texelAt(image, right, top), u),
                  glm::mix(texelAt(image, left, low), texelAt(image, right, low), u), v);
}

std::uint8_t codeOf(double value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

void convertGlossPicture(ByteImage& picture, const ByteImage* other, const GlossPicture& made) {
  const bool sameSize = other && other->width == picture.width && other->height == picture.height;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::dvec4 own = texelAt(picture, x, y);
      glm::dvec4 beside(1);
      if (sameSize)
        beside = texelAt(*other, x, y);
      else if (other)
        beside = valueAt(*other, (x + 0.5) / picture.width, (y + 0.5) / picture.height);
      // Without a diffuse picture, the colours come from the specular-glossiness picture.
      const bool ownIsDiffuse = made.isColor && other;
      const glm::dvec4 diffuse = ownIsDiffuse ? own : made.isColor ? glm::dvec4(1) : beside;
      const glm::dvec4 gloss = ownIsDiffuse ? beside : own;
      SpecularGlossiness texel = made.factors;
      texel.diffuse *= glm::dvec3(diffuse);
      texel.specular *= glm::dvec3(gloss);
      texel.glossiness *= gloss.a;
      const MetalShare share = metalShare(texel);
      std::uint8_t* to =
          &picture.values[std::size_t(4) *
                          (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
      if (made.isColor) {
        const glm::dvec3 color =
            texel.diffuse + (glm::min(texel.specular, 1.0) - texel.diffuse) * share.metallic;
        for (int i = 0; i < 3; ++i) to[i] = encodeSrgb8(float(color[i]));
        to[3] = codeOf(diffuse.a);
      } else {
        to[1] = codeOf(1 - texel.glossiness);
        to[2] = codeOf(share.metallic);
        to[3] = codeOf(share.reflectance);
      }
    }
}

}  // namespace glint
