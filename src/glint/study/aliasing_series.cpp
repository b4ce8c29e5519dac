#include <algorithm>
#include <cmath>
#include <map>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/study/series.h"

// Aliasing of a small picture over the exponent: how it compares with what forms are off by.
namespace glint {
namespace {

constexpr int smallSize = 128;  ///< pixels of the longer side

SeriesPoint pointOf(double x, const PictureError& e) {
  SeriesPoint point;
  point.x = x;
  point.max = e.max;
  point.rmse = e.rmse;
  point.relativeRmse = e.relativeRmse;
  return point;
}

}  // namespace

std::optional<StudySeries> aliasingSeries(const SeriesTools& tools) {
  Look look = exactLook(tools.look, Shading::phong);
  const double shrink = double(smallSize) / std::max(look.resolution.x, look.resolution.y);
  look.resolution =
      glm::max(glm::ivec2(1), glm::ivec2(glm::round(shrink * glm::dvec2(look.resolution))));
  const DrawList list = makeDrawList(tools.scene.scene, tools.scene.bounds, look);
  if (std::ranges::none_of(list.items, [](const DrawItem& item) { return item.variant.specular; }))
    return {};
  StudySeries series;
  series.name = "aliasing";
  series.title = "Aliasing of a small picture over the exponent";
  series.axis = "exponent α";
  series.note =
      "phong, 128 pixels across, where a surface covers all of a pixel: against the supersampled "
      "exact picture; lyon:8 against one exact sample a pixel, which is the error of the form "
      "alone";
  struct Way {
    const char* name;
    bool filtered;
    AntiAliasing samples;
  };
  const AntiAliasing none{AntiAliasing::Mode::none, 1}, msaa{AntiAliasing::Mode::msaa, 4};
  const Way ways[] = {{"one sample", false, none},
                      {"filtered", true, none},
                      {"msaa:4", false, msaa},
                      {"msaa:4 filtered", true, msaa},
                      {"ssaa:2", false, {AntiAliasing::Mode::ssaa, 2}}};
  for (const Way& way : ways) series.lines.push_back({way.name, {}});
  series.lines.push_back({"lyon:8, the form", {}});
  std::map<std::string, Renderer> renderers;
  const auto drawn = [&](const Look& of) {
    return drawList(renderers[antiAliasingText(of.antiAliasing)], tools.gpu,
                    makeDrawList(tools.scene.scene, tools.scene.bounds, of), of);
  };
  const StudyMask mask = maskOf(renderers[antiAliasingText(none)], tools.gpu, tools.scene, look);
  std::vector<double> exponents{10, 100, 1000, 10000};
  if (tools.quick) exponents = {100, 10000};
  for (std::size_t i = 0; i < exponents.size() && !tools.stopped(); ++i) {
    const double exponent = exponents[i];
    look.material[""].exponent = exponent;
    const WholeTruth truth =
        wholeTruthOf(tools.scene, look, Shading::phong, tools.quick ? 8 : 16, mask, tools.stop);
    if (truth.picture.values.empty()) break;
    for (std::size_t k = 0; k < std::size(ways); ++k) {
      Look own = look;
      own.specularAntialiasing = ways[k].filtered;
      own.antiAliasing = ways[k].samples;
      try {
        series.lines[k].points.push_back(
            pointOf(exponent, wholeErrorOf(truth, drawn(own), mask, 1).inside));
      } catch (const InputError&) {  // a driver without so many samples
      }
    }
    Look lyon = look;
    setForms(lyon, "lyon:8", "exact");
    const Radiances single = truthOf(tools.scene, look, Shading::phong, mask);
    series.lines.back().points.push_back(
        pointOf(exponent, errorOf(single, radiancesOf(drawn(lyon), mask))));
    tools.tell(double(i + 1) / double(exponents.size()));
  }
  std::erase_if(series.lines, [](const SeriesLine& line) { return line.points.empty(); });
  return series;
}

}  // namespace glint
