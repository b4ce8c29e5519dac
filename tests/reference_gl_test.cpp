// GL pictures compared with the double-precision reference: coverage, the whole error, and its
// parts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "glint/gl/context.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/file.h"
#include "glint/image/picture_writer.h"
#include "glint/image/srgb.h"
#include "glint/options/parameters.h"
#include "glint/reference/renderer.h"
#include "glint/render/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "gltf_text.h"
#include "reference_scenes.h"

namespace glint {
namespace reference_gl_test {

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

Image attributeImage(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look,
                     PixelOutput output) {
  for (DrawItem& item : list.items) item.variant = attributeVariant(item.variant, output);
  return renderer.draw(scene, std::move(list), look);
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
double wholeBound(const Comparison& c) { return 1e-5 + 4e-6 * std::sqrt(c.alpha); }

/// The largest error that shading may add to its inputs.
double shadingBound(const Comparison& c, const Look& look) {
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
Comparison compare(Renderer& renderer, Model& model, const Look& look,
                   const Places& nearEdge = {}) {
  ReferenceRenderer reference(model.scene, model.images, model.bounds, look);
  const int width = look.resolution.x, height = look.resolution.y;
  const Image truth = reference.draw();
  auto attributes = reference.attributes(0, height);
  GpuScene scene(model.scene, model.images);
  const DrawList list = makeDrawList(model.scene, model.bounds, look);
  const Image drawn = renderer.draw(scene, list, look);
  const auto output = [&](PixelOutput o) { return attributeImage(renderer, scene, list, look, o); };
  const bool split = perPixel(look.shading);
  const Image colors = output(PixelOutput::color), emission = output(PixelOutput::emission);
  // Position and normal of each pixel, which only per-pixel programs give.
  Look phong = look;
  if (!split) phong.shading = Shading::phong;
  Scene bare = model.scene;  // flat and gouraud ignore normal maps
  if (!split)
    for (Material& m : bare.materials) m.normalTexture.reset();
  const DrawList geometry = makeDrawList(bare, model.bounds, phong);
  GpuScene phongScene(bare, decodeImages(bare, phong));
  const Image positions =
      attributeImage(renderer, phongScene, geometry, phong, PixelOutput::position);
  const Image normals = attributeImage(renderer, phongScene, geometry, phong, PixelOutput::normal);

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

Layers layersOf(Renderer& renderer, Model model, const Look& look) {
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

void printHeading() {
  std::printf("%-24s %-12s %7s %5s %8s %6s %5s %5s %6s %7s %9s %9s %9s %9s %9s %9s %9s\n", "model",
              "program", "covered", "one", "fromEdge", "edge", "other", "over", "levels", "unequal",
              "whole", "bound", "shading", "interpol.", "position", "normal", "filtering");
}

void print(const std::string& name, Shading shading, const Comparison& c, double bound) {
  std::printf(
      "%-24s %-12s %7d %5d %8.1e %6d %5d %5d %6d %7d %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e %9.2e  "
      "%d,%d\n",
      name.c_str(), std::string(shadingName(shading)).c_str(), c.covered, c.coverage,
      c.coverageEdge, c.nearEdge, c.otherSurface, c.overBound, c.levels, c.unequal, c.whole, bound,
      c.shading, c.interpolation, c.position, c.normal, c.filtering, c.worstX, c.worstY);
}

/// For pictures without textures.
void expectAccurate(const std::string& what, const Look& look, const Comparison& c) {
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
      const std::string name = std::filesystem::path(path).filename();
      print(name, shading, c, wholeBound(c));
      if (!model.textured) {
        expectAccurate(name, look, c);
      }
    }
}

/// A special scene and the differences allowed in its pictures.
struct Special {
  const char* name;
  std::function<void(Scene&, Look&)> make;
  bool textured = false;
};

Material paint(double specular = 0.5) {
  Material m;
  m.shading.specular = specular;
  m.shading.color = {0.8, 0.4, 0.2};
  return m;
}

// Triangles with all corners at pixel centres: samples on edges show which triangle owns them.
void cornersAtCenters(Scene& scene, Look& look) {
  std::vector<glm::vec3> corners;
  for (const glm::vec2 v : {glm::vec2(-20.5f, -12.5f),
                            {18.5f, -12.5f},
                            {-20.5f, 20.5f},
                            {-4.5f, 25.5f},
                            {9.5f, 11.5f},
                            {23.5f, 25.5f},
                            {0.5f, -20.5f},
                            {20.5f, -30.5f},
                            {20.5f, -14.5f},
                            {-30.5f, 0.5f},
                            {-24.5f, -5.5f},
                            {-24.5f, 6.5f}})
    corners.emplace_back(v, 0.0f);
  Material both = paint();
  both.doubleSided = true;
  scene = scenes::sceneOf({{scenes::triangles(corners), both}});
  look.resolution = {64, 64};
  scenes::lookAlongZ(scene, look, 32);
}

/// Writes an environment picture without edges.
std::string smoothPicture() {
  static const std::string path = [] {
    const std::string name = test::temporaryFolder() + "/smooth.pfm";
    constexpr int width = 256, height = 128;
    const auto writer = openPictureWriter(name, width, height);
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double theta = std::numbers::pi * (y + 0.5) / height;
        const double phi = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
        const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                           -std::sin(theta) * std::cos(phi));
        for (int c = 0; c < 3; ++c)
          image.values.push_back(float(0.5 + 0.4 * std::sin(3 * d[c] + d[(c + 1) % 3])));
        image.values.push_back(1);
      }
    writer->write(image);
    writer->finish();
    return name;
  }();
  return path;
}

/// A PNG of 64 x 64 texels with these codes.
std::vector<std::byte> picture(const std::string& name,
                               const std::function<glm::ivec3(int x, int y)>& code) {
  const std::string path = test::temporaryFolder() + "/" + name;
  const auto writer = openPictureWriter(path, 64, 64);
  Image image{64, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const glm::ivec3 c = code(x, y);
      for (int k = 0; k < 3; ++k) image.values.push_back(decodeSrgb8(std::uint8_t(c[k])));
      image.values.push_back(1);
    }
  writer->write(image);
  writer->finish();
  return readFile(path);
}

/// Waves as a normal map, and a rotated texture, on the sphere under a mirroring transform.
void normalMapped(Scene& scene, Look& look) {
  scene = loadGltf(GLINT_SOURCE_DIR "/models/sphere.glb");
  scene.images.push_back({"waves",
                          picture("waves.png",
                                  [](int x, int y) {
                                    const double wave = 2 * std::numbers::pi / 32;
                                    const glm::dvec3 n = glm::normalize(glm::dvec3(
                                        0.4 * std::sin(wave * x), 0.4 * std::cos(wave * y), 1));
                                    return glm::ivec3(glm::round(127.5 * (n + 1.0)));
                                  }),
                          true});
  scene.images.push_back(
      {"ramp", picture("ramp.png", [](int x, int y) { return glm::ivec3(60 + x, 200 - y, 128); }),
       false});
  Texture normal, color;
  normal.sampler.mip = color.sampler.mip = MipFilter::none;
  normal.transform = {glm::dvec2(3, 0), glm::dvec2(0, 2), glm::dvec2(0.1, 0.2)};
  color.image = 1;
  color.sampler.wrapS = color.sampler.wrapT = Wrap::mirroredRepeat;
  color.transform = {glm::dvec2(0.8, -0.6), glm::dvec2(0.6, 0.8), glm::dvec2(0.3, 0)};
  for (Material& m : scene.materials) {
    m.normalTexture = normal;
    m.normalScale = 1.3;
    m.colorTexture = color;
    m.doubleSided = true;
  }
  for (Mesh& mesh : scene.meshes) {
    mesh.texcoords.resize(1);
    mesh.texcoords[0].clear();
    mesh.tangents.clear();
    for (const glm::vec3& p : mesh.positions) {  // from longitude and latitude
      const double turn = std::atan2(double(p.x), double(p.z)) / (2 * std::numbers::pi);
      mesh.texcoords[0].emplace_back(turn, 0.5 - 0.5 * double(p.y));
      mesh.tangents.emplace_back(glm::vec3(safeNormalize(glm::dvec3(double(p.z), 0, -double(p.x)))),
                                 1.0f);
    }
  }
  scene.instances[0].world = glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  look.cameraDirection = glm::dvec3(0.2, -0.1, -1);  // away from the seam, where u jumps
}

const Special specials[] = {
    {"normal map, mirrored, textures turned", normalMapped, true},
    {"corners at pixel centres", cornersAtCenters},
    {"floor through the eye",
     [](Scene& scene, Look& look) {
       Mesh mesh = scenes::triangles({{-100, -1, 50}, {100, -1, 50}, {0, -1, -100}});
       mesh.normals.assign(3, glm::vec3(0, 1, 0));
       scene = scenes::sceneOf({{mesh, paint()}});
       scenes::lookFromOrigin(scene, look, 1, 0.5, 40);
     }},
    {"all kinds of lights",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       Light sun, lamp, spot, camera;
       sun.direction = {1, 1, 0.3};
       sun.intensity = {0.5, 0.2, 0.1};
       lamp.type = Light::Type::point;
       lamp.position = {1, 1.2, 1.5};
       spot.type = Light::Type::spot;
       spot.position = {0, 2, 2};
       spot.direction = {0, -1, -0.9};
       spot.innerAngle = 5;
       spot.outerAngle = 30;
       spot.intensity = {0.1, 1, 0.3};
       camera.type = Light::Type::camera;
       camera.direction = {0.2, 0.1, 1};
       camera.intensity = glm::dvec3(0.3);
       look.light = std::vector{sun, lamp, spot, camera};
     }},
    {"lamps of the file",
     [](Scene& scene, Look&) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       FileLight sun, lamp, spot;
       sun.direction = glm::normalize(glm::dvec3(-1, -1, -0.3));
       sun.intensity = glm::dvec3(2, 1, 1);
       lamp.type = FileLight::Type::point;
       lamp.position = {1, 0.6, 1};
       lamp.range = 1.5;
       lamp.intensity = glm::dvec3(4, 2, 6);
       spot.type = FileLight::Type::spot;
       spot.position = {0, 1.5, 1};
       spot.direction = glm::normalize(glm::dvec3(0, -1, -0.4));
       spot.innerAngle = 0.2;
       spot.outerAngle = 0.6;
       spot.intensity = glm::dvec3(1, 8, 3);
       scene.lights = {sun, lamp, spot};
       scene.lightScale = 0.2;
     }},
    {"a picture around it, seen through glass",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/sphere.glb");
       for (Material& m : scene.materials) m.shading.transmission = 0.6;
       look.hdriFile = smoothPicture();
       look.environmentRotation = 35;
     }},
    {"orthographic",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/teapot.glb");
       look.cameraOrthographic = true;
     }},
    {"infinite viewer, pow",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/sphere.glb");
       look.viewer = Viewer::infinite;
       look.highlight = Highlight::pow;
     }},
    {"uneven scale, mirrored",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       scene.instances[0].world =
           glm::dmat4(-1, 0.2, 0, 0, 0, 2, 0.1, 0, 0.3, 0, 0.5, 0, 3, -2, 1, 1);
       look.resolution = {150, 90};
     }},
    {"a million away",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       scene.instances[0].world[3] = glm::dvec4(1e6, -2e6, 5e5, 1);
       look.resolution = {100, 100};
     }},
    {"1e-12 in size",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       scene.instances[0].world = glm::dmat4(1e-12);
       scene.instances[0].world[3].w = 1;
       look.resolution = {100, 100};
     }},
    {"glass, both sides, schlick",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       for (Material& m : scene.materials) m.shading.transmission = 0.6;
       look.twoSided = true;
       look.fresnel = Fresnel::schlick;
       look.cameraPosition = glm::dvec3(0.6, 0.1, 0);  // inside
     }},
    {"textbook in water",
     [](Scene& scene, Look& look) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/teapot.glb");
       look.fresnel = Fresnel::textbook;
       look.mediumIor = 1.33;
       look.environment = Environment::sky;
     }},
    {"blended panes that cross",
     [](Scene& scene, Look& look) {
       Material glass = paint();
       glass.alphaMode = AlphaMode::blend;
       glass.alpha = 0.4;
       glass.doubleSided = true;
       // One mesh, nearest first, whose triangles intersect each other.
       Mesh mesh = scenes::triangles({{-24, -20, 6},
                                      {24, -20, -6},
                                      {0, 24, 0},
                                      {-24, -18, -6},
                                      {24, -22, 6},
                                      {2, 22, 1},
                                      {-20, -24, 0},
                                      {22, -10, 3},
                                      {-4, 24, -4}});
       scene = scenes::sceneOf({{mesh, glass}});
       look.resolution = {64, 64};
       scenes::lookAlongZ(scene, look, 32);
     }},
    {"blended, both sides",
     [](Scene& scene, Look&) {
       scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
       for (Material& m : scene.materials) {
         m.alphaMode = AlphaMode::blend;
         m.alpha = 0.6;
         m.doubleSided = true;
       }
     }},
};

