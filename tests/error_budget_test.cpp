// --max-error: the choice keeps within its budget and is not needlessly expensive. Without GL: the
// formulas in double, with single precision's effect on the inputs of a lobe.

#include "glint/budget/error_budget.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "glint/budget/cost_file.h"
#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/bounds.h"
#include "glint/shading/costs.h"
#include "gltf_text.h"
#include "random.h"
#include "scenes.h"

namespace glint::test::error_budget_test {

int draws(int usual) { return test::drawsOf("GLINT_BUDGET_DRAWS", usual); }

using test::Random;

struct Draw {
  Scene scene;
  Look look;
};

Draw randomDraw(Random& r, bool automatic) {
  Draw d;
  Material m = test::materialOf(r.unit(), r.unit(), r.log(0.01, 2), r.log(0.5, 3000),
                                r.coin() ? 0.0 : r.unit());
  if (r.below(3) == 0) m.shading.exponent = std::round(m.shading.exponent) + 1;
  m.shading.color = r.color();
  m.shading.ior = r.coin() ? 1 + 2 * r.unit() : r.log(0.4, 4);
  if (r.below(4) == 0) m.shading.transmission = r.unit();
  d.scene = test::sceneOf(test::quad(), m);
  for (glm::vec3& n : d.scene.meshes[0].normals)
    n = glm::normalize(glm::vec3(n) +
                       float(r.coin() ? 0.2 * r.unit() : 0) * glm::vec3(r.direction()));
  constexpr Shading programs[] = {Shading::phong, Shading::blinnPhong, Shading::environment};
  d.look.shading = automatic ? Shading::automatic : programs[r.below(3)];
  d.look.maxError = r.log(1e-5, 0.5);
  d.look.light.emplace();
  const bool many = !automatic && r.below(4) == 0;  // some of which are dim
  for (int i = r.below(automatic ? 3 : many ? 24 : 5); i >= 0; --i) {
    const double brightness = many ? r.log(1e-4, 1) : 1.0;
    Light light = test::directional(r.direction(), brightness * r.color());
    if (r.below(3) == 0) {
      light.type = Light::Type::point;
      light.position = 3.0 * r.direction();
      light.direction = glm::dvec3(0.0);
    }
    d.look.light->push_back(light);
  }
  d.look.ambientLight = 0.2 * r.color();
  d.look.viewer = r.coin() ? Viewer::infinite : Viewer::local;
  d.look.environment = Environment(r.below(3));
  d.look.resolution = {12, 12};
  d.look.antiAliasing = {AntiAliasing::Mode::none, 1};
  return d;
}

double largestDifference(const Image& a, const Image& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    worst = std::max(worst, std::abs(double(a.values[i]) - double(b.values[i])));
  return worst;
}

Look exactly(const Look& look, Shading shading) {
  Look exact = look;
  exact.maxError.reset();
  exact.shading = shading;
  exact.highlight = Highlight::exact;
  exact.fresnel = Fresnel::exact;
  for (auto& [name, edit] : exact.material) edit.highlight.reset(), edit.fresnel.reset();
  return exact;
}

Image drawn(const Draw& d, const Look& look) {
  return ReferenceRenderer(d.scene, {}, boundsOf(d.scene), look, 1).draw();
}

std::string describe(const Draw& d, const ResolvedLook& r) {
  return saveLook(d.look) + saveLook(r.look) + " exponent " +
         std::to_string(d.scene.materials[0].shading.exponent);
}

TEST(ErrorBudget, PicturesKeepWithinIt) {
  Random random(21);
  int chosen = 0, byLight = 0;
  for (int i = 0; i < draws(1500); ++i) {
    const Draw d = randomDraw(random, i % 3 == 0);
    const ResolvedLook resolved = resolveLook(d.scene, boundsOf(d.scene), d.look);
    EXPECT_FALSE(resolved.look.maxError);
    const Shading truth = d.look.shading == Shading::automatic ? Shading::phong : d.look.shading;
    const double error =
        largestDifference(drawn(d, resolved.look), drawn(d, exactly(d.look, truth)));
    // Only the formulas' part: the reference has no significant rounding except that of its floats.
    ASSERT_LE(error, std::max(resolved.bound, 0.0) + 1e-6) << describe(d, resolved);
    if (resolved.bound <= *d.look.maxError) {
      ASSERT_LE(error, *d.look.maxError + 1e-6) << describe(d, resolved);
    }
    // Forms cheaper than exact are chosen only within the budget.
    for (const FormChoice& choice : resolved.choices) {
      if (choice.cost < choice.exactCost) {
        ASSERT_LE(choice.bound, *d.look.maxError) << describe(d, resolved);
      }
    }
    chosen += resolved.look.highlight != HighlightForm(Highlight::exact);
    byLight += !resolved.look.highlight.dimmer.empty();
  }
  EXPECT_GT(byLight, draws(1500) / 30);
  EXPECT_GT(chosen, draws(1500) / 4);
}

// Compared with a search over all forms for those whose measured error over lambda, not their
// bound, is within the budget: the chosen one costs no more than the cheapest for half of the
// budget.
TEST(ErrorBudget, TheChoiceIsNotNeedlesslyDear) {
  Random random(22);
  for (int i = 0; i < draws(150); ++i) {
    Draw d = randomDraw(random, false);
    d.look.shading = Shading::phong;
    d.look.maxError = random.log(1e-3, 0.3);
    ShadingParameters& m = d.scene.materials[0].shading;
    const ResolvedLook resolved = resolveLook(d.scene, boundsOf(d.scene), d.look);
    ASSERT_EQ(resolved.choices.size(), 1u);
    glm::dvec3 light(0.0);
    for (const Light& each : *d.look.light) light += each.intensity;
    const glm::dvec3 S = m.metalness * m.color + (1 - m.metalness);
    const double scale = m.specular * std::max({S.x * light.x, S.y * light.y, S.z * light.z});
    double least = CostTable().lobe(Highlight::exact, 1);
    for (Highlight form : {Highlight::lyon, Highlight::lyonTuned, Highlight::lyonCross,
                           Highlight::pade, Highlight::gaussian})
      for (int gamma = 1; gamma <= 64; gamma *= 2) {
        double worst = 0;
        for (int k = 0; k <= 4000; ++k)
          for (double x : {k / 2000.0, std::min(15.0 / m.exponent, 2.0) * k / 4000}) {
            const double exact = x < 1 ? std::exp(m.exponent * std::log1p(-x)) : 0.0;
            worst = std::max(worst, std::abs(lobe(form, gamma, x, m.exponent) - exact));
          }
        if (scale * worst < 0.6 * *d.look.maxError)
          least = std::min(least, CostTable().lobe(form, gamma));
      }
    EXPECT_LE(resolved.choices[0].cost, least * double(d.look.light->size()) + 1e-9)
        << describe(d, resolved);
  }
}

// With a table in which another form is the cheapest, that one is chosen; the table applies only
// with a budget.
TEST(ErrorBudget, GoesByTheTableOfCostsThatTheLookNames) {
  Random random(26);
  Draw d = randomDraw(random, false);
  d.scene.materials[0].shading = {};
  d.scene.materials[0].shading.specular = 0.5;
  d.scene.materials[0].shading.exponent = 300;
  d.look = {};
  d.look.maxError = 0.01;
  const auto chosen = [&] { return resolveLook(d.scene, boundsOf(d.scene), d.look); };
  const HighlightForms shipped = chosen().choices.at(0).highlight;
  EXPECT_NE(shipped, HighlightForms(Highlight::gaussian));
  CostFile file;
  file.costs.lobes[Highlight::gaussian] = {1};
  d.look.costTable = test::temporaryFolder() + "/gaussian.json";
  std::ofstream(d.look.costTable) << costFileText(file);
  const ResolvedLook resolved = chosen();
  EXPECT_EQ(resolved.choices.at(0).highlight, HighlightForms(Highlight::gaussian));
  EXPECT_LE(resolved.bound, 0.01);
  EXPECT_EQ(resolved.choices.at(0).cost, 1);
  EXPECT_EQ(resolved.look.costTable, "");
  d.look.costTable = "/no/such.json";
  EXPECT_THROW(chosen(), InputError);
  d.look.maxError.reset();  // nothing to choose
  EXPECT_EQ(chosen().look.costTable, "/no/such.json");
}

TEST(ErrorBudget, BelowTheExactFormsOwnBoundItIsExact) {
  Random random(23);
  for (int i = 0; i < 20; ++i) {
    Draw d = randomDraw(random, false);
    d.look.maxError = 0;
    const ResolvedLook resolved = resolveLook(d.scene, boundsOf(d.scene), d.look);
    EXPECT_EQ(resolved.look.highlight, Highlight::exact);
    EXPECT_EQ(resolved.look.fresnel, Fresnel::exact);
    EXPECT_GT(resolved.bound, 0);
    EXPECT_THAT(resolved.choices.at(0).reason, testing::HasSubstr("no form is within 0"));
  }
}

TEST(ErrorBudget, ALargerBudgetNeverCostsMore) {
  Random random(24);
  for (int i = 0; i < 40; ++i) {
    Draw d = randomDraw(random, false);
    double before = 1e9;
    for (double budget : {0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 1e6}) {
      d.look.maxError = budget;
      const ResolvedLook resolved = resolveLook(d.scene, boundsOf(d.scene), d.look);
      EXPECT_LE(resolved.choices.at(0).cost, before) << budget;
      before = resolved.choices.at(0).cost;
    }
  }
}

TEST(ErrorBudget, ResolvedLooksStayAsTheyAre) {
  Random random(25);
  for (int i = 0; i < 40; ++i) {
    const Draw d = randomDraw(random, i % 2 == 0);
    const ResolvedLook once = resolveLook(d.scene, boundsOf(d.scene), d.look);
    EXPECT_EQ(resolveLook(d.scene, boundsOf(d.scene), once.look).look, once.look);
    Look back;
    readLook(back, saveLook(once.look), "look");
    EXPECT_EQ(back, once.look);
  }
}

TEST(ErrorBudget, MaterialsThatDifferGetFormsOfTheirOwn) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 1, 1, 2000));
  scene.materials[0].name = "sharp";
  Material dull = test::materialOf(1, 1, 0.001, 3.5);
  dull.name = "dull";
  scene.materials.push_back(dull);
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes[1].material = int(scene.materials.size()) - 1;
  scene.instances.push_back({1, glm::dmat4(1.0)});
  Look look;
  look.maxError = 0.005;
  const ResolvedLook resolved = resolveLook(scene, boundsOf(scene), look);
  ASSERT_EQ(resolved.choices.size(), 2u);
  EXPECT_NE(resolved.choices[0].highlight, resolved.choices[1].highlight);
  EXPECT_EQ(resolved.look.material.at("dull").highlight, resolved.choices[0].highlight);
  EXPECT_EQ(resolved.look.material.at("sharp").highlight, resolved.choices[1].highlight);
}

