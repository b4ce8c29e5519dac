#include "diff_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "glint/image/file.h"
#include "glint/image/json_text.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

Json numberJson(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

/// Text with bytes that are no UTF-8 replaced.
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

std::string failureText(const DiffEntry& entry) {
  if (!entry.error.empty()) return entry.error;
  std::string text;
  for (const std::string& failure : entry.result.failures)
    text += (text.empty() ? "" : "; ") + failure;
  return text;
}

}  // namespace

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
  if (!entry.error.empty()) {
    json["error"] = entry.error;
    if (!entry.textB.empty()) json["textB"] = entry.textB;
    return json;
  }
  const Comparison& r = entry.result;
  json["same"] = r.same;
  json["failures"] = r.failures;
  if (!entry.note.empty()) json["note"] = entry.note;
  json["ms"] = entry.milliseconds;
  if (!entry.textA.empty()) json["textA"] = entry.textA;
  if (!entry.textB.empty()) json["textB"] = entry.textB;
  if (r.values.empty()) return json;  // different sizes
  json["width"] = entry.width;
  json["height"] = entry.height;
  json["values"] = r.space == ValueSpace::encoded ? "encoded" : "linear";
  json["pixels"] = r.pixels;
  json["ignoredPixels"] = r.ignoredPixels;
  json["differing"] = r.differing;
  json["antiAliased"] = r.antiAliased;
  json["nan"] = {{"a", r.nanA}, {"b", r.nanB}};
  json["infinite"] = {{"a", r.infinityA}, {"b", r.infinityB}};
  json["metrics"] = Json::object();
  for (const std::string& name : metricNames()) {
    const auto found = r.values.find(name);
    if (found == r.values.end()) continue;
    Json& metric = json["metrics"][name];
    metric["value"] = numberJson(found->second);
    const bool hdr = name == "hdr-flip";
    if (name == "flip" || hdr) {
      const FlipResult& flip = hdr ? r.hdrFlip : r.flip;
      metric["mean"] = numberJson(flip.mean);
      metric["max"] = numberJson(flip.maximum);
      metric["pixelsPerDegree"] = options.flip.pixelsPerDegree;
      if (hdr) {
        metric["startExposure"] = flip.startExposure;
        metric["stopExposure"] = flip.stopExposure;
        metric["exposures"] = flip.exposures;
      }
    }
    if (name == "pixels") metric["tolerance"] = options.tolerance;
    for (const Condition& condition : options.conditions)
      if (condition.metric == name) metric["threshold"] = condition.threshold;
  }
  json["worst"] = Json::array();
  for (const WorstPixel& pixel : r.worst) {
    Json a = Json::array(), b = Json::array();
    for (std::size_t c = 0; c < 4; ++c) {
      a.push_back(numberJson(pixel.a[c]));
      b.push_back(numberJson(pixel.b[c]));
    }
    json["worst"].push_back({{"x", pixel.x},
                             {"y", pixel.y},
                             {"a", a},
                             {"b", b},
                             {"difference", numberJson(pixel.difference)}});
  }
  return json;
}

std::string diffLine(const DiffEntry& entry) {
  if (!entry.error.empty()) return printablePath(entry.name) + ": " + entry.error;
  const Comparison& r = entry.result;
  if (entry.updated) return printablePath(entry.name) + ": " + entry.note;
  std::string line = printablePath(entry.name) + ": " + (r.same ? "same" : "differs");
  if (r.same && r.differing == 0) {
    line += ", equal in every pixel";
  } else if (!r.values.empty()) {
    for (const std::string& name : metricNames()) {
      const auto found = r.values.find(name);
      if (found == r.values.end() || name == "mean" || name == "relative-rmse") continue;
      line += ", " + name + " " + shortNumber(found->second);
    }
    line +=
        ", " + std::to_string(r.differing) + " of " + std::to_string(r.pixels) + " pixels differ";
  }
  if (!r.failures.empty()) line += " (" + failureText(entry) + ")";
  if (!r.worst.empty() && !r.same)
    line += "; worst at " + std::to_string(r.worst[0].x) + "," + std::to_string(r.worst[0].y);
  if (!entry.note.empty()) line += "; " + entry.note;
  return line;
}

std::string junitXml(const std::vector<DiffEntry>& entries) {
  std::size_t failures = 0, errors = 0;
  double seconds = 0;
  for (const DiffEntry& entry : entries) {
    failures += entry.status == 1 || entry.status == 4;
    errors += entry.status == 2;
    seconds += entry.milliseconds / 1000;
  }
  const std::string counts = "tests=\"" + std::to_string(entries.size()) + "\" failures=\"" +
                             std::to_string(failures) + "\" errors=\"" + std::to_string(errors) +
                             "\" time=\"" + shortNumber(seconds) + "\"";
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts +
                    ">\n<testsuite name=\"glint diff\" " + counts + ">\n";
  for (const DiffEntry& entry : entries) {
    xml += "<testcase classname=\"glint.diff\" name=\"" + xmlText(entry.name) + "\" time=\"" +
           shortNumber(entry.milliseconds / 1000) + "\"";
    if (entry.status == 0) {
      xml += "/>\n";
      continue;
    }
    const char* const kind = entry.status == 2 ? "error" : "failure";
    xml += std::string(">\n<") + kind + " message=\"" + xmlText(failureText(entry)) + "\">" +
           xmlText(diffLine(entry) + "\n" + entry.result.worstText()) + "</" + kind +
           ">\n</testcase>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace glint
