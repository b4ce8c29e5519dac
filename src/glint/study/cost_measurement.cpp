#include "glint/study/cost_measurement.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>
#include <random>

#include "glint/image/clock.h"
#include "glint/shading/angles.h"
#include "glint/study/format.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

constexpr int lightCount = 64;
// Frames of some milliseconds: shorter ones would measure how long threads take to wake.
constexpr glm::ivec2 lobeSize{256, 256}, reflectanceSize{1024, 1024};
constexpr int warmUp = 2, rounds = 6;  // of each build
constexpr int mostBuilds = 24;

/// The powers of `integer` that are measured; the costs of the others are interpolated between
/// them.
constexpr int measuredPowers[] = {1, 4, 16, 128, 127};

/// A sheet wider than the picture whose normals turn by up to 30 degrees, so that every light is
/// above the horizon everywhere and neighbouring pixels differ.
Scene sheetScene() {
  constexpr int cells = 16;
  Mesh mesh;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      const glm::vec2 at = glm::vec2(x, y) * (2.0f / cells) - 1.0f;
      mesh.positions.emplace_back(at, 0.0f);
      mesh.normals.push_back(glm::normalize(glm::vec3(0.4f * at, 1.0f)));
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const auto corner = std::uint32_t(y * (cells + 1) + x);
      for (const std::uint32_t step : {0u, 1u, cells + 2u, 0u, cells + 2u, cells + 1u})
        mesh.indices.push_back(corner + step);
    }
  Material material;
  material.shading = sphereMaterial();
  return sceneOf("sheet", std::move(mesh), material);
}

Look sheetLook(glm::ivec2 size) {
  Look look;
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  look.noBackground = true;
  look.resolution = size;
  look.cameraPosition = glm::dvec3(0, 0, 3);
  look.cameraFocalPoint = glm::dvec3(0.0);
  look.cameraViewAngle = 30;
  look.light.emplace();
  return look;
}

/// A picture whose time gives a cost: its time above that of the base picture.
struct Trial {
  std::string form;
  double* cost = nullptr;  ///< where it goes in the table; null: a control
  Look look;
  std::vector<double> milliseconds;  ///< the fastest frame of each build
};

/// Pictures measured together: the first is the base, the second has the exact form, and the last
/// is the exact form again.
using Trials = std::vector<Trial>;

Trials lobeTrials(CostTable& table, Look look) {
  look.light = spreadLights(lightCount, 40, Light::Type::directional);
  look.shading = Shading::phong;
  Look none = look;
  none.material[""].specular = 0;
  Trials trials{{"no highlight", nullptr, none, {}}};
  const auto add = [&](const std::string& form, double& cost) {
    Look own = look;
    setForms(own, form, "exact");
    trials.push_back({form, &cost, own, {}});
  };
  for (auto& [form, costs] : table.lobes) {
    const std::string name(row(form).name);
    if (row(form).wholePowers) {
      for (const int power : measuredPowers) {
        add(name, costs[std::size_t(productsOf(power))]);
        trials.back().look.material[""].exponent = power;
        trials.back().form += " (" + std::to_string(productsOf(power)) + " products)";
      }
    } else {
      for (std::size_t i = 0; i < costs.size(); ++i)
        add(name + (row(form).hasGamma() ? ":" + std::to_string(row(form).leastGamma << i) : ""),
            costs[i]);
    }
  }
  add("exact", table.lobes[Highlight::exact][0]);
  trials.back().cost = nullptr;
  return trials;
}

