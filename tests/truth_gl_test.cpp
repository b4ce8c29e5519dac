// Whole pictures of the driver compared with closed forms, and with the reference where it supports
// what they need: environment pictures, textures, multisampling.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>

#include "formulas.h"
#include "glint/gltf/scene_file.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"
#include "pictures.h"
#include "random.h"
#include "stage.h"
#include "textures.h"

namespace glint::test::truth_gl_test {

class Truth : public OnStage {
 protected:
  /// The positions of the driver's samples, relative to the pixel's centre.
  std::vector<glm::dvec2> samples(int count) {
    std::vector<glm::dvec2> all;
    for (const glm::vec2& place : RenderTarget(4, 4, count).samplePositions())
      all.push_back(glm::dvec2(place) - 0.5);
    return all;
  }

  Image reference(const Scene& given, const Look& look, std::vector<glm::dvec2> samples = {}) {
    Scene scene = given;
    const DecodedImages images = decodeImages(scene, look);
    ReferenceRenderer renderer(scene, images, boundsOf(scene), look, 1);
    if (!samples.empty()) renderer.sampleAt(std::move(samples));
    return renderer.draw();
  }
};

using Radiance = std::function<glm::dvec3(const glm::dvec3&)>;

// Linear and quadratic in direction, with no two axes alike.
glm::dvec3 linear(const glm::dvec3& d) {
  return 0.6 + glm::dvec3(0.3 * d.x + 0.1 * d.y, 0.3 * d.y - 0.1 * d.z, 0.3 * d.z + 0.15 * d.x);
}
glm::dvec3 quadratic(const glm::dvec3& d) {
  return 0.6 + 0.4 * glm::dvec3(d.x * d.y, d.z * d.z - d.x * d.z, d.y * d.z + d.x * d.x);
}

constexpr int pictureRows = 256;
constexpr double texel = std::numbers::pi / pictureRows;

std::string pictureOf(const std::string& name, const Radiance& radiance) {
  return environmentPicture(name, pictureRows, radiance);
}

// The direction that an environment rotated by an angle about +Y shows.
glm::dvec3 turnedBack(const glm::dvec3& d, double angle) {
  const double s = std::sin(-angle * degrees), c = std::cos(-angle * degrees);
  return {c * d.x + s * d.z, d.y, -s * d.x + c * d.z};
}

Look mirrorLook(const glm::dvec3& toViewer, const std::string& picture, double turn) {
  Look look = parallelLook(toViewer, 3);
  look.shading = Shading::environment;
  look.noLights = true;
  look.hdriFile = picture;
  look.environmentRotation = turn;
  return look;
}

// A mirror and a pane with the environment looked up at its full size. Bilinear texels are off by
// h^2 / 8 times the second derivatives along both axes, which are at most 0.32 and 1.2; also across
// a pole, where rows meet those of the other side. Floats add 2e-6 (direction, position and
// filter).
TEST_P(Truth, MirrorsAndPanesShowWhatIsThere) {
  const std::pair<Radiance, double> radiances[] = {{linear, 0.32}, {quadratic, 1.2}};
  std::vector<glm::dvec3> directions{{0, 1, 0},         {0, -1, 0}, {1e-4, 1, 0},  {0, 1, -2e-3},
                                     {-4e-3, -1, 5e-3}, {0, 0, 1},  {1e-5, 0, 1},  {-1e-5, 0.3, 1},
                                     {0, 0, -1},        {1, 0, 0},  {0.5, -0.4, 1}};
  for (int i = 0; const auto& [radiance, bend] : radiances) {
    const std::string picture = pictureOf("radiance" + std::to_string(i++), radiance);
    const double tolerance = bend * texel * texel / 4 + 2e-6;
    double mirrored = 0, seenThrough = 0;
    for (const double turn : {0.0, 33.0, 180.0, -120.0})
      for (const glm::dvec3& to : directions)
        for (const double cosine : {1.0, 0.6, 0.02}) {  // 0.02: grazing
          const glm::dvec3 seen = unit(to);
          const glm::dvec3 side = unit(glm::cross(
              seen, std::abs(seen.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0.2)));
          const double sine = std::sqrt(1 - cosine * cosine);
          const glm::dvec3 n = cosine * seen + sine * side;
          const glm::dvec3 v = unit(2 * cosine * n - seen);
          Mesh mesh = quad();
          const glm::dvec3 right = unit(glm::cross(
                               v, std::abs(v.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1))),
                           up = glm::cross(v, right);
          for (glm::vec3& p : mesh.positions)
            p = glm::vec3(-double(p.x) * right + double(p.y) * up);
          mesh.normals.assign(4, glm::vec3(n));
          Material mirror = materialOf(0, 0, 0, 1, 1);
          mirror.doubleSided = true;
          Look look = mirrorLook(v, picture, turn);
          look.cameraViewUp = up;
          if (glm::dot(glm::cross(glm::dvec3(mesh.positions[1] - mesh.positions[0]),
                                  glm::dvec3(mesh.positions[2] - mesh.positions[0])),
                       v) < 0)
            std::swap(mesh.indices[1], mesh.indices[2]),
                std::swap(mesh.indices[4], mesh.indices[5]);
          const glm::dvec3 shown = middle(draw(sceneOf(mesh, mirror), look));
          expectColor(shown, radiance(turnedBack(seen, turn)), tolerance, "mirror");
          mirrored = std::max(mirrored, largest(shown - radiance(turnedBack(seen, turn))));
          // Glass: the same direction by reflection, another one by refraction.
          Material glass = materialOf(0, 0, 0, 1);
          glass.shading.transmission = 1;
          const double r = reflectance(cosine, 1, 1.5);
          const glm::dvec3 along = (cosine * n - v) / 1.5;
          const glm::dvec3 through = along - std::sqrt(1 - glm::dot(along, along)) * n;
          const glm::dvec3 pane = middle(draw(sceneOf(mesh, glass), look));
          const glm::dvec3 both =
              r * radiance(turnedBack(seen, turn)) + (1 - r) * radiance(turnedBack(through, turn));
          expectColor(pane, both, tolerance + 1e-5, "glass");
          seenThrough = std::max(seenThrough, largest(pane - both));
          if (HasFailure())
            FAIL() << "to " << seen.x << " " << seen.y << " " << seen.z << " cosine " << cosine
                   << " turn " << turn;
        }
    std::printf("| %s | %.2e | %.2e | %.2e |\n", i == 1 ? "linear" : "quadratic", mirrored,
                seenThrough, tolerance);
  }
}

// A ball of water in glass with total reflection in part of it: reference and driver agree in every
// pixel, whatever happens in its neighbours.
TEST_P(Truth, NeighboursInTotalReflection) {
  Scene scene = loadGltf(GLINT_SOURCE_DIR "/models/sphere.glb");
  for (Material& m : scene.materials) m.shading.transmission = 0.9, m.shading.ior = 1.33;
  Look look;
  look.shading = Shading::environment;
  look.resolution = {128, 128};
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  look.mediumIor = 1.5;
  look.hdriFile = pictureOf("stripes", [](const glm::dvec3& d) {
    return glm::dvec3(0.5 + 0.5 * std::sin(20 * d.x), 0.5 + 0.5 * std::sin(25 * d.y),
                      0.5 + 0.5 * std::sin(20 * d.z));
  });
  const Image drawn = draw(scene, look), truth = reference(scene, look);
  int off = 0, covered = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      covered += color(truth, x, y) != color(truth, 0, 0);
      off += largest(color(drawn, x, y) - color(truth, x, y)) > 2e-3;
    }
  EXPECT_GT(covered, 5000);
  // At the outline, and where the square root at the critical angle takes the root of a rounding.
  EXPECT_LE(off, covered / 500);
}

