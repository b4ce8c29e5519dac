// Group D: exponents from 0 to 1e9 and the powers they make.

#include <limits>
#include <optional>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/shading/lobe.h"
#include "glint/shading/safe.h"
#include "glint/shading/sum.h"
#include "glint/stability/bench.h"
#include "glint/stability/document.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

const glm::vec3 up(0, 0, 1);

/// A geometry with R.V (Phong) = cos(angle), the light at right angles to the surface: R = N = L.
Geometry atAngle(double radians) {
  return {up, up, glm::vec3(-std::sin(radians), 0, -std::cos(radians))};
}

/// Geometries around a peak in any direction, exponent * angle^2 / 2 from 0 to 8: where the lobe is
/// steep.
std::vector<Geometry> nearPeak(double exponent, bool blinn, std::size_t count) {
  Random random(11);
  const std::vector<glm::dvec3> normals = randomDirections(count, 3),
                                lights = randomDirections(count, 4),
                                sides = randomDirections(count, 5);
  std::vector<Geometry> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = 1 - std::min(8 * random.unit() / (blinn ? 4 * exponent : exponent), 1.0);
    all.push_back(besidePeak(normals[i], lights[i], sides[i], c, blinn));
  }
  return all;
}

void expectNearPeak(Bench& bench, Record& record, double exponent) {
  for (bool blinn : {false, true}) {
    const std::vector<Geometry> all = nearPeak(exponent, blinn, 2000);
    const Points points = pointsOf(all);
    Look look = bench.lit(blinn ? Shading::blinnPhong : Shading::phong);
    const PointScene scene(look, litMaterial(0, 1, exponent));
    const std::vector<glm::vec3> got = bench.programs().shade(scene, points);
    const std::vector<glm::dvec3> truth = referenceShade(scene, points);
    // For unit vectors rounded to float; the half vector is at least 0.6 long.
    const double tolerance = blinn ? 2 * lobeTolerance(4 * exponent) : lobeTolerance(exponent);
    Worst worst;
    double highest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      double expected = truth[i].y;
      if (bench.lobeIsExact()) {
        const glm::dvec3 n = safeNormalize(glm::dvec3(all[i].n)), l(all[i].l),
                         v = safeNormalize(-glm::dvec3(all[i].p));
        // By the difference vector, since the dot product of vectors whose length is off by 6e-8 is
        // not the cosine.
        const double lambda =
            blinn ? blinnLambda(n, safeNormalize(l), v) : phongLambda(n, safeNormalize(l), v);
        expected = std::exp((blinn ? 4 : 1) * exponent * std::log1p(-lambda));
      }
      worst.add(got[i].y, expected, tolerance,
                "N " + vectorText(all[i].n) + " L " + vectorText(all[i].l) + " P " +
                    vectorText(all[i].p));
      highest = !(got[i].y <= highest) ? got[i].y : highest;
    }
    const std::string name(shadingName(look.shading));
    worst.into(record, name + ": 2000 places around the peak, exponent " + numberText(exponent));
    record.within(name + ": highest of them", highest, 0, 1);
  }
}

/// Shades on the driver with the form of the lobe that an option's text names; nothing if there is
/// no such form.
std::optional<std::vector<glm::vec3>> shadeWith(Bench& bench, const std::string& highlight,
                                                double exponent, const Points& points) {
  Look look = bench.lit();
  try {
    look.highlight = parseHighlights(highlight, "highlight");
  } catch (const InputError&) {
    return std::nullopt;
  }
  return bench.programs().shade({look, litMaterial(0, 1, exponent)}, points);
}

