// Pictures under difficult transforms: mirroring, uneven, singular, tiny and huge scales, large
// distances.

#include <gmock/gmock.h>

#include <vector>

#include "formulas.h"
#include "glint/gltf/scene_file.h"
#include "glint/scene/look_text.h"
#include "gltf_text.h"
#include "stage.h"
#include "variants.h"

namespace glint::test::render_transforms_gl_test {

class Transforms : public OnStage {};

// Without symmetry, with coordinates that are multiples of 1/64.
Mesh pebble() {
  Mesh mesh = sphere(20, 10);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 p(mesh.positions[i]);
    const glm::dvec3 q =
        p * glm::dvec3(1, 0.75, 0.5) + glm::dvec3(0.25 * p.y * p.y, 0.125 * p.x, 0);
    mesh.positions[i] = glm::vec3(glm::round(q * 64.0) / 64.0);
    mesh.normals[i] = glm::vec3(unit(p / glm::dvec3(1, 0.75, 0.5)));
  }
  return mesh;
}

Material paint() { return materialOf(0.5, 0.7, 0.4, 30, 0.5, {0.9, 0.6, 0.3}); }

Look plainLook(Shading shading, int pixels = 64) {
  Look look;
  look.shading = shading;
  look.environment = glint::Environment::white;  // its reflection has no edges
  look.resolution = {pixels, pixels};
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  look.backgroundColor = glm::dvec3(0);
  return look;
}

Image flipped(const Image& image) {
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int i = 0; i < 4; ++i)
        result.row(y)[4 * x + i] = image.row(y)[4 * (image.width - 1 - x) + i];
  return result;
}

// The largest difference allowed between two pictures of the same scene whose vertices were rounded
// differently. Window coordinates are floats of up to 64: a vertex moves by 64 * 2^-24 pixels, the
// three of a triangle and the pixel's own position by four times that. Towards the silhouette
// normals turn by up to 1 radian per pixel, and the light changes with m_d 0.7, a lobe of exponent
// 120 and strength 0.4 with 0.61 sqrt(120) 0.4 = 2.7, and a reflectance that rises by
// 2 (n^2 + 1) / sqrt(n^2 - 1) = 5.8.
double movedTolerance(Shading shading) {
  return 4 * 64 * rounding * (shading == Shading::environment ? 9.2 : 3.4);
}

// The largest difference where both pictures show the model, and the number of pixels where only
// one does.
std::pair<double, int> compared(const Image& a, const Image& b) {
  double most = 0;
  int single = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const glm::dvec3 p = color(a, x, y), q = color(b, x, y);
      const bool inA = p != glm::dvec3(0), inB = q != glm::dvec3(0);
      single += inA != inB;
      if (inA && inB)
        for (int i = 0; i < 3; ++i) most = std::max(most, std::abs(p[i] - q[i]));
    }
  return {most, single};
}

// B2, B3: a mirrored node under a mirrored light gives the mirror image, including front faces.
TEST_P(Transforms, MirroredNodesGiveMirrorImages) {
  for (Shading shading : everyShading)
    for (const glm::dvec3 mirror : {glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1)}) {
      Look look = parallelLook({0, 0, 1}, 64);
      look.shading = shading;
      look.environment = glint::Environment::white;  // the same from both sides
      look.cameraViewAngle = 40;
      look.ambientLight = glm::dvec3(0.25);
      const glm::dvec3 l(0.5, 0.3, 0.8);
      look.light = {directional(l)};
      const glm::dmat4 place = translation({0.1, 0.05, 0}) * rotation(0.5);
      const Image image = draw(sceneOf(pebble(), paint(), place), look);
      look.light = {directional(l * mirror)};
      const Image mirrored = draw(sceneOf(pebble(), paint(), scaling(mirror) * place), look);
      Image expected = flipped(image);
      if (mirror.y < 0) {
        for (int y = 0; y < image.height; ++y)
          std::memcpy(expected.row(y), image.row(image.height - 1 - y),
                      sizeof(float) * 4 * std::size_t(image.width));
      }
      const auto [most, single] = compared(expected, mirrored);
      EXPECT_GT(coveredPixels(image), 500u);
      // The same triangles on a mirrored grid, interpolated from another corner.
      EXPECT_LT(most, movedTolerance(shading)) << glint::shadingName(shading);
      EXPECT_LE(single, 2) << glint::shadingName(shading);
    }
}