// With an odd size, so that the levels have weights other than a half.
Scene texturedQuad(Sampler sampler, double repeats) {
  Material m;
  m.unlit = true;
  m.colorTexture = Texture{};
  m.colorTexture->sampler = sampler;
  Mesh mesh = quad();
  const float r = float(repeats);
  mesh.texcoords = {{{0, r}, {r, r}, {r, 0}, {0, 0}}};
  Scene scene = sceneOf(mesh, m);
  Random random(3);
  static const std::vector<std::byte> noise = png(61, 61, [&](int, int) {
    return glm::ivec4(random.below(256), random.below(256), random.below(256), 255);
  });
  scene.images.push_back({"noise", noise, false});
  return scene;
}

// Noise, magnified and minified, frontal and oblique, with every pair of filters and every wrap
// mode. The driver's and the reference's picture agree to 1e-5, plus the error of the coordinates,
// which are floats of at most `repeats` with two roundings, in texels, whose neighbours differ by
// 1.
TEST_P(Truth, TexturesAreFilteredByTheRule) {
  constexpr std::pair<Filter, Filter> filters[] = {{Filter::nearest, Filter::nearest},
                                                   {Filter::linear, Filter::linear},
                                                   {Filter::nearest, Filter::linear},
                                                   {Filter::linear, Filter::nearest}};
  constexpr std::pair<Wrap, Wrap> wraps[] = {{Wrap::repeat, Wrap::mirroredRepeat},
                                             {Wrap::clampToEdge, Wrap::repeat},
                                             {Wrap::mirroredRepeat, Wrap::clampToEdge}};
  int number = 0;
  std::map<std::string, double> largestOf;
  for (const MipFilter mip : {MipFilter::none, MipFilter::nearest, MipFilter::linear})
    for (const auto& [magnify, minify] : filters)
      for (const double repeats : {0.1, 0.7, 3.0})
        for (const bool aslant : {false, true}) {
          const auto& [wrapS, wrapT] = wraps[number++ % 3];
          Sampler sampler{magnify, minify, mip, wrapS, wrapT};
          const Scene scene = texturedQuad(sampler, repeats);
          Look look = parallelLook({0, 0, 1}, 64);
          if (aslant) {
            look.cameraOrthographic = false;
            look.cameraPosition = glm::dvec3(0.4, -2.5, 1.5);
            look.cameraViewAngle = 40;
          }
          const Image drawn = draw(scene, look), truth = reference(scene, look);
          double worst = 0;
          int jumps = 0;
          for (int y = 1; y < 63; ++y)
            for (int x = 1; x < 63; ++x) {
              const double most = largest(color(drawn, x, y) - color(truth, x, y));
              // A nearest texel, or a nearest level, may be either of two that are equally near.
              const bool jump = (magnify == Filter::nearest || minify == Filter::nearest ||
                                 mip == MipFilter::nearest || color(drawn, x, y) == glm::dvec3(0) ||
                                 color(truth, x, y) == glm::dvec3(0)) &&
                                most > 1e-4;
              jumps += jump;
              if (!jump) worst = std::max(worst, most);
            }
          SCOPED_TRACE("mip " + std::to_string(int(mip)) + " filters " +
                       std::to_string(int(magnify)) + std::to_string(int(minify)) + " wraps " +
                       std::to_string(int(wrapS)) + std::to_string(int(wrapT)) + " repeats " +
                       std::to_string(repeats) + " aslant " + std::to_string(aslant));
          EXPECT_LE(worst, 1e-5 + 64 * std::max(repeats, 1.0) * 0x1p-22);
          EXPECT_LE(jumps, 62 * 62 / 100);
          constexpr const char* levels[] = {"none", "nearest", "linear"};
          const bool smooth = magnify == Filter::linear && minify == Filter::linear;
          double& most = largestOf[std::string(levels[int(mip)]) + " | " +
                                   (smooth ? "linear" : "nearest in some") + " | " +
                                   (aslant ? "aslant" : "straight")];
          most = std::max(most, worst);
        }
  for (const auto& [what, most] : largestOf) std::printf("| %s | %.2e |\n", what.c_str(), most);
}

