// The terms of a picture: they add up to it, they equal those of the reference, and normal and
// depth are those of known surfaces.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "glint/reference/renderer.h"
#include "glint/reference/terms.h"
#include "glint/scene/look_text.h"
#include "stage.h"
#include "variants.h"

namespace glint::test::picture_terms_gl_test {

class Terms : public OnStage {
 protected:
  std::vector<std::pair<PictureTerm, Image>> terms(const Scene& scene, const Look& look) {
    const Bounds bounds = boundsOf(scene);
    GpuScene gpu(scene, {});
    std::vector<std::pair<PictureTerm, Image>> all;
    for (const PictureTerm& term : termsOf(makeDrawList(scene, bounds, look), look))
      all.emplace_back(term, drawTerm(stage().renderer(), gpu, bounds, look, term));
    return all;
  }
};

// A glossy, slightly emissive sphere, an unlit one, a glass one, and a blended one in front.
Scene everything() {
  Scene scene;
  scene.name = "everything";
  scene.meshes.assign(4, sphere(24, 16));
  for (int i = 0; i < 4; ++i) scene.meshes[std::size_t(i)].material = i;
  scene.materials.assign(5, materialOf(0.9, 0.8, 0.7, 12, 0.3, {0.8, 0.5, 0.3}));
  scene.materials[0].emission = {0.05, 0.02, 0.1};
  scene.materials[1].unlit = true;
  scene.materials[2].shading.transmission = 0.6;
  scene.materials[3].alphaMode = glint::AlphaMode::blend;
  scene.materials[3].alpha = 0.4;
  scene.materials[3].doubleSided = true;
  scene.instances = {{0, translation({0, 0, 0})},
                     {1, translation({1.5, 0.6, -0.5})},
                     {2, translation({-1.5, -0.4, 0.3})},
                     {3, translation({0.4, -0.3, 2}) * scaling({0.7, 0.5, 0.6})}};
  return scene;
}

Look threeLights(Shading shading) {
  Look look;
  look.shading = shading;
  look.resolution = {64, 48};
  look.ambientLight = {0.2, 0.25, 0.3};
  Light point = directional({}, {0.2, 0.9, 0.4});
  point.type = Light::Type::point;
  point.position = {1, 2, 3};
  Light spot = directional({-1, -1, -3}, {0.7, 0.7, 0.1});
  spot.type = Light::Type::spot;
  spot.position = {1, 1, 4};
  spot.innerAngle = 5;
  spot.outerAngle = 40;
  look.light = {spot, directional({1, 1, 1}, {0.8, 0.7, 0.6}), point};
  look.highlight = glint::Highlight::gaussian;  // for the point light, which is the brightest
  look.highlight.add(glint::Highlight::exact, 1);
  look.highlight.add({glint::Highlight::lyon, 64}, 2);  // for the spot
  return look;
}

std::string names(const std::vector<std::pair<PictureTerm, Image>>& terms) {
  std::string text;
  for (const auto& [term, image] : terms) text += term.name + " ";
  return text;
}

TEST_P(Terms, OfLightAddUpToThePicture) {
  const Scene scene = everything();
  for (const Shading shading : everyShading)
    for (const auto mode : {AntiAliasing::Mode::none, AntiAliasing::Mode::msaa})
      for (const bool transparent : {false, true}) {
        Look look = threeLights(shading);
        look.antiAliasing = {mode, 4};
        look.noBackground = transparent;
        const Image picture = draw(scene, look);
        const auto all = terms(scene, look);
        std::vector<double> sum(picture.values.size());
        for (const auto& [term, image] : all) {
          ASSERT_EQ(image.values.size(), sum.size());
          if (!term.isLight()) continue;
          for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(image.values[i]);
        }
        SCOPED_TRACE(testing::Message()
                     << shadingName(shading) << " " << int(mode) << " " << names(all));
        // Some 12 terms, each with a few roundings of values up to 4, in addition to the picture's
        // own roundings.
        double worst = 0;
        for (std::size_t i = 0; i < sum.size(); ++i)
          if (i % 4 != 3) worst = std::max(worst, std::abs(sum[i] - double(picture.values[i])));
        EXPECT_LE(worst, 16 * 4 * 4 * std::exp2(-24));
        // Each has the picture's coverage.
        for (const auto& [term, image] : all)
          if (term.kind == PictureTerm::Kind::ambient && transparent) {
            for (std::size_t i = 3; i < sum.size(); i += 4)
              ASSERT_EQ(image.values[i], picture.values[i]);
          }
      }
}

TEST_P(Terms, AreThoseOfTheReference) {
  const Scene scene = everything();
  for (const Shading shading : everyShading) {
    Look look = threeLights(shading);
    look.antiAliasing = {AntiAliasing::Mode::none, 1};
    for (const auto& [term, image] : terms(scene, look)) {
      const Image truth = drawReferenceTerm(scene, {}, boundsOf(scene), look, term);
      ASSERT_EQ(truth.values.size(), image.values.size());
      // Except for pixels at edges, which may belong to another surface, and the steps of flat
      // shading there. The sphere's normals in the layers of flat and gouraud are interpolated.
      int other = 0, seen = 0;
      for (std::size_t i = 0; i < image.values.size(); ++i) {
        if (i % 4 == 3) continue;
        const bool same = image.values[i] == truth.values[i] ||
                          std::abs(image.values[i] - truth.values[i]) <=
                              1e-3f * std::max(1.0f, std::abs(truth.values[i]));
        other += !same;
        seen += truth.values[i] != truth.values[i % 4];
      }
      EXPECT_LE(other, 40) << shadingName(shading) << " " << term.name;
      if (term.kind != PictureTerm::Kind::background && term.name != "refraction") {
        EXPECT_GT(seen, 100) << shadingName(shading) << " " << term.name;
      }
    }
  }
}

TEST_P(Terms, NormalAndDepthAreThoseOfASphere) {
  const Scene scene = sceneOf(sphere(96, 64), materialOf(1, 1, 1, 10));
  for (const bool orthographic : {false, true}) {
    Look look;
    look.resolution = {60, 40};
    look.cameraOrthographic = orthographic;
    const glint::Camera camera = cameraFor(scene, boundsOf(scene), look);
    const auto all = terms(scene, look);
    const Image& normals = all[all.size() - 3].second;
    const Image& depths = all[all.size() - 2].second;
    ASSERT_EQ(all[all.size() - 2].first.name, "depth");
    int hits = 0;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) {
        const float* const n = normals.row(y) + 4 * x;
        const double depth = depths.row(y)[4 * x];
        if (depths.row(y)[4 * x + 3] == 0) {
          EXPECT_TRUE(std::isinf(depth));
          EXPECT_EQ(n[0], 0);
          continue;
        }
        ++hits;
        // Back along the ray through the pixel's centre.
        const double across = ((x + 0.5) / 60 * 2 - 1) * camera.halfHeight * camera.aspect;
        const double up = (1 - (y + 0.5) / 40 * 2) * camera.halfHeight;
        const double reach = orthographic ? 1 : depth;
        const glm::dvec3 point =
            camera.eye + camera.axes * glm::dvec3(across * reach, up * reach, -depth);
        const glm::dvec3 normal(n[0], n[1], n[2]);
        // The faces lie up to 1 - cos(pi / 64) = 1.2e-3 inside the sphere; the error of an
        // interpolated normal is only a fraction of that.
        EXPECT_NEAR(glm::length(point), 1, 1.3e-3);
        EXPECT_NEAR(glm::length(normal), 1, 1e-6);
        EXPECT_LE(glm::length(normal - glm::normalize(point)), 3e-3);
      }
    EXPECT_GT(hits, 600);
  }
}