// The worst of all materials with the same name counts, in either order.
TEST(ErrorBudget, MaterialsOfOneNameShareTheWorst) {
  for (const bool swapped : {false, true}) {
    Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 1, swapped ? 0.1 : 0.7, 20));
    scene.materials.push_back(test::materialOf(1, 1, swapped ? 0.7 : 0.1, 20));
    for (Material& m : scene.materials) m.name = "both";
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[1].material = 1;
    scene.instances.push_back({1, glm::dmat4(1.0)});
    Look look;
    look.light = {test::directional({0, 0, 1})};
    look.maxError = 1e6;
    const ResolvedLook resolved = resolveLook(scene, boundsOf(scene), look);
    ASSERT_EQ(resolved.choices.size(), 1u);
    EXPECT_NEAR(resolved.choices[0].lobe, 0.7, 1e-12);
  }
}

// Likewise for exponents, indices and meshes.
TEST(ErrorBudget, SurfacesOfOneNameShareTheWorst) {
  const auto bound = [](double first, double second, double firstIor, double secondIor) {
    Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 1, 0.7, first));
    scene.materials.push_back(test::materialOf(1, 1, 0.7, second));
    scene.materials[0].shading.ior = firstIor, scene.materials[1].shading.ior = secondIor;
    for (Material& m : scene.materials) m.name = "both";
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[1].material = 1;
    scene.instances.push_back({1, glm::dmat4(1.0)});
    Look look;
    look.shading = Shading::environment;
    look.light = {test::directional({0, 0, 1})};
    look.maxError = 0.3;
    return resolveLook(scene, boundsOf(scene), look).choices.at(0);
  };
  EXPECT_DOUBLE_EQ(bound(30, 2.5, 1.5, 1.5).lobe, bound(2.5, 30, 1.5, 1.5).lobe);
  EXPECT_DOUBLE_EQ(bound(30, 30, 1.5, 1.1).reflectance, bound(30, 30, 1.1, 1.5).reflectance);
}

