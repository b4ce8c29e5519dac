// Group K: Fresnel's equations, Schlick's approximation, refraction.

#include <algorithm>
#include <limits>

#include "glint/image/error.h"
#include "glint/render/probe_search.h"
#include "glint/scene/look_text.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

/// The reflectance by driver and reference for light that comes from the index n1; if entering, n1
/// is the medium's.
struct Reflected {
  std::vector<float> driver;
  std::vector<double> reference;
};

Reflected reflected(Bench& bench, double n1, double n2, const std::vector<float>& cosines,
                    bool entering = true) {
  const PointScene scene(whiteRoom(bench, entering ? n1 : n2, !entering),
                         boundary(entering ? n2 : n1));
  return {bench.programs().reflectance(scene, cosines, entering),
          referenceReflectance(scene, cosines, entering)};
}

std::string indicesText(double n1, double n2) { return numberText(n1) + " to " + numberText(n2); }

/// Checks R at cosines against values of the exact function; approximations against the reference's
/// evaluation of the same form.
void expectReflectance(Bench& bench, Record& record, double n1, double n2,
                       const std::vector<float>& cosines, const std::vector<double>& exact,
                       double tolerance, double referenceTolerance = 1e-9, bool entering = true) {
  const Reflected r = reflected(bench, n1, n2, cosines, entering);
  Worst driver, reference;
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    const std::string where = "cosine " + numberText(cosines[i]);
    driver.add(r.driver[i], bench.fresnelIsExact() ? exact[i] : r.reference[i], tolerance, where);
    if (bench.fresnelIsExact()) reference.add(r.reference[i], exact[i], referenceTolerance, where);
  }
  driver.into(record, indicesText(n1, n2));
  if (bench.fresnelIsExact()) reference.into(record, indicesText(n1, n2) + " in the reference");
}

/// R by the cancellation-free form in long double: the truth for indices as given.
double truth(double n1, double n2, double cosine) {
  using Wide = long double;
  const Wide a = n1, b = n2, c = std::clamp(Wide(cosine), Wide(0), Wide(1));
  if (n1 == n2) return 0;
  const Wide e = (b - a) * (b + a) / (a * a), square = b * b / (a * a);
  const Wide g2 = e + c * c;
  if (g2 <= 0) return 1;
  const Wide g = std::sqrt(g2), s = c + g, p = square * c + g;
  const Wide rs = e / (s * s), rp = e * ((square + 1) * c * c - 1) / (p * p);
  return double(std::min((rs * rs + rp * rp) / 2, Wide(1)));
}

std::vector<double> truths(double n1, double n2, const std::vector<float>& cosines) {
  std::vector<double> values;
  for (float c : cosines) values.push_back(truth(n1, n2, c));
  return values;
}

void k1(Bench& bench, Record& record) {
  std::vector<float> cosines;
  for (int i = 0; i < 200; ++i) cosines.push_back(std::exp(-16 * float(i) / 200));
  for (double n : {1.0, 1.5, 1.0003}) {
    const Reflected r = reflected(bench, n, n, cosines);
    Worst driver, reference;
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const std::string where = "cosine " + numberText(cosines[i]);
      driver.add(r.driver[i], 0, 0, where);
      reference.add(r.reference[i], 0, 0, where);
    }
    driver.into(record, indicesText(n, n));
    reference.into(record, indicesText(n, n) + " in the reference");
  }
  const glm::dvec3 i = safeNormalize({0.8, 0, -0.1});
  const auto t = refract(i, {0, 0, 1}, 1.5, 1.5);
  record.that("the refracted direction is the incident one", t && *t == i);
  // A clear pane of equal index shows the room as if it were not there.
  Points points;
  points.add({0, 0, 1}, {0.9f, 0, -0.01f});
  record.near("radiance through a pane of equal index in a white room",
              bench.programs().shade({whiteRoom(bench), boundary(1, 1)}, points)[0].x, 1, 1e-6);
}

void k2(Bench& bench, Record& record) {
  for (double n : {1.0, 1.5}) {
    const Reflected r = reflected(bench, n, n, {0.0f, -0.0f, 1e-30f});
    for (std::size_t i = 0; i < 3; ++i)
      record.near(indicesText(n, n) + ", cosine 0", r.driver[i], 0, 0);
    record.near("in the reference", r.reference[0], 0, 0);
  }
}