// B1, B7: under uneven scales, shear and mirroring, normals stay perpendicular to the surface,
// which is the model's plane z = 0 under any transform.
TEST_P(Transforms, NormalsFollowTheSurfaceUnderUnevenScales) {
  glm::dmat4 shear(1);
  shear[2][0] = 0.8;
  shear[2][1] = -0.3;
  const glm::dmat4 worlds[] = {scaling({1, 1, 10}), rotation(0.7) * scaling({1, 1, 10}),
                               rotation(0.3) * scaling({2, 0.5, 0.1}),
                               rotation(0.5) * shear * scaling({1, 3, 1}),
                               rotation(0.4) * scaling({-1, 2, 0.3})};
  const glm::dvec3 n = unit({0, 1, 1});
  const glm::dvec3 v = unit({0.2, 0.5, 1});
  const glm::dvec3 l = unit({0.4, 0.9, 0.6});
  const SurfaceValues values{0, 0.6, 0.4, 12, 0, glm::dvec3(1)};
  for (const glm::dmat4& world : worlds)
    for (Shading shading : {Shading::gouraud, Shading::phong, Shading::blinnPhong}) {
      Look look = parallelLook(v, 3);
      look.shading = shading;
      look.light = {directional(l)};
      Scene scene = sceneOf(quad(n, 20), materialOf(0, 0.6, 0.4, 12), world);
      scene.materials[0].doubleSided = true;
      // By the inverse transpose in double, turned towards the viewer on the back of the square.
      const glm::dvec3 face = glm::transpose(glm::inverse(glm::dmat3(world))) * glm::dvec3(0, 0, 1);
      const glm::dvec3 normal = unit(glm::transpose(glm::inverse(glm::dmat3(world))) * n) *
                                (glm::dot(face, v) < 0 ? -1.0 : 1.0);
      const Image image = draw(scene, look);
      // The matrix's entries are rounded once and summed; the unevenness is at most 20.
      expectColor(middle(image),
                  shaded(values, glm::dvec3(0), normal, l, v, shading == Shading::blinnPhong),
                  lobeTolerance(48) + 24 * rounding, glint::shadingName(shading).data());
    }
  // The published figure: M n is 78.6 degrees off the correct normal.
  const glm::dmat3 m(scaling({1, 1, 10}));
  const glm::dvec3 right = unit(glm::transpose(glm::inverse(m)) * n), wrong = unit(m * n);
  EXPECT_NEAR(std::acos(glm::dot(right, wrong)) / degrees, 78.6, 0.05);
}

TEST_P(Transforms, SingularScalesAreFinite) {  // B6
  for (Shading shading : everyShading)
    for (const glm::dvec3 scale : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 0)}) {
      Look look = parallelLook({0, 0, 1}, 32);
      look.shading = shading;
      look.ambientLight = glm::dvec3(0.25);
      Material m = paint();
      m.doubleSided = true;
      m.shading.ior = 1;
      m.shading.metalness = 0;
      look.light = {directional({0, 0.6, 0.8})};
      const Image image = draw(sceneOf(sphere(16, 8), m, scaling(scale)), look);
      EXPECT_TRUE(isFinite(image));
      if (scale == glm::dvec3(1, 1, 0) && shading != Shading::flat) {
        // Flattened onto z = 0, the ball has that plane's normal on its front.
        const SurfaceValues values{0.5, 0.7, 0.4, 30, 0, {0.9, 0.6, 0.3}};
        const bool blinn = shading == Shading::blinnPhong || shading == Shading::environment;
        const glm::dvec3 lit =
            shaded(values, glm::dvec3(0.25), {0, 0, 1}, {0, 0.6, 0.8}, {0, 0, 1}, blinn);
        expectColor(color(image, 18, 13), lit, lobeTolerance(120) + 16 * rounding,
                    glint::shadingName(shading).data());
      }
    }
}

