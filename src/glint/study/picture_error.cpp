#include "glint/study/picture_error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "glint/image/flip.h"
#include "glint/image/srgb.h"
#include "glint/image/task.h"
#include "glint/reference/renderer.h"
#include "glint/study/statistics.h"
#include "glint/study/study.h"
#include "glint/study/variants.h"

namespace glint {
namespace {

/// The rows computed at a time: attributes take a few hundred bytes a pixel.
constexpr int bandRows = 64;

double largestSize(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

glm::vec4 valueAt(const Image& image, std::size_t pixel) {
  const float* p = image.values.data() + 4 * pixel;
  return {p[0], p[1], p[2], p[3]};
}

Image attributeImage(Renderer& renderer, GpuScene& gpu, DrawList list, const Look& look,
                     PixelOutput output) {
  for (DrawItem& item : list.items) item.variant = attributeVariant(item.variant, output);
  return renderer.draw(gpu, std::move(list), look);
}

/// Calls use(a pixel's index in the mask, its attributes) for the pixels of the mask, in parallel.
template <class Use>
void forAttributes(const ReferenceRenderer& reference, const Look& look, const StudyMask& mask,
                   const Use& use) {
  const std::size_t width = std::size_t(look.resolution.x);
  std::size_t begin = 0;
  for (int y0 = 0; y0 < look.resolution.y && begin < mask.pixels.size(); y0 += bandRows) {
    const int rows = std::min(bandRows, look.resolution.y - y0);
    const std::size_t first = width * std::size_t(y0), end = first + width * std::size_t(rows);
    std::size_t count = 0;
    while (begin + count < mask.pixels.size() && mask.pixels[begin + count] < end) ++count;
    if (count == 0) continue;
    const auto attributes = reference.attributes(y0, rows);
    constexpr std::size_t piece = 4096;
    inParallel(0, (count + piece - 1) / piece, [&](std::size_t n, int) {
      for (std::size_t i = n * piece; i < std::min(count, (n + 1) * piece); ++i)
        use(begin + i, attributes[mask.pixels[begin + i] - first]);
    });
    begin += count;
  }
}

bool hasNormalMap(const ReferenceRenderer& reference, const reference::Attributes& a) {
  return reference.stage().items[std::size_t(a.item)].normalTexture.has_value();
}

void takeSamples(reference::Attributes& a, const ReferenceRenderer& reference,
                 const DriverInput& input, const StudyMask& mask) {
  // A mapped normal depends on the driver's filtering: the driver's is taken, interpolation
  // included.
  if (hasNormalMap(reference, a)) a.normal = glm::dvec3(input.normal);
  if (!mask.sampledColors) return;
  a.base = glm::dvec4(input.base);
  a.emission = glm::dvec3(input.emission);
}

}  // namespace

StudyMask maskOf(Renderer& renderer, GpuScene& gpu, const StudyScene& scene, const Look& given) {
  const Look look = exactLook(given, Shading::phong);
  const ReferenceRenderer reference(scene.scene, scene.images, scene.bounds, look);
  const DrawList list = makeDrawList(scene.scene, scene.bounds, look);
  StudyMask mask;
  for (const DrawItem& item : list.items)
    mask.sampledColors |= item.variant.colorTexture || item.variant.emissionTexture;
  const Image drawn = renderer.draw(gpu, list, look);
  const auto output = [&](PixelOutput o) { return attributeImage(renderer, gpu, list, look, o); };
  const Image positions = output(PixelOutput::position), normals = output(PixelOutput::normal);
  Image colors, emissions;
  if (mask.sampledColors) {
    colors = output(PixelOutput::color);
    emissions = output(PixelOutput::emission);
  }

  const int width = look.resolution.x, height = look.resolution.y;
  const auto covers = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height &&
           drawn.values[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) + 3] > 0;
  };
  for (int y0 = 0; y0 < height; y0 += bandRows) {
    const int rows = std::min(bandRows, height - y0);
    const auto attributes = reference.attributes(y0, rows);
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const std::size_t pixel = std::size_t(y0) * std::size_t(width) + i;
      const int x = int(pixel % std::size_t(width)), y = int(pixel / std::size_t(width));
      const reference::Attributes& a = attributes[i];
      const bool covered = covers(x, y);
      if (!covered && a.item < 0) continue;
      ++mask.covered;
      if (covered != (a.item >= 0)) {
        // Where the reference has no surface, the driver may show a blended one.
        if (a.item >= 0) {
          ++mask.onlyOne;
          mask.onlyOneEdge = std::max(mask.onlyOneEdge, a.edgeDistance);
        } else {
          ++mask.other;
        }
        continue;
      }
      bool inner = a.edgeDistance >= 1.0 / 256;
      for (int k = 0; inner && k < 9; ++k) inner = covers(x - 1 + k % 3, y - 1 + k / 3);
      if (!inner) {
        ++mask.edge;
        continue;
      }
      DriverInput input;
      input.position = glm::vec3(valueAt(positions, pixel));
      const glm::vec4 normal = valueAt(normals, pixel);
      input.normal = glm::vec3(normal);
      input.front = normal.w > 0;
      const bool sameNormal =
          hasNormalMap(reference, a) || largestSize(glm::dvec3(input.normal) - a.normal) <= 1e-2;
      if (!(largestSize(glm::dvec3(input.position) - a.position) <= 1e-4 && sameNormal)) {
        ++mask.other;
        continue;
      }
      if (mask.sampledColors) {
        input.base = valueAt(colors, pixel);
        input.emission = glm::vec3(valueAt(emissions, pixel));
      }
      mask.pixels.push_back(std::uint32_t(pixel));
      mask.inputs.push_back(input);
    }
  }
  return mask;
}