void k3(Bench& bench, Record& record) {
  // The index 1 + 2^-23, cosines around 1.6e-4. At 1.6e-4 `truth` gives 0.2622..., which agrees
  // with an evaluation in 60 digits to 1e-17.
  const double n = 1 + std::exp2(-23);
  std::vector<float> cosines;
  for (int i = 0; i < 2000; ++i) cosines.push_back(float(1.6e-4 * std::exp((i - 1000) * 4e-3)));
  cosines.push_back(1.6e-4f);
  expectReflectance(bench, record, 1, n, cosines, truths(1, n, cosines), fresnelTolerance);
}

void k4(Bench& bench, Record& record) {
  const double n = 1 + std::exp2(-23), critical = criticalCosine(n, 1);
  std::vector<float> cosines;
  for (int i = 1; i <= 2000; ++i) cosines.push_back(float(critical * (1 + i * 1e-4)));
  const std::vector<double> exact = truths(n, 1, cosines);
  expectReflectance(bench, record, n, 1, cosines, exact, 5e-4, 1e-9);
  expectReflectance(bench, record, n, 1, cosines, exact, 5e-4, 1e-9, false);
}

constexpr double pairs[][2] = {{1, 1.0003}, {1, 1.33}, {1, 1.5},   {1, 2.4},
                               {1.5, 1},    {2.4, 1},  {1.33, 1.5}};

void k5(Bench& bench, Record& record) {
  for (const auto& [a, b] : pairs)
    expectReflectance(bench, record, a, b, {0.0f, -0.0f}, {1, 1}, fresnelTolerance);
}

void k6(Bench& bench, Record& record) {
  for (const auto& [a, b] : pairs) {
    const double r0 = (a - b) / (a + b) * ((a - b) / (a + b));
    expectReflectance(bench, record, a, b, {1}, {r0}, fresnelTolerance);
  }
}

void k7(Bench& bench, Record& record) {
  const float above = 1 + std::numeric_limits<float>::epsilon();
  for (const auto& [a, b] : pairs) {
    const Reflected r = reflected(bench, a, b, {1, above, 1.5f, 1e30f});
    for (std::size_t i = 1; i < 4; ++i)
      record.near(
          indicesText(a, b) + ", cosine " + numberText(std::array{1.f, above, 1.5f, 1e30f}[i]),
          r.driver[i], r.driver[0], 0);
  }
}

void k8(Bench& bench, Record& record) {
  for (const auto& [a, b] : pairs)
    expectReflectance(bench, record, a, b, {-0.2f, -1, -1e-6f}, {1, 1, 1}, fresnelTolerance);
  // A metal with its normal turned away: in a white room it is white, not brighter.
  Points points;
  points.add({0, 0, 1}, {0.6f, 0, 0.8f});
  const PointScene scene(whiteRoom(bench), boundary(1.5, 0, 1, {0.5, 0.25, 0}));
  const glm::vec3 got = bench.programs().shade(scene, points)[0];
  for (int i = 0; i < 3; ++i) {
    record.near("a metal at cosine -0.8, component " + std::to_string(i), got[i], 1, 1e-6);
    record.near("the reference's", referenceShade(scene, points)[0][i], 1, 1e-12);
  }
}

void k9(Bench& bench, Record& record) {
  for (double n : {1.33, 1.5, 2.4}) {
    const float critical = float(criticalCosine(n, 1));
    const Reflected r = reflected(bench, n, 1, {critical});
    record.near(indicesText(n, 1) + " at the critical angle", r.driver[0],
                bench.fresnelIsExact() ? 1 : r.reference[0], 2e-3);
    record.within("T = 1 - R there", 1 - double(r.driver[0]), 0, 1);
  }
}

/// Points seen from inside a boundary, at given cosines of incidence.
Points fromInside(const std::vector<double>& cosines) {
  Points points;
  points.front = false;
  for (double c : cosines) points.add({0, 0, -1}, glm::vec3(std::sqrt((1 - c) * (1 + c)), 0, -c));
  return points;
}

