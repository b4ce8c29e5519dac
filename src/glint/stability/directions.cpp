// Group C: the directions N, L and V where they coincide, oppose or vanish.

#include <random>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

constexpr double exponents[] = {0, 1, 20, 1e3, 1e6};

glm::dvec3 toViewer(const glm::vec3& position) { return safeNormalize(-glm::dvec3(position)); }

/// Expected values by the formulas of docs/science.md, for exactly the floats of the geometries.
std::vector<LightValues> formulas(const std::vector<Geometry>& geometries, double exponent) {
  std::vector<LightValues> values;
  for (const Geometry& g : geometries)
    values.push_back(
        formulaValues(safeNormalize(glm::dvec3(g.n)), glm::dvec3(g.l), toViewer(g.p), exponent));
  return values;
}

/// Geometries with L = N = V, in many directions.
std::vector<Geometry> aligned() {
  std::vector<Geometry> all{{{0, 0, 1}, {0, 0, 1}, {0, 0, -1}}};
  for (const glm::dvec3& n : randomDirections(200, 3)) {
    const glm::vec3 v(n);
    all.push_back({v, v, -v});
  }
  return all;
}

/// Geometries with V = sign * R, for light from all directions in front.
std::vector<Geometry> mirrored(double sign) {
  std::vector<Geometry> all;
  const std::vector<glm::dvec3> normals = randomDirections(200, 5),
                                lights = randomDirections(200, 7);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 n = normals[i];
    const glm::dvec3 l = glm::dot(n, lights[i]) > 0 ? lights[i] : -lights[i];
    if (glm::dot(n, l) < 0.05) continue;
    const glm::dvec3 r = 2 * glm::dot(n, l) * n - l;
    all.push_back({glm::vec3(n), glm::vec3(l), glm::vec3(-sign * r)});
  }
  return all;
}

std::string alphaText(double exponent) { return "exponent " + numberText(exponent); }

void c1(Bench& bench, Record& record) {
  const std::vector<Geometry> all = aligned();
  for (double alpha : exponents) {
    const std::vector<LightValues> one(all.size(), LightValues{1, 1, 1});
    expectLight(bench, record, "L = N = V, " + alphaText(alpha), alpha, all, one,
                tolerancesFor(alpha));
    for (Shading shading : {Shading::phong, Shading::blinnPhong}) {
      double highest = 0;
      for (const glm::vec3& c :
           bench.programs().shade({bench.lit(shading), litMaterial(0, 1, alpha)}, pointsOf(all)))
        highest = c.y > highest || std::isnan(c.y) ? c.y : highest;
      record.within(std::string(shadingName(shading)) + ": peak, " + alphaText(alpha), highest, 0,
                    1);
    }
  }
}

void expectDark(Bench& bench, Record& record, const std::string& what,
                const std::vector<Geometry>& geometries) {
  for (double alpha : {0.0, 1.0, 5.0, 1e3})
    expectLight(bench, record, what + ", " + alphaText(alpha), alpha, geometries,
                std::vector<LightValues>(geometries.size()), {0, 0, 0});
}

void c2(Bench& bench, Record& record) {
  expectDark(bench, record, "L = -N",
             {{{0, 0, 1}, {0, 0, -1}, {0, 0, -1}},
              {{0, 1, 0}, {0, -1, 0}, {0, -1, -1}},
              {{0.6f, 0, 0.8f}, {-0.6f, 0, -0.8f}, {0, 0, -1}}});
}

void c3(Bench& bench, Record& record) {
  expectDark(bench, record, "L at right angles to N",
             {{{0, 0, 1}, {1, 0, 0}, {1, 0, 0}},  // V = R = -L
              {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}},
              {{0, 0, 1}, {0.6f, 0.8f, 0}, {0.6f, 0.8f, -0.01f}}});
}

