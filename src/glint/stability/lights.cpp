// Group F: lights and colours.

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/shading/sum.h"
#include "glint/stability/bench.h"
#include "glint/stability/document.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

Look whiteLook(Bench& bench, Shading shading) {
  Look look = parallel(bench.lit(shading), {0, 0, 1}, 3);
  return look;
}

Material material(double ambient, double diffuse, double specular, double metalness,
                  const glm::dvec3& color) {
  Material m;
  m.shading = {ambient, diffuse, specular, 10, metalness, 1.0, color};
  return m;
}

/// Checks the middle of a square seen from the front, by every program and the reference.
void expectEverywhere(Bench& bench, Record& record, const std::string& what, const Material& m,
                      const glm::dvec3& ambientLight, const std::vector<Light>& lights,
                      const glm::dvec3& expected, double tolerance) {
  for (Shading shading : everyShading) {
    Look look = whiteLook(bench, shading);
    look.ambientLight = ambientLight;
    look.light = lights;
    const Scene scene = sceneOf(square(), m);
    const std::string name(shadingName(shading));
    // In a white room a metal seen from the front reflects its colour.
    glm::dvec3 own = expected;
    if (shading == Shading::environment) own += m.shading.metalness * m.shading.color;
    record.color(name + ": " + what, middle(bench.draw(scene, look)), own, tolerance);
    record.color(name + " in the reference: " + what, middle(bench.reference(scene, look)), own,
                 tolerance);
  }
}

void f1(Bench& bench, Record& record) {
  expectEverywhere(bench, record, "no light", material(0.5, 1, 1, 0, {0.5, 0.25, 1}),
                   glm::dvec3(0.5), {}, {0.125, 0.0625, 0.25}, 0);
  Look look = whiteLook(bench, Shading::phong);
  look.noLights = true;
  look.ambientLight = glm::dvec3(1);
  record.color("--no-lights",
               middle(bench.draw(sceneOf(square(), material(1, 1, 1, 0, glm::dvec3(0.5))), look)),
               glm::dvec3(0.5), 0);
}

void f2(Bench& bench, Record& record) {
  const glm::dvec3 l = safeNormalize({0.3, 0.2, 1});
  const Scene scene = sceneOf(square(), material(0, 0.7, 0.5, 0, {1, 0.5, 0.25}));
  for (Shading shading : everyShading) {
    Look look = whiteLook(bench, shading);
    look.light = {directional(l)};
    const Image one = bench.draw(scene, look);
    look.light = std::vector<Light>(64, directional(l, glm::dvec3(1 / 64.0)));
    const Image many = bench.draw(scene, look);
    record.alike(std::string(shadingName(shading)) + ": 64 lights of 1/64 against one", many, one,
                 1e-6);
    record.alike(std::string(shadingName(shading)) + " in the reference",
                 bench.reference(scene, look), one, 4e-6);
  }
}

void f3(Bench& bench, Record& record) {
  record.refused(
      std::to_string(maxLights + 1) + " lights",
      [&] { bench.take("light", "directional:0,0,1", maxLights + 1); },
      "more than " + std::to_string(maxLights) + " lights");
  // The largest number allowed is drawn.
  Look look = whiteLook(bench, Shading::phong);
  look.light =
      std::vector<Light>(maxLights, directional({0, 0, 1}, glm::dvec3(1 / double(maxLights))));
  record.color(std::to_string(maxLights) + " lights",
               middle(bench.draw(sceneOf(square(), material(0, 1, 0, 0, glm::dvec3(1))), look)),
               glm::dvec3(1), 1e-6);
}

void f4(Bench& bench, Record& record) {
  const Material m = material(0, 0.5, 0.25, 0, glm::dvec3(1));
  expectEverywhere(bench, record, "a light of intensity 0 beside one of 1", m, glm::dvec3(0),
                   {directional({0, 0, 1}, glm::dvec3(0)), directional({0, 0, 1})},
                   glm::dvec3(0.75), 1e-6);
  expectEverywhere(bench, record, "that light alone", m, glm::dvec3(0),
                   {directional({0, 0, 1}, glm::dvec3(0))}, glm::dvec3(0), 0);
}