/// Refraction along the surface, seen in an environment that depends on the direction.
void expectFiniteRefraction(Bench& bench, Record& record, double ior) {
  Look look = whiteRoom(bench, 1, true);
  look.environment = Environment::sky;
  std::vector<double> cosines;
  for (int i = -200; i <= 200; ++i) cosines.push_back(criticalCosine(ior, 1) * (1 + 3e-8 * i));
  int wrong = 0;
  for (const glm::vec3& c : bench.programs().shade({look, boundary(ior, 1)}, fromInside(cosines)))
    wrong += !(c.x >= 0 && c.x <= 10 && c.y >= 0 && c.y <= 10 && c.z >= 0 && c.z <= 10);
  record.near("radiances around the critical angle of " + numberText(ior) +
                  " in the sky that are not finite",
              wrong, 0, 0);
}

void k10(Bench& bench, Record& record) {
  for (double n : {1.1, 1.5, 2.4}) expectFiniteRefraction(bench, record, n);
  for (double n : {1.33, 1.5, 2.4, 4.0}) {
    const float critical = float(criticalCosine(n, 1));
    const std::vector<float> cosines{stepFloat(critical, -1), critical, stepFloat(critical, 1)};
    const Reflected r = reflected(bench, n, 1, cosines);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string what = indicesText(n, 1) + ", " + std::to_string(int(i) - 1) + " ulp";
      record.within(what, r.driver[i], 0, 1);
      record.near(what, r.driver[i],
                  bench.fresnelIsExact() ? truth(n, 1, cosines[i]) : r.reference[i], 2e-3);
    }
  }
}

/// Radiance of a clear body in a white room, seen from inside its boundary.
std::vector<glm::vec3> throughFromInside(Bench& bench, double ior,
                                         const std::vector<double>& cosines,
                                         std::vector<glm::dvec3>* reference = nullptr) {
  const Points points = fromInside(cosines);
  const PointScene scene(whiteRoom(bench, 1, true), boundary(ior, 1));
  if (reference) *reference = referenceShade(scene, points);
  return bench.programs().shade(scene, points);
}

/// Half a metal in total reflection: what is not reflected is not refracted either.
void expectNoRefraction(Bench& bench, Record& record) {
  const Points points = fromInside({0.5});
  const PointScene scene(whiteRoom(bench, 1, true), boundary(1.5, 1, 0.5, glm::dvec3(0.5)));
  // 1/2 of 1, and 1/2 of C + (1 - C)(1 - c)^5.
  const double expected = 0.5 + 0.5 * (0.5 + 0.5 * std::pow(0.5, 5));
  record.near("half a metal in total reflection", bench.programs().shade(scene, points)[0].x,
              expected, 1e-6);
  record.near("the reference's", referenceShade(scene, points)[0].x, expected, 1e-7);
}

void k11(Bench& bench, Record& record) {
  expectNoRefraction(bench, record);
  for (double n : {1.33, 1.5, 2.4}) {
    const double critical = criticalCosine(n, 1);
    const std::vector<float> beyond{0, float(critical * 0.5), float(critical * 0.999)};
    const Reflected r = reflected(bench, n, 1, beyond);
    for (std::size_t i = 0; i < 3; ++i)
      record.near(indicesText(n, 1) + ", cosine " + numberText(beyond[i]), r.driver[i], 1, 0);
    record.that("no refracted direction in the reference",
                !refract(safeNormalize({1, 0, -critical * 0.5}), {0, 0, 1}, n, 1));
    // Total reflection shows the room once, not twice and not as NaN.
    for (const glm::vec3& c : throughFromInside(bench, n, {critical * 0.5, critical * 0.999, 1e-4}))
      record.near("radiance in total reflection from " + numberText(n), c.x, 1, 1e-6);
  }
}

void k12(Bench& bench, Record& record) {
  const double c = std::cos(brewsterAngle(1, 1.5));
  record.near("Brewster's angle in degrees", brewsterAngle(1, 1.5) / degrees, 56.309932, 1e-6);
  record.near("R parallel in the reference", fresnelPolarized(c, 1, 1.5).parallel, 0, 1e-12);
  expectReflectance(bench, record, 1, 1.5, {float(c)}, {0.5 * std::pow(1.25 / 3.25, 2)}, 2e-7);
}