void d1(Bench& bench, Record& record) {
  const float below = -0.01f;
  // R.V above 0, exactly 0, below 0. Blinn-Phong's N.H is above 0 in all of them.
  const std::vector<Geometry> all{atAngle(0), {up, up, {-1, 0, 0}}, {up, up, {1, 0, -below}}};
  expectLight(bench, record, "exponent 0", 0, all, {{1, 1, 1}, {1, 0, 1}, {1, 0, 1}},
              {diffuseTolerance, 1e-6, 1e-6});
  const std::vector<float> lambda{0, 0.5f, 1, 2};
  const std::vector<float> lobes = bench.run("float lobeExact(float, float)", {lambda, {0}});
  const std::vector<float> powers =
      bench.run("float lobePow(float, float)", {{1, 0.5f, 0, -1}, {0}});
  for (std::size_t i = 0; i < 4; ++i) {
    const double expected = i < 2 ? 1 : 0;
    record.near("lobeExact(" + numberText(lambda[i]) + ", 0)", lobes[i], expected, 0);
    record.near("lobePow(" + numberText(1 - lambda[i]) + ", 0)", powers[i], expected, 0);
    record.near("reference lobe at lambda " + numberText(lambda[i]) + ", exponent 0",
                lobeExact(lambda[i], 0), expected, 0);
  }
}

void d2(Bench& bench, Record& record) {
  const std::vector<Geometry> all{{up, -up, -up}, {up, {0.6f, 0, -0.8f}, {0.6f, 0, -0.8f}}};
  expectLight(bench, record, "exponent 0, lit from behind", 0, all, {{}, {}}, {0, 0, 0});
}

void d3(Bench& bench, Record& record) {
  expectNearPeak(bench, record, 1e6);
  // The angle at which cos^1e6 is one half: 0.0675 degrees.
  const double half = std::acos(std::exp2(-1e-6));
  expectLight(bench, record, "half of the peak at 0.0675 degrees", 1e6, {atAngle(half), atAngle(0)},
              {{1, 0.5, std::pow(std::cos(half / 2), 4e6)}, {1, 1, 1}},
              {diffuseTolerance, lobeTolerance(1e6) + 1e-4, 2 * lobeTolerance(4e6)});
}

void d4(Bench& bench, Record& record) { expectNearPeak(bench, record, 1e4); }