void c4(Bench& bench, Record& record) {
  // V = R. The half vector is 2e-8 long and counts as undefined: Blinn-Phong gives nothing.
  const std::vector<Geometry> lit{{{0, 0, 1}, {1, 0, 1e-8f}, {1, 0, -1e-8f}}};
  const std::vector<Geometry> unlit{{{0, 0, 1}, {1, 0, -1e-8f}, {1, 0, -1e-8f}}};
  expectLight(bench, record, "N.L = 1e-8", 20, lit, {{1e-8, 1, 0}}, {1e-14, lobeTolerance(20), 0});
  expectLight(bench, record, "N.L = -1e-8", 20, unlit, {{0, 0, 0}}, {0, 0, 0});
}

void c5(Bench& bench, Record& record) {
  const std::vector<Geometry> all = mirrored(1);
  for (double alpha : exponents) {
    LightTolerances tolerances = tolerancesFor(alpha);
    tolerances.blinn *= 5;  // |L + V| = 2 N.L may be 0.1
    std::vector<LightValues> expected = formulas(all, alpha);
    for (LightValues& e : expected) e.phong = e.blinn = 1;
    // L and V are rounded to floats: V is R only to 1.2e-7.
    tolerances.phong += 0.5 * alpha * 1.5e-14;
    tolerances.blinn += 2 * alpha * 4e-12;
    const bool exact = bench.lobeIsExact();
    const Points points = pointsOf(all);
    for (Shading shading : everyShading) {
      const PointScene scene(bench.lit(shading), litMaterial(1, 1, alpha));
      const std::vector<glm::vec3> got = bench.programs().shade(scene, points);
      const std::vector<glm::dvec3> truth = referenceShade(scene, points);
      Worst worst;
      for (std::size_t i = 0; i < all.size(); ++i)
        worst.add(got[i].y, exact ? 1.0 : truth[i].y,
                  isBlinn(shading) ? tolerances.blinn : tolerances.phong,
                  "N " + vectorText(all[i].n) + " L " + vectorText(all[i].l));
      worst.into(record, std::string(shadingName(shading)) + ": V = R, " + alphaText(alpha));
    }
  }
}

