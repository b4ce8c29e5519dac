#include <cmath>
#include <nlohmann/json.hpp>

#include "glint/image/json_text.h"
#include "glint/scene/look_text.h"
#include "glint/study/advice.h"
#include "glint/study/report.h"
#include "glint/study/report_words.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

Json spreadJson(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  const Spread s = spreadOf(values);
  return {{"minimum", s.minimum}, {"lowerQuartile", s.lowerQuartile},
          {"median", s.median},   {"upperQuartile", s.upperQuartile},
          {"maximum", s.maximum}, {"frames", s.count}};
}

Json roundsJson(const std::vector<double>& times) {
  Json rounds = Json::array();  // in whole microseconds
  for (const double t : times) rounds.push_back(std::round(t * 1000) / 1000);
  return rounds;
}

Json timesJson(const FrameTimes& times) {
  return {{"wall", spreadJson(times.wall)},
          {"cpu", spreadJson(times.cpu)},
          {"query", spreadJson(times.query)},
          {"rounds", roundsJson(times.wall)},
          {"cpuRounds", roundsJson(times.cpu)}};
}

/// By name, for the clocks that were measured.
Json clocksJson(const StudyResult& r) {
  Json clocks = Json::object();
  for (std::size_t c = 0; c < frameClocks; ++c) {
    const ClockNoise& noise = r.noise[c];
    if (noise.spread == 0) continue;
    Json controls = Json::array();
    for (std::size_t i = 0; i < noise.ratios.size(); ++i)
      controls.push_back({{"variant", r.controls[i]},
                          {"ratio", noise.ratios[i].value},
                          {"low", noise.ratios[i].low},
                          {"high", noise.ratios[i].high}});
    clocks[std::string(clockName(FrameClock(c)))] = {{"spread", jsonNumber(noise.spread)},
                                                     {"controls", controls}};
  }
  return clocks;
}

Json errorJson(const PictureError& e) {
  return {{"max", jsonNumber(e.max)},
          {"p999", jsonNumber(e.percentile999)},
          {"rmse", jsonNumber(e.rmse)},
          {"relative-rmse", jsonNumber(e.relativeRmse)},
          {"offByMoreThanOneLevel", e.offByMore},
          {"levels", e.levels}};
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

Json wholeJson(const WholeError& e) {
  return {{"inside", errorJson(e.inside)}, {"picture", errorJson(e.picture)}};
}

Json waysJson(const StudyResult& r) {
  Json ways = Json::array();
  for (std::size_t i = 0; i < r.ways.size(); ++i) {
    const StudyWay& way = r.ways[i];
    Json entry{{"name", way.name},
               {"model", shadingName(way.model)},
               {"times", timesJson(way.times)},
               {"whole", wholeJson(way.error)}};
    if (const std::string place = wayPlaceWords(r, i); !place.empty()) entry["place"] = place;
    ways.push_back(entry);
  }
  return ways;
}

Json adviceJson(const StudyHead& head, const StudyResult& r) {
  Json forms = Json::array(), parts = Json::array();
  for (const AdvisedForm& form : advisedForms(head, r))
    forms.push_back({{"codes", form.codes},
                     {"variant", r.variants[form.variant].variant.name},
                     {"time", form.time.value},
                     {"low", form.time.low},
                     {"high", form.time.high}});
  for (const FramePart& part : r.parts)
    parts.push_back({{"name", part.name},
                     {"share", part.share.value},
                     {"low", part.share.low},
                     {"high", part.share.high}});
  return {{"text", adviceText(head, r)}, {"forms", forms}, {"parts", parts}};
}

}  // namespace

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
  json["clock"] = clockName(r.clock);
  json["spread"] = jsonNumber(r.spread());
  json["spreadLimit"] = r.spreadLimit;
  json["noFront"] = r.noFront.empty() ? Json(nullptr) : Json(r.noFront);
  json["clocks"] = clocksJson(r);
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
      error["open"] = Json::array();
      for (const std::string& metric : errorMetrics()) {
        const StudyFront* front = frontOf(r, e.against, metric);
        const FrontPlace* place = placeOf(front, i);
        if (!place) continue;
        error["fronts"][metric] = place->onFront ? Json(true) : Json(dominator(r, *front, *place));
        if (!place->onFront && !place->isSlower) error["open"].push_back(metric);
      }
      entry["errors"].push_back(error);
    }
    entry["parts"] = {{"shading", errorJson(v.shading)},
                      {"interpolation", errorJson(v.interpolation)}};
    if (v.whole) entry["whole"] = wholeJson(*v.whole);
    json["variants"].push_back(entry);
  }
  json["fronts"] = Json::array();
  for (const StudyFront& front : r.fronts) {
    Json names = Json::array(), open = Json::array();
    for (std::size_t i = 0; i < front.variants.size(); ++i) {
      const FrontPlace& place = front.places[i];
      if (place.onFront || !place.isSlower)
        (place.onFront ? names : open)
            .push_back(r.variants[std::size_t(front.variants[i])].variant.name);
    }
    json["fronts"].push_back({{"model", shadingName(front.model)},
                              {"metric", front.metric},
                              {"variants", names},
                              {"open", open}});
  }
  json["series"] = Json::array();
  for (const StudySeries& s : r.series) json["series"].push_back(seriesJson(s));
  json["advice"] = adviceJson(head, r);
  json["wholeTruths"] = Json::array();
  for (const WholeTruth& truth : r.wholeTruths)
    json["wholeTruths"].push_back({{"model", shadingName(truth.model)},
                                   {"samples", truth.samples},
                                   {"own", errorJson(truth.own)}});
  json["ways"] = waysJson(r);
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

}  // namespace glint
