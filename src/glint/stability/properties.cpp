// Group P: properties that hold for every input, checked on random ones, and the worst inputs that
// a search finds (hunts.cpp).

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/hunts.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

Look highlightLook(Bench& bench, Shading shading) {
  Look look = bench.lit(shading);
  return look;
}

void p1(Bench& bench, Record& record) {
  for (Shading shading : {Shading::phong, Shading::blinnPhong})
    for (double alpha : {0.5, 1.0, 10.0, 100.0, 1e4, 1e6}) {
      Points points;
      const double reach = std::min(90.0 * degrees, std::sqrt(40 / alpha));
      for (int i = 0; i <= 2000; ++i) {
        const double angle = reach * i / 2000;
        points.add({0, 0, 1}, glm::vec3(-std::sin(angle), 0, -std::cos(angle)), {0, 0, 1});
      }
      const PointScene scene(highlightLook(bench, shading), litMaterial(0, 1, alpha));
      const auto got = bench.programs().shade(scene, points);
      double rise = 0;
      for (std::size_t i = 1; i < got.size(); ++i)
        rise = std::max(rise, double(got[i].y) - got[i - 1].y);
      // Both neighbours may be off by the rounding of D.
      record.within(std::string(shadingName(shading)) +
                        ": largest rise away from the peak, exponent " + numberText(alpha),
                    rise, 0, 2 * lobeTolerance(isBlinn(shading) ? 4 * alpha : alpha));
    }
}

void p2(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    double high = 0, low = 0;
    Random random(5);
    for (double alpha : {0.0, 1.0, 100.0, 1e4, 1e6}) {
      Points points;
      const auto n = randomDirections(20000, 3), l = randomDirections(20000, 4),
                 v = randomDirections(20000, 6);
      for (std::size_t i = 0; i < n.size(); ++i) {
        const glm::dvec3 r = 2 * glm::dot(n[i], l[i]) * n[i] - l[i];
        const double spread = std::exp(-18 * random.unit());
        points.add(glm::vec3(n[i]), glm::vec3(-safeNormalize(r + spread * v[i])), glm::vec3(l[i]));
      }
      const PointScene scene(highlightLook(bench, shading), litMaterial(0, 1, alpha));
      for (const glm::vec3& c : bench.programs().shade(scene, points)) {
        high = c.y <= high ? high : c.y;
        low = c.y >= low ? low : c.y;
      }
    }
    record.within(std::string(shadingName(shading)) + ": highest of 100000", high, 0.9, 1);
    record.within(std::string(shadingName(shading)) + ": lowest", low, 0, 0);
  }
}

Scene pebbleScene(const glm::dmat4& world) { return sceneOf(pebble(), paint(), world); }

/// A look at the origin with all positions and directions turned by `turn`, and lengths scaled by
/// `scale`.
Look turnedLook(Bench& bench, Shading shading, const glm::dmat4& turn, double scale) {
  const glm::dmat3 m(turn);
  Look look = bench.look(shading);
  look.resolution = {48, 48};
  look.cameraPosition = m * glm::dvec3(2, 1.5, 3) * scale;
  look.cameraFocalPoint = glm::dvec3(0);
  look.cameraViewUp = m * glm::dvec3(0, 1, 0);
  look.clippingRange = glm::dvec2(1, 8) * scale;
  look.ambientLight = glm::dvec3(0.25);
  Light point;
  point.type = Light::Type::point;
  point.position = m * glm::dvec3(1, 2, 3) * scale;
  Light spot = point;
  spot.type = Light::Type::spot;
  spot.position = m * glm::dvec3(-2, 2, 2) * scale;
  spot.direction = m * glm::dvec3(2, -2, -2);
  spot.intensity = glm::dvec3(0.5);
  look.light = {directional(m * glm::dvec3(-1, 1, 1), glm::dvec3(0.5)), point, spot};
  return look;
}

