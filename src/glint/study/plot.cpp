#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "glint/study/page.h"

// The plot as a picture for documents. Its colours are fixed, on white, since a picture in a page
// cannot adapt to the page's.
namespace glint {
namespace {

using Json = nlohmann::ordered_json;

constexpr double width = 860, height = 500, left = 76, right = 20, top = 46, bottom = 56;

std::string number(double value, const char* format = "%.1f") {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string text(double x, double y, const std::string& words, const char* more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + more + ">" + words +
         "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* more) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\" " + more + "/>\n";
}

/// A logarithmic axis: maps a value to a coordinate.
struct Axis {
  double low, high, from, to;
  double operator()(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
};

const char* colorOf(const std::string& shading) {
  static const std::map<std::string, const char*> colors{{"flat", "#8c564b"},
                                                         {"gouraud", "#2ca02c"},
                                                         {"phong", "#1f77b4"},
                                                         {"blinn-phong", "#d6301d"},
                                                         {"environment", "#9467bd"}};
  const auto found = colors.find(shading);
  return found == colors.end() ? "#555" : found->second;
}

struct Point {
  std::string name, shading;
  double ms, low, high, error;
  bool onFront, isOpen, isChosen;  // isOpen: undecided whether it is on the front
};

/// The times of a variant or a floor by the clock that decides; null if it was not timed.
const Json& timesOf(const Json& json, const Json& of) {
  const std::string clock = json["clock"];
  return of["times"][clock == "gpu" ? "query" : clock];
}

std::vector<Point> pointsOf(const Json& json, const std::string& model) {
  std::vector<Point> points;
  for (const Json& v : json["variants"]) {
    const Json& times = timesOf(json, v);
    if (times.is_null()) continue;
    for (const Json& e : v["errors"]) {
      const bool isOpen = std::ranges::find(e["open"], Json("rmse")) != e["open"].end();
      if (e["against"] == model && e["rmse"].is_number())
        points.push_back({v["name"], v["shading"], times["median"], times["lowerQuartile"],
                          times["upperQuartile"], std::max(e["rmse"].get<double>(), 1e-9),
                          e["fronts"].value("rmse", Json()) == Json(true), isOpen,
                          v.contains("bound")});
    }
  }
  return points;
}

std::string axes(const Axis& x, const Axis& y) {
  std::string svg;
  for (int decade = -9; decade <= 4; ++decade)
    for (const int digit : {1, 2, 3, 5, 7}) {
      const double value = digit * std::pow(10.0, decade);
      const bool wide = x.high > 15 * x.low;
      if (value >= x.low && value <= x.high && !(wide && digit % 2 != 0 && digit > 1)) {
        svg += line(x(value), y.from, x(value), y.to, "stroke=\"#e4e4e4\"");
        svg += text(x(value), y.from + 18, number(value, "%g"), "text-anchor=\"middle\"");
      }
      if (digit == 1 && value >= y.low && value <= y.high) {
        svg += line(x.from, y(value), x.to, y(value), "stroke=\"#e4e4e4\"");
        svg += text(x.from - 8, y(value) + 4, number(value, "%.0e"), "text-anchor=\"end\"");
      }
    }
  return svg;
}

}  // namespace

std::string studyPlot(const Json& json) {
  std::string model;
  std::vector<Point> points;
  for (const char* each : {"phong", "blinn-phong", "environment"}) {
    model = each;
    if (!(points = pointsOf(json, model)).empty()) break;
  }
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) +
                    " " + number(height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  if (points.empty()) return svg + text(20, 30, "no times were measured") + "</svg>\n";
  double fastest = 1e300, slowest = 0, least = 1e300, most = 0;
  for (const Point& p : points) {
    fastest = std::min(fastest, p.low);
    slowest = std::max(slowest, p.high);
    least = std::min(least, p.error);
    most = std::max(most, p.error);
  }
  double constant = 0;
  for (const Json& floor : json["floors"])
    if (floor["name"] == "constant" && !timesOf(json, floor).is_null())
      constant = timesOf(json, floor)["median"];
  if (constant > 0) fastest = std::min(fastest, constant);
  const Axis x{fastest / 1.1, slowest * 1.25, left, width - right};
  const Axis y{least / 2, most * 2, height - bottom, top};
  svg += text(left, 24,
              "Time and error against exact " + model +
                  " shading: " + json["gl"]["renderer"].get<std::string>(),
              "font-size=\"15\"");
  svg += axes(x, y);
  svg +=
      text((left + width - right) / 2, height - 12,
           "ms a frame, " + json["clock"].get<std::string>() + " time (median; line: quartiles)" +
               (json["noFront"].is_null() ? "" : ": too uncertain for a front"),
           "text-anchor=\"middle\"");
  svg += "<text transform=\"translate(16 " + number((top + height - bottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">RMSE, linear light</text>\n";
  if (constant > 0) {
    svg += line(x(constant), y.from, x(constant), y.to, "stroke=\"#888\" stroke-dasharray=\"4 3\"");
    svg += text(x(constant) + 4, top + 10, "constant colour", "fill=\"#666\"");
  }
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.error < b.error; });
  std::string path;
  for (const Point& p : points)
    if (p.onFront) path += (path.empty() ? "M" : " L") + number(x(p.ms)) + " " + number(y(p.error));
  svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.5\"/>\n";
  bool above = true;
  for (const Point& p : points) {
    const std::string color = colorOf(p.shading);
    svg += line(x(p.low), y(p.error), x(p.high), y(p.error),
                ("stroke=\"" + color + "\" stroke-opacity=\"0.35\"").c_str());
    svg += "<circle cx=\"" + number(x(p.ms)) + "\" cy=\"" + number(y(p.error)) + "\" r=\"" +
           (p.onFront ? "5" : "3") + "\" fill=\"" + color +
           (p.isOpen ? "\" fill-opacity=\"0.2\" stroke=\"" + color : "") + "\"><title>" + p.name +
           "</title></circle>\n";
    if (p.isChosen)  // by --max-error
      svg += "<path d=\"M" + number(x(p.ms)) + " " + number(y(p.error) - 10) +
             " l10 10 l-10 10 l-10 -10 Z\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.5\"/>\n";
    if (p.onFront || p.isChosen) {
      // Names go above and below in turn, so that neighbours do not overlap, and before the point
      // if there is no room after it.
      const double beside = p.isChosen ? 12 : 8, below = p.onFront ? 15 : 26;
      const bool before = x(p.ms) + 7 * double(p.name.size()) > width - right;
      svg += text(x(p.ms) + (before ? -beside : beside),
                  y(p.error) + (p.onFront && above ? -7 : below), p.name,
                  before ? "font-weight=\"bold\" text-anchor=\"end\"" : "font-weight=\"bold\"");
    }
    above = above != p.onFront;
  }
  double place = left;
  for (const char* shading : {"flat", "gouraud", "phong", "blinn-phong", "environment"}) {
    if (std::none_of(points.begin(), points.end(),
                     [&](const Point& p) { return p.shading == shading; }))
      continue;
    svg += "<circle cx=\"" + number(place + 5) + "\" cy=\"38\" r=\"4\" fill=\"" + colorOf(shading) +
           "\"/>\n" + text(place + 13, 42, shading);
    place += 100;
  }
  return svg + "</svg>\n";
}

}  // namespace glint
