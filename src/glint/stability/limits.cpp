// Group L: what exceeds a driver's limits is drawn in parts or smaller, or refused by name.

#include <glad/gl.h>

#include <algorithm>

#include "glint/gl/framebuffer.h"
#include "glint/image/error.h"
#include "glint/render/tiles.h"
#include "glint/scene/look_text.h"
#include "glint/stability/bench.h"
#include "glint/stability/document.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

int limitOf(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

void l1(Bench& bench, Record& record) {
  const int most = limitOf(GL_MAX_RENDERBUFFER_SIZE);
  record.refused(
      "a target of " + std::to_string(most + 1) + " pixels", [&] { RenderTarget(most + 1, 1, 1); },
      "--resolution");
  // A larger picture is drawn in tiles. --resolution takes at most 65535.
  const int width = std::min(most + 8, 65535);
  Look look = bench.look();
  look.resolution = {width, 1};
  look.backgroundColor = glm::dvec3(0.25);
  const Image image = bench.draw(sceneOf(square(), unlitMaterial(glm::dvec3(1))), look);
  record.near("a picture of " + std::to_string(width) + " x 1: last value of its row",
              image.values.at(std::size_t(4) * std::size_t(width) - 4), 0.25, 0);
}

void l2(Bench& bench, Record& record) {
  for (const AntiAliasing& antiAliasing :
       {AntiAliasing{AntiAliasing::Mode::none, 1}, AntiAliasing{AntiAliasing::Mode::msaa, 4},
        AntiAliasing{AntiAliasing::Mode::ssaa, 2}}) {
    const TileLayout layout = tilesFor({16384, 16384}, antiAliasing);
    double covered = 0;
    int largest = 0;
    for (const auto& band : layout.bands)
      for (const Tile& tile : band) {
        covered += double(tile.width) * tile.height;
        largest = std::max({largest, tile.width * layout.scale, tile.height * layout.scale});
      }
    const std::string what = "16384 x 16384, " + antiAliasingText(antiAliasing);
    record.near(what + ": pixels in its tiles", covered, 16384.0 * 16384, 0);
    record.within(what + ": widest tile", largest, 1, limitOf(GL_MAX_RENDERBUFFER_SIZE));
  }
  Look look = bench.look();
  look.resolution = {16384, 16384};
  look.backgroundColor = glm::dvec3(0.25);
  const Scene scene = sceneOf(square({0, 0, 1}, 1), unlitMaterial(glm::dvec3(1)));
  GpuScene gpu(scene, {});
  Renderer::Picture picture =
      bench.renderer().begin(gpu, makeDrawList(scene, boundsOf(scene), look), look);
  Image band;
  picture.drawBand(band);
  record.near("width of its first band", band.width, 16384, 0);
  record.near("first pixel", band.values.at(0), 0.25, 0);
  record.near("last pixel of the band", band.values.at(band.values.size() - 4), 0.25, 0);
}

void l3(Bench& bench, Record& record) {
  const int most = maxSamples();
  if (most >= 64) return record.that("as many samples as may be asked for", true);
  Look look = bench.look();
  look.antiAliasing = {AntiAliasing::Mode::msaa, 64};
  record.refused(
      "msaa:64 where the driver has " + std::to_string(most) + " samples",
      [&] { bench.draw(sceneOf(square()), look); }, "use --anti-aliasing ssaa:8");
  look.antiAliasing = {AntiAliasing::Mode::msaa, most};
  record.finite("msaa:" + std::to_string(most), bench.draw(sceneOf(square()), look));
}

void l4(Bench& bench, Record& record) {
  record.within("bytes of a uniform block on this driver", limitOf(GL_MAX_UNIFORM_BLOCK_SIZE),
                double(maxLights) * sizeof(LightEntry), 1e12);
  for (Light::Type type : {Light::Type::point, Light::Type::spot}) {
    Light light;
    light.type = type;
    light.position = {0, 0, 3};
    light.direction = {0, 0, -1};
    light.intensity = glm::dvec3(1 / double(maxLights));
    Look look = parallel(bench.look(), {0, 0, 1}, 3);
    look.light = std::vector<Light>(maxLights, light);
    record.near(std::to_string(maxLights) + (type == Light::Type::point ? " points" : " spots"),
                bench.draw(sceneOf(square(), litMaterial(1, 0, 1)), look).row(1)[4], 1, 1e-5);
  }
}

void l5(Bench& bench, Record& record) {
  // Skins are applied on loading, in double: a driver's number of uniforms does not limit the
  // joints.
  constexpr int joints = 2000;
  Document document;
  nlohmann::json attributes = {
      {"POSITION", document.accessor("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})},
      {"NORMAL", document.accessor("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})},
      {"JOINTS_0", document.shorts("VEC4", {0, 0, 0, 0, 1000, 0, 0, 0, joints - 1, 0, 0, 0})},
      {"WEIGHTS_0", document.accessor("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0})}};
  document.show({{"attributes", attributes}});
  document.json["nodes"][0]["skin"] = 0;
  nlohmann::json skin = {{"joints", nlohmann::json::array()}};
  for (int i = 0; i < joints; ++i) {
    document.json["nodes"].push_back(
        {{"translation", {i == 1000 ? 4 : 0, i == joints - 1 ? 8 : 0, 0}}});
    skin["joints"].push_back(i + 1);
    document.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  document.json["skins"] = {skin};
  const Scene scene = document.load();
  record.near("2000 joints: the second vertex moved by its own",
              scene.meshes.at(0).positions.at(1).x + scene.meshes.at(0).origin.x, 5, 1e-6);
  record.near("the third by the last",
              scene.meshes.at(0).positions.at(2).y + scene.meshes.at(0).origin.y, 9, 1e-6);
  Look look = bench.look();
  look.cameraDirection = glm::dvec3(0, 0, -1);
  record.finite("drawn", bench.draw(scene, look));
}

void l6(Bench& bench, Record& record) {
  const int most = limitOf(GL_MAX_TEXTURE_SIZE);
  Scene scene = sceneOf(square(), unlitMaterial(glm::dvec3(1)));
  scene.meshes[0].texcoords = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  scene.materials[0].colorTexture = Texture{};
  scene.images.push_back({"wide.png", {}});
  const auto draw = [&](int width) {
    DecodedImages images;
    images[0].image = {width, 1, 4,
                       std::vector<std::uint8_t>(std::size_t(4) * std::size_t(width), 255)};
    return bench.draw(scene, parallel(bench.look()), images);
  };
  record.near("a texture of " + std::to_string(most + 1) + " pixels, shown smaller",
              draw(most + 1).row(4)[16], 1, 1e-6);
  record.near("one of " + std::to_string(most), draw(most).row(4)[16], 1, 1e-6);
}

const Case limitTable[] = {
    {"L1", "more pixels per side than a target of the driver has",
     "a target is refused by name, a "
     "picture drawn in tiles",
     "exact", "GL_INVALID_VALUE, or a wrong picture", "", l1},
    {"L2", "16384 x 16384", "tiles that cover it, each within the driver's limits; its first band",
     "exact", "4 GiB at once", "bands of at most 2 Mi samples", l2},
    {"L3", "more samples than the driver has", "refused, naming ssaa", "exact",
     "drivers round the count silently", "", l3},
    {"L4", "128 point and spot lights", "drawn", "1e-5: 128 roundings",
     "uniform blocks are limited", "", l4},
    {"L5", "a skin of 2000 joints", "drawn", "1e-6", "uniforms are limited",
     "skins are applied on loading", l5},
    {"L6", "a texture wider than the driver's limit", "drawn smaller", "1e-6",
     "GL_INVALID_VALUE, or black", "", l6},
};

}  // namespace

std::span<const Case> limitCases() { return limitTable; }

}  // namespace glint::stability
