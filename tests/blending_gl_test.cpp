// Blending: `over` at every sample, nearest surface last, within a mesh, between meshes and where
// surfaces intersect; and surfaces that are not blended though their material asks for it.

#include <gtest/gtest.h>

#include "formulas.h"
#include "glint/reference/renderer.h"
#include "glint/render/draw_list.h"
#include "random.h"
#include "stage.h"
#include "textures.h"

namespace glint::test {
namespace blending_gl_test {

class Blending : public OnStage {};

Material pane(const glm::dvec3& color, double alpha) {
  Material m;
  m.unlit = true;
  m.shading.color = color;
  m.alpha = alpha;
  m.alphaMode = AlphaMode::blend;
  return m;
}

/// One mesh of unlit quads with these vertex colours, whose heights are linear functions of x.
Mesh quadsOf(const std::vector<glm::vec4>& colors, const std::vector<glm::vec2>& heights) {
  Mesh mesh;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const auto first = std::uint32_t(mesh.positions.size());
    const float left = heights[i].x, right = heights[i].y;
    for (const glm::vec3 p : {glm::vec3(-2, -2, left), glm::vec3(2, -2, right),
                              glm::vec3(2, 2, right), glm::vec3(-2, 2, left)}) {
      mesh.positions.push_back(p);
      mesh.normals.emplace_back(0, 0, 1);
      mesh.colors.push_back(colors[i]);
    }
    for (const std::uint32_t k : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + k);
  }
  return mesh;
}

glm::dvec3 over(const glm::vec4& color, const glm::dvec3& below) {
  return double(color.a) * glm::dvec3(color) + (1 - double(color.a)) * below;
}

std::vector<AntiAliasing> kinds() {
  return {
      {AntiAliasing::Mode::none, 1}, {AntiAliasing::Mode::msaa, 4}, {AntiAliasing::Mode::ssaa, 2}};
}

// Binary fractions, so that every sum is exact; nearest first in the list of triangles.
TEST_P(Blending, PanesOfOneMeshLieOverOneAnother) {
  const std::vector<glm::vec4> colors = {{0, 0, 1, 0.5f}, {0, 1, 0, 0.5f}, {1, 0, 0, 0.5f}};
  const Scene scene =
      sceneOf(quadsOf(colors, {{0.5f, 0.5f}, {0, 0}, {-0.5f, -0.5f}}), pane(glm::dvec3(1), 1));
  for (const AntiAliasing& kind : kinds()) {
    Look look = parallelLook();
    look.antiAliasing = kind;
    look.backgroundColor = glm::dvec3(0.5);
    glm::dvec3 expected(0.5);
    for (auto color = colors.rbegin(); color != colors.rend(); ++color)
      expected = over(*color, expected);
    const Image image = draw(scene, look);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) EXPECT_EQ(color(image, x, y), expected) << x << "," << y;
  }
}

// Beyond a few layers, the rest is drawn in a fixed order, if there is a correct one: for panes in
// any order in their list there is; with two intersecting ones in front of all there never is.
TEST_P(Blending, ManyPanesLieOverOneAnother) {
  for (const bool cutting : {false, true}) {
    std::vector<glm::vec4> colors;
    std::vector<glm::vec2> heights;
    std::vector<std::size_t> order;  // back to front
    constexpr std::size_t count = 40;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t level = (i * 17) % count;
      const float z = -1 + 0.04f * float(level);
      heights.emplace_back(z, z);
      colors.emplace_back(float(level % 3) / 2, float(level % 4) / 4, float(level % 5) / 4, 0.25f);
    }
    for (std::size_t level = 0; level < count; ++level)
      for (std::size_t i = 0; i < count; ++i)
        if ((i * 17) % count == level) order.push_back(i);
    if (cutting) {
      for (const float slope : {0.3f, -0.3f}) {
        order.push_back(heights.size());
        heights.emplace_back(1 - slope, 1 + slope);
        colors.emplace_back(slope > 0 ? 1 : 0, 0, slope > 0 ? 0 : 1, 0.5f);
      }
    }
    const Scene scene = sceneOf(quadsOf(colors, heights), pane(glm::dvec3(1), 1));
    for (const AntiAliasing& kind : kinds()) {
      Look look = parallelLook();
      look.antiAliasing = kind;
      const Image image = draw(scene, look);
      for (int x = 0; x < 8; ++x) {
        auto here = order;
        if (cutting && x >= 4) std::swap(here[count], here[count + 1]);
        glm::dvec3 expected(0);
        for (const std::size_t i : here) expected = over(colors[i], expected);
        // About 42 sums of floats, each within 2^-24 of numbers below 1.
        expectColor(color(image, x, 3), expected, 42 * std::exp2(-24.0));
      }
    }
  }
}

