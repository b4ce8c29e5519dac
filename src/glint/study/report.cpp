#include "glint/study/report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "glint/image/json_text.h"
#include "glint/scene/look_text.h"
#include "glint/study/format.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json jsonNumber(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json spreadJson(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  const Spread s = spreadOf(values);
  return {{"minimum", s.minimum}, {"lowerQuartile", s.lowerQuartile},
          {"median", s.median},   {"upperQuartile", s.upperQuartile},
          {"maximum", s.maximum}, {"frames", s.count}};
}

Json timesJson(const FrameTimes& times) {
  Json rounds = Json::array();  // in whole microseconds
  for (const double t : times.wall) rounds.push_back(std::round(t * 1000) / 1000);
  return {{"wall", spreadJson(times.wall)}, {"query", spreadJson(times.query)}, {"rounds", rounds}};
}

Json errorJson(const PictureError& e) {
  return {{"max", jsonNumber(e.max)},
          {"p999", jsonNumber(e.percentile999)},
          {"rmse", jsonNumber(e.rmse)},
          {"relative-rmse", jsonNumber(e.relativeRmse)},
          {"offByMoreThanOneLevel", e.offByMore},
          {"levels", e.levels}};
}

double median(const FrameTimes& times) {
  return times.wall.empty() ? 0 : quantile(times.wall, 0.5);
}

/// Nanoseconds that a frame takes above the empty one, for each pixel the model covers.
double perPixel(const StudyResult& r, const FrameTimes& times) {
  if (times.wall.empty() || r.floors.empty()) return 0;
  const auto above = [&] {
    std::vector<double> values = times.wall;
    const double floor = median(r.floors[0].times);
    for (double& v : values) v -= floor;
    return quantile(std::move(values), 0.5);
  }();
  return above * 1e6 / double(std::max<std::size_t>(1, r.mask.covered));
}

Json seriesJson(const StudySeries& s) {
  Json lines = Json::array();
  for (const SeriesLine& line : s.lines) {
    Json points = Json::array();
    for (const SeriesPoint& p : line.points)
      points.push_back({{"x", p.x},
                        {"max", jsonNumber(p.max)},
                        {"rmse", jsonNumber(p.rmse)},
                        {"relative-rmse", jsonNumber(p.relativeRmse)},
                        {"ms", p.milliseconds}});
    Json entry{{"name", line.name}, {"points", points}};
    if (s.hasOrders)
      entry["order"] = {{"max", jsonNumber(line.orderMax)}, {"rmse", jsonNumber(line.orderRmse)}};
    lines.push_back(entry);
  }
  return {{"name", s.name},
          {"title", s.title},
          {"axis", s.axis},
          {"note", s.note},
          {"logarithmic", s.logarithmic},
          {"errors", s.hasErrors},
          {"lines", lines}};
}

const StudyFront* frontOf(const StudyResult& r, Shading model, const std::string& metric) {
  for (const StudyFront& front : r.fronts)
    if (front.model == model && front.metric == metric) return &front;
  return nullptr;
}

/// Its place on the front of a model, or null.
const FrontPlace* placeOf(const StudyFront* front, std::size_t variant) {
  if (!front) return nullptr;
  for (std::size_t i = 0; i < front->variants.size(); ++i)
    if (front->variants[i] == int(variant)) return &front->places[i];
  return nullptr;
}

std::string dominator(const StudyResult& r, const StudyFront& front, const FrontPlace& place) {
  return r.variants[std::size_t(front.variants[std::size_t(place.dominatedBy)])].variant.name;
}

}  // namespace

std::vector<std::string> studyMethod(const StudyHead& head, const StudyResult& r) {
  const bool software = r.gl.renderer.find("llvmpipe") != std::string::npos;
  const char* threads = std::getenv("LP_NUM_THREADS");
  std::vector<std::string> all{
      formatted(
          "Variants, floors and controls take turns, in another order each round: %d rounds after "
          "%d that are not counted. They are shared by %d builds of all programs, since where a "
          "driver puts one may change how fast it is.",
          head.rounds, head.warmUp, head.builds),
      "wall: from the first GL call of a frame until glFinish returns, nothing read back.",
      software
          ? "query: GL_TIME_ELAPSED. llvmpipe counts in its rasteriser's threads, anew in each "
            "tile: a small part of a frame, which is why nothing here is judged by it."
          : "query: GL_TIME_ELAPSED, the time of the GPU alone.",
      formatted(
          "empty: the target is cleared and no more; constant: the same surface in one colour. ns "
          "per pixel: median above the empty frame, for each of the %zu covered pixels.",
          r.mask.covered),
      formatted("Two times differ only if the 95 %% bootstrap interval of the ratio of their lower "
                "quartiles is farther from 1 than the spread, %.1f %%: the most by which a variant "
                "differs from itself, built and measured twice (A/A).",
                100 * r.spread),
      formatted(
          "Errors: linear light before exposure, over %zu pixels, against double precision in the "
          "exact form. Left out of %zu covered: %zu at edges, %zu covered by one alone, %zu that "
          "show another or a blended surface.",
          r.mask.pixels.size(), r.mask.covered, r.mask.edge, r.mask.onlyOne, r.mask.other),
      "flat, gouraud and phong are compared with phong per pixel, blinn-phong and environment with "
      "themselves, blinn-phong with phong too.",
      "shading: form and rounding, from what the driver interpolated; interpolation: what that "
      "differs from the exact (of flat and gouraud: light interpolated in place of normals)."};
  if (head.longFrame > 0)
    all.push_back(formatted(
        "Half the usual width and height, since a frame of exact phong takes more than %g ms "
        "there.",
        head.longFrame));
  if (r.mask.sampledColors)
    all.emplace_back(
        "The driver's own samples of the textures count as given: their filtering is "
        "no error of shading.");
  all.push_back(
      formatted("Rasteriser's threads: %s; processors: %u; Mesa's cache of shaders is off.",
                threads ? threads : "the driver's choice", std::thread::hardware_concurrency()));
  return all;
}

