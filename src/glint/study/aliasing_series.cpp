#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/study/series.h"
#include "glint/study/statistics.h"

// Aliasing of small pictures: over the exponent, next to the errors of forms; over the distance, as
// a model moves away; and over time, as the change of a highlight from one picture to the next.
namespace glint {
namespace {

constexpr int smallSize = 128;  ///< pixels of the longer side

Look smallLook(const SeriesTools& tools, int size) {
  Look look = exactLook(tools.look, Shading::phong);
  look.resolution = resolutionOf(look, size);
  return look;
}

/// A way to treat aliasing.
struct Way {
  const char* name;
  SpecularAntialiasing filter;
  AntiAliasing samples;
};
using Filter = SpecularAntialiasing;
const Way ways[] = {{"one sample", Filter::none, {AntiAliasing::Mode::none, 1}},
                    {"kaplanyan", Filter::kaplanyan, {AntiAliasing::Mode::none, 1}},
                    {"toksvig", Filter::toksvig, {AntiAliasing::Mode::none, 1}},
                    {"msaa:4", Filter::none, {AntiAliasing::Mode::msaa, 4}},
                    {"msaa:4 kaplanyan", Filter::kaplanyan, {AntiAliasing::Mode::msaa, 4}},
                    {"msaa:4 toksvig", Filter::toksvig, {AntiAliasing::Mode::msaa, 4}},
                    {"ssaa:2", Filter::none, {AntiAliasing::Mode::ssaa, 2}}};

/// Draws small pictures of one size: each kind of anti-aliasing has its own renderer.
class SmallPictures {
 public:
  explicit SmallPictures(const SeriesTools& tools) : tools_(tools) {}

  Image draw(const Look& look) {
    return renderers_[antiAliasingText(look.antiAliasing)].draw(
        tools_.gpu, makeDrawList(tools_.scene.scene, tools_.scene.bounds, look), look);
  }
  Image draw(const Look& look, const Way& way) { return draw(lookOf(look, way)); }
  /// Whether a way's filter changes anything.
  bool has(const Look& look, const Way& way) const {
    return way.filter == Filter::none ||
           anyItem(tools_, lookOf(look, way), &Variant::specularAntialiasing);
  }
  /// Begins the picture of a way, for timing.
  Renderer::Picture begin(const Look& given, const Way& way) {
    const Look look = lookOf(given, way);
    return renderers_[antiAliasingText(look.antiAliasing)].begin(
        tools_.gpu, makeDrawList(tools_.scene.scene, tools_.scene.bounds, look), look);
  }
  StudyMask mask(Look look) {
    look.antiAliasing = ways[0].samples;
    return maskOf(renderers_[antiAliasingText(look.antiAliasing)], tools_.gpu, tools_.scene, look);
  }
  WholeTruth truth(const Look& look, const StudyMask& mask) {
    return wholeTruthOf(tools_.scene, look, Shading::phong, tools_.quick ? 8 : 16, mask,
                        tools_.stop);
  }

 private:
  static Look lookOf(Look look, const Way& way) {
    look.specularAntialiasing = way.filter;
    look.antiAliasing = way.samples;
    return look;
  }

