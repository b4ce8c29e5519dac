#include "diff_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "glint/image/file.h"
#include "glint/image/json_text.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

/// The text with invalid UTF-8 replaced.
std::string utf8(const std::string& text) {
  return parsedJson<Json>(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

std::string xmlText(const std::string& text) {
  std::string safe;
  for (const char letter : utf8(text)) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(letter) < 0x20 && letter != '\n' ? '?' : letter;
    }
  }
  return safe;
}

std::size_t countOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<std::size_t>() : 0;
}

std::string joined(const Json& json, const char* key) {
  std::string text;
  if (const auto found = json.find(key); found != json.end())
    for (const Json& part : *found)
      if (part.is_string()) text += (text.empty() ? "" : "; ") + part.get<std::string>();
  return text;
}

std::string failureText(const Json& pair) {
  const std::string error = textOf(pair, "error");
  return error.empty() ? joined(pair, "failures") : error;
}

/// The value of a metric, or an empty text.
std::string metricText(const Json& pair, const std::string& name) {
  const auto metrics = pair.find("metrics");
  if (metrics == pair.end() || !metrics->contains(name)) return "";
  const Json& value = (*metrics)[name]["value"];
  if (value.is_number()) return shortNumber(value.get<double>());
  // The PSNR of equal pictures is infinite; a metric without any numbers is NaN.
  const bool equal =
      name == "psnr" && metrics->contains("max") && (*metrics)["max"]["value"].is_number();
  return equal ? "inf" : "nan";
}

/// The metrics of a comparison.
Json metricsJson(const Comparison& r, const CompareOptions& options) {
  Json metrics = Json::object();
  for (const std::string& name : metricNames()) {
    const auto found = r.values.find(name);
    if (found == r.values.end()) continue;
    Json& metric = metrics[name];
    metric["value"] = jsonNumber(found->second);
    const bool hdr = name == "hdr-flip";
    if (name == "flip" || hdr) {
      const FlipResult& flip = hdr ? r.hdrFlip : r.flip;
      metric["mean"] = jsonNumber(flip.mean);
      metric["max"] = jsonNumber(flip.maximum);
      metric["weightedMedian"] = flip.median;
      metric["weightedQuartiles"] = {flip.firstQuartile, flip.thirdQuartile};
      metric["pixelsPerDegree"] = options.flip.pixelsPerDegree;
      if (hdr) {
        const ToneMapper mapper = options.flip.toneMapper;
        metric["startExposure"] = jsonNumber(flip.startExposure);
        metric["stopExposure"] = jsonNumber(flip.stopExposure);
        metric["exposures"] = flip.exposures;
        metric["toneMapper"] = mapper == ToneMapper::aces    ? "aces"
                               : mapper == ToneMapper::hable ? "hable"
                                                             : "reinhard";
      } else if (r.aboveOne > 0) {
        metric["clampedPixels"] = r.aboveOne;
      }
    }
    if (name == "pixels") {
      metric["tolerance"] = options.tolerance;
      metric["distance"] =
          options.distance == PixelDistance::yiq ? "as pixelmatch 7.2" : "as pixelmatch 8.0";
      if (options.window > 0) metric["window"] = options.window;
      if (options.shift > 0) metric["shift"] = options.shift;
      for (const PixelLimit& limit : options.maxPixels)
        metric["atMost"].push_back(limit.isShare ? shortNumber(limit.most * 100) + "%"
                                                 : shortNumber(limit.most));
    }
    for (const Condition& condition : options.conditions)
      if (condition.metric == name) metric["threshold"] = condition.threshold;
  }
  return metrics;
}

Json worstJson(const Comparison& r) {
  Json worst = Json::array();
  for (const WorstPixel& pixel : r.worst) {
    Json a = Json::array(), b = Json::array();
    for (std::size_t c = 0; c < 4; ++c) {
      a.push_back(jsonNumber(pixel.a[c]));
      b.push_back(jsonNumber(pixel.b[c]));
    }
    worst.push_back({{"x", pixel.x},
                     {"y", pixel.y},
                     {"a", a},
                     {"b", b},
                     {"difference", jsonNumber(pixel.difference)}});
  }
  return worst;
}

/// The number of regions, and the worst of them.
void addRegions(const Comparison& r, Json& json) {
  if (r.regions.empty()) return;
  json["regionCount"] = r.regions.size();
  json["regions"] = Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(r.regions.size(), 100); ++i) {
    const DifferingRegion& region = r.regions[i];
    json["regions"].push_back({{"left", region.box.left},
                               {"top", region.box.top},
                               {"right", region.box.right},
                               {"bottom", region.box.bottom},
                               {"pixels", region.pixels},
                               {"difference", jsonNumber(region.difference)}});
  }
}

}  // namespace

