// The GL pictures against the double-precision reference: coverage, the whole error, and its parts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "glint/gl/context.h"
#include "glint/render/reference_renderer.h"
#include "glint/render/renderer.h"
#include "glint/scene/gltf.h"
#include "glint/scene/parameters.h"

namespace glint {
namespace {

constexpr Shading allPrograms[] = {Shading::flat, Shading::gouraud, Shading::phong,
                                   Shading::blinnPhong, Shading::environment};

struct Model {
  Scene scene;
  Bounds bounds;
  DecodedImages images;
  bool textured = false;
};

Model modelAt(const std::string& path, const Look& look) {
  Model model;
  model.scene = loadGltf(path);
  model.bounds = boundsOf(model.scene);
  model.images = decodeImages(model.scene, look);
  model.textured = !model.images.empty();
  return model;
}

Look lookWith(Shading shading, int size) {
  Look look;
  look.shading = shading;
  look.resolution = {size, size};
  look.antiAliasing.mode = AntiAliasing::Mode::none;
  look.noBackground = true;
  return look;
}

Image drawWith(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look) {
  auto picture = renderer.begin(scene, std::move(list), look);
  Image image{look.resolution.x, look.resolution.y, {}}, band;
  for (int i = 0; i < picture.bandCount(); ++i) {
    picture.drawBand(band);
    image.values.insert(image.values.end(), band.values.begin(), band.values.end());
  }
  return image;
}

Image attributeImage(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look,
                     PixelOutput output) {
  for (DrawItem& item : list.items) item.variant = attributeVariant(item.variant, output);
  return drawWith(renderer, scene, std::move(list), look);
}

glm::dvec4 pixel(const Image& image, int x, int y) {
  const float* p = image.row(y) + 4 * x;
  return {p[0], p[1], p[2], p[3]};
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

bool perPixel(Shading s) { return s != Shading::flat && s != Shading::gouraud; }

/// Counts and largest differences between a GL picture and the reference.
struct Comparison {
  int covered = 0;       ///< in both
  int coverage = 0;      ///< pixels that one of them covers and the other does not
  int nearEdge = 0;      ///< covered in both, within 1/256 of an edge of the triangle
  int otherSurface = 0;  ///< GL shows another: an edge in front, or depths that float cannot tell
  int interior = 0;      ///< the rest, with a neighbourhood covered in both
  double coverageEdge = 0;  ///< the farthest from an edge that the reference sees of `coverage`
  double whole = 0, shading = 0, interpolation = 0, position = 0, normal = 0, filtering = 0;
  int worstX = 0, worstY = 0;
  double alpha = 0;  ///< the largest exponent of the lobe
};

Comparison compare(Renderer& renderer, Model& model, const Look& look) {
  ReferenceRenderer reference(model.scene, model.images, model.bounds, look);
  const int width = look.resolution.x, height = look.resolution.y;
  const Image truth = reference.draw();
  auto attributes = reference.attributes(0, height);
  GpuScene scene(model.scene, model.images);
  const DrawList list = makeDrawList(model.scene, model.bounds, look);
  const Image drawn = drawWith(renderer, scene, list, look);
  const auto output = [&](PixelOutput o) { return attributeImage(renderer, scene, list, look, o); };
  const bool split = perPixel(look.shading);
  const Image colors = output(PixelOutput::color), emission = output(PixelOutput::emission);
  // Which programs have no part in: where a pixel lies and how it is turned.
  Look phong = look;
  phong.shading = Shading::phong;
  const DrawList geometry = makeDrawList(model.scene, model.bounds, phong);
  const Image positions = attributeImage(renderer, scene, geometry, phong, PixelOutput::position);
  const Image normals = attributeImage(renderer, scene, geometry, phong, PixelOutput::normal);

  Comparison c;
  for (const DrawItem& item : list.items)
    c.alpha = std::max(c.alpha, double(item.materialBlock.strength.w));
  const auto at = [&](int x, int y) -> reference::Attributes& {
    return attributes[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  };
  const auto both = [&](int x, int y) {
    return truth.row(y)[4 * x + 3] > 0 && drawn.row(y)[4 * x + 3] > 0;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const reference::Attributes& a = at(x, y);
      const bool covered = a.item >= 0;
      if (covered != (drawn.row(y)[4 * x + 3] > 0)) {
        ++c.coverage;
        if (covered) c.coverageEdge = std::max(c.coverageEdge, a.edgeDistance);
        continue;
      }
      if (!covered) continue;
      ++c.covered;
      if (a.edgeDistance < 1.0 / 256) {
        ++c.nearEdge;
        continue;
      }
      bool inner = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
      for (int i = 0; inner && i < 9; ++i) inner = both(x - 1 + i % 3, y - 1 + i / 3);
      if (!inner) continue;
      const glm::dvec3 place(pixel(positions, x, y)), turn(pixel(normals, x, y));
      if (largest(place - a.position) > 1e-4 || largest(turn - a.normal) > 1e-2) {
        ++c.otherSurface;
        if (std::getenv("GLINT_SHOW"))
          std::printf("%d,%d item %d edge %g position %g normal %g\n", x, y, a.item, a.edgeDistance,
                      largest(place - a.position), largest(turn - a.normal));
        continue;
      }
      ++c.interior;
      const glm::dvec3 gl(pixel(drawn, x, y));
      const double whole = largest(gl - glm::dvec3(pixel(truth, x, y)));
      if (whole > c.whole) {
        c.whole = whole;
        c.worstX = x;
        c.worstY = y;
      }
      c.filtering =
          std::max(c.filtering, largest(glm::dvec3(pixel(colors, x, y)) - glm::dvec3(a.base)));
      c.filtering = std::max(c.filtering, largest(glm::dvec3(pixel(emission, x, y)) - a.emission));
      if (!split) continue;
      reference::Attributes fromGl = a;
      fromGl.position = place;
      fromGl.normal = turn;
      fromGl.front = pixel(normals, x, y).w > 0;
      c.position = std::max(c.position, largest(fromGl.position - a.position));
      c.normal = std::max(c.normal, largest(fromGl.normal - a.normal));
      const glm::dvec3 interpolated = reference.shade(fromGl).radiance;
      c.interpolation =
          std::max(c.interpolation, largest(interpolated - reference.shade(a).radiance));
      fromGl.base = pixel(colors, x, y);
      fromGl.emission = glm::dvec3(pixel(emission, x, y));
      c.shading = std::max(c.shading, largest(gl - reference.shade(fromGl).radiance));
    }
  return c;
}

void printHeading() {
  std::printf("%-24s %-12s %7s %5s %8s %6s %5s %9s %9s %9s %9s %9s %9s %9s\n", "model", "program",
              "covered", "one", "fromEdge", "edge", "other", "whole", "bound", "shading",
              "interpol.", "position", "normal", "filtering");
}

void print(const std::string& name, Shading shading, const Comparison& c, double bound) {
  std::printf(
      "%-24s %-12s %7d %5d %8.1e %6d %5d %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e  %d,%d\n",
      name.c_str(), std::string(shadingName(shading)).c_str(), c.covered, c.coverage,
      c.coverageEdge, c.nearEdge, c.otherSurface, c.whole, bound, c.shading, c.interpolation,
      c.position, c.normal, c.filtering, c.worstX, c.worstY);
}

class AgainstReference : public testing::TestWithParam<Backend> {};

TEST_P(AgainstReference, ShippedModels) {
  const auto context = openContext(GetParam());
  context->makeCurrent();
  Renderer renderer;
  std::vector<std::string> models;
  for (const char* name : {"sphere.glb", "torus.glb", "teapot.glb"})
    models.push_back(std::string(GLINT_SOURCE_DIR "/models/") + name);
  if (const char* more = std::getenv("GLINT_REFERENCE_MODELS"))
    for (const auto& entry : std::filesystem::directory_iterator(more))
      if (entry.path().extension() == ".glb") models.push_back(entry.path());
  printHeading();
  for (const std::string& path : models)
    for (Shading shading : allPrograms) {
      Look look = lookWith(shading, 256);
      if (const char* size = std::getenv("GLINT_REFERENCE_SIZE"))
        look.resolution = glm::ivec2(std::atoi(size));
      Model model = modelAt(path, look);
      const Comparison c = compare(renderer, model, look);
      const double bound = 1e-5 + 4e-6 * std::sqrt(c.alpha);
      const std::string name = std::filesystem::path(path).filename();
      print(name, shading, c, bound);
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, AgainstReference,
                         testing::Values(Backend::osmesa, Backend::eglSoftware), [](const auto& p) {
                           return p.param == Backend::osmesa ? "osmesa" : "egl_software";
                         });

}  // namespace
}  // namespace glint
