#include "glint/study/frame_parts.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "glint/scene/material_parameters.h"
#include "glint/study/variants.h"

namespace glint {
namespace {

constexpr int fewPixels = 16;  ///< of the longer side

Scene withoutTextures(Scene scene) {
  for (Material& material : scene.materials) {
    for (std::optional<Texture>* texture : texturesOf(material)) texture->reset();
    material.textured = 0;
  }
  return scene;
}

bool readsTextures(const DrawList& list) {
  return std::ranges::any_of(list.items, [](const DrawItem& item) {
    const Variant& v = item.variant;
    return v.colorTexture || v.emissionTexture || v.normalTexture || v.textured != 0;
  });
}

}  // namespace

DrawList emptied(DrawList list) {
  list.items.clear();
  return list;
}

DrawList inOneColor(DrawList list) {
  for (DrawItem& item : list.items) {
    item.variant = Variant{};
    item.variant.unlit = true;
  }
  return list;
}

std::vector<FramePart> frameParts(const StudyScene& scene, GpuScene& gpu, const Look& given,
                                  Shading model, FrameClock clock, const Timing& timing) {
  const Look look = exactLook(given, model);
  Look none = look, tiny = look;
  setForms(none, "none", "exact");
  tiny.resolution = resolutionOf(look, fewPixels);
  const DrawList list = makeDrawList(scene.scene, scene.bounds, look);
  const DrawList tinyList = makeDrawList(scene.scene, scene.bounds, tiny);
  const bool textures = readsTextures(list), highlights = anyHas(list, &Variant::specular);
  std::optional<StudyScene> plain;
  std::optional<GpuScene> plainGpu;
  if (textures) {
    plain.emplace(withoutTextures(scene.scene), DecodedImages());
    plainGpu.emplace(plain->scene, plain->images);
  }

  Renderer large, small;
  std::deque<Renderer::Picture> pictures;
  pictures.push_back(large.begin(gpu, list, look));
  pictures.push_back(large.begin(gpu, emptied(list), look));
  pictures.push_back(large.begin(gpu, inOneColor(list), look));
  pictures.push_back(small.begin(gpu, tinyList, tiny));
  pictures.push_back(small.begin(gpu, emptied(tinyList), tiny));
  enum Place : std::size_t { whole, cleared, colored, few, fewCleared, dull, untextured };
  pictures.push_back(large.begin(gpu, makeDrawList(scene.scene, scene.bounds, none), none));
  if (textures)
    pictures.push_back(
        large.begin(*plainGpu, makeDrawList(plain->scene, plain->bounds, look), look));
  std::vector<Renderer::Picture*> all;
  for (Renderer::Picture& picture : pictures) all.push_back(&picture);
  const std::vector<FrameTimes> times = timeInTurn(all, timing);
  if (times[0].wall.empty()) return {};

  std::vector<std::span<const double>> rounds;
  for (const FrameTimes& each : times) rounds.push_back(each.by(clock));
  using Quartiles = std::span<const double>;
  const auto above = [](double x) { return std::max(x, 0.0); };
  const auto vertices = [=](Quartiles q) { return above(q[few] - q[fewCleared]); };
  const auto filling = [=](Quartiles q) { return above(q[colored] - q[cleared] - vertices(q)); };
  const auto shine = [=](Quartiles q) { return highlights ? above(q[whole] - q[dull]) : 0.0; };
  const auto texels = [=](Quartiles q) { return textures ? above(q[whole] - q[untextured]) : 0.0; };
  std::vector<FramePart> parts;
  const auto add = [&](const char* name, const auto& part) {
    parts.push_back(
        {name, quartileFunction(rounds, [&](Quartiles q) { return part(q) / q[whole]; })});
  };
  add("vertices", vertices);
  add("the target", [](Quartiles q) { return q[cleared]; });
  add("filling", filling);
  if (textures) add("textures", texels);
  if (highlights) add("highlights", shine);
  add("other light", [&](Quartiles q) {
    return above(q[whole] - q[cleared] - vertices(q) - filling(q) - texels(q) - shine(q));
  });
  return parts;
}

}  // namespace glint