TEST_P(AgainstReference, SpecialScenes) {
  const auto context = openContext(GetParam());
  context->makeCurrent();
  Renderer renderer;
  printHeading();
  for (const Special& special : specials)
    for (Shading shading : allPrograms) {
      // Flat and Gouraud shading ignore normal maps, which the driver's normals would include.
      if (special.textured && !perPixel(shading)) continue;
      Look look = lookWith(shading, 200);
      Model model;
      special.make(model.scene, look);
      model.bounds = boundsOf(model.scene);
      model.images = decodeImages(model.scene, look);
      Comparison c = compare(renderer, model, look);
      if (c.blended) {
        const Layers layers = layersOf(renderer, model, look);
        c = compare(renderer, model, look, layers.nearEdge);
        c.interpolation = layers.interpolation;
      }
      print(special.name, shading, c, wholeBound(c));
      expectAccurate(special.name, look, c);
      EXPECT_LE(c.filtering, 1e-6) << special.name;
    }
}

// Every form of lobe and reflectance, drawn by both.
TEST_P(AgainstReference, EveryForm) {
  const auto context = openContext(GetParam());
  context->makeCurrent();
  Renderer renderer;
  Model model;
  model.scene = loadGltf(GLINT_SOURCE_DIR "/models/torus.glb");
  for (Material& m : model.scene.materials) m.shading.transmission = 0.6;
  model.bounds = boundsOf(model.scene);
  printHeading();
  for (const std::string& form : highlightTexts()) {
    const HighlightForms highlight = parseHighlights(form, "form");
    const int gamma = highlight.brightest.gamma;
    if (gamma != 0 && gamma != 4) continue;
    for (Shading shading : {Shading::gouraud, Shading::phong, Shading::blinnPhong}) {
      Look look = lookWith(shading, 100);
      look.highlight = highlight;
      const Comparison c = compare(renderer, model, look);
      print(form, shading, c, wholeBound(c));
      expectAccurate(form, look, c);
    }
  }
  // Forms by light: from the brightest to the dimmest, a point, a directional light, a spot and
  // another.
  for (const std::string form :
       {"exact/2,lyon:4", "lyon:1/1,pow/1,pade:4/1,none", "none/1,lyon-cross:2/2,gaussian"})
    for (int program = 0; program < 5; ++program) {
      const Shading shading = Shading(program);
      Look look = lookWith(shading, 100);
      look.light.emplace();
      look.highlight = parseHighlights(form, "form");
      // Some lamps have fall-off and some do not.
      for (const char* light :
           {"spot:2,2,3:-2,-2,-3:10,40:4,3,3:falloff", "point:-2,2,2:0.7,0.9,0.5",
            "point:0,3,2:7,8,5:falloff,9", "spot:-2,2,3:2,-2,-3:10,40:0.4,0.3,0.3",
            "directional:1,1,1:0.3,0.2,0.2", "directional:0,1,2:0.6,0.5,0.5"})
        look.light->push_back(parseLight(light));
      const Comparison c = compare(renderer, model, look);
      print(form, shading, c, wholeBound(c));
      expectAccurate(form, look, c);
    }
  for (const std::string_view form : fresnelTexts())
    for (const bool other : {false, true}) {
      Look look = lookWith(Shading::environment, 100);
      look.fresnel = parseFresnel(std::string(form), "form");
      look.environment = Environment::sky;
      look.twoSided = true;
      look.material[""].metalness = 0.3;
      if (other) {
        look.mediumIor = 1.7;
        look.schlickExponent = 4.5;
      }
      const Comparison c = compare(renderer, model, look);
      print(std::string(form), look.shading, c, wholeBound(c));
      expectAccurate(std::string(form), look, c);
    }
}