void expectNearlyAlike(Record& record, const std::string& what, const Image& got,
                       const Image& expected) {
  // Every coordinate is rounded differently, and an edge may move across a sample.
  int different = 0, covered = 0;
  for (std::size_t i = 0; i < got.values.size(); i += 4) {
    bool off = false;
    for (std::size_t k = 0; k < 3; ++k)
      off = off || !(std::abs(got.values[i + k] - expected.values[i + k]) <= 2e-5);
    different += off;
    covered += expected.values[i] != 0;
  }
  record.within(what + ": pixels that differ by more than 2e-5", different, 0, 6);
  record.within(what + ": pixels that show the model", covered, 200, 48 * 48);
}

void p3(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    // The built-in environments would have to turn with the world; a white one is the same from all
    // sides.
    const Image one =
        bench.draw(pebbleScene(glm::dmat4(1)), turnedLook(bench, shading, glm::dmat4(1), 1));
    for (double angle : {0.3, 1.7, 3.1}) {
      const glm::dmat4 turn = rotation(angle);
      expectNearlyAlike(record,
                        std::string(shadingName(shading)) + ", turned by " + numberText(angle),
                        bench.draw(pebbleScene(turn), turnedLook(bench, shading, turn, 1)), one);
    }
  }
}

void p4(Bench& bench, Record& record) {
  Random random(23);
  for (Shading shading : everyShading) {
    const Image one =
        bench.draw(pebbleScene(glm::dmat4(1)), turnedLook(bench, shading, glm::dmat4(1), 1));
    for (int i = 0; i < 3; ++i) {
      const double scale = std::pow(10, random.between(-12, 12));
      expectNearlyAlike(record,
                        std::string(shadingName(shading)) + ", scaled by " + numberText(scale),
                        bench.draw(pebbleScene(scaling(glm::dvec3(scale))),
                                   turnedLook(bench, shading, glm::dmat4(1), scale)),
                        one);
    }
  }
}

void p5(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    Look look = turnedLook(bench, shading, glm::dmat4(1), 1);
    const Scene scene = pebbleScene(glm::dmat4(1));
    for (int i = 0; i < 5; ++i)
      look.light->push_back(directional({std::cos(i), std::sin(i), 1}, glm::dvec3(0.125 * i)));
    const Image one = bench.draw(scene, look);
    std::reverse(look.light->begin(), look.light->end());
    // A sum of 8 lights of up to 1, in another order: 8 roundings of values of up to 4.
    record.alike(std::string(shadingName(shading)) + ": lights in reverse", bench.draw(scene, look),
                 one, 8 * 4 * rounding);
  }
}

void p6(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    const Look look = turnedLook(bench, shading, glm::dmat4(1), 1);
    const Image one = bench.draw(pebbleScene(glm::dmat4(1)), look);
    Scene scene = pebbleScene(glm::dmat4(1));
    std::vector<std::uint32_t>& indices = scene.meshes[0].indices;
    Random random(29);
    for (std::size_t i = indices.size() / 3; i-- > 1;) {
      const std::size_t k = std::size_t(random.below(int(i + 1)));
      for (std::size_t c = 0; c < 3; ++c) std::swap(indices[3 * i + c], indices[3 * k + c]);
    }
    record.alike(std::string(shadingName(shading)) + ": triangles shuffled",
                 bench.draw(scene, look), one, 1e-6);
  }
}

void p11(Bench& bench, Record& record) {
  // A cone from 20 to 30 degrees; the light 1 above the plane, at angles off its axis.
  for (Shading shading : everyShading)
    for (double angle : {0.0, 10.0, 19.9, 25.0, 30.1, 60.0, 90.0, 120.0, 180.0}) {
      Look look = bench.look(shading);
      look.light = {spotAlong({std::sin(angle * degrees), 0, -std::cos(angle * degrees)}, 20, 30)};
      Points points;
      points.add({0, 0, 1}, {0, 0, -1}, {0, 0, 0});
      const PointScene scene(look, litMaterial(1, 0, 1));
      const double inner = std::cos(20 * degrees), outer = std::cos(30 * degrees);
      const double ramp =
          std::clamp((std::cos(angle * degrees) - outer) / (inner - outer), 0.0, 1.0);
      const std::string what = ": " + numberText(angle) + " degrees off a spot's axis";
      const std::string name(shadingName(shading));
      // The cosine's rounding divided by the ramp's width of 0.074, twice for the square.
      record.near(name + what, bench.programs().shade(scene, points)[0].x, ramp * ramp, 8e-6);
      record.near(name + " in the reference" + what, referenceShade(scene, points)[0].x,
                  ramp * ramp, 1e-6);
    }
}