Trials reflectanceTrials(CostTable& table, Look look) {
  look.shading = Shading::environment;
  look.environment = Environment::white;
  look.noLights = true;
  Look metal = look;
  metal.material[""].metalness = 1;
  Trials trials{{"metal", nullptr, metal, {}}};
  const auto add = [&](const std::string& form, double* cost, double exponent = 5) {
    Look own = look;
    setForms(own, "exact", form);
    own.schlickExponent = exponent;
    trials.push_back({form, cost, own, {}});
    if (look.mediumIor > 1) trials.back().form += ", denser side";
  };
  for (ReflectanceCosts* costs : {&table.fresnel, &table.fresnelDenser}) {
    look.mediumIor = costs == &table.fresnel ? 1 : 2 * sphereMaterial().ior;
    for (const FresnelRow& form : fresnelRows()) {
      add(std::string(form.name), &(costs->*form.cost));
      if (form.form != Fresnel::schlick) continue;
      add(std::string(form.name), &costs->schlickExponent, 4.5);
      trials.back().form += ", other exponent";
    }
  }
  look.mediumIor = 1;
  add("exact", nullptr);
  return trials;
}

/// Builds the programs and measures each picture once more; false if it was stopped.
bool measureBuild(Trials& trials, const StudyScene& scene, GpuScene& gpu, const Stop& stop) {
  Renderer renderer;  // has built nothing yet
  std::deque<Renderer::Picture> pictures;
  std::vector<Renderer::Picture*> all;
  for (const Trial& trial : trials) {
    if (stop && stop()) return false;
    pictures.push_back(
        renderer.begin(gpu, makeDrawList(scene.scene, scene.bounds, trial.look), trial.look));
    all.push_back(&pictures.back());
  }
  const auto times = timeInTurn(all, {warmUp, rounds, false, stop, {}});
  if (times[0].wall.size() < std::size_t(rounds)) return false;
  for (std::size_t i = 0; i < trials.size(); ++i)
    trials[i].milliseconds.push_back(*std::min_element(times[i].wall.begin(), times[i].wall.end()));
  return true;
}

/// A time over chosen builds: the lower quartile, which leaves out unlucky ones.
double timeOf(const Trial& trial, const std::vector<std::size_t>& builds) {
  std::vector<double> times;
  for (const std::size_t i : builds) times.push_back(trial.milliseconds[i]);
  return quantile(std::move(times), 0.25);
}

/// The total time of the exact lobe for all lights and pixels of its picture, ms.
double unitOf(const Trials& lobes, const std::vector<std::size_t>& builds) {
  return timeOf(lobes[1], builds) - timeOf(lobes[0], builds);
}

/// The costs of the trials after the base, without the control. `share`: evaluations in the lobes'
/// picture for each one in this. Noise is how far costs may be off: half of the median interval, or
/// the difference between the two measurements of the exact form if that is larger; at least 1.
std::vector<MeasuredCost> measuredCosts(const Trials& trials, const Trials& lobes, double share,
                                        double& noise) {
  const std::size_t builds = lobes[0].milliseconds.size();
  std::vector<std::size_t> chosen(builds);
  std::iota(chosen.begin(), chosen.end(), std::size_t(0));
  const auto costs = [&] {
    const double base = timeOf(trials[0], chosen), unit = unitOf(lobes, chosen);
    std::vector<double> all;
    for (const Trial& trial : trials)
      all.push_back(100 * share * (timeOf(trial, chosen) - base) / unit);
    return all;
  };
  const std::vector<double> measured = costs();
  std::vector<std::vector<double>> drawn(trials.size());
  std::mt19937 random(1);
  for (int k = 0; k < 400; ++k) {  // bootstrap: builds are drawn for all forms together
    for (std::size_t& i : chosen) i = std::size_t(std::uint64_t(random()) * builds >> 32);
    const auto again = costs();
    for (std::size_t i = 0; i < trials.size(); ++i) drawn[i].push_back(again[i]);
  }
  std::vector<MeasuredCost> all;
  std::vector<double> halves;
  for (std::size_t i = 1; i + 1 < trials.size(); ++i) {
    const double low = quantile(drawn[i], 0.025), high = quantile(drawn[i], 0.975);
    all.push_back({trials[i].form, *trials[i].cost, measured[i], low, high, 0});
    halves.push_back((high - low) / 2);
  }
  noise = std::max({1.0, quantile(halves, 0.5), std::abs(measured.back() - measured[1])});
  return all;
}

void fillIn(const Trials& trials, std::vector<MeasuredCost>& costs, double noise) {
  for (std::size_t i = 0; i < costs.size(); ++i)
    *trials[i + 1].cost = costs[i].inTable = std::max(roundedCost(costs[i].value, noise), 1.0);
}