void c6(Bench& bench, Record& record) {
  const std::vector<Geometry> all{{{0, 0, 1}, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}},
                                  {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
  // R.V = -1: Phong gives 0. L + V is (1.2, 0, 0), at right angles to N, or 0. At right angles some
  // approximations jump: any value is allowed there.
  const double edge = bench.lobeIsExact() ? 1e-6 : 1;
  for (double alpha : {1.0, 5.0, 1e3})
    expectLight(bench, record, "V = -R, " + alphaText(alpha), alpha, all, {{0.8, 0, 0}, {1, 0, 0}},
                {diffuseTolerance, 1e-6, edge});
}

void c7(Bench& bench, Record& record) {
  const float s = float(std::sqrt(0.75));
  const std::vector<Geometry> all{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                                  {{0, 0, 1}, {s, 0, 0.5f}, {s, 0, 0.5f}},
                                  {{0, 0, 1}, {1, 0, 0}, {1, 0, 0}}};
  // Phong's R.V = 1 - 2 (N.L)^2 is -1, 1/2, and gated.
  for (double alpha : {1.0, 4.0})
    expectLight(bench, record, "L = -V, " + alphaText(alpha), alpha, all,
                {{1, 0, 0}, {0.5, std::pow(0.5, alpha), 0}, {0, 0, 0}},
                {diffuseTolerance, lobeTolerance(alpha), 0});
}

void c8(Bench& bench, Record& record) {
  std::vector<Geometry> all;
  for (float off : {1e-7f, -1e-7f, 5e-7f})
    for (const glm::vec3& side : {glm::vec3(0, 1, 0), glm::vec3(0.8f, 0, -0.6f)})
      all.push_back({{0, 0, 1}, {0.6f, 0, 0.8f}, glm::vec3(0.6f, 0, 0.8f) + off * side});
  std::vector<LightValues> expected = formulas(all, 3);
  for (LightValues& e : expected) e.blinn = 0;
  expectLight(bench, record, "L = -V within 1e-7", 3, all, expected,
              {diffuseTolerance, lobeTolerance(3), 0});
}

void c9(Bench& bench, Record& record) {
  // Seen from below the tangent plane: the formulas apply unchanged, since the gate depends only on
  // N.L.
  const std::vector<Geometry> all{{{0, 0, 1}, {0.96f, 0, 0.28f}, {0.9f, 0.1f, 0.2f}},
                                  {{0, 0, 1}, {0, 0.6f, 0.8f}, {0.1f, 0.9f, 0.05f}},
                                  {{0, 0, 1}, {0, 0, 1}, {0.3f, 0, 0.9f}}};
  for (double alpha : {1.0, 5.0, 50.0})
    expectLight(bench, record, "N.V < 0, " + alphaText(alpha), alpha, all, formulas(all, alpha),
                tolerancesFor(alpha));
  // Two-sided: on the back the normal is turned.
  Look look = bench.lit();
  look.twoSided = true;
  Points points;
  points.add({0, 0, -1}, {0, 0, -1}, {0, 0, 1});
  points.front = false;
  for (Shading shading : everyShading) {
    look.shading = shading;
    const PointScene scene(look, litMaterial(1, 1, 5));
    const std::string name(shadingName(shading));
    record.near(name + ": back of a two-sided surface, light behind the viewer",
                bench.programs().shade(scene, points)[0].y, 1, lobeTolerance(20));
    record.near(name + " in the reference: the same", referenceShade(scene, points)[0].y, 1, 1e-12);
  }
}

void c10(Bench& bench, Record& record) {
  // Light 150 degrees from the viewer: without the gate 0.487 of it leaks at exponent 5.
  const double w = 150 * degrees;
  std::vector<Geometry> all;
  for (double t : {95.0, 100.0, 110.0, 120.0}) {
    const glm::dvec3 l(std::sin(w), 0, std::cos(w)),
        n(std::sin((150 - t) * degrees), 0, std::cos((150 - t) * degrees));
    all.push_back({glm::vec3(n), glm::vec3(l), {0, 0, -1}});
  }
  expectDark(bench, record, "N.L < 0, R.V > 0", all);
}

void c11(Bench& bench, Record& record) {
  const std::vector<Geometry> at{{{0, 0, 1}, {0, 0, -1}, {0, 0, -1}},
                                 {{0, 0, 1}, {0.25f, 0.5f, -3}, {0.25f, 0.5f, -3}}};
  for (double alpha : {0.0, 20.0})
    expectLight(bench, record, "point light at the place itself, " + alphaText(alpha), alpha, at,
                {{0, 0, 0}, {0, 0, 0}}, {0, 0, 0}, Light::Type::point);
}

void c12(Bench& bench, Record& record) {
  for (float distance : {1e-30f, 1e-20f, 1e20f, 1e30f}) {
    // At the eye itself, where V is +Z: R.V = 0.8, N.H = 0.9487.
    const std::vector<Geometry> all{{{0, 0, 1}, glm::vec3(0.6f, 0, 0.8f) * distance, {0, 0, 0}}};
    const double h = std::sqrt(0.9);
    expectLight(bench, record, "point light at a distance of " + numberText(distance), 10, all,
                {{0.8, std::pow(0.8, 10), std::pow(h, 40)}}, tolerancesFor(10), Light::Type::point);
  }
  // A spot at the same distances, with the place inside its cone of 90 degrees.
  for (float distance : {1e-30f, 1e30f})
    for (Shading shading : {Shading::phong, Shading::gouraud}) {
      Look spotLook = bench.look(shading);
      spotLook.light = {spotAlong({0, 0, -1}, 89, 90)};
      Points points;
      points.add({0, 0, 1}, {0, 0, 0}, glm::vec3(0.6f, 0, 0.8f) * distance);
      const PointScene scene(spotLook, litMaterial(1, 0, 1));
      record.near(
          std::string(shadingName(shading)) + ": spot at a distance of " + numberText(distance),
          bench.programs().shade(scene, points)[0].x, 0.8, diffuseTolerance);
    }
  // The same through the renderer, with a light 1e30 away in the world.
  Look look = bench.look(Shading::phong);
  Light light;
  light.type = Light::Type::point;
  light.position = glm::dvec3(0.6e30, 0, 0.8e30);
  look.light = {light};
  const Scene scene = sceneOf(square(), litMaterial(1, 0, 1));
  const Image image = bench.draw(scene, parallel(look));
  record.near("picture with a point light 1e30 away", image.row(4)[16], 0.8, diffuseTolerance);
}

void c13(Bench& bench, Record& record) {
  const std::vector<Geometry> all{{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 0}},
                                  {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}}};
  expectLight(bench, record, "eye on the surface", 10, all,
              {{0.8, std::pow(0.8, 10), std::pow(std::sqrt(0.9), 40)}, {1, 1, 1}},
              tolerancesFor(10));
}