void d5(Bench&, Record& record) {
  record.refused("--material ",
                 {"exponent=-1", "exponent=nan", "exponent=inf", "exponent=1e7", "exponent=x"},
                 takeMaterial, "is not a number from 0 to");
  Document document;
  document.triangle();
  for (const char* text : {"-1", "1e7"}) {
    document.json["materials"] = {{{"extras", {{"glint", {{"exponent", std::atof(text)}}}}}}};
    document.json["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = document.load();
    const double exponent = scene.materials.at(0).shading.exponent;
    record.within("extras.glint exponent " + std::string(text) + " of a file", exponent, 0, 1e6);
    record.that("and a warning", !scene.warnings.empty());
  }
  for (double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SumParameters p;
    p.specular = 1;
    p.exponent = bad;
    const glm::dvec3 n(0, 0, 1), v = safeNormalize({0.1, 0, 1});
    record.within("reference with exponent " + numberText(bad),
                  phongLight(p, n, n, v, glm::dvec3(1)).specular.x, 0, 1);
  }
}

void d6(Bench& bench, Record& record) {
  const double angle = 120 * degrees;
  expectLight(bench, record, "R.V = -0.5, exponent 2.5", 2.5, {atAngle(angle)},
              {{1, 0, std::pow(0.5, 10)}},
              {diffuseTolerance, bench.lobeIsExact() ? 0 : 1e-6, 2e-6});
  const std::vector<float> got = bench.run("float lobePow(float, float)", {{-0.5f}, {2.5f}});
  record.near("lobePow(-0.5, 2.5)", got[0], 0, 0);
}

void d7(Bench& bench, Record& record) {
  record.near("(1 - beta lambda)^8 at 90 degrees", lyon(1, 1, 8), 0.343608916, 1e-9);
  record.near("the same at 180 degrees", lyon(2, 1, 8), 0.100112915, 1e-9);
  record.near("the power itself at 90 degrees", lobeExact(1, 1), 0, 0);
  Points points;
  points.add(up, {-1, 0, 0}, up);
  points.add(up, {-1, 0, 1e-3f}, up);
  if (const auto got = shadeWith(bench, "lyon:8", 1, points)) {
    Look look = bench.lit();
    look.highlight = {Highlight::lyon, 8};
    const auto truth = referenceShade({look, litMaterial(0, 1, 1)}, points);
    for (std::size_t i = 0; i < 2; ++i)
      record.near("--highlight lyon:8 at exponent 1, driver against reference", (*got)[i].y,
                  truth[i].y, lobeTolerance(1));
  }
}

void d8(Bench& bench, Record& record) {
  Points points;
  for (int i = 0; i <= 90; ++i) {
    const Geometry g = atAngle(i * degrees);
    points.add(g.n, g.p, g.l);
  }
  const auto got = shadeWith(bench, "lyon:8", 8, points);
  Worst formula, driver;
  for (int i = 0; i <= 90; ++i) {
    const double lambda = 1 - std::cos(i * degrees);
    const std::string where = std::to_string(i) + " degrees";
    formula.add(lyon(lambda, 8, 8), std::pow(std::cos(i * degrees), 8), 1e-14, where);
    if (got)
      driver.add((*got)[std::size_t(i)].y, std::pow(std::cos(i * degrees), 8), lobeTolerance(8),
                 where);
  }
  formula.into(record, "Lyon with gamma = exponent = 8 against cos^8, in double");
  if (got) driver.into(record, "--highlight lyon:8 at exponent 8 against cos^8");
}

void d9(Bench& bench, Record& record) {
  // beta lambda = 1 where 250 (1 - cos) = 1: 5.126 degrees.
  const double edge = std::acos(1 - 1 / 250.0);
  record.near("edge in degrees", edge / degrees, 5.1258, 1e-3);
  record.near("Lyon past the edge", lyon(1 / 250.0 + 1e-9, 1000, 4), 0, 0);
  record.near("cos^1000 there", std::pow(std::cos(edge), 1000), 0.0181695, 1e-6);
  Points points;
  const Geometry g = atAngle(edge * 1.001);
  points.add(g.n, g.p, g.l);
  if (const auto got = shadeWith(bench, "lyon:4", 1000, points))
    record.near("--highlight lyon:4 past the edge", (*got)[0].y, 0, 0);
}

void d10(Bench& bench, Record& record) {
  const float above = 1 + std::numeric_limits<float>::epsilon();
  for (float exponent : {1.0f, 1e4f, 1e6f})
    record.near("lobePow(1 + 2^-23, " + numberText(exponent) + ")",
                bench.run("float lobePow(float, float)", {{above}, {exponent}})[0], 1, 0);
  // Vectors longer than 1 by one rounding or four, exactly parallel to each other.
  for (float length : {1.0f, above, 1 + 4 * (above - 1)})
    for (Shading shading : {Shading::phong, Shading::blinnPhong}) {
      Look look = bench.lit(shading);
      Points points;
      points.add(up, -up, {0, 0, length});
      const float got = bench.programs().shade({look, litMaterial(0, 1, 1e6)}, points)[0].y;
      record.within(std::string(shadingName(shading)) + ": L of length " + numberText(length), got,
                    0.999, 1);
    }
}

void d11(Bench& bench, Record& record) {
  // 0.5^140 = 7e-43, a subnormal.
  record.within("lobePow(0.5, 140)", bench.run("float lobePow(float, float)", {{0.5f}, {140}})[0],
                0, 1e-42);
  record.within("lobeExact(0.5, 140)",
                bench.run("float lobeExact(float, float)", {{0.5f}, {140}})[0], 0, 1e-42);
  expectLight(bench, record, "R.V = 0.5, exponent 140", 140, {atAngle(60 * degrees)},
              {{1, 0, std::pow(std::sqrt(0.75), 560)}},
              {diffuseTolerance, bench.lobeIsExact() ? 1e-42 : 1e-6, 1e-6});
}

void d12(Bench& bench, Record& record) {
  for (double factor : {4.0, 1e3}) {
    Look look = bench.lit(Shading::blinnPhong);
    look.blinnFactor = factor;
    Points points;
    points.add(up, -up, up);
    const Geometry off = atAngle(30 * degrees);
    points.add(off.n, off.p, off.l);
    const PointScene scene(look, litMaterial(0, 1, 1e6));
    const std::string what = "blinn-factor " + numberText(factor) + ", exponent 1e6: ";
    const auto got = bench.programs().shade(scene, points);
    const auto truth = referenceShade(scene, points);
    record.near(what + "peak", got[0].y, 1, 1e-6);
    record.near(what + "30 degrees off", got[1].y, 0, 0);
    record.near(what + "peak in the reference", truth[0].y, 1, 1e-12);
    record.near(what + "30 degrees off in the reference", truth[1].y, 0, 1e-300);
    record.near(what + "exponent that the shader is given", scene.item().materialBlock.exponent,
                factor * 1e6, 0);
  }
}

constexpr const char* peakTolerance =
    "1e-6 + 4e-7 sqrt(exponent), twice that of 4 exponent for Blinn-Phong (|H| > 1/2 of |L + V|)";

const Case exponentTable[] = {
    {"D1", "exponent 0, R.V above, at and below 0", "1 where R.V > 0, else 0", "exact; 1e-6",
     "pow(0, 0) is 1 in C, undefined in GLSL, 0 on llvmpipe",
     "exponent 0 gives 1 where the cosine is positive and 0 elsewhere, also where it is 0", d1},
    {"D2", "exponent 0 on the back", "0", "exact", "0^0 = 1 would light it", "", d2},
    {"D3", "exponent 1e6, 2000 places around the peak", "the power to 0.1 level, never above 1",
     peakTolerance, "the dot product errs by up to 0.66 and overshoots to 1.6", "", d3},
    {"D4", "exponent 1e4, 2000 places around the peak", "the power to 0.011 level", peakTolerance,
     "the dot product errs by a level", "", d4},
    {"D5", "exponent below 0, above 1e6, NaN, infinite", "refused as an option, clamped in a file",
     "exact", "pow of such is anything",
     "options are refused; a file's value is clamped to [0, 1e6] with a warning", d5},
    {"D6", "R.V = -0.5, exponent 2.5", "0", "exact", "pow of a negative base is undefined", "", d6},
    {"D7", "Lyon's form with gamma 8, exponent 1", "the documented leak: 0.344 at 90 degrees",
     "1e-9 in double; driver against reference 1e-6 + 4e-7", "beta < 1 leaks past 90 degrees",
     "gamma at most the exponent is the user's choice; the leak is documented", d7},
    {"D8", "Lyon's form with gamma = exponent = 8", "cos^8", "1e-14 in double, 2e-6 on the driver",
     "an identity", "", d8},
    {"D9", "Lyon's form with gamma 4, exponent 1000",
     "0 beyond 5.13 degrees, where cos^1000 is 0.018", "exact", "a truncated skirt", "", d9},
    {"D10", "cosines above 1: 1 + 2^-23, L longer than unit by 4 ulp", "at most 1",
     "exact; 1e-3 for lambda of the length error", "pow(1 + 2^-23, 1e6) is 1.127", "", d10},
    {"D11", "0.5^140: a subnormal result", "0 or subnormal", "1e-42", "flush to zero", "", d11},
    {"D12", "exponent 1e6 times blinn-factor 4 and 1000",
     "peak 1, 0 elsewhere, the same everywhere", "1e-6; exact", "limits of a slider or table", "",
     d12},
};

}  // namespace

std::span<const Case> exponentCases() { return exponentTable; }

}  // namespace glint::stability