std::string textOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string driverNote(const DiffEntry& entry) {
  for (const char* key : {"GL_RENDERER", "GL_VERSION", "GL_VENDOR"}) {
    const auto a = entry.textA.find(key), b = entry.textB.find(key);
    if (a != entry.textA.end() && b != entry.textB.end() && a->second != b->second)
      return "compared across drivers: " + a->second + " and " + b->second;
  }
  return "";
}

std::string jsonText(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json diffJson(const DiffEntry& entry, const CompareOptions& options) {
  Json json{{"name", entry.name}, {"a", entry.a}, {"b", entry.b}, {"status", entry.status}};
  if (!entry.textA.empty()) json["textA"] = entry.textA;
  if (!entry.textB.empty()) json["textB"] = entry.textB;
  if (!entry.error.empty()) {
    json["error"] = entry.error;
    return json;
  }
  const Comparison& r = entry.result;
  json["same"] = r.same;
  json["failures"] = r.failures;
  std::vector<std::string> notes = entry.notes;
  const bool flipAsked =
      std::any_of(options.conditions.begin(), options.conditions.end(),
                  [](const Condition& condition) { return condition.metric == "flip"; }) ||
      std::count(options.metrics.begin(), options.metrics.end(), "flip") > 0;
  if (r.aboveOne > 0 && flipAsked)
    notes.push_back("flip clamps " + std::to_string(r.aboveOne) +
                    " pixels above 1; hdr-flip does not");
  if (!entry.notCompared.empty()) {
    std::string text;
    for (const std::string& what : entry.notCompared) text += (text.empty() ? "" : ", ") + what;
    notes.push_back("not compared: " + text);
    json["notCompared"] = entry.notCompared;
  }
  if (!notes.empty()) json["notes"] = notes;
  if (!entry.unfollowed.empty()) json["notFollowed"] = entry.unfollowed;
  if (entry.updated) json["updated"] = true;
  if (entry.removed) json["removed"] = true;
  if (entry.acrossDrivers) json["acrossDrivers"] = true;
  json["ms"] = entry.milliseconds;
  if (r.values.empty()) return json;  // nothing to compare
  json["width"] = r.width;
  json["height"] = r.height;
  json["sizesDiffer"] = r.sizesDiffer;
  json["values"] = r.space == ValueSpace::encoded ? "encoded" : "linear";
  json["pixels"] = r.pixels;
  json["ignoredPixels"] = r.ignoredPixels;
  json["differing"] = r.differing;
  json["antiAliased"] = r.antiAliased;
  json["nan"] = {{"a", r.nanA}, {"b", r.nanB}};
  json["infinite"] = {{"a", r.infinityA}, {"b", r.infinityB}, {"differing", r.infinityDiffering}};
  if (!entry.mainName.empty()) json["layer"] = entry.mainName;
  json["metrics"] = metricsJson(r, options);
  json["worst"] = worstJson(r);
  // The regions and the worst pixels belong to the layer that is shown.
  addRegions(r, json);
  for (const LayerResult& layer : entry.layers) {
    Json part{{"name", layer.name},
              {"same", layer.result.same},
              {"differing", layer.result.differing},
              {"metrics", metricsJson(layer.result, options)},
              {"worst", worstJson(layer.result)}};
    addRegions(layer.result, part);
    json["layers"].push_back(part);
  }
  if (entry.shown != entry.mainName) json["shown"] = entry.shown;
  return json;
}

std::string diffLine(const Json& pair) {
  const std::string name = printablePath(textOf(pair, "name"));
  if (pair.contains("error")) return name + ": " + textOf(pair, "error");
  std::string line = name + ": ";
  const bool same = pair.value("same", false), shownOnly = pair.contains("shown");
  std::size_t layers = 0;
  if (const auto found = pair.find("layers"); found != pair.end())
    for (const Json& layer : *found) layers += countOf(layer, "differing") > 0;
  if (pair.value("updated", false) || pair.value("removed", false)) {
    line += joined(pair, "notes");
    return line;
  }
  line += same ? "same" : "differs";
  if (same && countOf(pair, "differing") == 0 && layers == 0) {
    line += ", equal in every pixel";
  } else if (pair.contains("metrics")) {
    // Reports what differs: the main picture, or the first layer that does.
    const Json* told = &pair;
    if (shownOnly)
      for (const Json& layer : pair["layers"])
        if (layer["name"] == pair["shown"]) told = &layer;
    if (told != &pair) line += ", layer " + printablePath(textOf(pair, "shown"));
    for (const std::string& metric : metricNames()) {
      const std::string value = metricText(*told, metric);
      if (value.empty() || metric == "mean" || metric == "relative-rmse") continue;
      line += ", " + metric + " " + value;
    }
    line += ", " + std::to_string(countOf(*told, "differing")) + " of " +
            std::to_string(countOf(pair, "pixels")) + " pixels differ";
  }
  if (const std::string failures = failureText(pair); !failures.empty())
    line += " (" + failures + ")";
  if (const auto worst = pair.find("worst"); !same && worst != pair.end() && !worst->empty())
    line += "; worst at " + std::to_string((*worst)[0]["x"].get<int>()) + "," +
            std::to_string((*worst)[0]["y"].get<int>());
  if (const std::string notes = joined(pair, "notes"); !notes.empty()) line += "; " + notes;
  return line;
}

std::string notFollowedText(const Json& pair) {
  std::string text;
  if (const auto found = pair.find("notFollowed"); found != pair.end())
    for (const auto& [what, value] : found->items())
      text += (text.empty() ? "" : ", ") + what +
              (value == "yes" ? "" : " (" + value.get<std::string>() + ")");
  return text;
}

std::string junitXml(const Json& pairs) {
  std::size_t failures = 0, errors = 0;
  double seconds = 0;
  for (const Json& pair : pairs) {
    const int status = pair["status"].get<int>();
    failures += status == 1 || status == 4;
    errors += status == 2;
    seconds += pair.value("ms", 0.0) / 1000;
  }
  const std::string counts = "tests=\"" + std::to_string(pairs.size()) + "\" failures=\"" +
                             std::to_string(failures) + "\" errors=\"" + std::to_string(errors) +
                             "\" time=\"" + shortNumber(seconds) + "\"";
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts +
                    ">\n<testsuite name=\"glint diff\" " + counts + ">\n";
  for (const Json& pair : pairs) {
    const int status = pair["status"].get<int>();
    xml += "<testcase classname=\"glint.diff\" name=\"" + xmlText(textOf(pair, "name")) +
           "\" time=\"" + shortNumber(pair.value("ms", 0.0) / 1000) + "\"";
    if (status == 0) {
      xml += "/>\n";
      continue;
    }
    const char* const kind = status == 2 ? "error" : "failure";
    std::string text = diffLine(pair) + "\n";
    if (pair.contains("worst"))
      for (const Json& pixel : pair["worst"])
        text += "(" + pixel["x"].dump() + ", " + pixel["y"].dump() + "): " + pixel["a"].dump() +
                " -> " + pixel["b"].dump() + "\n";
    if (pair.contains("log")) text += textOf(pair, "log");
    xml += std::string(">\n<") + kind + " message=\"" + xmlText(failureText(pair)) + "\">" +
           xmlText(text) + "</" + kind + ">\n</testcase>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

std::string markdownText(const Json& report) {
  const auto cell = [](const std::string& text) {
    std::string safe;
    const std::string whole = utf8(text);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const char letter = whole[i];
      // Cut at a character boundary.
      if (i > 250 && (static_cast<unsigned char>(letter) & 0xc0) != 0x80) return safe + "...";
      if (std::string_view("|`*_[<\\&~$#").find(letter) != std::string_view::npos) safe += '\\';
      safe += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
    }
    return safe;
  };
  const Json& pairs = report["pairs"];
  std::map<std::string, std::size_t> counts;
  for (const Json& pair : pairs) ++counts[kindOf(pair)];
  std::string text = "### Pictures: ";
  bool first = true;
  for (const auto& [kind, count] : counts) {
    text += (first ? "" : ", ") + std::to_string(count) + " " + kind;
    first = false;
  }
  text += "\n";
  constexpr std::size_t most = 50;
  std::size_t told = 0;
  for (const Json& pair : pairs) {
    if (pair["status"] == 0 && !pair.value("updated", false) && !pair.value("removed", false))
      continue;
    if (told++ == most) break;
    if (told == 1)
      text += "\n| picture | result | flip | max | pixels | why |\n|---|---|---|---|---|---|\n";
    text += "| " + cell(textOf(pair, "name")) + " | " + kindOf(pair);
    for (const char* metric : {"flip", "max", "pixels"}) text += " | " + metricText(pair, metric);
    text += " | " + cell(failureText(pair)) + " |\n";
  }
  if (told > most) text += "\nand more; see the report for all of them.\n";
  if (report.contains("updateCommand"))
    text += "\nTo accept them: `" + textOf(report, "updateCommand") + "`\n";
  return text;
}

std::string kindOf(const Json& pair) {
  const int status = pair["status"].get<int>();
  if (status == 0) return "same";
  if (status == 1) return "differs";
  if (status == 4) return "no baseline";
  return textOf(pair, "b").empty() ? "missing" : "error";
}

}  // namespace glint
