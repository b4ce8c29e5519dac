#include "probe.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "glint/image/srgb.h"
#include "glint/reference/pixel.h"
#include "glint/reference/raster.h"
#include "glint/reference/renderer.h"
#include "glint/scene/lights.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/safe.h"
#include "glint/shading/sum.h"
#include "materials.h"

namespace glint::viewer {
namespace {

constexpr std::size_t mostLayers = 64;

// The primitives that the ray meets, each a mesh of its own with its transform: the part of the
// scene that the reference needs for one pixel.
Scene sceneOf(const Scene& from, const std::vector<Hit>& hits) {
  Scene scene;
  scene.materials = from.materials;
  scene.cameras = from.cameras;
  scene.lights = from.lights;
  scene.lightScale = from.lightScale;
  for (const EncodedImage& image : from.images)
    scene.images.push_back({image.name, {}, image.isData});
  for (const Hit& hit : hits) {
    const Mesh& mesh = from.meshes[std::size_t(hit.mesh)];
    Mesh one;
    one.origin = mesh.origin;
    one.normalsMayCancel = mesh.normalsMayCancel;
    one.material = mesh.material;
    one.opaqueTexels = mesh.opaqueTexels;
    one.texcoords.resize(mesh.texcoords.size());
    one.topology = mesh.topology;
    const std::size_t corners = cornersOf(mesh.topology);
    for (std::size_t i = 0; i < corners; ++i) {
      const std::uint32_t v = mesh.indices[corners * hit.primitive + i];
      one.positions.push_back(mesh.positions[v]);
      if (!mesh.normals.empty()) one.normals.push_back(mesh.normals[v]);
      if (!mesh.tangents.empty()) one.tangents.push_back(mesh.tangents[v]);
      if (!mesh.colors.empty()) one.colors.push_back(mesh.colors[v]);
      for (std::size_t set = 0; set < mesh.texcoords.size(); ++set)
        if (!mesh.texcoords[set].empty()) one.texcoords[set].push_back(mesh.texcoords[set][v]);
      one.indices.push_back(std::uint32_t(i));
    }
    scene.instances.push_back(
        {int(scene.meshes.size()), from.instances[std::size_t(hit.instance)].world});
    scene.meshes.push_back(std::move(one));
  }
  return scene;
}

// The index of the list item that draws this side of an instance, or -1.
int itemOf(const DrawList& list, int instance, bool back) {
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const DrawItem& item = list.items[i];
    if (item.instance == instance && (item.faces == FaceSide::both || !back)) return int(i);
  }
  return -1;
}

// A ray that passes near a point or a line need not be in a pixel that shows it. (For a triangle it
// is, except on an edge, where the adjacent triangle would do as well.)
bool covers(const reference::Primitive& primitive, const glm::ivec2& grid, glm::ivec2 pixel) {
  if (primitive.topology == Topology::triangles) return true;
  bool found = false;
  reference::forEachSample(primitive, grid, pixel.y, pixel.y + 1, glm::dvec2(0.0),
                           [&](int column, int) { found = found || column == pixel.x; });
  return found;
}

struct LayerValue {
  int item;  ///< index into the stage's items
  std::size_t hit;
  reference::Attributes attributes;
  glm::dvec3 radiance;
};

void setShown(Probe& probe, const Image& shown, float scale) {
  const float* rgba = shown.row(probe.pixel.y) + std::size_t(4) * std::size_t(probe.pixel.x);
  for (int i = 0; i < 3; ++i) {
    probe.shown[i] = rgba[i];
    probe.code[i] = encodeSrgb8(rgba[i] * scale);
  }
}

void compareWith(Probe& probe, const Image* plain, float scale) {
  for (int i = 0; i < 3; ++i) probe.expectedCode[i] = encodeSrgb8(float(probe.expected[i]) * scale);
  if (!plain) return;
  const float* rgba = plain->row(probe.pixel.y) + std::size_t(4) * std::size_t(probe.pixel.x);
  probe.center = glm::vec3(rgba[0], rgba[1], rgba[2]);
  for (int i = 0; i < 3; ++i) {
    const float e = std::abs(float(probe.expected[i]));
    const double unit = double(std::nextafter(e, INFINITY)) - double(e);
    probe.ulps[i] = (double(rgba[i]) - probe.expected[i]) / unit;
  }
}

// The background by the reference, for an empty scene.
glm::dvec3 backgroundAt(const ProbeScene& where, const Look& look, glm::ivec2 pixel) {
  if (look.noBackground) return glm::dvec3(0.0);
  if (!look.environmentBackground) return look.backgroundColor;
  Scene none = sceneOf(where.scene, {});
  ReferenceRenderer renderer(none, where.images, where.bounds, look, 1);
  Image row;
  renderer.drawRows(pixel.y, 1, row);
  const float* rgba = row.row(0) + std::size_t(4) * std::size_t(pixel.x);
  return {double(rgba[0]), double(rgba[1]), double(rgba[2])};
}

// The terms of the frontmost layer, light by light.
void setTerms(Probe& probe, const reference::Stage& stage, const LayerValue& layer,
              const std::vector<Light>& lights) {
  const reference::Surface& s = stage.items[std::size_t(layer.item)].surface;
  const glm::dmat3& toWorld = stage.camera.axes;
  const reference::Attributes& a = layer.attributes;
  probe.color = glm::dvec3(a.base);
  probe.alpha = a.base.a;
  if (s.unlit) return;
  glm::dvec3 N = reference::shadingNormal(s, a), position = a.position;
  if (s.program == Shading::flat) {
    N = s.twoSided && !a.front ? -a.faceNormal : a.faceNormal;
    const auto& eye = stage.vertices[stage.items[std::size_t(layer.item)].vertices].eye;
    position = (eye[0] + eye[1] + eye[2]) / 3.0;
  }
  const glm::dvec3 V = reference::toViewer(stage.frame, position);
  probe.N = toWorld * N;
  probe.V = toWorld * V;
  probe.nv = glm::dot(N, V);
  const bool entering = a.front || !s.twoSided;
  probe.reflectance = entering ? fresnelExact(probe.nv, s.mediumIor, s.ior)
                               : fresnelExact(probe.nv, s.ior, s.mediumIor);
  const auto termsWith = [&](std::vector<reference::Light> some, const glm::dvec3& ambient) {
    reference::Stage alone = stage;
    alone.frame.lights = std::move(some);
    alone.frame.ambientLight = ambient;
    reference::PixelShader shader(alone);
    return reference::shade(alone.frame, s,
                            shader.attributes(layer.item, 0, probe.pixel.x, probe.pixel.y));
  };
  const reference::Terms dark = termsWith({}, stage.frame.ambientLight);
  probe.ambient = sumColor({dark.matte, glm::dvec3(0.0)}, probe.color, a.numbers.metalness);
  probe.emission = a.emission;
  probe.environment = s.program == Shading::environment;
  probe.reflection = dark.reflection;
  probe.refraction = dark.refraction;
  probe.transparency = dark.transparency;
  static const char* const names[] = {"directional", "point", "spot", "camera"};
  std::vector<const char*> named;
  for (const Light& light : lights)
    if (light.intensity != glm::dvec3(0.0)) named.push_back(names[int(light.type)]);
  for (std::size_t i = 0; i < stage.frame.lights.size(); ++i) {
    const reference::Light& light = stage.frame.lights[i];
    const reference::Terms terms = termsWith({light}, glm::dvec3(0.0));
    LightProbe each;
    each.name = i < named.size() ? named[i] : "light";
    each.diffuse = sumColor({terms.matte, glm::dvec3(0.0)}, probe.color, a.numbers.metalness);
    each.specular = sumColor({glm::dvec3(0.0), terms.specular}, probe.color, a.numbers.metalness);
    const glm::dvec3 L = light.type == reference::Light::Type::directional
                             ? light.place
                             : safeNormalize(light.place - position);
    each.L = toWorld * L;
    each.nl = glm::dot(N, L);
    each.rv = glm::dot(2 * each.nl * N - L, V);
    each.nh = glm::dot(N, safeNormalize(L + V));
    probe.lights.push_back(each);
  }
}

std::string remarkFor(const reference::Stage& stage, const std::vector<LayerValue>& layers) {
  const reference::Item& item = stage.items[std::size_t(layers.front().item)];
  if (item.mesh->topology != Topology::triangles)
    return "a point or line: no normal, so it shows only C";
  if (layers.front().attributes.edgeDistance < 1.0 / 256)
    return "an edge passes so close to the pixel's centre that the driver may show the surface "
           "next to it";
  if (item.colorTexture || item.emissionTexture)
    return "textured: drivers filter textures in fixed point, to about 1/256";
  return {};
}

}  // namespace

