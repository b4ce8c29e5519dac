#include "glint/stability/plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "glint/image/error.h"
#include "glint/render/probe_error.h"
#include "glint/scene/look_text.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"
#include "glint/shading/safe.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

using Json = nlohmann::ordered_json;

constexpr double plottedExponents[] = {10, 100, 1e3, 1e4, 1e5, 1e6};
constexpr double floor = 1e-9;  // the lower end of logarithmic axes of errors

const std::vector<std::string> lobeForms{"pow",          "exact",  "lyon:8",  "lyon-tuned:8",
                                         "lyon-cross:8", "pade:8", "gaussian"};
const std::vector<std::string> fresnelForms{"textbook", "exact", "schlick", "schlick-exp2",
                                            "rational"};

double shortened(double x) { return std::isfinite(x) ? std::stod(numberText(float(x))) : -1; }

using Curve = std::vector<std::pair<double, double>>;

Curve curveOf(const std::vector<double>& x, const std::vector<double>& y) {
  Curve curve;
  for (std::size_t i = 0; i < y.size(); ++i) curve.emplace_back(x[i], y[i]);
  return curve;
}

Json seriesJson(const std::string& name, const Curve& points, bool dots = false,
                bool truth = false) {
  Json list = Json::array();
  for (const auto& [x, y] : points) list.push_back({shortened(x), shortened(y)});
  return {{"name", name}, {"points", list}, {"dots", dots}, {"truth", truth}};
}

Json plotJson(const std::string& title, const std::string& note, const std::string& x, bool xLog,
              const std::string& y, bool yLog) {
  return {{"title", title},
          {"note", note},
          {"x", {{"label", x}, {"log", xLog}}},
          {"y", {{"label", y}, {"log", yLog}}},
          {"series", Json::array()}};
}

struct Peak {
  Points points;
  std::vector<double> scaled;  ///< exponent * lambda
  std::vector<double> truth;
};

/// Phong geometries in all directions with exponent * lambda from 0 to 8, ascending.
Peak aroundPeak(double exponent, std::size_t count) {
  Peak peak;
  const auto normals = randomDirections(count, 61), lights = randomDirections(count, 62),
             sides = randomDirections(count, 63);
  for (std::size_t i = 0; i < count; ++i) {
    const double lambda = std::min(8 * (i + 0.5) / double(count) / exponent, 1.0);
    const Geometry g = besidePeak(normals[i], lights[i], sides[i], 1 - lambda, false);
    peak.points.add(g.n, g.p, g.l);
    const double own = phongLambda(safeNormalize(glm::dvec3(g.n)), safeNormalize(glm::dvec3(g.l)),
                                   safeNormalize(-glm::dvec3(g.p)));
    peak.scaled.push_back(exponent * own);
    peak.truth.push_back(lobeExact(own, exponent));
  }
  return peak;
}

std::vector<double> lobeOf(Bench& bench, const std::string& form, double exponent,
                           const Points& points) {
  Look look = bench.lit(Shading::phong);
  look.highlight = parseHighlights(form, "highlight");
  std::vector<double> values;
  for (const glm::vec3& c : bench.programs().shade({look, litMaterial(0, 1, exponent)}, points))
    values.push_back(c.y);
  return values;
}

/// The largest error in each of `bins` parts of [0, 8].
Curve binned(const Peak& peak, const std::vector<double>& got, int bins) {
  Curve points;
  for (int b = 0; b < bins; ++b) points.emplace_back((b + 0.5) * 8 / bins, floor);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const int b = std::clamp(int(peak.scaled[i] / 8 * bins), 0, bins - 1);
    double& worst = points[std::size_t(b)].second;
    worst = std::max(worst, std::abs(got[i] - peak.truth[i]));
  }
  return points;
}

