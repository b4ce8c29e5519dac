#include "glint/render/picture_terms.h"

#include <algorithm>
#include <limits>

#include "glint/render/gpu_scene.h"
#include "glint/render/renderer.h"

namespace glint {
namespace {

using Kind = PictureTerm::Kind;

constexpr float infinity = std::numeric_limits<float>::infinity();

// The index of a term's light in a draw list, and among the lights of its type.
struct LightPlace {
  LightPlace(const DrawList& list, const PictureTerm& term) {
    if (term.kind != Kind::diffuse && term.kind != Kind::specular) return;
    const auto found = std::ranges::find(list.lightNumbers, term.light);
    index = int(found - list.lightNumbers.begin());
    for (const DrawItem& item : list.items) {  // any variant that reads lights will do
      const Variant& v = item.variant;
      if (v.directionalLights + v.pointLights + v.spotLights == 0) continue;
      const int point = index - v.directionalLights, spot = point - v.pointLights;
      type = point < 0 ? 0 : spot < 0 ? 1 : 2;
      among = point < 0 ? index : spot < 0 ? point : spot;
    }
  }
  int index = 0, type = 0, among = 0;
};

void removeLights(Variant& v) {
  v.directionalLights = v.pointLights = v.spotLights = 0;
  v.diffuse = v.specular = v.specularAntialiasing = v.toksvig = false;
  v.highlight = Highlight::exact;
  v.dimmer.clear();
}

void keepOneLight(DrawItem& item, const LightPlace& place, const PictureTerm& term) {
  Variant& v = item.variant;
  const bool lit = v.directionalLights + v.pointLights + v.spotLights > 0;
  const bool diffuse = v.diffuse && term.kind == Kind::diffuse;
  bool specular = v.specular && term.kind == Kind::specular;
  const bool filtered = v.specularAntialiasing, toksvig = v.toksvig;
  const MaterialBlock& block = item.materialBlock;
  HighlightForm form = v.highlight;
  glm::vec2 shape = block.lobe;
  int table = 0, tableEnd = lobeTableRows(form);
  const glm::vec2 shapes[] = {block.secondLobe, block.thirdLobe, block.fourthLobe};
  for (std::size_t i = 0; i < v.dimmer.size(); ++i) {
    const Variant::Dimmer& each = v.dimmer[i];
    const int from = place.type == 0 ? each.directional : place.type == 1 ? each.point : each.spot;
    const int begin = tableEnd;
    tableEnd += lobeTableRows(each.form);
    if (place.among >= from) form = each.form, shape = shapes[i], table = begin;
  }
  removeLights(v);
  if (!lit) return;
  specular = specular && form.form != Highlight::none;
  (place.type == 0 ? v.directionalLights : place.type == 1 ? v.pointLights : v.spotLights) = 1;
  v.diffuse = diffuse;
  v.specular = specular;
  if (!specular) return;
  v.specularAntialiasing = filtered;
  v.toksvig = toksvig;
  v.highlight = form;
  item.materialBlock.lobe = shape;
  const auto own = item.lobeTables.begin() + table;
  item.lobeTables = {own, own + lobeTableRows(form)};
}

void keepLight(DrawItem& item, const LightPlace& place, const PictureTerm& term) {
  Variant& v = item.variant;
  if (v.unlit) {
    if (term.kind == Kind::emission) return;
    item.materialBlock.color = glm::vec3(0);
    v.dropEmission();
    return;
  }
  const bool oneLight = term.kind == Kind::diffuse || term.kind == Kind::specular;
  if (oneLight)
    keepOneLight(item, place, term);
  else
    removeLights(v);
  if (term.kind != Kind::emission) v.dropEmission();
  if (v.program != Shading::environment) return;
  v.output = term.kind == Kind::reflection   ? PixelOutput::reflection
             : term.kind == Kind::refraction ? PixelOutput::refraction
                                             : PixelOutput::sum;
}

// Normals are those of a per-pixel program, whichever program draws the picture.
void keepGeometry(DrawItem& item, const PictureTerm& term) {
  Variant& v = item.variant;
  v.multisampled = false;
  v.dropEmission();
  if (term.kind != Kind::normal) {
    v.output = term.kind == Kind::depth ? PixelOutput::depth : PixelOutput::ids;
    return;
  }
  v.output = PixelOutput::shadingNormal;
  if (v.unlit) return;
  v.dropParameterTextures();
  removeLights(v);
  v.program = Shading::phong;
  v.vanishingNormal = v.pixelPosition = v.unevenScale = true;
  v.twoSided = item.faces != FaceSide::front;
}

DrawList termList(const Scene& scene, DrawList list, const PictureTerm& term) {
  const LightPlace place(list, term);
  if (!term.isLight()) {
    std::erase_if(list.items, [](const DrawItem& item) { return item.blended; });
    for (DrawItem& item : list.items) {
      keepGeometry(item, term);
      if (term.kind == Kind::ids) item.materialBlock.emission = idsOf(scene, item);
    }
    return list;
  }
  for (DrawItem& item : list.items) keepLight(item, place, term);
  if (term.kind != Kind::ambient) list.frame.ambientLight = glm::vec3(0);
  if (term.kind == Kind::diffuse || term.kind == Kind::specular)
    list.lights = {list.lights.at(std::size_t(place.index))};
  else
    list.lights.clear();
  return list;
}

void toWorld(Image& normals, const Camera& camera) {
  for (std::size_t i = 0; i < normals.values.size(); i += 4) {
    float* const n = normals.values.data() + i;
    const glm::dvec3 world = camera.axes * glm::dvec3(n[0], n[1], n[2]);
    for (int c = 0; c < 3; ++c) n[c] = float(world[c]);
  }
}

void markBackground(Image& ids) {
  for (std::size_t i = 0; i < ids.values.size(); i += 4)
    if (!(ids.values[i + 3] > 0)) std::fill_n(ids.values.begin() + std::ptrdiff_t(i), 3, -1.0f);
}

void toDistance(Image& depths, const Camera& camera, bool reversed) {
  for (std::size_t i = 0; i < depths.values.size(); i += 4) {
    float* const p = depths.values.data() + i;
    double distance = infinity;
    if (p[3] > 0 && camera.orthographic) {
      const double share = reversed ? 1 - double(p[0]) : double(p[0]);
      distance = camera.near + share * (camera.far - camera.near);
    } else if (p[3] > 0) {
      distance = camera.unit / double(p[1]);
    }
    p[0] = p[1] = p[2] = float(distance);
  }
}

}  // namespace

std::vector<PictureTerm> termsOf(const DrawList& list, const Look& look) {
  std::vector<PictureTerm> terms{{Kind::ambient, 0, "ambient"}};
  std::vector<int> lights = list.lightNumbers;
  std::ranges::sort(lights);
  for (const int light : lights) {
    const std::string number = "-" + std::to_string(light);
    terms.push_back({Kind::diffuse, light, "diffuse" + number});
    terms.push_back({Kind::specular, light, "specular" + number});
  }
  if (look.shading == Shading::environment) {
    terms.push_back({Kind::reflection, 0, "reflection"});
    terms.push_back({Kind::refraction, 0, "refraction"});
  }
  terms.push_back({Kind::emission, 0, "emission"});
  if (!look.noBackground) terms.push_back({Kind::background, 0, "background"});
  terms.push_back({Kind::normal, 0, "normal"});
  terms.push_back({Kind::depth, 0, "depth"});
  terms.push_back({Kind::ids, 0, "id"});
  return terms;
}

glm::vec3 idsOf(const Scene& scene, const DrawItem& item) {
  const int object = scene.instances[std::size_t(item.instance)].object;
  const int mesh = scene.meshes[std::size_t(item.mesh)].fileMesh;
  return {object >= 0 ? object : item.instance, mesh >= 0 ? mesh : item.mesh, item.material};
}

Look termLook(const PictureTerm& term, Look look) {
  if (term.kind != Kind::background) look.noBackground = true;
  if (!term.isLight()) look.antiAliasing = {AntiAliasing::Mode::none, 1};
  return look;
}

Image drawTerm(Renderer& renderer, GpuScene& scene, const Bounds& bounds, const Look& look,
               const PictureTerm& term) {
  const DrawList list = makeDrawList(scene.scene(), bounds, look);
  const Camera camera = list.camera;
  const Look own = termLook(term, look);
  Image image = renderer.draw(scene, termList(scene.scene(), list, term), own);
  if (term.kind == Kind::normal) toWorld(image, camera);
  if (term.kind == Kind::ids) markBackground(image);
  if (term.kind == Kind::depth) toDistance(image, camera, renderer.reversedDepth());
  return image;
}

}  // namespace glint