  const SeriesTools& tools_;
  std::map<std::string, Renderer> renderers_;
};

/// Adds a point to the line of each way that the driver and the scene support; `draw` returns its
/// picture.
template <typename Draw>
void addWays(StudySeries& series, const SmallPictures& pictures, const Look& look, double x,
             const WholeTruth& truth, const StudyMask& mask, const Draw& draw) {
  for (std::size_t k = 0; k < std::size(ways); ++k) try {
      if (!pictures.has(look, ways[k])) continue;
      series.lines[k].points.push_back(
          pointOf(x, wholeErrorOf(truth, draw(ways[k]), mask, 1).inside));
    } catch (const InputError&) {  // the driver has fewer samples
    }
}

/// Times the ways that have a point at x, in turn.
void timeWays(StudySeries& series, SmallPictures& pictures, const Look& look, double x,
              const SeriesTools& tools) {
  std::deque<Renderer::Picture> begun;
  std::vector<Renderer::Picture*> all;
  std::vector<SeriesPoint*> points;
  for (std::size_t k = 0; k < std::size(ways); ++k) {
    SeriesLine& line = series.lines[k];
    if (line.points.empty() || line.points.back().x != x) continue;
    points.push_back(&line.points.back());
    all.push_back(&begun.emplace_back(pictures.begin(look, ways[k])));
  }
  if (all.empty()) return;
  const auto times = timeInTurn(all, tools.timing(tools.rounds));
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!times[i].wall.empty()) points[i]->milliseconds = quantile(times[i].by(tools.clock), 0.5);
}

StudySeries seriesOfWays(const char* name, const char* title, const char* axis, const char* note) {
  StudySeries series{name, title, axis, note};
  for (const Way& way : ways) series.lines.push_back({way.name, {}});
  return series;
}

StudySeries finished(StudySeries series) {
  std::erase_if(series.lines, [](const SeriesLine& line) { return line.points.empty(); });
  return series;
}

/// The look with its camera moved so that the model's centre moves by `pixels`.
Look movedLook(const SeriesTools& tools, const Look& look, const glm::dvec2& pixels) {
  const StudyScene& s = tools.scene;
  Look moved = definiteLook(look, s.scene, s.bounds);
  const Camera camera = cameraFor(s.scene, s.bounds, moved);
  const double away = camera.orthographic ? 1.0 : glm::length(camera.eye - s.bounds.center);
  const double pixel = 2 * camera.halfHeight * away / look.resolution.y;
  const glm::dvec3 way = camera.axes * glm::dvec3(-pixel * pixels, 0.0);
  *moved.cameraPosition += way;
  *moved.cameraFocalPoint += way;
  return moved;
}

/// Mostly highlight: no filter of highlights corrects what bumps do to diffuse light.
ShadingParameters bumpyMaterial() {
  ShadingParameters lacquer = sphereMaterial();
  lacquer.diffuse = 0.2;
  return lacquer;
}

/// The scene and the tools for series of the sphere with a normal map.
struct BumpyTools {
  StudyScene scene{bumpySphereScene(bumpyMaterial()), bumpyImages()};
  GpuScene gpu{scene.scene, scene.images};
  SeriesTools tools;

  explicit BumpyTools(const SeriesTools& given)
      : tools{scene,        gpu,        given.renderer, {},         given.quick, given.warmUp,
              given.rounds, given.stop, given.progress, given.clock} {
    tools.look.antiAliasing = {AntiAliasing::Mode::none, 1};
    tools.look.resolution = glm::ivec2(smallSize);
    tools.look.noBackground = true;
    tools.look.specularAntialiasing = Filter::none;
  }
};

void subtract(Image& from, const Image& what) {
  for (std::size_t i = 0; i < from.values.size(); ++i) from.values[i] -= what.values[i];
}

}  // namespace

std::optional<StudySeries> aliasingSeries(const SeriesTools& tools) {
  Look look = smallLook(tools, smallSize);
  if (!anyItem(tools, look, &Variant::specular)) return {};
  StudySeries series = seriesOfWays(
      "aliasing", "Aliasing of a small picture over the exponent", "exponent α",
      "phong, 128 pixels across, where a surface covers all of a pixel: against the supersampled "
      "exact picture; lyon:8 against one exact sample a pixel, which is the error of the form "
      "alone");
  series.lines.push_back({"lyon:8, the form", {}});
  SmallPictures pictures(tools);
  const StudyMask mask = pictures.mask(look);
  std::vector<double> exponents{10, 100, 1000, 10000};
  if (tools.quick) exponents = {100, 10000};
  for (std::size_t i = 0; i < exponents.size() && !tools.stopped(); ++i) {
    look.material[""].exponent = exponents[i];
    const WholeTruth truth = pictures.truth(look, mask);
    if (truth.picture.values.empty()) break;
    addWays(series, pictures, look, exponents[i], truth, mask,
            [&](const Way& way) { return pictures.draw(look, way); });
    Look lyon = look;
    setForms(lyon, "lyon:8", "exact");
    const Radiances single = truthOf(tools.scene, look, Shading::phong, mask);
    series.lines.back().points.push_back(
        pointOf(exponents[i], errorOf(single, radiancesOf(pictures.draw(lyon), mask))));
    tools.tell(double(i + 1) / double(exponents.size()));
  }
  return finished(std::move(series));
}