void lobePlots(Bench& bench, Json& plots) {
  const std::vector<std::string> pair{"pow", "exact"};
  Json near = plotJson("Error over λ near the peak, for each exponent",
                       "Phong's highlight over 8000 geometries; the largest error of each bin. "
                       "pow(R·V, α) against the exact form from the difference vector.",
                       "α λ", false, "error", true);
  Json over = plotJson("Largest error over the exponent",
                       "The same for every form. Approximations end at their own error; the stable "
                       "forms grow like √α, the dot product like α.",
                       "exponent α", true, "largest error", true);
  std::map<std::string, Curve> largest;
  for (double alpha : plottedExponents) {
    const Peak peak = aroundPeak(alpha, 8000);
    for (const std::string& form : lobeForms) {
      const std::vector<double> got = lobeOf(bench, form, alpha, peak.points);
      double worst = floor;
      for (std::size_t i = 0; i < got.size(); ++i)
        worst = std::max(worst, std::abs(got[i] - peak.truth[i]));
      largest[form].emplace_back(alpha, worst);
      if (std::find(pair.begin(), pair.end(), form) != pair.end())
        near["series"].push_back(
            seriesJson(form + " α=" + numberText(alpha), binned(peak, got, 48)));
    }
  }
  for (const std::string& form : lobeForms)
    over["series"].push_back(seriesJson(form, largest[form]));
  Curve half;
  for (double alpha : plottedExponents) half.emplace_back(alpha, 1 / 510.0);
  over["series"].push_back(seriesJson("half a level of 8 bits", half, false, true));
  plots.push_back(near);
  plots.push_back(over);

  Json stairs = plotJson("The peak at exponent 1e6",
                         "One geometry turned through 0.2 degrees. R·V is one of a few floats next "
                         "to 1: a staircase, and above it nothing between. The difference vector "
                         "keeps the curve.",
                         "angle between R and V, degrees", false, "highlight", false);
  // Light and normal are slanted, so that no component is special.
  const glm::dvec3 n = safeNormalize({0.36, 0.48, 0.8}), l = safeNormalize({0.1, 0.7, 0.7});
  const glm::dvec3 r = 2 * glm::dot(n, l) * n - l, side = safeNormalize(glm::cross(r, n));
  Points points;
  std::vector<double> angles, truth;
  for (int i = 0; i <= 400; ++i) {
    const double a = (i - 200) / 200.0 * 0.2 * degrees;
    const glm::vec3 v(std::cos(a) * r + std::sin(a) * side);
    points.add(glm::vec3(n), -v, glm::vec3(l));
    angles.push_back(a / degrees);
    truth.push_back(std::pow(std::cos(a), 1e6));
  }
  const auto curve = [&](const std::vector<double>& values) { return curveOf(angles, values); };
  stairs["series"].push_back(seriesJson("cos^1e6", curve(truth), false, true));
  for (const std::string& form : pair)
    stairs["series"].push_back(seriesJson(form, curve(lobeOf(bench, form, 1e6, points)), true));
  plots.push_back(stairs);

  Json all = plotJson("Every form of the lobe, exponent 50",
                      "What the approximations give up, each over the others.",
                      "angle between R and V, degrees", false, "highlight", false);
  Points wide;
  std::vector<double> exact;
  angles.clear();
  for (int i = 0; i <= 200; ++i) {
    const double a = i * 0.2 * degrees;
    wide.add({0, 0, 1}, glm::vec3(-std::sin(a), 0, -std::cos(a)), {0, 0, 1});
    angles.push_back(i * 0.2);
    exact.push_back(std::pow(std::cos(a), 50));
  }
  all["series"].push_back(seriesJson("cos^50", curve(exact), false, true));
  for (const std::string& form : lobeForms)
    all["series"].push_back(seriesJson(form, curve(lobeOf(bench, form, 50, wide))));
  plots.push_back(all);
}

std::vector<float> reflectanceOf(Bench& bench, const std::string& form, double n1, double n2,
                                 const std::vector<float>& cosines) {
  Look look = whiteRoom(bench, n1);
  look.fresnel = parseFresnel(form, "fresnel");
  return bench.programs().reflectance({look, boundary(n2)}, cosines, true);
}

