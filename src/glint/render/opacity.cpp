#include "glint/render/opacity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace glint {
namespace {

// Finds texels that are not opaque in rectangles, with a summed-area table.
class SeeThrough {
 public:
  explicit SeeThrough(const ByteImage& image)
      : width_(std::size_t(image.width)), sums_((width_ + 1) * (std::size_t(image.height) + 1), 0) {
    const std::uint8_t* alpha = image.values.data() + 3;
    for (std::size_t y = 0; y < std::size_t(image.height); ++y) {
      std::uint32_t row = 0;
      for (std::size_t x = 0; x < width_; ++x, alpha += 4) {
        row += *alpha != 255;
        at(x + 1, y + 1) = at(x + 1, y) + row;
      }
    }
  }
  /// Whether there is one in columns [x0, x1] and rows [y0, y1].
  bool any(std::size_t x0, std::size_t x1, std::size_t y0, std::size_t y1) {
    return at(x1 + 1, y1 + 1) + at(x0, y0) != at(x1 + 1, y0) + at(x0, y1 + 1);
  }

 private:
  std::uint32_t& at(std::size_t x, std::size_t y) { return sums_[y * (width_ + 1) + x]; }

  std::size_t width_;
  std::vector<std::uint32_t> sums_;
};

struct Range {
  std::size_t first, last;
};

// The texels along one side that coordinates from `low` to `high` read: one range, or two where the
// picture repeats.
std::vector<Range> texelsRead(double low, double high, int size, Wrap wrap, bool linear) {
  const double n = size, half = linear ? 0.5 : 0.0;
  const std::vector<Range> all{{0, std::size_t(size - 1)}};
  // A pixel lies within its triangle: texels that only the triangle's border touches do not count,
  // and rounding of coordinates (1e-4 of a texel) must not add any.
  const double slack = std::min(1e-4, 0.5 * (high - low) * n);
  double first = std::floor(low * n - half + slack);
  double last = std::max(first, std::floor(high * n - half - slack) + (linear ? 1 : 0));
  if (!std::isfinite(first) || !std::isfinite(last)) return all;
  const auto place = [&](double i) { return std::size_t(std::clamp(i, 0.0, n - 1)); };
  if (wrap == Wrap::clampToEdge) return {{place(first), place(last)}};
  if (last - first + 1 >= n) return all;
  if (wrap == Wrap::mirroredRepeat) {
    const double period = std::floor(first / n);
    if (std::floor(last / n) != period) return all;
    first -= period * n, last -= period * n;
    if (std::fmod(period, 2.0) != 0) return {{place(n - 1 - last), place(n - 1 - first)}};
    return {{place(first), place(last)}};
  }
  const double turn = n * std::floor(first / n);
  first -= turn, last -= turn;
  if (last < n) return {{place(first), place(last)}};
  return {{place(first), place(n - 1)}, {0, place(last - n)}};
}

}  // namespace

bool texelsAreOpaque(const Mesh& mesh, const Texture& texture, const ByteImage& image) {
  if (std::size_t(texture.texcoord) >= mesh.texcoords.size()) return false;
  const auto& places = mesh.texcoords[std::size_t(texture.texcoord)];
  if (places.empty() || image.width < 1 || image.height < 1) return false;
  bool all = true;
  for (std::size_t i = 3; all && i < image.values.size(); i += 4) all = image.values[i] == 255;
  if (all) return true;
  SeeThrough through(image);
  const std::size_t step = mesh.topology == Topology::triangles ? 3
                           : mesh.topology == Topology::lines   ? 2
                                                                : 1;
  const Sampler& s = texture.sampler;
  const bool linear = s.magnify == Filter::linear || s.minify == Filter::linear;
  for (std::size_t i = 0; i + step <= mesh.indices.size(); i += step) {
    glm::dvec2 low(1e300), high(-1e300);
    for (std::size_t k = 0; k < step; ++k) {
      const glm::dvec2 at = texture.transform * glm::dvec3(places[mesh.indices[i + k]], 1);
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    for (const Range& x : texelsRead(low.x, high.x, image.width, s.wrapS, linear))
      for (const Range& y : texelsRead(low.y, high.y, image.height, s.wrapT, linear))
        if (through.any(x.first, x.last, y.first, y.last)) return false;
  }
  return true;
}

bool isBlended(const Mesh& mesh, const Material& material) {
  if (material.alphaMode != AlphaMode::blend) return false;
  if (material.alpha < 1) return true;
  const auto seeThrough = [](const glm::vec4& color) { return !(color.a >= 1); };
  if (std::ranges::any_of(mesh.colors, seeThrough)) return true;
  const auto& texture = material.colorTexture;
  const bool reads = texture && std::size_t(texture->texcoord) < mesh.texcoords.size() &&
                     !mesh.texcoords[std::size_t(texture->texcoord)].empty();
  return reads && !mesh.opaqueTexels;
}

}  // namespace glint
