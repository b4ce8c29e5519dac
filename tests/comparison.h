#pragma once

// A GL picture compared with the reference: coverage, the whole error, and its parts.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "glint/gltf/scene_file.h"
#include "glint/image/srgb.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "stage.h"

namespace glint::test {

inline constexpr Shading allPrograms[] = {Shading::flat, Shading::gouraud, Shading::phong,
                                          Shading::blinnPhong, Shading::environment};

struct Model {
  Scene scene;
  Bounds bounds;
  DecodedImages images;
};

inline Model modelOf(Scene scene, const Look& look) {
  Model model{std::move(scene), {}, {}};
  model.bounds = boundsOf(model.scene);
  model.images = decodeImages(model.scene, look);
  return model;
}

/// A model of this project.
inline Scene shippedScene(const std::string& name) {
  return loadGltf(GLINT_SOURCE_DIR "/models/" + name + ".glb");
}

inline Look lookWith(Shading shading, int size) {
  Look look;
  look.shading = shading;
  look.resolution = {size, size};
  look.antiAliasing.mode = AntiAliasing::Mode::none;
  look.noBackground = true;
  return look;
}

inline Image attributeImage(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look,
                            PixelOutput output) {
  for (DrawItem& item : list.items) item.variant = attributeVariant(item.variant, output);
  return renderer.draw(scene, std::move(list), look);
}

inline bool perPixel(Shading s) { return s != Shading::flat && s != Shading::gouraud; }

/// Counts and largest differences between a GL picture and the reference.
struct Comparison {
  int covered = 0;          ///< in both
  int coverage = 0;         ///< pixels covered in only one of the two
  int nearEdge = 0;         ///< covered in both, within 1/256 of an edge of the triangle
  int otherSurface = 0;     ///< GL shows another one: an edge in front, or depths equal in float
  int interior = 0;         ///< the rest, with neighbours covered in both
  int overBound = 0;        ///< interior ones with a whole error above wholeBound
  double coverageEdge = 0;  ///< farthest from an edge in the reference, among `coverage`
  double whole = 0, shading = 0, interpolation = 0, position = 0, normal = 0, filtering = 0;
  int worstX = 0, worstY = 0;
  int levels = 0;        ///< largest difference of interior pixels in codes of the encoded picture
  int unequal = 0;       ///< interior pixels whose codes differ
  bool blended = false;  ///< some surfaces are, for which the reference has no attributes
  double alpha = 0;      ///< the largest exponent of the lobe
};

/// The largest whole error allowed at an interior pixel without textures: normals interpolated to a
/// few ulps, magnified by a lobe whose steepest slope grows like the root of alpha.
inline double wholeBound(const Comparison& c) { return 1e-5 + 4e-6 * std::sqrt(c.alpha); }

/// The largest error that shading may add to its inputs.
inline double shadingBound(const Comparison& c, const Look& look) {
  double bound = 1e-6 + 4e-7 * std::sqrt(c.alpha);
  // The textbook's power of a dot product loses digits in proportion to the exponent
  // (docs/science.md 2.5): at most alpha times the rounding of the dot product, 8 * 2^-24.
  if (look.highlight == Highlight::pow) bound += 8 * 6e-8 * c.alpha;
  // The other forms are at most twice as steep as the exponential (Lyon's with gamma = 1), and a
  // power p by squaring costs 3 p / 2 roundings.
  if (look.highlight.brightest.form >= Highlight::integer)
    bound += 6e-7 * std::sqrt(c.alpha) + 1.5 * 6e-8 * std::max(look.highlight.brightest.gamma, 100);
  // glint/shading/environment_map.h gives 6.5e-6 for single precision on unit directions.
  if (look.shading == Shading::environment) bound += 1e-5;
  return bound;
}

using Places = std::set<std::pair<int, int>>;

/// Leaves out pixels in `nearEdge`, and those of opaque surfaces that are near an edge.
inline Comparison compare(Renderer& renderer, Model& model, const Look& look,
                          const Places& nearEdge = {}) {
  ReferenceRenderer reference(model.scene, model.images, model.bounds, look);
  const int width = look.resolution.x, height = look.resolution.y;
  const Image truth = reference.draw();
  auto attributes = reference.attributes(0, height);
  GpuScene scene(model.scene, model.images);
  const DrawList list = makeDrawList(model.scene, model.bounds, look);
  const Image drawn = renderer.draw(scene, list, look);
  const bool split = perPixel(look.shading);
  // Position, normal and colours of each pixel, which only per-pixel programs give. They depend on
  // no program, form or light; if they did, shading computed from them would differ, below.
  const Look phong = geometryLook(look);
  Scene bare = model.scene;  // flat and gouraud ignore normal maps
  if (!split)
    for (Material& m : bare.materials) m.normalTexture.reset();
  const DrawList geometry = makeDrawList(bare, model.bounds, phong);
  GpuScene phongScene(bare, decodeImages(bare, phong));
  const auto output = [&](PixelOutput o) {
    return attributeImage(renderer, phongScene, geometry, phong, o);
  };
  const Image colors = output(PixelOutput::color), emission = output(PixelOutput::emission);
  const Image positions = output(PixelOutput::position), normals = output(PixelOutput::normal);

  Comparison c;
  for (const DrawItem& item : list.items)
    c.alpha = std::max(c.alpha, double(item.materialBlock.exponent));
  const auto at = [&](int x, int y) -> reference::Attributes& {
    return attributes[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  };
  const auto both = [&](int x, int y) {
    return truth.row(y)[4 * x + 3] > 0 && drawn.row(y)[4 * x + 3] > 0;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const reference::Attributes& a = at(x, y);
      const bool covered = truth.row(y)[4 * x + 3] > 0;
      if (covered != (drawn.row(y)[4 * x + 3] > 0)) {
        ++c.coverage;
        if (a.item >= 0) c.coverageEdge = std::max(c.coverageEdge, a.edgeDistance);
        continue;
      }
      if (!covered) continue;
      ++c.covered;
      const bool blended = a.item < 0;
      if ((!blended && a.edgeDistance < 1.0 / 256) || nearEdge.contains({x, y})) {
        ++c.nearEdge;
        continue;
      }
      bool inner = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
      for (int i = 0; inner && i < 9; ++i) inner = both(x - 1 + i % 3, y - 1 + i / 3);
      if (!inner) continue;
      const glm::dvec3 place(pixel(positions, x, y)), turn(pixel(normals, x, y));
      const bool other =
          blended ? std::abs(drawn.row(y)[4 * x + 3] - truth.row(y)[4 * x + 3]) > 1e-5
                  : largest(place - a.position) > 1e-4 || largest(turn - a.normal) > 1e-2;
      if (other) {
        ++c.otherSurface;
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
      c.overBound += whole > wholeBound(c);
      int levels = 0;
      for (int i = 0; i < 3; ++i)
        levels = std::max(levels, std::abs(encodeSrgb8(drawn.row(y)[4 * x + i]) -
                                           encodeSrgb8(truth.row(y)[4 * x + i])));
      c.levels = std::max(c.levels, levels);
      c.unequal += levels > 0;
      c.blended = c.blended || blended;
      if (blended) continue;
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

/// Properties of blended layers, whose attributes cannot be separated, taken from the same surfaces
/// drawn opaque, the near and the far ones: where their edges are close to a pixel's centre, and
/// the largest interpolation error, because the layers' weights at a pixel add up to at most 1.
struct Layers {
  Places nearEdge;
  double interpolation = 0;
};

inline Layers layersOf(Renderer& renderer, Model model, const Look& look) {
  Layers layers;
  const int width = look.resolution.x;
  for (const bool far : {false, true}) {
    for (Material& m : model.scene.materials) {
      m.alphaMode = AlphaMode::opaque;
      m.doubleSided = false;
    }
    for (Mesh& mesh : model.scene.meshes) {
      if (!far) break;
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
      for (glm::vec3& n : mesh.normals) n = -n;
    }
    layers.interpolation =
        std::max(layers.interpolation, compare(renderer, model, look).interpolation);
    ReferenceRenderer reference(model.scene, model.images, model.bounds, look);
    int i = 0;
    for (const reference::Attributes& a : reference.attributes(0, look.resolution.y)) {
      if (a.item >= 0 && a.edgeDistance < 1.0 / 256) layers.nearEdge.insert({i % width, i / width});
      ++i;
    }
  }
  return layers;
}

inline void printHeading() {
  std::printf("%-24s %-12s %7s %5s %8s %6s %5s %5s %6s %7s %9s %9s %9s %9s %9s %9s %9s\n", "model",
              "program", "covered", "one", "fromEdge", "edge", "other", "over", "levels", "unequal",
              "whole", "bound", "shading", "interpol.", "position", "normal", "filtering");
}

inline void print(const std::string& name, Shading shading, const Comparison& c, double bound) {
  std::printf(
      "%-24s %-12s %7d %5d %8.1e %6d %5d %5d %6d %7d %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e  "
      "%d,%d\n",
      name.c_str(), std::string(shadingName(shading)).c_str(), c.covered, c.coverage,
      c.coverageEdge, c.nearEdge, c.otherSurface, c.overBound, c.levels, c.unequal, c.whole, bound,
      c.shading, c.interpolation, c.position, c.normal, c.filtering, c.worstX, c.worstY);
}

/// For pictures without textures.
inline void expectAccurate(const std::string& what, const Look& look, const Comparison& c) {
  SCOPED_TRACE(what + " " + std::string(shadingName(look.shading)));
  EXPECT_GT(c.interior, 500);
  // The driver snaps vertices to 1/256 of a pixel; a few pixel centres are that close.
  EXPECT_LE(c.coverage, 3);
  EXPECT_LT(c.coverageEdge, 1.0 / 256);
  EXPECT_LE(c.shading, shadingBound(c, look));
  // A few pixels of slivers, whose normals change much from pixel to pixel: there the whole error
  // is the driver's rounding of interpolated normals, as the split shows.
  EXPECT_LE(c.overBound, 5 + c.interior / 2000);
  EXPECT_LE(c.whole, 10 * wholeBound(c));
  // Errors this small change a code only if a threshold lies between the two values.
  EXPECT_LE(c.levels, 1);
  EXPECT_LE(c.unequal, c.interior / 200);
  if (perPixel(look.shading)) {
    EXPECT_LE(c.whole, wholeBound(c) + 1.2 * c.interpolation);
  }
}

class AgainstReference : public OnStage {};

}  // namespace glint::test