Radiances truthOf(const StudyScene& scene, const Look& given, Shading program,
                  const StudyMask& mask, bool atInputs) {
  const Look look = exactLook(given, program);
  const ReferenceRenderer reference(scene.scene, scene.images, scene.bounds, look);
  Radiances truth(mask.pixels.size());
  forAttributes(reference, look, mask, [&](std::size_t i, reference::Attributes a) {
    const DriverInput& input = mask.inputs[i];
    takeSamples(a, reference, input, mask);
    if (atInputs) {
      a.position = glm::dvec3(input.position);
      a.normal = glm::dvec3(input.normal);
      a.front = input.front;
    }
    truth[i] = reference.shade(a).radiance;
  });
  return truth;
}

Radiances radiancesOf(const Image& picture, const StudyMask& mask) {
  Radiances values(mask.pixels.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = glm::dvec3(valueAt(picture, mask.pixels[i]));
  return values;
}

PictureError errorOf(const Radiances& truth, const Radiances& drawn, double exposureScale) {
  PictureError error;
  if (truth.empty()) return error;
  std::vector<double> worst(truth.size());
  double squares = 0, truthSquares = 0;
  std::size_t off = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    int levels = 0;
    for (int c = 0; c < 3; ++c) {
      double d = std::abs(drawn[i][c] - truth[i][c]);
      if (std::isnan(d)) d = std::numeric_limits<double>::infinity();
      worst[i] = std::max(worst[i], d);
      squares += d * d;
      truthSquares += truth[i][c] * truth[i][c];
      levels = std::max(levels, std::abs(encodeSrgb8(float(drawn[i][c] * exposureScale)) -
                                         encodeSrgb8(float(truth[i][c] * exposureScale))));
    }
    error.max = std::max(error.max, worst[i]);
    error.levels = std::max(error.levels, levels);
    off += levels > 1;
  }
  const double count = double(truth.size());
  error.percentile999 = quantile(std::move(worst), 0.999);
  error.rmse = std::sqrt(squares / (3 * count));
  if (truthSquares > 0) error.relativeRmse = std::sqrt(squares / truthSquares);
  error.offByMore = double(off) / count;
  return error;
}

Image overBackground(const Image& picture, const glm::dvec3& background, const StudyMask& mask,
                     const Radiances* at) {
  Image image{picture.width, picture.height, picture.values};
  for (std::size_t i = 0; i < image.values.size(); i += 4) {
    const float rest = 1 - image.values[i + 3];
    for (std::size_t c = 0; c < 3; ++c)
      image.values[i + c] += rest * float(background[glm::length_t(c)]);
    image.values[i + 3] = 1;
  }
  if (at)
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        image.values[4 * std::size_t(mask.pixels[i]) + c] = float((*at)[i][glm::length_t(c)]);
  return image;
}

double flipOf(const Image& picture, const StudyMask& mask, const Radiances& truth,
              const glm::dvec3& background, double exposureScale) {
  const Image test = overBackground(picture, background, mask);
  const Image reference = overBackground(picture, background, mask, &truth);
  const int width = picture.width;
  const auto rows = [&](const Image& of) {
    return PixelRows{width, of.height, [&of, exposureScale](int first, int count, float* out) {
                       const float* from = of.row(first);
                       for (int i = 0; i < 4 * of.width * count; ++i)
                         out[i] = i % 4 == 3 ? from[i] : from[i] * float(exposureScale);
                     }};
  };
  std::vector<unsigned char> counts(std::size_t(width) * std::size_t(picture.height));
  for (const std::uint32_t pixel : mask.pixels) counts[pixel] = 1;
  return flip(rows(reference), rows(test), {}, {},
              [&](int y, unsigned char* row) {
                std::memcpy(row, counts.data() + std::size_t(y) * std::size_t(width),
                            std::size_t(width));
              })
      .mean;
}

const std::vector<std::string>& errorMetrics() {
  static const std::vector<std::string> names{"rmse", "max", "p999", "relative-rmse", "flip"};
  return names;
}

double metricOf(const VariantError& e, const std::string& metric) {
  if (metric == "max") return e.whole.max;
  if (metric == "p999") return e.whole.percentile999;
  if (metric == "relative-rmse") return e.whole.relativeRmse;
  if (metric == "flip") return e.flip;
  return e.whole.rmse;
}

const VariantError* errorAgainst(const VariantResult& variant, Shading model) {
  for (const VariantError& error : variant.errors)
    if (error.against == model) return &error;
  return nullptr;
}

}  // namespace glint