/// Interpolates the powers of `integer` in between.
void interpolate(CostTable& table) {
  std::vector<double>& costs = table.lobes[Highlight::integer];
  int before = 0;
  for (const int power : measuredPowers) {
    const int products = productsOf(power);
    for (int p = before + 1; p < products; ++p)
      costs[std::size_t(p)] = std::lerp(costs[std::size_t(before)], costs[std::size_t(products)],
                                        double(p - before) / (products - before));
    before = products;
  }
}

}  // namespace

double roundedCost(double cost, double noise) {
  return noise > 0 ? 100 + noise * std::round((cost - 100) / noise) : cost;
}

CostMeasurement measureCosts(const CostMeasuring& how, const Stop& stop,
                             const StudyProgress& progress) {
  CostMeasurement result;
  result.file.gl = glStrings();
  CostTable& table = result.file.costs;
  const StudyScene scene(sheetScene(), DecodedImages());
  GpuScene gpu(scene.scene, scene.images);
  Trials lobes = lobeTrials(table, sheetLook(lobeSize));
  Trials reflectances = reflectanceTrials(table, sheetLook(reflectanceSize));
  const auto begin = Clock::now();
  for (; result.builds < mostBuilds; ++result.builds) {
    const double past = secondsSince(begin);
    if (result.builds >= how.fewestBuilds && past > how.seconds) break;
    if (progress)
      progress("costs of the forms",
               std::max(std::min(past / how.seconds, 0.99), double(result.builds) / mostBuilds));
    if (!measureBuild(lobes, scene, gpu, stop)) return result;
    if (!measureBuild(reflectances, scene, gpu, stop)) return result;
  }
  const double evaluations = double(lightCount) * lobeSize.x * lobeSize.y;
  std::vector<std::size_t> builds(std::size_t(result.builds));
  std::iota(builds.begin(), builds.end(), std::size_t(0));
  result.exactNanoseconds = unitOf(lobes, builds) * 1e6 / evaluations;
  if (!(result.exactNanoseconds > 0))
    throw Error("a highlight takes no measurable time here: leave --cost-table out");
  const double pixels = double(reflectanceSize.x) * reflectanceSize.y;
  double noise = 0, reflectanceNoise = 0;
  result.lobes = measuredCosts(lobes, lobes, 1, noise);
  result.reflectances = measuredCosts(reflectances, lobes, evaluations / pixels, reflectanceNoise);
  fillIn(lobes, result.lobes, noise);
  interpolate(table);
  // Rounded around the cost of the exact reflectance, which is not 100.
  const double exact = result.reflectances[0].value;
  for (std::size_t i = 0; i < result.reflectances.size(); ++i) {
    MeasuredCost& cost = result.reflectances[i];
    const double rounded = exact + roundedCost(100 + cost.value - exact, reflectanceNoise) - 100;
    *reflectances[i + 1].cost = cost.inTable = std::max(rounded, 0.0);
  }
  result.file.noise = noise;
  result.reflectanceNoise = reflectanceNoise;
  result.complete = true;
  return result;
}

std::string costText(const CostMeasurement& m) {
  std::string text = formatted(
      "%s; %d builds of each program; noise %.1f\nthe exact lobe takes %.2f ns for one light at "
      "one pixel, which counts as 100\n",
      m.file.gl.renderer.c_str(), m.builds, m.file.noise, m.exactNanoseconds);
  for (const auto& [title, costs] :
       {std::pair("lobe", &m.lobes), {"reflectance", &m.reflectances}}) {
    text +=
        formatted("\n%-38s %8s %9s %16s %9s\n", title, "shipped", "measured", "95 %", "in table");
    for (const MeasuredCost& c : *costs)
      text += formatted("%-38s %8.0f %9.1f %7.1f-%8.1f %9.1f\n", c.form.c_str(), c.shipped, c.value,
                        c.low, c.high, c.inTable);
  }
  return text;
}

}  // namespace glint