// B4, B5: scaling everything by a power of two changes no bit; any other factor changes only the
// roundings of the input.
TEST_P(Transforms, ScaleOfEverythingDoesNotMatter) {
  for (Shading shading : everyShading) {
    const glm::dmat4 place = rotation(0.4) * scaling({1, 1.5, 0.7});
    Light point = lightOf(Light::Type::point);
    const auto drawn = [&](double scale) {
      Look look = plainLook(shading);
      point.position = glm::dvec3(1, 2, 3) * scale;
      look.light = {point, directional({-1, 1, 1}, glm::dvec3(0.5))};
      return draw(sceneOf(pebble(), paint(), scaling(glm::dvec3(scale)) * place), look);
    };
    const Image one = drawn(1);
    EXPECT_GT(coveredPixels(one), 500u);
    for (int k : {-67, -10, 1, 13, 66})
      EXPECT_EQ(differingPixels(drawn(std::exp2(k)), one), 0u) << "2^" << k;
    for (double scale : {1e-20, 1e20}) {
      // The camera's unit is a power of two: lengths divided by it change by a factor between 1 and
      // 2 and are rounded again.
      const auto [most, single] = compared(drawn(scale), one);
      EXPECT_LT(most, movedTolerance(shading)) << scale << " " << glint::shadingName(shading);
      EXPECT_LE(single, 1) << scale;
    }
  }
}

// B8. Whole numbers far away and vertices on a grid need no rounding: identical bits.
TEST_P(Transforms, PlaceOfEverythingDoesNotMatter) {
  for (Shading shading : everyShading) {
    const auto drawn = [&](const glm::dvec3& place) {
      Look look = plainLook(shading);
      look.cameraPosition = place + glm::dvec3(2, 1.5, 3);
      look.cameraFocalPoint = place;
      Light point = lightOf(Light::Type::point);
      point.position += place;
      look.light = {point, directional({-1, 1, 1}, glm::dvec3(0.5))};
      look.clippingRange = glm::dvec2(1, 8);
      return draw(sceneOf(pebble(), paint(), translation(place)), look);
    };
    const Image origin = drawn({0, 0, 0});
    EXPECT_GT(coveredPixels(origin), 500u);
    EXPECT_EQ(differingPixels(drawn({1e6, -1e6, 2e6}), origin), 0u);
    EXPECT_EQ(differingPixels(drawn({1e7, 0, -3e7}), origin), 0u);
  }
}

// The same with glint's own framing, which adds and halves far from the origin: in double, where
// 1e7 has an ulp of 1.9e-9. This may change the last place of the picture's floats.
TEST_P(Transforms, FramingFarAwayIsThatAtTheOrigin) {
  for (Shading shading : everyShading) {
    const auto drawn = [&](const glm::dvec3& place) {
      return draw(sceneOf(pebble(), paint(), translation(place)), plainLook(shading));
    };
    const Image origin = drawn({0, 0, 0});
    for (double far : {1e6, 1e7}) {
      const auto [most, single] = compared(drawn({far, far, -far}), origin);
      EXPECT_LT(most, movedTolerance(shading)) << far << " " << glint::shadingName(shading);
      EXPECT_LE(single, 1) << far;
    }
  }
}

// Vertices that are far from their own origin in the file are, to float precision, where they would
// be near it. 1/16 is the step of float at 1e6.
TEST_P(Transforms, VerticesFarFromTheirOriginAreWhereTheyWouldBeNearIt) {
  Mesh mesh = pebble();
  for (glm::vec3& p : mesh.positions) p = glm::round(p * 32.0f) / 16.0f;
  const auto drawn = [&](const glm::vec3& offset, Shading shading) {
    Mesh moved = mesh;
    for (glm::vec3& p : moved.positions) p += offset;
    const std::string path = writeGltf("far_vertices", moved);
    Look look = plainLook(shading);
    look.cameraPosition = glm::dvec3(offset) + glm::dvec3(5, 3, 6);
    look.cameraFocalPoint = glm::dvec3(offset);
    look.clippingRange = glm::dvec2(2, 16);
    return draw(glint::loadGltf(path), look);
  };
  for (Shading shading : everyShading) {
    const Image origin = drawn({0, 0, 0}, shading);
    EXPECT_GT(coveredPixels(origin), 500u);
    EXPECT_EQ(differingPixels(drawn({1e6f, -1e6f, 5e5f}, shading), origin), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Render, Transforms, softwareBackends(), nameOfBackend);

}  // namespace glint::test::render_transforms_gl_test
