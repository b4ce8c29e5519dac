// --max-error is not needlessly expensive: its choice is compared with a search over all forms for
// those that keep within the budget when measured, on a sphere seen from several sides, by the
// reference.
//
// The search uses the same forms for all lights. The choice may also use several forms, with
// cheaper ones for dimmer lights, which can only cost less.
//
// How much more expensive the choice may be is derived. The bound of a pair of forms is a sum of
// parts, one for the highlight of each light and one for the reflectance, and rounding. Each part
// is at most `form` times the largest error of the form; on a sphere that error times its factor
// shows up to a factor `seen` (below), and the measured error is at least the largest part. So with
// P parts, a pair whose measured error is within (E - rounding) / (P form seen) has a bound within
// E, and the choice, the cheapest of all pairs with such a bound, cannot cost more.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "glint/budget/error_budget.h"
#include "glint/options/parameters.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/bounds.h"
#include "glint/shading/costs.h"
#include "glint/shading/sum.h"
#include "random.h"
#include "scenes.h"

namespace glint::test::error_budget_dear_test {

// Looseness of the forms' bounds, from tests/bounds_test.cpp: 1.002 for lobes, 1.25 for
// reflectances.
constexpr double form = 1.25;
// Points on a sphere do not cover it fully: up to 5 % of the error at the worst angle may be
// missed.
constexpr double seen = 1.05;

int draws(int usual) { return test::drawsOf("GLINT_BUDGET_DRAWS", usual); }

using test::Random;

struct Draw {
  Scene scene;
  Look look;
  std::vector<glm::dvec3> sides;  // viewing directions
};

Draw randomDraw(Random& r, Shading program, bool white) {
  Draw d;
  Material m = test::materialOf(0, r.coin() ? r.unit() : 0, r.below(4) ? r.log(0.02, 1) : 0,
                                r.log(1, 500), r.coin() ? 0 : r.unit(), r.color());
  if (r.coin()) m.shading.exponent = std::round(m.shading.exponent);
  m.shading.ior = r.coin() ? 1.05 + 1.5 * r.unit() : r.log(0.4, 3);
  d.scene = test::sceneOf(test::sphere(12, 6), m);
  d.look.shading = program;
  d.look.ambientLight = glm::dvec3(0);
  d.look.viewer = r.coin() ? Viewer::infinite : Viewer::local;
  d.look.environment = white      ? Environment::white
                       : r.coin() ? Environment::sky
                                  : Environment::studio;
  d.look.resolution = {8, 8};
  d.look.antiAliasing = {AntiAliasing::Mode::none, 1};
  d.look.light.emplace();
  for (int i = r.below(3); i >= 0; --i)
    d.look.light->push_back(test::directional(r.direction(), r.coin() ? glm::dvec3(1) : r.color()));
  // Seen from each light's direction, all angles between R and V occur. In the environments,
  // reflectance at the rim is multiplied by the radiance of their brightest lights.
  for (const Light& light : *d.look.light) d.sides.push_back(glm::normalize(light.direction));
  d.sides.push_back(r.direction());
  if (d.look.shading == Shading::environment && d.look.environment != Environment::white) {
    d.sides.push_back(glm::normalize(glm::dvec3(0.768, -0.28, -0.576)));  // the studio's key light
    d.sides.push_back(glm::normalize(glm::dvec3(-0.48, -0.64, -0.60)));   // the sun
  }
  return d;
}

Look withForms(const Look& look, const HighlightForm& highlight, Fresnel fresnel) {
  Look formed = look;
  formed.maxError.reset();
  readLook(formed,
           R"({"glint-look": 1, "highlight": ")" + highlightText(highlight) + R"(", "fresnel": ")" +
               std::string(fresnelText(fresnel)) + "\"}",
           "forms");
  return formed;
}

// Points on the sphere for each viewing direction: everywhere, and ever nearer to the highlights;
// in eye space.
using Points = std::vector<std::vector<reference::Attributes>>;

Look lookFrom(const Draw& d, std::size_t side) {
  Look look = d.look;
  look.cameraPosition = 6.0 * d.sides[side];
  look.cameraFocalPoint = glm::dvec3(0.0);
  return look;
}