void f5(Bench& bench, Record& record) {
  const double most = 1e6;
  expectEverywhere(bench, record, "intensity 1e6, strength 1e6, colour 1e6",
                   material(0, most, 0, 0, glm::dvec3(most)), glm::dvec3(0),
                   {directional({0, 0, 1}, glm::dvec3(most))}, glm::dvec3(1e18), 1e12);
  expectEverywhere(bench, record, "intensity 1e6, colour 0",
                   material(most, most, 0, 0, glm::dvec3(0)), glm::dvec3(most),
                   {directional({0, 0, 1}, glm::dvec3(most))}, glm::dvec3(0), 0);
  record.refused(
      "--light ...:", {"1e30", "inf", "nan"},
      [](const std::string& text) { parseLight("directional:0,0,1:" + text + ",1,1"); },
      "is not a colour");
  SumParameters p;
  const double infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 z(0, 0, 1);
  const LightTerms terms = phongLight(p, z, z, z, glm::dvec3(infinity));
  record.color("infinite intensity and colour 0 in the reference",
               sumColor(terms, glm::dvec3(0), 0), glm::dvec3(0), 0);
}

void f6(Bench& bench, Record& record) {
  record.refused(
      "--light ...:-1,1,1", [] { parseLight("directional:0,0,1:-1,1,1"); }, "is not a colour");
  record.refused(
      "--ambient-light -1,0,0", [&] { bench.take("ambient-light", "-1,0,0"); }, "is not a colour");
  SumParameters p;
  const glm::dvec3 z(0, 0, 1);
  record.color("negative intensity in the reference", phongLight(p, z, z, z, glm::dvec3(-1)).matte,
               glm::dvec3(0), 0);
}

void f7(Bench& bench, Record& record) {
  expectEverywhere(bench, record, "black with metalness 0", material(1, 1, 0.75, 0, glm::dvec3(0)),
                   glm::dvec3(0.5), {directional({0, 0, 1})}, glm::dvec3(0.75), 1e-6);
}

void f8(Bench& bench, Record& record) {
  // The program `environment` reflects a white room in it: F = (1 - c)^5 at least, 0 from the
  // front.
  expectEverywhere(bench, record, "black with metalness 1", material(1, 1, 0.75, 1, glm::dvec3(0)),
                   glm::dvec3(0.5), {directional({0, 0, 1})}, glm::dvec3(0), 0);
}

void f9(Bench&, Record& record) {
  const glm::dvec3 c(0.5, 0.25, 0);
  record.color("metalness -1 in the reference", specularColor(c, -1), glm::dvec3(1), 0);
  record.color("metalness 2 in the reference", specularColor(c, 2), c, 0);
  record.refused("--material ", {"metalness=-1", "metalness=2", "metalness=nan"}, takeMaterial,
                 "is not a number from 0 to 1");
  for (double bad : {-1.0, 2.0}) {
    Document document;
    document.triangle();
    document.json["materials"] = {{{"extras", {{"glint", {{"metalness", bad}}}}}}};
    document.json["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = document.load();
    record.near("extras.glint metalness " + numberText(bad) + " of a file",
                scene.materials.at(0).shading.metalness, bad < 0 ? 0 : 1, 0);
    record.that("and a warning", !scene.warnings.empty());
  }
}

void f10(Bench& bench, Record& record) {
  // Red 2.5, green 0.5: clamped once, when encoded. A clamp of each term would give 1.5 and 0.5.
  expectEverywhere(bench, record, "terms that add up to more than 1",
                   material(1, 1, 0.5, 1, {1, 0.2, 0}), glm::dvec3(1), {directional({0, 0, 1})},
                   {2.5, 0.5, 0}, 2e-6);
}

/// A square that fills the picture, with colours at its left and right edges.
Mesh ramp(const glm::vec4& left, const glm::vec4& right) {
  Mesh mesh = square({0, 0, 1}, 1);
  mesh.colors = {left, right, right, left};
  return mesh;
}

void f11(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    Look look = whiteLook(bench, shading);
    look.noLights = true;
    look.ambientLight = glm::dvec3(1);
    const Scene scene =
        sceneOf(ramp({2, 0, 1, 1}, {0, 2, 1, 1}), material(1, 1, 0, 0, glm::dvec3(1)));
    const std::string name(shadingName(shading));
    // A plane equation of values up to 2 with about 8 roundings.
    record.color(name + ": between vertex colours 2 and 0", middle(bench.draw(scene, look)),
                 glm::dvec3(1), 16 * rounding);
    record.color(name + " in the reference", middle(bench.reference(scene, look)), glm::dvec3(1),
                 1e-7);
  }
  // Light above 1 at a vertex is interpolated unclamped, too.
  Look look = whiteLook(bench, Shading::gouraud);
  look.light = {directional({0, 0, 1}, glm::dvec3(2))};
  Mesh mesh = square({0, 0, 1}, 1);
  const glm::vec3 dark(1, 0, 0), lit(0, 0, 1);
  mesh.normals = {lit, dark, dark, lit};
  record.color("gouraud: between light of 2 and 0",
               middle(bench.draw(sceneOf(mesh, material(0, 1, 0, 0, glm::dvec3(1))), look)),
               glm::dvec3(1), 16 * rounding);
}