std::optional<StudySeries> distanceSeries(const SeriesTools& tools) {
  if (!anyItem(tools, smallLook(tools, smallSize), &Variant::specular)) return {};
  StudySeries series =
      seriesOfWays("distance", "Aliasing as the model moves away", "pixels across",
                   "phong, where a surface covers all of a pixel: against the supersampled exact "
                   "picture");
  std::vector<int> sizes{256, 128, 64, 32};
  if (tools.quick) sizes = {128, 32};
  for (std::size_t i = 0; i < sizes.size() && !tools.stopped(); ++i) {
    const Look look = smallLook(tools, sizes[i]);
    SmallPictures pictures(tools);
    const StudyMask mask = pictures.mask(look);
    if (mask.pixels.empty()) break;
    const WholeTruth truth = pictures.truth(look, mask);
    if (truth.picture.values.empty()) break;
    addWays(series, pictures, look, sizes[i], truth, mask,
            [&](const Way& way) { return pictures.draw(look, way); });
    timeWays(series, pictures, look, sizes[i], tools);
    tools.tell(double(i + 1) / double(sizes.size()));
  }
  return finished(std::move(series));
}

std::optional<StudySeries> motionSeries(const SeriesTools& tools) {
  Look look = smallLook(tools, smallSize);
  if (!anyItem(tools, look, &Variant::specular)) return {};
  StudySeries series = seriesOfWays(
      "motion", "Flicker: how the change from one picture to the next is off", "exponent α",
      "phong, 128 pixels across, the model moved by 0.5 and 0.25 pixels, where a surface covers "
      "all of "
      "a pixel in both pictures: their difference against that of the supersampled exact pictures");
  SmallPictures pictures(tools);
  const auto moved = [&] { return movedLook(tools, look, {0.5, 0.25}); };
  const StudyMask before = pictures.mask(look), after = pictures.mask(moved());
  StudyMask both;
  std::set_intersection(before.pixels.begin(), before.pixels.end(), after.pixels.begin(),
                        after.pixels.end(), std::back_inserter(both.pixels));
  if (both.pixels.empty()) return {};
  std::vector<double> exponents{10, 100, 1000, 10000};
  if (tools.quick) exponents = {1000};
  for (std::size_t i = 0; i < exponents.size() && !tools.stopped(); ++i) {
    look.material[""].exponent = exponents[i];
    const Look next = moved();
    const WholeTruth first = pictures.truth(look, both);
    WholeTruth change = pictures.truth(next, both);
    if (first.picture.values.empty() || change.picture.values.empty()) break;
    subtract(change.picture, first.picture);
    addWays(series, pictures, look, exponents[i], change, both, [&](const Way& way) {
      Image drawn = pictures.draw(next, way);
      subtract(drawn, pictures.draw(look, way));
      return drawn;
    });
    tools.tell(double(i + 1) / double(exponents.size()));
  }
  return finished(std::move(series));
}

std::optional<StudySeries> bumpsSeries(const SeriesTools& tools) {
  auto series = distanceSeries(BumpyTools(tools).tools);
  if (!series) return {};
  series->name = "bumps";
  series->title = "Aliasing of a bumpy sphere as it moves away";
  series->note =
      "phong, a built-in sphere with a normal map of waves of 10 texels, slopes of 0.15, diffuse "
      "0.2, "
      "α = 40: against the supersampled exact picture";
  return series;
}

std::optional<StudySeries> bumpsMotionSeries(const SeriesTools& tools) {
  auto series = motionSeries(BumpyTools(tools).tools);
  if (!series) return {};
  series->name = "bumps-motion";
  series->title = "Flicker of a bumpy sphere";
  series->note =
      "phong, the sphere of the series bumps, 128 pixels across, moved by 0.5 and 0.25 pixels: the "
      "difference of both pictures against that of the supersampled exact ones";
  return series;
}

}  // namespace glint