Points pointsOf(const Draw& d, Random& r) {
  Points all;
  for (std::size_t side = 0; side < d.sides.size(); ++side) {
    const Look look = lookFrom(d, side);
    const Camera camera = cameraFor(d.scene, boundsOf(d.scene), look);
    const glm::dmat3 toEye = glm::transpose(camera.axes);
    auto& points = all.emplace_back();
    const auto add = [&](const glm::dvec3& n) {
      const glm::dvec3 view = camera.eye - n;
      if (!(glm::dot(n, look.viewer == Viewer::infinite ? camera.axes[2] : view) > 0)) return;
      reference::Attributes a;
      a.item = 0;
      a.position = toEye * (n - camera.eye) / camera.unit;
      a.normal = a.faceNormal = toEye * n;
      const ShadingParameters& m = d.scene.materials[0].shading;
      a.numbers = {m.ambient, m.diffuse, m.specular, m.exponent, m.metalness, m.transmission};
      a.base = glm::dvec4(m.color, 1);
      points.push_back(a);
    };
    // Rings around the view, ever finer towards the rim, where reflectances differ most; from the
    // denser side (an index below 1), towards grazing refracted rays.
    const double n = std::min(d.scene.materials[0].shading.ior, 1.0);
    for (int ring = 0; ring < 40; ++ring)
      for (int around = 0; around < 12; ++around) {
        const double thin = std::pow((ring + 0.5) / 40, 1.5);
        const double s = n * std::sqrt(1 - thin * thin), c = std::sqrt(1 - s * s);
        const double angle = (around + 0.3 * ring) * 30 * test::degrees;
        add(camera.axes * glm::dvec3(s * std::cos(angle), s * std::sin(angle), c));
      }
    for (const Light& light : *d.look.light) {
      const glm::dvec3 middle = glm::normalize(glm::normalize(light.direction) + camera.axes[2]);
      for (int step = 0; step < 60; ++step) {
        const double t = 1.5 * std::pow(0.9, step);
        const glm::dvec3 across = glm::cross(middle, r.direction());
        add(std::cos(t) * middle + std::sin(t) * glm::normalize(across));
      }
    }
  }
  return all;
}

using Radiances = std::vector<glm::dvec3>;

Radiances shaded(const Draw& d, const Points& points, const HighlightForm& highlight,
                 Fresnel fresnel) {
  Radiances radiances;
  for (std::size_t side = 0; side < points.size(); ++side) {
    const ReferenceRenderer reference(d.scene, {}, boundsOf(d.scene),
                                      withForms(lookFrom(d, side), highlight, fresnel), 1);
    for (const reference::Attributes& a : points[side])
      radiances.push_back(reference.shade(a).radiance);
  }
  return radiances;
}

// In the look's own forms.
Radiances shadedAsItIs(const Draw& d, const Points& points) {
  Radiances radiances;
  for (std::size_t side = 0; side < points.size(); ++side) {
    const ReferenceRenderer reference(d.scene, {}, boundsOf(d.scene), lookFrom(d, side), 1);
    for (const reference::Attributes& a : points[side])
      radiances.push_back(reference.shade(a).radiance);
  }
  return radiances;
}

struct Candidate {
  std::string name;
  Radiances off;  // difference from the exact form, by magnitude
  double cost = 0, rounding = 0;
};

void setOff(Candidate& c, const Radiances& from, const Radiances& exact) {
  for (std::size_t i = 0; i < exact.size(); ++i) c.off.push_back(glm::abs(from[i] - exact[i]));
}

std::vector<Candidate> lobesOf(const Draw& d, const Points& points, const Radiances& exact,
                               bool specular) {
  std::vector<HighlightForm> forms{Highlight::exact};
  if (specular) forms.emplace_back(Highlight::none);
  const bool blinn = d.look.shading != Shading::phong;
  const Material& m = d.scene.materials[0];
  const double alpha = (blinn ? d.look.blinnFactor : 1) * m.shading.exponent;
  if (specular) {
    forms.emplace_back(Highlight::pow);
    if (isIntegerPower(alpha)) forms.emplace_back(Highlight::integer);
    for (const Highlight with :
         {Highlight::lyon, Highlight::lyonTuned, Highlight::lyonCross, Highlight::pade})
      for (int gamma = 1; gamma <= 64; gamma *= 2) forms.emplace_back(with, gamma);
    forms.emplace_back(Highlight::gaussian);
  }
  glm::dvec3 light(0.0);
  for (const Light& each : *d.look.light) light += each.intensity;
  const glm::dvec3 shine = specularColor(m.shading.color, m.shading.metalness) * light;
  const double scale = m.shading.specular * std::max({shine.x, shine.y, shine.z});
  std::vector<Candidate> candidates;
  for (const HighlightForm& each : forms) {
    Candidate c{highlightText(each), {}, 0, 0};
    setOff(c, shaded(d, points, each, Fresnel::exact), exact);
    const auto lobe = each.form;
    const int power = each.form == Highlight::integer ? int(alpha) : each.gamma;
    if (specular) c.cost = double(d.look.light->size()) * CostTable().lobe(lobe, power);
    c.rounding = scale * (lobeRoundingBound(lobe, power, alpha, blinn) -
                          lobeRoundingBound(Highlight::exact, 1, alpha, blinn));
    candidates.push_back(std::move(c));
  }
  return candidates;
}