void c14(Bench& bench, Record& record) {
  expectDark(bench, record, "directional light without direction",
             {{{0, 0, 1}, {0, 0, 0}, {0, 0, -1}}, {{0.6f, 0, 0.8f}, {-0.0f, 0, 0}, {1, 2, -3}}});
  record.refused(
      "--light directional:0,0,0", [] { parseLight("directional:0,0,0"); }, "has no direction");
  record.refused(
      "--light spot:...:0,0,0:...", [] { parseLight("spot:0,0,0:0,0,0:10,20"); },
      "has no direction");
  Look look = bench.look(Shading::blinnPhong);
  look.light = {Light{}};  // its direction is (0, 0, 0)
  const Scene scene = sceneOf(square(), litMaterial(1, 1, 5));
  const Image image = bench.draw(scene, parallel(look));
  record.near("picture of such a light given as a value", image.row(4)[16], 0, 0);
}

void c15(Bench& bench, Record& record) {
  // A plane under a directional light and a parallel view is the same in every pixel.
  for (Shading shading : everyShading) {
    Look look = parallel(bench.lit(shading, {0.3, 0.2, 1}));
    const Scene scene = sceneOf(square({0.2, 0.1, 1}, 4), litMaterial(0.25, 0.5, 30));
    const Image got = bench.draw(scene, look), truth = bench.reference(scene, look);
    const std::string name(shadingName(shading));
    const LightValues v = formulaValues(
        safeNormalize(shading == Shading::flat ? glm::dvec3(0, 0, 1) : glm::dvec3(0.2, 0.1, 1)),
        safeNormalize({0.3, 0.2, 1}), {0, 0, 1}, 30);
    const double lobe = isBlinn(shading) ? v.blinn : v.phong;
    for (int at : {0, 31, 63}) {
      const double value = bench.lobeIsExact() ? 0.5 * lobe : truth.values[std::size_t(at) * 4 + 1];
      record.near(
          name + ": highlight at pixel " + std::to_string(at % 8) + "," + std::to_string(at / 8),
          got.values[std::size_t(at) * 4 + 1], value, 2 * lobeTolerance(120));
    }
  }
}

void c16(Bench& bench, Record& record) {
  for (Shading shading : {Shading::phong, Shading::blinnPhong}) {
    const std::string name(shadingName(shading));
    Look look = bench.lit(shading);
    look.cameraPosition = glm::dvec3(0, 0, 2);
    look.cameraFocalPoint = glm::dvec3(0);
    look.cameraViewAngle = 90;
    const Scene scene = sceneOf(square({0, 0, 1}, 4), litMaterial(0, 1, 8));
    const Image local = bench.draw(scene, look);
    look.viewer = Viewer::infinite;
    const Image infinite = bench.draw(scene, look);
    record.near(name + ": infinite viewer, corner of a 90 degree view", infinite.values[1], 1,
                lobeTolerance(32));
    // V is 52 degrees off the axis there.
    record.within(name + ": local viewer, the same corner", local.values[1], 0, 0.6);
    const DrawList list = makeDrawList(scene, boundsOf(scene), look);
    bool labelled = false;
    for (const std::string& feature : featureNames(list.items.at(0).variant))
      labelled = labelled || feature == "constant-view";
    record.that(name + ": the variant says constant-view", labelled);
    record.alike(name + ": infinite viewer against the reference", infinite,
                 bench.reference(scene, look), 2 * lobeTolerance(32));
  }
}