// Every pixel has the whole numbers of one opaque draw, or -1, even if the picture has several
// samples; they equal the reference's except at edges.
TEST_P(Terms, IdsAreThoseOfOneSurface) {
  Scene scene = everything();
  scene.materials[0].alphaMode = glint::AlphaMode::mask;
  scene.meshes[1].fileMesh = 7;
  scene.objects.assign(9, {});
  scene.instances[0].object = 8;
  Look look = threeLights(Shading::phong);
  look.antiAliasing = {AntiAliasing::Mode::msaa, 4};
  const auto all = terms(scene, look);
  ASSERT_EQ(all.back().first.name, "id");
  const Image& ids = all.back().second;
  const Image truth = drawReferenceTerm(scene, {}, boundsOf(scene), look, all.back().first);
  std::map<std::array<float, 3>, int> seen;
  int other = 0;
  for (std::size_t i = 0; i < ids.values.size(); i += 4) {
    const float* const p = ids.values.data() + i;
    ++seen[{p[0], p[1], p[2]}];
    EXPECT_EQ(p[3], p[0] >= 0 ? 1 : 0);
    other += !std::equal(p, p + 4, truth.values.data() + i);
  }
  EXPECT_LE(other, 10);
  // The blended one in front is ignored.
  using Ids = std::array<float, 3>;
  ASSERT_EQ(seen.size(), 4u);
  for (const Ids& expected : {Ids{-1, -1, -1}, Ids{8, 0, 0}, Ids{1, 7, 1}, Ids{2, 2, 2}})
    EXPECT_GT(seen[expected], 100) << expected[0];
}

TEST_P(Terms, AreListedByTheLook) {
  const Scene scene = everything();
  Look look = threeLights(Shading::environment);
  EXPECT_EQ(names(terms(scene, look)),
            "ambient diffuse-0 specular-0 diffuse-1 specular-1 diffuse-2 specular-2 reflection "
            "refraction emission background normal depth id ");
  look.shading = Shading::flat;
  look.noLights = true;
  look.noBackground = true;
  EXPECT_EQ(names(terms(scene, look)), "ambient emission normal depth id ");
}

INSTANTIATE_TEST_SUITE_P(Render, Terms, testing::Values(glint::Backend::osmesa), nameOfBackend);

}  // namespace glint::test::picture_terms_gl_test