void fresnelPlots(Bench& bench, Json& plots) {
  const std::vector<std::string> pair{"textbook", "exact"};
  // 1 - R varies as the root of the distance from the critical cosine: plots both sides of it.
  for (const double n : {1.5, 1 + std::exp2(-23)}) {
    Json plot = plotJson(
        n == 1.5 ? "Reflectance near the critical angle, 1.5 to 1"
                 : "The same for indices 1 + 2⁻²³ to 1",
        n == 1.5 ? "R is 1 beyond it (left) and falls with infinite slope."
                 : "The critical angle is at 89.97 degrees; the textbook's form misplaces it.",
        "(cos θ − critical) / critical", false, "R", false);
    const double critical = criticalCosine(n, 1), reach = n == 1.5 ? 2e-3 : 2;
    std::vector<float> cosines;
    std::vector<double> x, truth;
    for (int i = -100; i <= 300; ++i) {
      const double t = reach * i / 300;
      cosines.push_back(float(critical * (1 + t)));
      x.push_back(cosines.back() / critical - 1);
      truth.push_back(fresnelExact(double(cosines.back()), n, 1));
    }
    plot["series"].push_back(seriesJson("in double", curveOf(x, truth), false, true));
    for (const std::string& form : pair) {
      const auto got = reflectanceOf(bench, form, n, 1, cosines);
      plot["series"].push_back(seriesJson(form, curveOf(x, {got.begin(), got.end()}), true));
    }
    plots.push_back(plot);
  }

  Json equal = plotJson("Largest error as n2/n1 nears 1",
                        "Over 2000 cosines from 1e-6 to 1. From the denser side the textbook's "
                        "form loses everything; the form without cancellation keeps 1e-6.",
                        "|n2 − n1| / n1", true, "largest error of R", true);
  std::map<std::string, Curve> lines;
  for (double d = std::exp2(-23); d < 1; d *= 2) {
    for (const std::string& form : pair)
      for (bool denser : {false, true}) {
        const double n1 = denser ? 1 + d : 1, n2 = denser ? 1 : 1 + d;
        std::vector<float> cosines;
        for (int i = 0; i < 2000; ++i) cosines.push_back(float(std::exp(-13.8 * i / 2000)));
        const auto got = reflectanceOf(bench, form, n1, n2, cosines);
        double worst = floor;
        for (std::size_t i = 0; i < got.size(); ++i)
          worst = std::max(worst, std::abs(got[i] - fresnelExact(double(cosines[i]), n1, n2)));
        lines[form + (denser ? ", n to 1" : ", 1 to n")].emplace_back(d, worst);
      }
  }
  for (const auto& [name, points] : lines) equal["series"].push_back(seriesJson(name, points));
  plots.push_back(equal);

  Json all = plotJson("Every form of the reflectance, 1 to 1.5", "Over the angle of incidence.",
                      "angle of incidence, degrees", false, "R", false);
  std::vector<float> cosines;
  std::vector<double> angles, truth;
  for (int i = 0; i <= 180; ++i) {
    angles.push_back(i * 0.5);
    cosines.push_back(float(std::cos(i * 0.5 * degrees)));
    truth.push_back(fresnelExact(double(cosines.back()), 1, 1.5));
  }
  all["series"].push_back(seriesJson("in double", curveOf(angles, truth), false, true));
  for (const std::string& form : fresnelForms) {
    const auto got = reflectanceOf(bench, form, 1, 1.5, cosines);
    all["series"].push_back(seriesJson(form, curveOf(angles, {got.begin(), got.end()})));
  }
  plots.push_back(all);
}

void normalPlot(Bench& bench, Json& plots) {
  Json plot = plotJson("Normals of length 1e-38 to 1e38",
                       "The largest error of a component over 64 directions of each length; 1 and "
                       "more is no direction at all.",
                       "length", true, "error", true);
  const std::pair<const char*, const char*> functions[] = {
      {"normalize (the driver's)", "vec3 f(vec3 v) { return normalize(v); }"},
      {"unit", "vec3 unit(vec3)"},
      {"safeUnit", "vec3 safeUnit(vec3)"}};
  const auto directions = randomDirections(64, 71);
  for (const auto& [name, function] : functions) {
    Curve points;
    std::vector<float> v;
    std::vector<glm::dvec3> truth;
    for (int e = -76; e <= 76; ++e)
      for (const glm::dvec3& d : directions) {
        const glm::vec3 x(d * std::pow(10, e * 0.5));
        v.insert(v.end(), {x.x, x.y, x.z});
        truth.push_back(safeNormalize(glm::dvec3(x)));
      }
    const std::vector<float> got = bench.run(function, {v});
    for (int e = 0; e <= 152; ++e) {
      double worst = floor;
      for (std::size_t k = 0; k < 64; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t row = std::size_t(e) * 64 + k;
          worst =
              std::max(worst, std::min(absoluteError(got[3 * row + c], truth[row][int(c)]), 10.0));
        }
      points.emplace_back(std::pow(10, (e - 76) * 0.5), worst);
    }
    plot["series"].push_back(seriesJson(name, points));
  }
  plots.push_back(plot);
}

}  // namespace

Json plotsJson(Bench& bench) {
  Json plots = Json::array();
  lobePlots(bench, plots);
  fresnelPlots(bench, plots);
  normalPlot(bench, plots);
  return plots;
}

}  // namespace glint::stability