std::vector<Candidate> reflectancesOf(const Draw& d, const Points& points, const Radiances& exact,
                                      bool dielectric, double radiance) {
  std::vector<Candidate> candidates;
  const double ior = d.scene.materials[0].shading.ior;
  for (const Fresnel each :
       {Fresnel::exact, Fresnel::schlick, Fresnel::schlickExp2, Fresnel::rational}) {
    if (each != Fresnel::exact && !dielectric) break;
    Candidate c{std::string(fresnelText(each)), {}, 0, 0};
    setOff(c, shaded(d, points, Highlight::exact, each), exact);
    if (dielectric) c.cost = CostTable().reflectance(each, d.look.schlickExponent, ior < 1);
    c.rounding = radiance * std::max(fresnelRoundingBound(each, 1, ior) -
                                         fresnelRoundingBound(Fresnel::exact, 1, ior),
                                     0.0);
    candidates.push_back(std::move(c));
  }
  return candidates;
}

// The largest sum of both; errors that happen to cancel do not reduce it.
double measured(const Candidate& lobe, const Candidate& reflectance) {
  double worst = 0;
  for (std::size_t i = 0; i < lobe.off.size(); ++i) {
    const glm::dvec3 off = lobe.off[i] + reflectance.off[i];
    worst = std::max({worst, off.x, off.y, off.z});
  }
  return worst;
}

// `margin` is the ratio by which the bound's part for reflectance, which uses the environment's
// brightest radiance everywhere, exceeds the radiance where reflectances differ most.
void compare(Shading program, unsigned seed, int usual, double margin) {
  Random r(seed);
  std::vector<double> ratios;
  int dearest = 0;
  const int count = draws(usual);
  for (int i = 0; i < count; ++i) {
    Draw d = randomDraw(r, program, margin == 1);
    const ShadingParameters& m = d.scene.materials[0].shading;
    const bool specular = m.specular > 0;
    const bool dielectric = program == Shading::environment && m.metalness < 1;
    const Bounds bounds = boundsOf(d.scene);
    const double radiance =
        largestRadiance(d.look.environment == Environment::white ? BuiltinEnvironment::white
                        : d.look.environment == Environment::sky ? BuiltinEnvironment::sky
                                                                 : BuiltinEnvironment::studio);
    const Points points = pointsOf(d, r);
    const Radiances exact = shaded(d, points, Highlight::exact, Fresnel::exact);
    const auto lobes = lobesOf(d, points, exact, specular);
    const auto reflectances = reflectancesOf(d, points, exact, dielectric, radiance);
    d.look.maxError = 0;
    const double rounding = resolveLook(d.scene, bounds, d.look).choices.at(0).rounding;
    const double parts = (specular ? double(d.look.light->size()) : 0) + (dielectric ? 1 : 0);
    for (const double budget : {r.log(1e-4, 0.03), r.log(1e-3, 0.3)}) {
      d.look.maxError = budget;
      const ResolvedLook resolved = resolveLook(d.scene, bounds, d.look);
      const FormChoice& choice = resolved.choices.at(0);
      Candidate chosen;
      setOff(chosen, shadedAsItIs({d.scene, resolved.look, d.sides}, points), exact);
      for (const glm::dvec3& off : chosen.off)
        ASSERT_LE(std::max({off.x, off.y, off.z}), resolved.bound) << saveLook(resolved.look);
      double cheapest = choice.exactCost, allowed = choice.exactCost;
      std::string name = "exact";
      for (const Candidate& lobe : lobes)
        for (const Candidate& reflectance : reflectances) {
          const double cost = lobe.cost + reflectance.cost;
          if (cost >= std::max(cheapest, allowed)) continue;
          const double error = measured(lobe, reflectance);
          const double left = budget - rounding - lobe.rounding - reflectance.rounding;
          if (error <= budget) cheapest = std::min(cheapest, cost);
          if (error <= left / (parts * form * seen * margin) && cost < allowed)
            allowed = cost, name = lobe.name + " " + reflectance.name;
        }
      if (cheapest > 0) ratios.push_back(choice.cost / cheapest);
      dearest += choice.cost == choice.exactCost;
      EXPECT_LE(choice.cost, allowed + 1e-9)
          << name << " beside " << highlightText(choice.highlight) << " "
          << fresnelText(choice.fresnel) << ": " << saveLook(d.look) << " exponent " << m.exponent
          << " ior " << m.ior << " metalness " << m.metalness;
    }
  }
  std::sort(ratios.begin(), ratios.end());
  const auto at = [&](double share) {
    return ratios.at(std::size_t(share * double(ratios.size() - 1)));
  };
  std::printf("cost / cheapest measured of %zu: half %.3f, 90 %% %.3f, most %.3f; exact %d times\n",
              ratios.size(), at(0.5), at(0.9), at(1), dearest);
}