void p12(Bench& bench, Record& record) {
  for (Shading shading : everyShading)
    for (double alpha : {0.25, std::nextafter(0.5f, 0.f) * 1.0, 0.5, 1.0}) {
      Look look = parallel(bench.look(shading), {0, 0, 1}, 3);
      look.ambientLight = glm::dvec3(1);
      look.noLights = true;
      Material material = litMaterial(0, 0, 1);
      material.shading.ambient = 1;
      material.alphaMode = AlphaMode::mask;
      material.alphaCutoff = 0.5;
      material.alpha = alpha;
      const Scene scene = sceneOf(square(), material);
      const std::string what = std::string(shadingName(shading)) + ": alpha " + numberText(alpha);
      record.near(what, bench.draw(scene, look).row(1)[4], alpha >= 0.5 ? 1 : 0, 0);
      record.near(what + " in the reference", bench.reference(scene, look).row(1)[4],
                  alpha >= 0.5 ? 1 : 0, 0);
    }
}

void p14(Bench& bench, Record& record) {
  // A file's lamp with a range of 10, straight above the place: 1/d^2, windowed to 0 at 10.
  for (Shading shading : everyShading) {
    Look look = bench.look(shading);
    Light lamp;
    lamp.type = Light::Type::point;
    lamp.fallsOff = true;
    lamp.range = 10;
    look.light = {lamp};
    Points points;
    const float distances[] = {1e-20f, 1e-7f, 1e-3f, 1, 5, 9.99f, 10, 11, 1e6f, 1e15f};
    for (float d : distances) points.add({0, 0, 1}, {0, 0, 0}, {0, 0, d});
    const PointScene scene(look, litMaterial(1, 0, 1));
    const auto got = bench.programs().shade(scene, points);
    const auto truth = referenceShade(scene, points);
    const std::string name(shadingName(shading));
    for (std::size_t i = 0; i < std::size(distances); ++i) {
      const double d = std::max(double(distances[i]), 1e-6);
      const double expected = std::max(1 - std::pow(d / 10, 4), 0.0) / (d * d);
      const std::string what = ": a lamp " + numberText(distances[i]) + " away";
      // Relative: the square, its quotient, and the window's 4 roundings of at most 1.
      const double tolerance = 1e-6 * std::max(expected, 1 / (d * d));
      record.near(name + what, got[i].x, expected, tolerance);
      record.near(name + " in the reference" + what, truth[i].x, expected, tolerance);
    }
  }
}

void p15(Bench& bench, Record& record) {
  // What a driver may interpolate for the light and the colour of vertices, in a triangle almost
  // without area or with extremely distant corners.
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> given{
      std::numeric_limits<float>::quiet_NaN(), -infinity, -1, 0, 0.5f, 1e30f, infinity};
  const double expected[] = {0, 0, 0, 0, 0.5, 1e30f, 1e30f};
  Look look = bench.lit(Shading::gouraud);
  const Variant variant = PointScene(look, litMaterial(1, 0, 1)).item().variant;
  const auto got = bench.programs().probe(variant).run(
      "float finiteValue(float x) { return finiteOrZero(vec4(x)).x; }", {given});
  for (std::size_t i = 0; i < given.size(); ++i)
    record.near("interpolated " + numberText(given[i]), got[i], expected[i], 0);
}