Json studyJson(const StudyHead& head, const StudyResult& r) {
  Json json{
      {"glint", head.version},
      {"study", 1},
      {"complete", r.complete},
      {"missing", r.missing},
      {"quick", head.quick},
      {"model", head.model},
      {"backend", head.backend},
      {"gl", {{"vendor", r.gl.vendor}, {"renderer", r.gl.renderer}, {"version", r.gl.version}}},
      {"triangles", r.triangles},
      {"draws", r.draws},
      {"builds", head.builds},
      {"resolution", {head.look.resolution.x, head.look.resolution.y}}};
  json["mask"] = {{"pixels", r.mask.pixels.size()},
                  {"covered", r.mask.covered},
                  {"edge", r.mask.edge},
                  {"onlyOne", r.mask.onlyOne},
                  {"onlyOneEdge", r.mask.onlyOneEdge},
                  {"other", r.mask.other},
                  {"sampledColors", r.mask.sampledColors}};
  json["method"] = studyMethod(head, r);
  json["look"] = parsedJson<Json>(head.lookText);
  json["spread"] = r.spread;
  json["controls"] = Json::array();
  for (std::size_t i = 0; i < r.controls.size(); ++i) {
    const TimeRatio& ratio = r.controlRatios[i];
    json["controls"].push_back({{"variant", r.controls[i]},
                                {"ratio", ratio.value},
                                {"low", ratio.low},
                                {"high", ratio.high}});
  }
  json["floors"] = Json::array();
  for (const StudyFloor& floor : r.floors)
    json["floors"].push_back({{"name", floor.name},
                              {"times", timesJson(floor.times)},
                              {"nsPerPixel", perPixel(r, floor.times)}});
  json["variants"] = Json::array();
  for (std::size_t i = 0; i < r.variants.size(); ++i) {
    const VariantResult& v = r.variants[i];
    Json entry{{"name", v.variant.name},
               {"shading", shadingName(v.variant.program)},
               {"highlight", v.variant.highlight}};
    if (!v.variant.fresnel.empty()) entry["fresnel"] = v.variant.fresnel;
    if (v.variant.bound) entry["bound"] = jsonNumber(*v.variant.bound);
    entry["features"] = v.features;
    entry["ms"] = {{"compile", v.compile}, {"firstFrame", v.firstFrame}};
    entry["times"] = timesJson(v.times);
    entry["nsPerPixel"] = perPixel(r, v.times);
    entry["errors"] = Json::array();
    for (const VariantError& e : v.errors) {
      Json error = errorJson(e.whole);
      error["flip"] = e.flip;
      error["against"] = shadingName(e.against);
      error["fronts"] = Json::object();
      for (const std::string& metric : errorMetrics()) {
        const StudyFront* front = frontOf(r, e.against, metric);
        const FrontPlace* place = placeOf(front, i);
        if (!place) continue;
        error["fronts"][metric] = place->onFront ? Json(true) : Json(dominator(r, *front, *place));
      }
      entry["errors"].push_back(error);
    }
    entry["parts"] = {{"shading", errorJson(v.shading)},
                      {"interpolation", errorJson(v.interpolation)}};
    json["variants"].push_back(entry);
  }
  json["fronts"] = Json::array();
  for (const StudyFront& front : r.fronts) {
    Json names = Json::array();
    for (std::size_t i = 0; i < front.variants.size(); ++i)
      if (front.places[i].onFront)
        names.push_back(r.variants[std::size_t(front.variants[i])].variant.name);
    json["fronts"].push_back(
        {{"model", shadingName(front.model)}, {"metric", front.metric}, {"variants", names}});
  }
  json["series"] = Json::array();
  for (const StudySeries& s : r.series) json["series"].push_back(seriesJson(s));
  json["specialisation"] = Json::array();
  for (const Specialisation& s : r.specialisations)
    json["specialisation"].push_back(
        {{"program", s.program},
         {"specialised",
          {{"compile", s.compile}, {"firstFrame", s.first}, {"times", timesJson(s.times)}}},
         {"general",
          {{"compile", s.generalCompile},
           {"firstFrame", s.generalFirst},
           {"times", timesJson(s.generalTimes)}}},
         {"difference", jsonNumber(s.difference)}});
  return json;
}