void f12(Bench& bench, Record& record) {
  expectEverywhere(bench, record, "red light on green, green on green",
                   material(0, 1, 0, 0, {0, 0.5, 0}), glm::dvec3(0),
                   {directional({0, 0, 1}, {1, 0, 0}), directional({0, 0, 1}, {0, 0.5, 0})},
                   {0, 0.25, 0}, 1e-6);
  expectEverywhere(bench, record, "red light in a coloured highlight",
                   material(0, 0, 1, 1, {0.5, 1, 0}), glm::dvec3(0),
                   {directional({0, 0, 1}, {1, 0, 1})}, {0.5, 0, 0}, 1e-6);
}

void f13(Bench& bench, Record& record) {
  expectEverywhere(bench, record, "all strengths 0", material(0, 0, 0, 0, glm::dvec3(1)),
                   glm::dvec3(1), {directional({0, 0, 1})}, glm::dvec3(0), 0);
}

constexpr const char* few = "1e-6: a few roundings of values of 1";

const Case lightTable[] = {
    {"F1", "no light", "ambient light alone", "exact: binary fractions", "bounds of loops", "", f1},
    {"F2", "64 lights of 1/64", "as one light of 1", "1e-6", "summation", "", f2},
    {"F3", "129 lights with a limit of 128", "refused by name; 128 are drawn", "1e-6",
     "silence otherwise", "at most 128 lights: GL's least uniform block holds them", f3},
    {"F4", "a light of intensity 0", "no effect", few, "NaN otherwise", "", f4},
    {"F5", "intensity, strength and colour of 1e6; 1e30, infinite", "1e18; refused; finite",
     "1e12: 1e-6 of it", "0 times infinity is NaN",
     "intensities are at most 1e6; the reference clamps to [0, 1e30]", f5},
    {"F6", "negative intensity", "refused", "exact", "light that darkens",
     "refused as an option, 0 in the formulas", f6},
    {"F7", "colour 0, metalness 0", "a white highlight", few, "S = 1", "", f7},
    {"F8", "colour 0, metalness 1", "no highlight", "exact", "S = C", "", f8},
    {"F9", "metalness -1 and 2", "clamped to [0, 1]; refused as an option", "exact",
     "S leaves its range", "a file's value is clamped with a warning", f9},
    {"F10", "terms that add up to more than 1", "their sum, clamped once at the encode", few,
     "clamping each term changes the colour", "pictures are linear and unclamped up to the encode",
     f10},
    {"F11", "vertex colours 2 and 0, light 2 and 0", "1 in the middle", "16 roundings",
     "clamped at vertices it would be 0.5", "", f11},
    {"F12", "saturated coloured light", "products by component", few, "–", "", f12},
    {"F13", "m_a = m_d = m_s = 0", "black", "exact", "–", "", f13},
};

}  // namespace

std::span<const Case> lightCases() { return lightTable; }

}  // namespace glint::stability