// Points and lines, whose rules leave the driver more freedom: the same pixels unless a tie is
// near.
TEST_P(AgainstReference, PointsAndLines) {
  const auto context = openContext(GetParam());
  context->makeCurrent();
  Renderer renderer;
  Mesh points, lines;
  points.topology = Topology::points;
  lines.topology = Topology::lines;
  for (int i = 0; i < 40; ++i) {
    const float a = 0.7f * float(i), r = 0.07f * float(i);
    points.positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.1f * std::sin(3 * a));
    points.indices.push_back(std::uint32_t(i));
    lines.positions.push_back(points.positions.back() * 1.3f);
    lines.indices.push_back(std::uint32_t(i));
  }
  Scene scene = scenes::sceneOf({{points, paint()}, {lines, paint()}});
  const Look look = lookWith(Shading::phong, 150);
  ReferenceRenderer reference(scene, {}, boundsOf(scene), look);
  const Image truth = reference.draw();
  GpuScene gpu(scene, {});
  const Image drawn = renderer.draw(gpu, boundsOf(scene), look);
  int covered = 0, other = 0;
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 150; ++x) {
      covered += pixel(truth, x, y).a > 0;
      other += pixel(truth, x, y).a != pixel(drawn, x, y).a;
    }
  std::printf("points and lines: %d pixels, %d of them differ\n", covered, other);
  EXPECT_GT(covered, 300);
  EXPECT_LE(other, covered / 50);
}

INSTANTIATE_TEST_SUITE_P(Backends, AgainstReference,
                         testing::Values(Backend::osmesa, Backend::eglSoftware), [](const auto& p) {
                           return p.param == Backend::osmesa ? "osmesa" : "egl_software";
                         });

}  // namespace reference_gl_test
}  // namespace glint
