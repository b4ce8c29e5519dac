#include "glint/study/page_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "glint/image/flip.h"
#include "glint/image/png_bytes.h"
#include "glint/image/srgb.h"

namespace glint {
namespace {

/// Larger pictures are made smaller by a whole factor.
constexpr int mostPixels = 400;

int shrinking(const Image& image) {
  return (std::max(image.width, image.height) + mostPixels - 1) / mostPixels;
}

/// Calls use(index in the small picture, the pixels of the block that it covers).
template <class Use>
void forBlocks(const Image& image, int factor, const Use& use) {
  const int width = (image.width + factor - 1) / factor;
  const int height = (image.height + factor - 1) / factor;
  std::vector<std::size_t> block;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      block.clear();
      for (int v = y * factor; v < std::min(image.height, (y + 1) * factor); ++v)
        for (int u = x * factor; u < std::min(image.width, (x + 1) * factor); ++u)
          block.push_back(std::size_t(v) * std::size_t(image.width) + std::size_t(u));
      use(std::size_t(y) * std::size_t(width) + std::size_t(x), block);
    }
}

/// Decades of the error map: from 1e-7, rounding, to 1.
constexpr double decades = 7;
constexpr int shades = 64;

}  // namespace

std::vector<std::byte> pagePng(const Image& opaque, double exposure) {
  const int factor = shrinking(opaque);
  const int width = (opaque.width + factor - 1) / factor;
  const int height = (opaque.height + factor - 1) / factor;
  std::vector<std::uint8_t> rgb(std::size_t(3) * std::size_t(width) * std::size_t(height));
  forBlocks(opaque, factor, [&](std::size_t at, const std::vector<std::size_t>& block) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (const std::size_t pixel : block) sum += double(opaque.values[4 * pixel + c]);
      rgb[3 * at + c] = encodeSrgb8(float(exposure * sum / double(block.size())));
    }
  });
  return pngOfRgb(rgb, width, height);
}

std::vector<std::byte> pageErrorPng(const Image& picture, const StudyMask& mask,
                                    const Radiances& truth) {
  std::vector<float> errors(picture.values.size() / 4, -1.0f);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    const float* p = picture.values.data() + 4 * std::size_t(mask.pixels[i]);
    double worst = 0;
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double(p[c]) - truth[i][c]));
    errors[mask.pixels[i]] = std::isnan(worst) ? 1.0f : float(worst);
  }
  std::vector<std::array<std::uint8_t, 3>> palette(shades + 1);
  for (int i = 0; i < shades; ++i) magma(float(i) / (shades - 1), palette[std::size_t(i)].data());
  palette[shades] = {96, 96, 96};
  const int factor = shrinking(picture);
  const int width = (picture.width + factor - 1) / factor;
  const int height = (picture.height + factor - 1) / factor;
  std::vector<std::uint8_t> indices(std::size_t(width) * std::size_t(height));
  forBlocks(picture, factor, [&](std::size_t at, const std::vector<std::size_t>& block) {
    float worst = -1;
    for (const std::size_t pixel : block) worst = std::max(worst, errors[pixel]);
    const double share = 1 + std::log10(std::max(double(worst), 1e-9)) / decades;
    indices[at] = worst < 0 ? std::uint8_t(shades)
                            : std::uint8_t(std::lround(std::clamp(share, 0.0, 1.0) * (shades - 1)));
  });
  return pngOfIndices(indices, width, height, palette);
}

}  // namespace glint