void p16(Bench& bench, Record& record) {
  const Scene scene = sceneOf(sphere(24, 12), litMaterial(0.5, 0.5, 9));
  Light point = directional({}, glm::dvec3(0.5));
  point.type = Light::Type::point;
  point.position = {-2, 1, 3};
  const std::vector<Light> lights{directional({1, 1, 2}, glm::dvec3(0.25)), point,
                                  directional({-1, 0, 2}, glm::dvec3(1)),
                                  directional({0, -1, 2}, glm::dvec3(0.125))};
  const char* const forms[] = {"pade:8", "lyon:4", "exact", "none"};  // in the order of the lights
  for (const Shading shading : everyShading) {
    Look look = parallel(bench.look(shading), {0, 0, 1}, 32);
    Image sum;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      look.light = {lights[i]};
      look.highlight = parseHighlights(forms[i], "highlight");
      const Image alone = bench.draw(scene, look);
      if (i == 0) sum = alone;
      for (std::size_t k = 0; i > 0 && k < sum.values.size(); ++k)
        if (k % 4 != 3) sum.values[k] += alone.values[k];
    }
    look.light = lights;
    look.highlight = parseHighlights("exact/1,lyon:4/1,pade:8/1,none", "highlight");
    // Values of up to 2 in sums of up to eight terms.
    record.alike(std::string(shadingName(shading)) + ": four lights with a form each",
                 bench.draw(scene, look), sum, 16 * 2 * rounding);
  }
}

const Case propertyTable[] = {
    {"P1", "2000 angles from the peak outwards, exponent 0.5 to 1e6", "the highlight only falls",
     "twice the lobe's rounding", "staircases and wrong pieces", "", p1},
    {"P2", "100000 random geometries crowded around the peak", "between 0 and 1", "exact",
     "overshoot", "", p2},
    {"P3", "everything turned about an axis", "the same picture", "2e-5; 6 pixels at edges",
     "a direction in the wrong space", "", p3},
    {"P4", "everything scaled by 1e-12 to 1e12", "the same picture", "2e-5; 6 pixels at edges",
     "lengths that are not divided out", "", p4},
    {"P5", "eight lights in reverse order", "the same picture", "8 roundings of values of up to 4",
     "sums", "", p5},
    {"P6", "triangles in another order", "the same picture", "1e-6", "depth ties", "", p6},
    {"P7", "worst input of lobeExact, hunted, and earlier finds", "within its bound", "1e-6",
     "bounds are proven on paper only", "", huntLobe},
    {"P8", "worst input of fresnelExact, hunted, from both sides", "within its bound", "1e-6",
     "bounds are proven on paper only", "", huntFresnel},
    {"P9", "worst input of unit and safeUnit, hunted", "within their bound",
     "2.2e-7: 3.5 roundings and the truth's", "bounds are proven on paper only", "", huntUnit},
    {"P10", "worst geometry of the highlight of whole programs, hunted", "within its bound",
     "1e-6 + 4e-7 sqrt(exponent), twice with 4 exponent for Blinn-Phong",
     "bounds are proven on paper only", "", huntHighlight},
    {"P11", "a spot's cone from its axis to its back", "full inside, glTF's ramp, none outside",
     "8e-6: the cosine's rounding over the ramp's width", "the square of a negative ramp lights",
     "", p11},
    {"P12", "alpha around the cutoff of a mask", "there from the cutoff on", "exact",
     "masked parts", "", p12},
    {"P13", "360000 cosines and indices, crowded against grazing and the critical angle",
     "R in [0, 1]", "exact", "T = 1 - R is negative otherwise", "", reflectanceStaysInRange},
    {"P14", "a lamp with range 10 from 1e-20 to 1e15 away",
     "glTF's fall-off, finite, 0 from its range on", "1e-6 of 1/d^2: roundings",
     "1/0 at the lamp, negative light beyond its range", "distances count as at least 1e-6", p14},
    {"P15", "light and vertex colours that a driver interpolates as NaN, infinite or negative",
     "0, 0 and at most 1e30", "exact",
     "found by a search: triangles without area, corners beyond all measure",
     "what is no number, or negative, counts as 0", p15},
    {"P16", "four lights, each with a form of the highlight of its own",
     "the sum of their pictures", "16 roundings of values of up to 2",
     "a light left out, drawn twice or by another's form", "the brightest has the first form", p16},
};

}  // namespace

std::span<const Case> propertyCases() { return propertyTable; }

}  // namespace glint::stability