// The budget from which --shading auto chooses gouraud, relative to gouraud's measured error in a
// picture of 128 x 128: about twice. The bound adds diffuse light and highlight of all lights,
// which are worst at different places and may be hidden or between pixels, and counts by how much
// normal, light and view turn regardless of direction: seldom more than 4 parts of up to 2 here.
TEST(ErrorBudgetIsNotDear, WithAutomaticShading) {
  Random r(65);
  std::vector<double> ratios;
  for (int i = 0; i < draws(25); ++i) {
    Draw d = randomDraw(r, Shading::automatic, true);
    ShadingParameters& m = d.scene.materials[0].shading;
    m.exponent = r.log(2, 40);
    const int around = 20 + r.below(60);
    d.scene.meshes[0] = test::sphere(around, around / 2);
    d.look = lookFrom(d, 0);
    if (r.below(3) == 0)
      for (Light& light : *d.look.light) {
        light.type = Light::Type::point;
        light.position = r.log(3, 20) * glm::normalize(light.direction);
      }
    d.look.resolution = {128, 128};
    const Bounds bounds = boundsOf(d.scene);
    const auto drawn = [&](Shading program) {
      Look look = withForms(d.look, Highlight::exact, Fresnel::exact);
      look.shading = program;
      return ReferenceRenderer(d.scene, {}, bounds, look, 1).draw();
    };
    const Image carried = drawn(Shading::gouraud), exact = drawn(Shading::phong);
    double worst = 0;
    for (std::size_t k = 0; k < exact.values.size(); ++k)
      worst = std::max(worst, std::abs(double(carried.values[k]) - double(exact.values[k])));
    if (worst < 1e-4) continue;  // rounding counts, too
    double low = worst, high = 1e3 * worst;
    for (int step = 0; step < 24; ++step) {
      d.look.maxError = std::sqrt(low * high);
      const bool taken = resolveLook(d.scene, bounds, d.look).look.shading == Shading::gouraud;
      (taken ? high : low) = *d.look.maxError;
    }
    ratios.push_back(high / worst);
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("budget needed / measured of %zu: least %.2f, half %.2f, most %.2f\n", ratios.size(),
              ratios.front(), ratios[ratios.size() / 2], ratios.back());
  EXPECT_GE(ratios.front(), 1);
  EXPECT_LT(ratios[ratios.size() / 2], 3);
  EXPECT_LT(ratios[ratios.size() * 9 / 10], 8);
}

TEST(ErrorBudgetIsNotDear, WithPhong) { compare(Shading::phong, 61, 50, 1); }
TEST(ErrorBudgetIsNotDear, WithBlinnPhong) { compare(Shading::blinnPhong, 62, 50, 1); }
TEST(ErrorBudgetIsNotDear, WithStudioAndSky) { compare(Shading::environment, 64, 25, 2.5); }
TEST(ErrorBudgetIsNotDear, WithAWhiteEnvironment) { compare(Shading::environment, 63, 35, 1); }

}  // namespace glint::test::error_budget_dear_test
