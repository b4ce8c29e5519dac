#include "glint/study/whole_picture.h"

#include <algorithm>

#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/study/variants.h"

namespace glint {
namespace {

/// Draws band by band; may be stopped after each. Empty if it was.
Image supersampled(const StudyScene& scene, const Look& look, int samples, const Stop& stop) {
  Look fine = look;
  fine.antiAliasing = {AntiAliasing::Mode::ssaa, samples};
  ReferenceRenderer reference(scene.scene, scene.images, scene.bounds, fine);
  Image whole{look.resolution.x, look.resolution.y, {}}, band;
  for (int y = 0; y < look.resolution.y; y += reference.bandRows()) {
    if (stop && stop()) return {};
    reference.drawRows(y, std::min(reference.bandRows(), look.resolution.y - y), band);
    whole.values.insert(whole.values.end(), band.values.begin(), band.values.end());
  }
  return whole;
}

PictureError errorAt(const std::vector<std::uint32_t>& pixels, const Image& truth,
                     const Image& drawn, double exposureScale) {
  const auto radiances = [&](const Image& image) {
    Radiances values;
    values.reserve(pixels.size());
    for (const std::uint32_t pixel : pixels) {
      const float* p = image.values.data() + std::size_t(4) * pixel;
      values.emplace_back(p[0], p[1], p[2]);
    }
    return values;
  };
  return errorOf(radiances(truth), radiances(drawn), exposureScale);
}

}  // namespace

WholeTruth wholeTruthOf(const StudyScene& scene, const Look& given, Shading model, int samples,
                        const StudyMask& mask, const Stop& stop) {
  WholeTruth truth;
  truth.model = model;
  truth.samples = samples;
  Look look = exactLook(given, model);
  look.specularAntialiasing = SpecularAntialiasing::none;
  const Image coarse = supersampled(scene, look, samples / 2, stop);
  if (!coarse.values.empty()) truth.picture = supersampled(scene, look, samples, stop);
  if (!truth.picture.values.empty()) truth.own = wholeErrorOf(truth, coarse, mask, 1).picture;
  return truth;
}

WholeError wholeErrorOf(const WholeTruth& truth, const Image& drawn, const StudyMask& mask,
                        double exposureScale) {
  std::vector<std::uint32_t> covered;
  for (std::size_t i = 0; 4 * i < drawn.values.size(); ++i)
    if (drawn.values[4 * i + 3] > 0 || truth.picture.values[4 * i + 3] > 0)
      covered.push_back(std::uint32_t(i));
  return {errorAt(mask.pixels, truth.picture, drawn, exposureScale),
          errorAt(covered, truth.picture, drawn, exposureScale)};
}

std::vector<StudyWay> studyWays(const StudyScene& scene, const Look& given) {
  std::vector<StudyWay> ways;
  for (const Shading model : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
    using Filter = SpecularAntialiasing;
    const auto add = [&](const char* form, Filter filter, const AntiAliasing& samples) {
      StudyWay way;
      way.model = model;
      way.look = exactLook(given, model);
      setForms(way.look, form, "exact");
      way.look.specularAntialiasing = filter;
      way.look.antiAliasing = samples;
      way.name = std::string(shadingName(model)) + " " + form;
      if (filter != Filter::none)
        way.name += " " + std::string(specularAntialiasingNames[std::size_t(filter)]);
      if (samples.mode != AntiAliasing::Mode::none) way.name += " " + antiAliasingText(samples);
      const DrawList list = makeDrawList(scene.scene, scene.bounds, way.look);
      if (filter != Filter::none && !anyHas(list, &Variant::specularAntialiasing))
        return;  // no highlight, or no normal map
      ways.push_back(std::move(way));
    };
    const AntiAliasing none{AntiAliasing::Mode::none, 1}, msaa{AntiAliasing::Mode::msaa, 4};
    for (const char* form : {"exact", "lyon-tuned:16", "gaussian"}) {
      if (std::string_view(form) != "exact" && model == Shading::environment) continue;
      for (const Filter filter : {Filter::none, Filter::kaplanyan, Filter::toksvig})
        add(form, filter, none);
    }
    for (const Filter filter : {Filter::none, Filter::kaplanyan, Filter::toksvig})
      add("exact", filter, msaa);
    add("exact", Filter::none, {AntiAliasing::Mode::ssaa, 2});
  }
  return ways;
}

}  // namespace glint