void k13(Bench& bench, Record& record) {
  std::vector<float> cosines{0, 1, 0.5f, 1e-4f, 1e-20f};
  for (int i = 0; i < 200; ++i) cosines.push_back(float(i) / 200);
  for (double n : {1e-4, 1e4, 1e-3, 1e3}) {
    const Reflected r = reflected(bench, 1, n, cosines);
    double low = 1, high = 0;
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      for (double x : {double(r.driver[i]), r.reference[i]}) {
        low = !(x >= low) ? x : low;
        high = !(x <= high) ? x : high;
      }
    }
    record.within(indicesText(1, n) + ": lowest", low, 0, 1);
    record.within(indicesText(1, n) + ": highest", high, 0, 1);
  }
}

void k14(Bench& bench, Record& record) {
  for (const char* text : {"0", "-1.5", "nan", "inf", "1e4", "1e-4"}) {
    const char* const range = "is not a number from 0.001 to 1000";
    record.refused(
        "--material ior=", {text}, [](const std::string& n) { takeMaterial("ior=" + n); }, range);
    record.refused(
        "--medium-ior ", {text}, [&](const std::string& n) { bench.take("medium-ior", n); }, range);
  }
  for (double n : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                   std::numeric_limits<double>::infinity()})
    record.within("reference with n = " + numberText(n), fresnelExact(0.5, 1, n), 0, 1);
}

void k15(Bench& bench, Record& record) {
  const float c = float(std::cos(40 * degrees));
  Look look = whiteRoom(bench, 1.5);
  look.fresnel = Fresnel::schlick;
  const Material material = boundary(1);
  const float got = bench.programs().reflectance({look, material}, {c}, true)[0];
  // From the denser side with the refracted cosine: 0.2456; with that of incidence it would be
  // 0.0407, while Fresnel's value is 0.2453.
  record.near("Schlick from 1.5 to 1 at 40 degrees", got, 0.2456, 1e-4);
  record.within("apart from Schlick with the cosine of incidence", got - 0.0407, 0.2, 0.21);
  record.near("the reference's", schlick(c, 1.5, 1), 0.2456, 1e-4);
  // Other exponents at normal incidence, where the power's base is 0: R0, or 1 with exponent 0.
  for (double exponent : {0.0, 2.5}) {
    look.schlickExponent = exponent;
    const double expected = exponent > 0 ? 0.04 : 1;
    const std::string what = "Schlick with exponent " + numberText(exponent) + " at cosine 1";
    record.near(what, bench.programs().reflectance({look, material}, {1}, true)[0], expected, 1e-6);
    record.near(what + " in the reference", schlick(1.0, 1.5, 1, exponent), expected, 1e-12);
  }
}

void k16(Bench& bench, Record& record) {
  std::vector<double> cosines;
  for (int i = 0; i <= 200; ++i) cosines.push_back(std::max(i / 200.0, 1e-5));
  for (double n : {1.1, 1.5, 2.4}) {
    // In a white room a clear body is white: R + T = 1.
    Worst inside, outside, lowest;
    std::vector<glm::dvec3> reference;
    const std::vector<glm::vec3> in = throughFromInside(bench, n, cosines, &reference);
    std::vector<float> floats(cosines.begin(), cosines.end());
    const Reflected r = reflected(bench, 1, n, floats);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const std::string where = "cosine " + numberText(cosines[i]);
      inside.add(in[i].x, 1, 1e-6, where);
      outside.add(reference[i].x, 1, 1e-12, where);
      lowest.add(std::min(1 - double(r.driver[i]), 0.0), 0, 0, where);
    }
    inside.into(record, "R + T seen from inside " + numberText(n));
    outside.into(record, "the same in the reference");
    lowest.into(record, "T = 1 - R from outside is not negative");
  }
}