Probe probePixel(const ProbeScene& where, const Look& shownLook, const Image& shown,
                 const Image* plain, glm::ivec2 pixel) {
  Probe probe;
  probe.pixel = pixel;
  const float scale = float(std::exp2(shownLook.exposure));
  setShown(probe, shown, scale);
  Look look = shownLook;
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  const Camera camera = cameraFor(where.scene, where.bounds, look);
  std::vector<Hit> hits = where.picker.pickAll(
      where.scene, rayThrough(camera, glm::dvec2(pixel) + 0.5, look.resolution), look.twoSided);
  if (hits.size() > mostLayers) hits.resize(mostLayers);
  const Scene scene = sceneOf(where.scene, hits);
  const DrawList list = makeDrawList(scene, where.bounds, look);
  const reference::Stage stage(scene, where.images, list, look);
  reference::PixelShader shader(stage);
  std::vector<LayerValue> layers;  // front to back; the last one is opaque, if any is
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const int item = itemOf(list, int(k), hits[k].backFace);
    if (item < 0) continue;
    const reference::Item& drawn = stage.items[std::size_t(item)];
    const auto primitive = reference::makePrimitive(drawn, stage.vertices[drawn.vertices], 0);
    if (!primitive || !covers(*primitive, stage.grid, pixel)) continue;
    const reference::Attributes a = shader.attributes(item, 0, pixel.x, pixel.y);
    if (drawn.mask && a.base.a < drawn.alphaCutoff) continue;
    const glm::dvec3 radiance = reference::shade(stage.frame, drawn.surface, a).radiance;
    layers.push_back({item, k, a, radiance});
    if (!drawn.blended) break;
  }
  probe.layers = int(layers.size());
  probe.expected = layers.empty() || stage.items[std::size_t(layers.back().item)].blended
                       ? backgroundAt(where, look, pixel)
                       : glm::dvec3(0.0);
  if (!layers.empty()) {
    probe.hit = hits[layers.front().hit];
    setTerms(probe, stage, layers.front(), lightsOf(withFileLights(scene, look)));
    probe.remark = remarkFor(stage, layers);
    for (auto each = layers.rbegin(); each != layers.rend(); ++each) {
      const LayerValue& layer = *each;
      const double alpha =
          stage.items[std::size_t(layer.item)].blended ? layer.attributes.base.a : 1.0;
      probe.expected = layer.radiance * alpha + (1 - alpha) * probe.expected;
    }
  }
  compareWith(probe, plain, scale);
  return probe;
}