std::string studyCsv(const StudyResult& r) {
  std::string csv =
      "variant,against,frames,wall_min_ms,wall_lower_quartile_ms,wall_median_ms,"
      "wall_upper_quartile_ms,query_median_ms,ns_per_pixel,compile_ms,first_frame_ms,max,p999,rmse,"
      "relative_rmse,flip,off_by_more_than_one_level,shading_max,shading_rmse,interpolation_max,"
      "interpolation_rmse,rmse_front,dominated_by\n";
  for (std::size_t i = 0; i < r.variants.size(); ++i) {
    const VariantResult& v = r.variants[i];
    const Spread wall = spreadOf(v.times.wall), query = spreadOf(v.times.query);
    for (const VariantError& e : v.errors) {
      const StudyFront* front = frontOf(r, e.against, "rmse");
      const FrontPlace* place = placeOf(front, i);
      csv += "\"" + v.variant.name + "\"," + std::string(shadingName(e.against)) + "," +
             formatted("%zu,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,", wall.count, wall.minimum,
                       wall.lowerQuartile, wall.median, wall.upperQuartile, query.median,
                       perPixel(r, v.times), v.compile, v.firstFrame) +
             formatted("%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,", e.whole.max, e.whole.percentile999,
                       e.whole.rmse, e.whole.relativeRmse, e.flip, e.whole.offByMore) +
             formatted("%.6g,%.6g,%.6g,%.6g,", v.shading.max, v.shading.rmse, v.interpolation.max,
                       v.interpolation.rmse) +
             (!place           ? ","
              : place->onFront ? "yes,"
                               : "no,\"" + dominator(r, *front, *place) + "\"") +
             "\n";
    }
  }
  return csv;
}

std::string studyTable(const StudyHead& head, const StudyResult& r) {
  std::string table =
      head.model + formatted(": %zu triangles, %zu draws, %d x %d pixels, %zu compared; %s\n",
                             r.triangles, r.draws, head.look.resolution.x, head.look.resolution.y,
                             r.mask.pixels.size(), r.gl.renderer.c_str());
  for (const StudyFloor& floor : r.floors)
    if (!floor.times.wall.empty())
      table += formatted("floor, %-9s %8.3f ms\n", floor.name.c_str(), median(floor.times));
  if (r.spread > 0) table += formatted("spread (A/A)    %8.1f %%\n", 100 * r.spread);
  for (const Shading model : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
    const StudyFront* front = frontOf(r, model, "rmse");
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < r.variants.size(); ++i)
      if (const VariantError* e = errorAgainst(r.variants[i], model))
        order.emplace_back(e->whole.rmse, i);
    if (order.empty()) continue;
    std::sort(order.begin(), order.end());
    int width = 32;
    for (const auto& [rmse, i] : order)
      width = std::max(width, int(r.variants[i].variant.name.size()));
    table +=
        formatted("\n%-*s %8s %17s %7s %9s %9s %9s %9s %7s  %s\n", width,
                  ("against exact " + std::string(shadingName(model))).c_str(), "ms", "quartiles",
                  "ns/px", "max", "p99.9", "rmse", "flip", ">1 lev", "front (rmse)");
    for (const auto& [rmse, i] : order) {
      const VariantResult& v = r.variants[i];
      const VariantError& e = *errorAgainst(v, model);
      const Spread wall = spreadOf(v.times.wall);
      const FrontPlace* place = placeOf(front, i);
      table += formatted("%-*s ", width, v.variant.name.c_str());
      table += wall.count == 0
                   ? formatted("%8s %17s %7s ", "-", "-", "-")
                   : formatted("%8.3f %8.3f-%8.3f %7.2f ", wall.median, wall.lowerQuartile,
                               wall.upperQuartile, perPixel(r, v.times));
      table += formatted("%9.2e %9.2e %9.2e %9.2e %6.2f%%  %s\n", e.whole.max,
                         e.whole.percentile999, e.whole.rmse, e.flip, 100 * e.whole.offByMore,
                         !place           ? ""
                         : place->onFront ? "on the front"
                                          : ("by " + dominator(r, *front, *place)).c_str());
    }
  }
  if (!r.complete) {
    table += "\nincomplete: ended before";
    for (const std::string& what : r.missing) table += " " + what + ";";
    table += "\n";
  }
  return table;
}

}  // namespace glint
