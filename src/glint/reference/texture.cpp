#include "glint/reference/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "glint/image/srgb.h"

namespace glint::reference {
namespace {

// A texel's index along one side; `i` is whole but may be far outside, hence double.
int wrapped(double i, int size, Wrap wrap) {
  const double n = size;
  switch (wrap) {
    case Wrap::repeat:
      i -= n * std::floor(i / n);
      break;
    case Wrap::mirroredRepeat:
      i -= 2 * n * std::floor(i / (2 * n));
      if (i >= n) i = 2 * n - 1 - i;
      break;
    case Wrap::clampToEdge:
      break;
  }
  return int(std::clamp(i, 0.0, n - 1));
}

}  // namespace

TextureSampler::TextureSampler(const ByteImage& base, std::span<const ByteImage> smaller,
                               const Sampler& sampler, bool isData)
    : base_(&base), smaller_(smaller), sampler_(sampler), isData_(isData) {}

const ByteImage& TextureSampler::level(int i) const {
  return i == 0 ? *base_ : smaller_[std::size_t(i - 1)];
}

glm::dvec4 TextureSampler::fetch(const ByteImage& image, double x, double y) const {
  const int column = wrapped(x, image.width, sampler_.wrapS);
  const int row = wrapped(y, image.height, sampler_.wrapT);
  const std::uint8_t* t = &image.values[std::size_t(4) * (std::size_t(row) * image.width + column)];
  if (isData_) return glm::dvec4(t[0], t[1], t[2], t[3]) / 255.0;
  return {decodeSrgb8(t[0]), decodeSrgb8(t[1]), decodeSrgb8(t[2]), t[3] / 255.0};
}

glm::dvec4 TextureSampler::filter(int number, Filter filter, const glm::dvec2& at) const {
  const ByteImage& image = level(number);
  const double u = at.x * image.width, v = at.y * image.height;
  if (filter == Filter::nearest) return fetch(image, std::floor(u), std::floor(v));
  const double x = std::floor(u - 0.5), y = std::floor(v - 0.5);
  const double a = u - 0.5 - x, b = v - 0.5 - y;
  return (1 - b) * ((1 - a) * fetch(image, x, y) + a * fetch(image, x + 1, y)) +
         b * ((1 - a) * fetch(image, x, y + 1) + a * fetch(image, x + 1, y + 1));
}

glm::dvec4 TextureSampler::sampleLevel(const glm::dvec2& at, double levelOfDetail) const {
  if (base_->width <= 0 || base_->height <= 0) return glm::dvec4(1.0);
  // Coordinates so far out have no fraction left, and their product with a size may overflow.
  constexpr double farthest = 1e300;
  if (!(std::abs(at.x) <= farthest && std::abs(at.y) <= farthest))
    return sampleLevel(glm::dvec2(0.0), 0);
  if (!(levelOfDetail > 0)) return filter(0, sampler_.magnify, at);
  const int last = int(smaller_.size());
  const double lod = std::min(levelOfDetail, double(last));
  switch (sampler_.mip) {
    case MipFilter::none:
      return filter(0, sampler_.minify, at);
    case MipFilter::nearest:
      return filter(std::max(int(std::ceil(lod + 0.5)) - 1, 0), sampler_.minify, at);
    case MipFilter::linear: {
      const int lower = int(std::floor(lod));
      const double share = lod - lower;
      const glm::dvec4 fine = filter(lower, sampler_.minify, at);
      if (share == 0) return fine;
      return (1 - share) * fine + share * filter(lower + 1, sampler_.minify, at);
    }
  }
  return glm::dvec4(1.0);
}

glm::dvec4 TextureSampler::sample(const glm::dvec2& at,
                                  std::initializer_list<glm::dvec2> steps) const {
  const glm::dvec2 size(base_->width, base_->height);
  double square = 0;
  for (const glm::dvec2& step : steps)
    square = std::max(square, glm::dot(step * size, step * size));
  return sampleLevel(at, square > 0 ? 0.5 * std::log2(square) : -1.0);
}

}  // namespace glint::reference