std::string probeText(const Scene& scene, const Probe& p) {
  using Json = nlohmann::ordered_json;
  const auto vec = [](const auto& v) { return Json{v[0], v[1], v[2]}; };
  Json json;
  json["pixel"] = {p.pixel.x, p.pixel.y};
  if (p.other) {
    json["look"] = std::string(1, p.side);
    const glm::vec3 a = p.side == 'A' ? p.shown : *p.other, b = p.side == 'A' ? *p.other : p.shown;
    json["A-B"] = vec(glm::dvec3(a) - glm::dvec3(b));
  }
  if (p.hit) {
    json["material"] = materialLabel(scene, p.hit->material);
    json["back-face"] = p.hit->backFace;
    json["layers"] = p.layers;
    json["N"] = vec(p.N);
    json["V"] = vec(p.V);
    json["N.V"] = p.nv;
    json["R(theta)"] = p.reflectance;
    json["C"] = vec(p.color);
    json["alpha"] = p.alpha;
    json["ambient"] = vec(p.ambient);
    json["emission"] = vec(p.emission);
    if (p.environment) {
      json["reflection"] = vec(p.reflection);
      json["refraction"] = vec(p.refraction);
      json["transparency"] = p.transparency;
    }
    json["lights"] = Json::array();
    for (const LightProbe& light : p.lights)
      json["lights"].push_back({{"type", light.name},
                                {"L", vec(light.L)},
                                {"N.L", light.nl},
                                {"R.V", light.rv},
                                {"N.H", light.nh},
                                {"diffuse", vec(light.diffuse)},
                                {"specular", vec(light.specular)}});
  }
  json["shown"] = vec(p.shown);
  json["code"] = {p.code[0], p.code[1], p.code[2]};
  json["reference"] = vec(p.expected);
  json["reference-code"] = {p.expectedCode[0], p.expectedCode[1], p.expectedCode[2]};
  if (p.center) {
    json["center"] = vec(*p.center);
    json["ulp"] = {p.ulps[0], p.ulps[1], p.ulps[2]};
  }
  if (!p.remark.empty()) json["remark"] = p.remark;
  return json.dump(2) + "\n";
}

}  // namespace glint::viewer