// A pixel fully covered by one triangle looks the same as without anti-aliasing: to 1e-6, and twice
// that if the interpolated direction is looked up in a picture.
TEST_P(Truth, WhollyCoveredPixelsAreShadedInTheirMiddle) {
  for (const Shading shading :
       {Shading::gouraud, Shading::phong, Shading::blinnPhong, Shading::environment}) {
    const Scene scene = loadGltf(GLINT_SOURCE_DIR "/models/sphere.glb");
    Look look;
    look.shading = shading;
    look.resolution = {256, 256};
    look.noBackground = true;
    if (shading == Shading::environment) look.hdriFile = pictureOf("linear", linear);
    Look plain = look;
    plain.antiAliasing = {AntiAliasing::Mode::none, 1};
    const Image multi = draw(scene, look), single = draw(scene, plain);
    // Fully covered: all of the pixel's corners lie in the triangle at its centre.
    const ReferenceRenderer renderer(scene, {}, boundsOf(scene), plain, 1);
    const auto seen = renderer.attributes(0, 256);
    int whole = 0;
    for (int y = 1; y < 255; ++y)
      for (int x = 1; x < 255; ++x) {
        const reference::Attributes& a = seen[std::size_t(256 * y + x)];
        if (a.item < 0 || a.edgeDistance < 0.75) continue;
        ++whole;
        const glm::dvec3 value = color(single, x, y);
        expectColor(color(multi, x, y), value,
                    (shading == Shading::environment ? 2e-6 : 1e-6) *
                        std::max({1.0, value.r, value.g, value.b}),
                    std::string(shadingName(shading)).c_str());
      }
    EXPECT_GT(whole, 300);
  }
}

