#include "glint/study/series.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glint/scene/look_text.h"
#include "glint/shading/angles.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

/// A program in each of its forms over a number of every material.
StudySeries formSeries(const SeriesTools& tools, Shading program,
                       const std::vector<std::string>& forms,
                       std::optional<double> MaterialEdit::*number,
                       const std::vector<double>& values, StudySeries series) {
  SeriesDrawer drawer(tools, std::move(series));
  const StudyMask mask = maskOf(tools.renderer, tools.gpu, tools.scene, tools.look);
  for (std::size_t i = 0; i < values.size() && !tools.stopped(); ++i) {
    Look look = exactLook(tools.look, program);
    look.material[""].*number = values[i];
    const Radiances truth = truthOf(tools.scene, look, program, mask);
    for (const std::string& form : forms) {
      setForms(look, program == Shading::phong ? form : "exact",
               program == Shading::phong ? "exact" : form);
      drawer.add(form, values[i], look, &mask, &truth);
    }
    tools.tell(0.5 * double(i + 1) / double(values.size()));
  }
  return drawer.finish();
}

constexpr Shading lightPrograms[] = {Shading::flat, Shading::gouraud, Shading::phong,
                                     Shading::blinnPhong};

}  // namespace

SeriesDrawer::SeriesDrawer(const SeriesTools& tools, StudySeries series)
    : tools_(tools), series_(std::move(series)) {}

void SeriesDrawer::add(const std::string& name, double x, const Look& look, const StudyMask* mask,
                       const Radiances* truth) {
  add(name, x, tools_.gpu, tools_.scene, look, mask, truth);
}

void SeriesDrawer::add(const std::string& name, double x, GpuScene& gpu, const StudyScene& scene,
                       const Look& look, const StudyMask* mask, const Radiances* truth) {
  auto line = std::find_if(series_.lines.begin(), series_.lines.end(),
                           [&](const SeriesLine& l) { return l.name == name; });
  if (line == series_.lines.end()) {
    series_.lines.push_back({name, {}});
    line = series_.lines.end() - 1;
  }
  DrawList list = makeDrawList(scene.scene, scene.bounds, look);
  PictureError error;
  if (mask && truth)
    error = errorOf(*truth, radiancesOf(tools_.renderer.draw(gpu, list, look), *mask));
  trials_.push_back({std::size_t(line - series_.lines.begin()), line->points.size(),
                     tools_.renderer.begin(gpu, std::move(list), look)});
  line->points.push_back(pointOf(x, error));
}

StudySeries SeriesDrawer::finish() {
  std::vector<Renderer::Picture*> pictures;
  for (Trial& trial : trials_) pictures.push_back(&trial.picture);
  const int whole = tools_.warmUp + tools_.rounds;
  Timing timing = tools_.timing(tools_.rounds);
  timing.done = [&](int round) { tools_.tell(0.5 + 0.5 * (round + tools_.warmUp + 1) / whole); };
  const auto times = timeInTurn(pictures, timing);
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (!times[i].wall.empty())
      series_.lines[trials_[i].line].points[trials_[i].point].milliseconds =
          quantile(times[i].by(tools_.clock), 0.5);
  if (series_.hasOrders) setOrders(series_);
  return std::move(series_);
}

void setOrders(StudySeries& series) {
  for (SeriesLine& line : series.lines) {
    if (line.points.size() < 2) continue;
    const SeriesPoint &coarse = line.points[line.points.size() - 2], &fine = line.points.back();
    const double step = std::log(coarse.x / fine.x);
    line.orderMax = std::log(coarse.max / fine.max) / step;
    line.orderRmse = std::log(coarse.rmse / fine.rmse) / step;
  }
}