// Lights that no normal faces together count one at a time; glass seen from inside rounds more.
TEST(ErrorBudget, LightsFromBothSidesCountOnce) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 1, 0.7, 20));
  Look look;
  look.light = {test::directional({0, 0, 1}), test::directional({0, 0, -1})};
  look.maxError = 1e6;
  EXPECT_NEAR(resolveLook(scene, boundsOf(scene), look).choices.at(0).lobe, 0.7, 1e-12);
  look.shading = Shading::environment;
  look.maxError = 0;
  const double front = resolveLook(scene, boundsOf(scene), look).bound;
  look.twoSided = true;
  EXPECT_GT(resolveLook(scene, boundsOf(scene), look).bound, 5 * front);
}

// A highlight on glass counts only by the share that the glass does not transmit.
TEST(ErrorBudget, HighlightsOnGlassCountByTheirShare) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 1, 0.8, 20));
  scene.materials[0].shading.transmission = 0.75;
  Look look;
  look.shading = Shading::environment;
  look.light = {test::directional({0, 0, 1})};
  look.maxError = 1e6;
  EXPECT_NEAR(resolveLook(scene, boundsOf(scene), look).choices.at(0).lobe, 0.2, 1e-12);
}

// Shading per vertex pays only while there are fewer vertices than pixels.
TEST(ErrorBudget, FineModelsInSmallPicturesAreShadedPerPixel) {
  const Scene scene = test::sceneOf(test::sphere(64, 32), test::materialOf(1, 1, 0, 20));
  Look look;
  look.shading = Shading::automatic;
  look.maxError = 0.1;
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::gouraud);
  look.resolution = {48, 48};
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::phong);
}