// Two panes that intersect in the middle column: on either side another one is in front.
TEST_P(Blending, PanesThatCutEachOtherChangeTheirOrderThere) {
  const glm::vec4 red(1, 0, 0, 0.5f), blue(0, 0, 1, 0.25f);
  const Scene scene =
      sceneOf(quadsOf({red, blue}, {{-0.5f, 0.5f}, {0.5f, -0.5f}}), pane(glm::dvec3(1), 1));
  for (const AntiAliasing& kind : kinds()) {
    Look look = parallelLook();
    look.antiAliasing = kind;
    const Image image = draw(scene, look);
    for (int x = 0; x < 8; ++x) {
      const bool redFront = x >= 4;
      const glm::dvec3 expected =
          redFront ? over(red, over(blue, glm::dvec3(0))) : over(blue, over(red, glm::dvec3(0)));
      EXPECT_EQ(color(image, x, 3), expected) << x;
    }
  }
}

// Random triangles in one mesh, and opaque ones in another, compared with the reference, which
// sorts every sample. A driver snaps corners, so samples at edges differ; few do.
TEST_P(Blending, AgreesWithTheReferenceOnAHeapOfTriangles) {
  Random random(7);
  Mesh heap, walls;
  for (int i = 0; i < 60; ++i) {
    Mesh& mesh = i < 50 ? heap : walls;
    const glm::vec4 own(random.unit(), random.unit(), random.unit(), 0.2 + 0.6 * random.unit());
    for (int k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(2 * random.unit() - 1, 2 * random.unit() - 1,
                                  2 * random.unit() - 1);
      mesh.normals.emplace_back(0, 0, 1);
      mesh.colors.push_back(own);
      mesh.indices.push_back(std::uint32_t(mesh.indices.size()));
    }
  }
  Scene scene = sceneOf(heap, pane(glm::dvec3(1), 1));
  scene.materials[0].doubleSided = true;
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].alphaMode = AlphaMode::opaque;
  walls.material = 1;
  scene.meshes.push_back(walls);
  scene.instances.push_back({1, glm::dmat4(1)});
  Look look = parallelLook({0.3, 0.2, 1}, 128);
  look.cameraOrthographic = false;
  look.cameraViewAngle = 40;
  look.backgroundColor = {0.1, 0.2, 0.3};
  for (const int samples : {1, 2}) {
    look.antiAliasing = {samples > 1 ? AntiAliasing::Mode::ssaa : AntiAliasing::Mode::none,
                         samples};
    const Image drawn = draw(scene, look);
    ReferenceRenderer reference(scene, {}, boundsOf(scene), look);
    const Image truth = reference.draw();
    int off = 0;
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x) {
        const glm::dvec3 d = glm::abs(color(drawn, x, y) - color(truth, x, y));
        off += std::max({d.x, d.y, d.z}) > 1e-5;
      }
    EXPECT_LE(off, 8 * samples);  // of 16,384; 60 triangles have some 6,000 samples at edges
  }
}