std::optional<StudySeries> exponentSeries(const SeriesTools& tools) {
  if (!anyItem(tools, exactLook(tools.look, Shading::phong), &Variant::specular)) return {};
  return formSeries(tools, Shading::phong, lobeForms(tools.quick), &MaterialEdit::exponent,
                    tools.quick ? std::vector<double>{5, 20, 100, 1000}
                                : std::vector<double>{5, 10, 20, 50, 100, 200, 500, 1000, 10000},
                    {"exponent", "Forms of the highlight over the exponent", "exponent α",
                     "phong in each form against exact phong; every material's exponent is α"});
}

std::optional<StudySeries> iorSeries(const SeriesTools& tools) {
  if (!anyItem(tools, exactLook(tools.look, Shading::environment), &Variant::dielectric)) return {};
  return formSeries(
      tools, Shading::environment, reflectanceForms(tools.quick), &MaterialEdit::ior,
      tools.quick ? std::vector<double>{1.1, 1.33, 1.5, 2.4}
                  : std::vector<double>{1.05, 1.1, 1.2, 1.33, 1.5, 1.8, 2.4, 4},
      {"ior", "Forms of the reflectance over the index of refraction", "index of refraction n",
       "environment in each form against exact environment; every material's index "
       "is n"});
}

std::optional<StudySeries> lightSeries(const SeriesTools& tools) {
  SeriesDrawer drawer(tools, {"lights", "Programs over the number of lights", "lights",
                              "directional lights from the front with the total intensity of one; "
                              "exact forms against exact phong, blinn-phong against itself"});
  std::vector<int> counts{1, 2, 4, 8, 16, 32, 64};
  if (tools.quick) counts = {1, 8, 64};
  const StudyMask mask = maskOf(tools.renderer, tools.gpu, tools.scene, tools.look);
  for (std::size_t i = 0; i < counts.size() && !tools.stopped(); ++i) {
    Look lit = tools.look;
    lit.noLights = false;
    lit.light = spreadLights(counts[i], 75, Light::Type::camera);
    const Radiances phong = truthOf(tools.scene, lit, Shading::phong, mask);
    for (const Shading program : lightPrograms) {
      const Look look = exactLook(lit, program);
      const Radiances blinn =
          program == Shading::blinnPhong ? truthOf(tools.scene, lit, program, mask) : Radiances();
      drawer.add(std::string(shadingName(program)), counts[i], look, &mask,
                 blinn.empty() ? &phong : &blinn);
    }
    tools.tell(0.5 * double(i + 1) / double(counts.size()));
  }
  return drawer.finish();
}

std::optional<StudySeries> resolutionSeries(const SeriesTools& tools) {
  StudySeries whole{"resolution", "Programs over the resolution", "pixels of the picture",
                    "time only; exact forms; constant aspect ratio"};
  whole.hasErrors = false;
  // Relative to the study's own picture; other series draw it at half the width.
  std::vector<double> scales{0.125, 0.25, 0.5, 1, 2};
  if (tools.quick) scales = {0.25, 0.5, 1};
  const glm::dvec2 size(2 * tools.look.resolution);
  for (std::size_t i = 0; i < scales.size() && !tools.stopped(); ++i) {
    Renderer renderer;  // its target is of this size
    SeriesTools sized{tools.scene,  tools.gpu,    renderer,   tools.look, tools.quick,
                      tools.warmUp, tools.rounds, tools.stop, {},         tools.clock};
    sized.look.resolution = glm::max(glm::ivec2(1), glm::ivec2(glm::round(scales[i] * size)));
    SeriesDrawer drawer(sized, whole);
    for (const Shading program : lightPrograms)
      drawer.add(std::string(shadingName(program)),
                 double(sized.look.resolution.x) * sized.look.resolution.y,
                 exactLook(sized.look, program), nullptr, nullptr);
    StudySeries part = drawer.finish();
    if (part.lines[0].points.back().milliseconds > 0) whole = std::move(part);
    tools.tell(double(i + 1) / double(scales.size()));
  }
  return whole;
}

}  // namespace glint