// A key light and many dim ones: the highlights of the dim ones may have larger errors.
TEST(ErrorBudget, DimLightsGetCheaperForms) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 0.8, 0.5, 60.5));
  Look look;
  look.light = {test::directional({0, 1, 1}, glm::dvec3(1e-5)),
                test::directional({0, 0, 1}, glm::dvec3(1))};
  for (int i = 0; i < 12; ++i)
    look.light->push_back(test::directional({1, 0.1 * i, 1}, glm::dvec3(0.002)));
  look.maxError = 2e-3;
  const ResolvedLook resolved = resolveLook(scene, boundsOf(scene), look);
  const HighlightForms& forms = resolved.look.highlight;
  EXPECT_EQ(forms.of(13), HighlightForm(Highlight::none)) << highlightText(forms);
  EXPECT_NE(forms.of(0), forms.of(1)) << highlightText(forms);
  EXPECT_LE(resolved.bound, 2e-3);
  const auto lobe = [&](int light) {
    const HighlightForm form = forms.of(light);
    return lobeFormulaBound(form.form, form.gamma, 60.5);
  };
  EXPECT_LT(lobe(0), lobe(1));
  double error = 0.5 * (lobe(0) + 1e-5);
  for (int light = 1; light < 13; ++light) error += 0.5 * 0.002 * lobe(light);
  EXPECT_NEAR(resolved.choices.at(0).lobe, error, 1e-12);
}

// Among meshes that share a material the coarsest counts, wherever it is.
TEST(ErrorBudget, TheCoarsestMeshOfAMaterialCounts) {
  const auto interpolation = [](std::vector<Mesh> meshes) {
    Scene scene = test::sceneOf(meshes[0], test::materialOf(1, 0.8, 0.5, 20));
    for (std::size_t i = 1; i < meshes.size(); ++i) {
      meshes[i].material = scene.meshes[0].material;
      scene.meshes.push_back(meshes[i]);
      scene.instances.push_back({int(i), glm::dmat4(1.0)});
    }
    Look look;
    look.shading = Shading::automatic;
    look.maxError = 100;
    const ResolvedLook resolved = resolveLook(scene, boundsOf(scene), look);
    EXPECT_EQ(resolved.look.shading, Shading::gouraud);
    return resolved.choices.at(0).interpolation;
  };
  const Mesh coarse = test::sphere(16, 8), fine = test::sphere(64, 32);
  EXPECT_GT(interpolation({coarse}), 2 * interpolation({fine}));
  for (const std::vector<Mesh>& both : {std::vector<Mesh>{coarse, fine}, {fine, coarse}})
    EXPECT_NEAR(interpolation(both), interpolation({coarse}), 1e-9);
}