// Opaque surfaces with alpha mode BLEND are drawn as opaque ones, by the same programs.
TEST_P(Blending, AnAlphaOfOneIsOpaque) {
  for (const Shading shading : {Shading::flat, Shading::phong, Shading::environment}) {
    Look look = parallelLook({0.2, 0.3, 1}, 32);
    look.shading = shading;
    look.light = {directional({0.3, 0.4, 1})};
    Scene scene = sceneOf(sphere(16, 8), materialOf(1, 0.8, 0.5, 20));
    scene.materials[0].doubleSided = true;
    const Image opaque = draw(scene, look);
    scene.materials[0].alphaMode = AlphaMode::blend;
    const Image blend = draw(scene, look);
    EXPECT_EQ(opaque.values, blend.values);
    scene.materials[0].alphaMode = AlphaMode::opaque;
    const Bounds bounds = boundsOf(scene);
    Scene says = scene;
    says.materials[0].alphaMode = AlphaMode::blend;
    EXPECT_EQ(makeDrawList(says, bounds, look).items[0].variant,
              makeDrawList(scene, bounds, look).items[0].variant);
  }
}

// The texture's left half is opaque, its right half is not; it depends on which half is used.
TEST_P(Blending, TexelsThatAreUsedDecide) {
  const auto half = png(8, 4, [](int x, int) { return glm::ivec4(200, 100, 50, x < 4 ? 255 : 0); });
  for (const bool nearest : {true, false})
    for (const double from : {0.0, 0.5}) {
      Mesh mesh = quad();
      // Up to the border of the last opaque texel, whose neighbour a linear filter would read.
      const float u0 = float(from), u1 = float(from + (nearest ? 0.5 : 0.4375));
      mesh.texcoords = {{{u0, 0}, {u1, 0}, {u1, 1}, {u0, 1}}};
      Material m = pane(glm::dvec3(1), 1);
      m.colorTexture = Texture{};
      m.colorTexture->sampler.wrapS = m.colorTexture->sampler.wrapT = Wrap::clampToEdge;
      m.colorTexture->sampler.mip = MipFilter::none;
      if (nearest)
        m.colorTexture->sampler.magnify = m.colorTexture->sampler.minify = Filter::nearest;
      Scene scene = sceneOf(mesh, m);
      scene.images.push_back({"half", half, false});
      const Look look = parallelLook();
      decodeImages(scene, look);
      const bool blended = makeDrawList(scene, boundsOf(scene), look).items[0].blended;
      EXPECT_EQ(blended, from > 0) << nearest << " " << from;
    }
}

// A mask that cuts at just the alpha of an opaque vertex colour leaves no holes, though
// perspective weights of vertices do not sum to exactly 1.
TEST_P(Blending, AMaskAtTheAlphaOfOpaqueVerticesKeepsEveryPixel) {
  Mesh mesh = sphere(12, 8);
  mesh.colors.assign(mesh.positions.size(), glm::vec4(1));
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) mesh.colors[i].g = float(i % 3) / 2;
  for (const double alpha : {0.5, 1.0})
    for (const AntiAliasing& kind : kinds()) {
      Scene scene = sceneOf(mesh, pane(glm::dvec3(1), alpha));
      Look look;
      look.resolution = {64, 64};
      look.antiAliasing = kind;
      const auto both = [&](AlphaMode mode) {
        scene.materials[0].alphaMode = mode;
        const Bounds bounds = boundsOf(scene);
        ReferenceRenderer reference(scene, {}, bounds, look);
        return std::array{draw(scene, look), reference.draw()};
      };
      scene.materials[0].alphaCutoff = alpha;
      const auto whole = both(AlphaMode::opaque), kept = both(AlphaMode::mask);
      scene.materials[0].alphaCutoff = std::nextafter(float(alpha), 2.f);
      const auto none = both(AlphaMode::mask);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(kept[i].values, whole[i].values) << alpha << " " << i;
        EXPECT_GT(pixel(whole[i], 32, 32).g, pixel(none[i], 32, 32).g);
        EXPECT_EQ(glm::vec3(pixel(none[i], 32, 32)), glm::vec3(look.backgroundColor));
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Software, Blending, softwareBackends(), nameOfBackend);

}  // namespace blending_gl_test
}  // namespace glint::test