/// The number of pixels that differ from the reference, and the largest difference relative to the
/// allowed one.
struct Deviation {
  int pixels = 0;
  double most = 0, ofBound = 0;
  void add(double difference, double bound) {
    ++pixels;
    most = std::max(most, difference);
    ofBound = std::max(ofBound, difference / bound);
  }
};

// Compared with the reference at the driver's own sample positions, for every pixel. A pixel
// covered by a single triangle is within the bound without anti-aliasing,
// 1e-5 + 4e-6 sqrt(exponent) (comparison.h). Where edges cross it, the driver rounds
// vertices to 1/256 of a pixel, by up to 1/512 along either axis, and so moves every edge: a sample
// that close to an edge may fall on its other side. Pictures by the reference with all samples
// moved to a corner of that square show the effect; the sum over the four corners accounts for
// edges that move differently. The rows of docs/accuracy.md.
TEST_P(Truth, MultisampledPicturesAgreeWithTheReference) {
  constexpr int size = 128;
  const auto places = samples(4);
  ASSERT_EQ(places.size(), 4u);
  for (const char* model : {"sphere.glb", "torus.glb", "teapot.glb"})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong,
                                  Shading::blinnPhong, Shading::environment}) {
      const Scene scene = loadGltf(std::string(GLINT_SOURCE_DIR "/models/") + model);
      Look look;
      look.shading = shading;
      look.resolution = {size, size};
      look.noBackground = true;
      const Image drawn = draw(scene, look), truth = reference(scene, look, places);
      std::vector<Image> corners;
      for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        auto moved = places;
        for (glm::dvec2& place : moved) place += corner / 512.0;
        corners.push_back(reference(scene, look, moved));
      }
      Look plain = look;
      plain.antiAliasing = {AntiAliasing::Mode::none, 1};
      const ReferenceRenderer renderer(scene, {}, boundsOf(scene), plain, 1);
      const auto seen = renderer.attributes(0, size);
      double alpha = 0;
      for (const Material& m : scene.materials) alpha = std::max(alpha, lobeExponent(m, look));
      const double smooth = 1e-5 + 4e-6 * std::sqrt(alpha);
      Deviation single, crossed, outline;
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const auto difference = [&](const Image& other) {
            return std::max(largest(color(other, x, y) - color(truth, x, y)),
                            std::abs(pixel(other, x, y).a - pixel(truth, x, y).a));
          };
          const reference::Attributes& a = seen[std::size_t(size * y + x)];
          double bound = smooth;
          for (const Image& corner : corners) bound += difference(corner);
          Deviation& kind = pixel(truth, x, y).a < 1                ? outline
                            : a.item >= 0 && a.edgeDistance >= 0.75 ? single
                                                                    : crossed;
          kind.add(difference(drawn), &kind == &single ? smooth : bound);
        }
      std::printf("| %s | %s, msaa:4 | %d, %.2e, %.2f | %d, %.2e, %.2f | %d, %.2e, %.2f |\n", model,
                  std::string(shadingName(shading)).c_str(), single.pixels, single.most,
                  single.ofBound, crossed.pixels, crossed.most, crossed.ofBound, outline.pixels,
                  outline.most, outline.ofBound);
      EXPECT_GT(single.pixels + crossed.pixels, 2000);
      EXPECT_LE(single.ofBound, 1);
      EXPECT_LE(crossed.ofBound, 1);
      EXPECT_LE(outline.ofBound, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Software, Truth, softwareBackends(), nameOfBackend);

}  // namespace glint::test::truth_gl_test