TEST(ErrorBudget, FlatIsChosenWhereItIsExact) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 0.8, 0.5, 20));
  Look look;
  look.shading = Shading::automatic;
  look.cameraDirection = glm::dvec3(0, 0, -1);
  look.light = {test::directional({0, 0, 1})};
  look.viewer = Viewer::infinite;
  look.maxError = 1e-3;
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::flat);
  look.viewer = Viewer::local;  // the highlight moves over the face
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::phong);
  look.maxError.reset();
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::phong);
}

// A lamp with fall-off counts by the intensity that it has at the nearest point of the scene.
TEST(ErrorBudget, LampsThatWeakenCountWhereTheyAreNearest) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 0, 0.5, 20));
  Look look;
  look.maxError = 1e6;
  Light lamp;
  lamp.type = Light::Type::point;
  lamp.fallsOff = true;
  // Above the middle of the square of half size 2, beside an edge, and beyond a corner.
  for (const auto& [place, nearest] :
       {std::pair{glm::dvec3(0, 0, 3), 3.0}, std::pair{glm::dvec3(0.5, 1, -0.25), 0.25},
        std::pair{glm::dvec3(5, 1, 4), 5.0}, std::pair{glm::dvec3(-4, -3, 2), 3.0}}) {
    lamp.position = place;
    look.light = {lamp};
    EXPECT_NEAR(resolveLook(scene, boundsOf(scene), look).choices.at(0).lobe,
                0.5 / (nearest * nearest), 1e-5);
  }
}

// Faces under a distant lamp: nearly constant.
TEST(ErrorBudget, LampsAreNoHindrance) {
  Scene scene = test::sceneOf(test::quad(), test::materialOf(1, 0.8, 0, 20));
  Look look;
  look.shading = Shading::automatic;
  look.maxError = 0.02;
  Light lamp;
  lamp.type = Light::Type::point;
  lamp.position = {50, 0, 200};
  look.light = {lamp};
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::flat);
  look.maxError = 1e-3;
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::gouraud);
  lamp.position = {0.5, 0, 1};
  look.light = {lamp};
  EXPECT_EQ(resolveLook(scene, boundsOf(scene), look).look.shading, Shading::phong);
}

TEST(ActiveIntensity, CountsOnlyLightsThatOneNormalSees) {
  using V = std::vector<glm::dvec3>;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), one(1.0), half(0.5);
  EXPECT_EQ(activeIntensity({}, {}), glm::dvec3(0.0));
  EXPECT_EQ(activeIntensity({x}, {one}), one);
  EXPECT_EQ(activeIntensity({x, -x}, {one, half}), one);
  EXPECT_EQ(activeIntensity({x, y, z}, {one, one, one}), glm::dvec3(3.0));
  EXPECT_EQ(activeIntensity({x, -x, y, -y, z, -z}, V(6, one)), glm::dvec3(3.0));
  EXPECT_EQ(activeIntensity({x, x, -x}, V(3, one)), glm::dvec3(2.0));
  // Compared with random normals: never below, and reached.
  Random random(26);
  for (int i = 0; i < 20; ++i) {
    V directions, intensities;
    for (int k = 2 + random.below(8); k > 0; --k) {
      directions.push_back(random.direction());
      intensities.push_back(random.color());
    }
    glm::dvec3 most(0.0);
    for (int k = 0; k < 5000; ++k) {
      const glm::dvec3 n = random.direction();
      glm::dvec3 sum(0.0);
      for (std::size_t j = 0; j < directions.size(); ++j)
        if (glm::dot(n, directions[j]) > 0) sum += intensities[j];
      most = glm::max(most, sum);
    }
    const glm::dvec3 bound = activeIntensity(directions, intensities);
    for (int c = 0; c < 3; ++c) {
      EXPECT_LE(most[c], bound[c] + 1e-12);
      EXPECT_GE(most[c], 0.75 * bound[c]);
    }
  }
}

}  // namespace glint::test::error_budget_test