constexpr const char* lightTolerance =
    "diffuse 6e-7 (roundings of unit vectors), highlight 1e-6 + 4e-7 sqrt(exponent): D is exact "
    "near the peak, so that lambda is off by |D| 6.5e-7";

const Case directionTable[] = {
    {"C1", "L = N = V, exponent 0 to 1e6, 200 directions", "diffuse 1, highlight 1, never above 1",
     lightTolerance, "pow(1 + 2^-23, exponent) exceeds the peak and pow(1 - 2^-24, 1e6) is 0.94",
     "", c1},
    {"C2", "L = -N", "0", "exact", "the gate N.L > 0", "", c2},
    {"C3", "L at right angles to N; V = -L", "diffuse 0, highlight 0", "exact",
     "R = -L: without the gate V = -L gives a highlight of 1",
     "a light shines where N.L > 0, not where it is 0", c3},
    {"C4", "N.L = 1e-8 and -1e-8, V = R", "diffuse 1e-8 and 0; Phong 1 and 0; Blinn-Phong 0",
     "diffuse to 1e-14, highlight 1e-6 + 4e-7 sqrt(exponent)",
     "diffuse light is continuous at the terminator, the gated highlight jumps",
     "where |L + V|^2 <= 1e-12 the half vector is undefined and Blinn-Phong has no highlight", c4},
    {"C5", "V = R, 200 directions, exponent 0 to 1e6", "highlight 1", lightTolerance,
     "lambda = 0: the dot product of rounded vectors is a staircase there", "", c5},
    {"C6", "V = -R", "Phong 0", "1e-6", "the cross product form is 1 again without its gate", "",
     c6},
    {"C7", "L = -V, N.L = 1, 1/2, 0", "Blinn-Phong 0, no NaN; Phong max(R.V, 0)^exponent",
     "exact; highlight 1e-6 + 4e-7 sqrt(exponent)", "H = 0/0",
     "the gate is N.L > 0 alone: Phong is as its formula also where N.V < 0", c7},
    {"C8", "L = -V within 1e-7 and 5e-7", "Blinn-Phong 0; Phong as its formula", "exact",
     "H is noise: the gate comes before the division",
     "where |L + V|^2 <= 1e-12 the half vector is undefined and Blinn-Phong has no highlight", c8},
    {"C9", "N.V < 0: an interpolated normal turned away", "the formulas as they stand",
     lightTolerance, "silhouettes",
     "the gate is N.L > 0 alone; N.V < 0 is clamped in the reflectance only; on back faces of "
     "two-sided surfaces the normal is turned to the viewer",
     c9},
    {"C10", "light 150 degrees from the viewer, N.L < 0 < R.V", "0", "exact",
     "without the gate 0.487 leaks at exponent 5", "", c10},
    {"C11", "point light at the place itself", "0, finite", "exact", "normalize(0) is NaN",
     "a light without direction contributes nothing", c11},
    {"C12", "point light 1e-30 to 1e30 away", "diffuse 0.8: the direction is right", lightTolerance,
     "squares under- and overflow", "", c12},
    {"C13", "eye on the surface", "finite: V = +Z", lightTolerance, "V = 0/0",
     "at the eye itself V is +Z in eye space", c13},
    {"C14", "directional light of direction 0", "refused as an option, nothing as a value", "exact",
     "normalize(0) is NaN", "a light without direction contributes nothing", c14},
    {"C15", "orthographic camera, plane, directional light", "one highlight in every pixel",
     "1e-6 + 4e-7 sqrt(exponent of Blinn), twice", "-P in place of V bends it", "", c15},
    {"C16", "infinite viewer in a 90 degree view", "differs from the local viewer, and says so",
     "0.4 apart in the corner", "the highlight moves by 22 degrees",
     "--viewer infinite is a choice; the variant is called constant-view", c16},
};

}  // namespace

std::span<const Case> directionCases() { return directionTable; }

}  // namespace glint::stability