void k17(Bench& bench, Record& record) {
  for (double n : {1.0003, 1.1, 1.5, 2.4, 4.0}) {
    std::vector<float> outside, inside;
    for (int i = 0; i < 2000; ++i) {
      outside.push_back(float(0.1 + 0.9 * (i + 0.5) / 2000));
      const double x = outside.back();
      inside.push_back(float(std::sqrt(1 - (1 - x * x) / (n * n))));
    }
    const Reflected in = reflected(bench, 1, n, outside), out = reflected(bench, n, 1, inside);
    Worst worst;
    for (std::size_t i = 0; i < outside.size(); ++i) {
      // The cosine of refraction is rounded by 2^-25; R's slope in it is that in the cosine of
      // incidence times n^2 cos(t) / cos(i).
      const double ci = outside[i], ct = inside[i], h = 1e-4;
      const double slope = std::abs(truth(1, n, ci - h) - truth(1, n, ci + h)) / (2 * h);
      worst.add(in.driver[i], out.driver[i],
                2 * fresnelTolerance + slope * n * n * ct / ci * rounding,
                "cosine " + numberText(ci));
    }
    worst.into(record, "R(1 to " + numberText(n) + ", i) against R(" + numberText(n) + " to 1, t)");
  }
}

const Case fresnelTable[] = {
    {"K1", "n1 = n2, cosine 1 to 1e-7", "R = 0, T = 1, the direction unchanged", "exact; 1e-6",
     "rounding leaves something at grazing angles", "equal indices are no boundary", k1},
    {"K2", "n1 = n2, cosine 0", "0", "exact", "0/0: pbrt gives 1, Mitsuba 0",
     "equal indices are no boundary: 0 at grazing incidence too", k2},
    {"K3", "n2/n1 = 1 + 2^-23, cosines around 1.6e-4", "R to 1e-6",
     "1e-6: 12 roundings in amplitudes, no cancellation", "the textbook's form is off by 0.02", "",
     k3},
    {"K4", "n1/n2 = 1 + 2^-23, just inside the critical angle", "R to 5e-4",
     "5e-4: one ulp of the cosine, where R's slope is infinite",
     "the textbook's form is off by 0.94", "", k4},
    {"K5", "cosine 0, n1 != n2", "1", "1e-6", "grazing incidence", "", k5},
    {"K6", "cosine 1", "((n1 - n2)/(n1 + n2))^2", "1e-6", "normal incidence", "", k6},
    {"K7", "cosine above 1: 1 + 2^-23, 1.5, 1e30", "as at 1", "exact", "the clamp at entry", "",
     k7},
    {"K8", "cosine -0.2, -1, -1e-6", "1", "1e-6", "without the clamp -0.2 gives 3.69 at n = 1.5",
     "a negative cosine counts as 0, where R is 1; sides are told by facing, not by its sign", k8},
    {"K9", "the critical angle exactly", "R = 1, T >= 0, no NaN",
     "2e-3: the rounding of the cosine", "the square root of -0", "", k9},
    {"K10", "one ulp on either side of the critical angle", "in [0, 1], R to 2e-3",
     "2e-3: the slope is infinite", "R's slope", "", k10},
    {"K11", "beyond the critical angle", "R = 1 exactly, nothing refracted", "exact; 1e-6",
     "GLSL's refract gives the zero vector there: never to be normalised", "", k11},
    {"K12", "Brewster's angle at n = 1.5", "R parallel 0, R = 0.0739645", "2e-7; 1e-12 in double",
     "cancellation to zero", "", k12},
    {"K13", "n = 1e-4, 1e-3, 1e3, 1e4", "finite, in [0, 1]", "exact", "n^2 and n^4 leave the range",
     "", k13},
    {"K14", "n = 0, negative, NaN, infinite, outside [1e-3, 1e3]", "refused", "exact",
     "NaN or 1 otherwise", "indices are refused outside [1e-3, 1e3]; formulas clamp", k14},
    {"K15", "Schlick from 1.5 to 1 at 40 degrees; other exponents at cosine 1",
     "0.2456, not 0.0407; R0", "1e-4: published digits; 1e-6",
     "with the cosine of incidence it is wrong", "", k15},
    {"K16", "a clear body in a white room", "white: R + T = 1, T >= 0", "1e-6; 1e-12 in double",
     "the sum without the half gives T = -1", "", k16},
    {"K17", "R(1 to n, i) and R(n to 1, t)", "equal",
     "2e-6 and the rounding of cos t times R's slope", "reciprocity", "", k17},
};

}  // namespace

std::span<const Case> fresnelCases() { return fresnelTable; }

}  // namespace glint::stability
