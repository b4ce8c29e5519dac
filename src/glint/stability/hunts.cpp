#include "glint/stability/hunts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/render/probe_error.h"
#include "glint/render/probe_search.h"
#include "glint/scene/look_text.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"
#include "glint/shading/safe.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

using Columns = std::vector<std::vector<float>>;

/// Adds the errors of fresnelExact for columns of cosines and of indices n, seen from the thinner
/// or the denser side; returns the worst.
double boundaryError(Bench& bench, bool denser, const Columns& c, std::vector<double>& errors) {
  std::vector<float> boundaries;
  for (float n : c[1]) {
    const FresnelConstants k = denser ? fresnelConstants(n, 1) : fresnelConstants(1, n);
    const double critical = k.e < 0 ? std::sqrt(-k.e) : 0.0;
    boundaries.insert(boundaries.end(), {float(k.e), float(k.nSquared), float(critical),
                                         float(critical - float(critical))});
  }
  const std::vector<float> got =
      bench.run("float fresnelExact(float, Boundary)", {c[0], boundaries});
  double worst = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double truth = denser ? fresnelExact(double(c[0][i]), double(c[1][i]), 1)
                                : fresnelExact(double(c[0][i]), 1, double(c[1][i]));
    errors.push_back(absoluteError(got[i], truth));
    worst = std::max(worst, errors.back());
  }
  return worst;
}

/// Searches for the worst input of a shader function and checks its error against the bound.
void expectHunted(Record& record, const std::string& what, const std::vector<SearchRange>& ranges,
                  double bound, const SearchErrors& errors) {
  const SearchResult worst = huntWorst(ranges, errors, 1 << 12, 8);
  std::string input;
  for (float x : worst.input) input += (input.empty() ? "" : ", ") + numberText(x);
  record.near(what + ", worst found at (" + input + ")", worst.error, 0, bound);
}

}  // namespace

void huntLobe(Bench& bench, Record& record) {
  expectHunted(record, "lobeExact(lambda, exponent)",
               {{0, 2, {0.5f, 1}}, {0, 1e6f, {0.5f, 1, 2, 10, 1e3f}}}, 1e-6, [&](const Columns& c) {
                 const auto got = bench.run("float lobeExact(float, float)", c);
                 std::vector<double> errors;
                 for (std::size_t i = 0; i < got.size(); ++i)
                   errors.push_back(absoluteError(got[i], lobeExact(c[0][i], c[1][i])));
                 return errors;
               });
  // Found by longer searches: the switch of log1m at 1/2, and the largest error near the peak.
  const Columns finds{{0.5f, 0.50000006f, 9.5367e-7f, 0.333333343f, 0.0191f},
                      {1, 1, 1e6f, 2, 52.3f}};
  const auto got = bench.run("float lobeExact(float, float)", finds);
  for (std::size_t i = 0; i < got.size(); ++i)
    record.near("lobeExact(" + numberText(finds[0][i]) + ", " + numberText(finds[1][i]) + ")",
                got[i], lobeExact(finds[0][i], finds[1][i]), 1e-6);
}

void huntFresnel(Bench& bench, Record& record) {
  for (bool denser : {false, true})
    expectHunted(
        record, denser ? "fresnelExact from the denser side" : "fresnelExact from the thinner side",
        {{0, 1, {1e-4f, 0.7071068f, 0.745356f}}, {1.0000001f, 1e3f, {1.1f, 1.5f, 2}}},
        fresnelTolerance, [&](const Columns& c) {
          std::vector<double> errors;
          boundaryError(bench, denser, c, errors);
          return errors;
        });
}

void huntUnit(Bench& bench, Record& record) {
  for (const bool safe : {false, true}) {
    // Components from 1e-15 to 1e18 for unit, whose squares stay in range; anything except
    // subnormal for safeUnit.
    const float low = safe ? 1.2e-38f : 1e-15f, high = safe ? 3e38f : 1e18f;
    const SearchRange range{low, high, {1, 1.0995116e12f, 9.094947e-13f}};
    expectHunted(
        record, safe ? "safeUnit" : "unit", {range, range, range}, 2.2e-7, [&](const Columns& c) {
          std::vector<float> v;
          for (std::size_t i = 0; i < c[0].size(); ++i)
            v.insert(v.end(), {c[0][i], c[1][i], -c[2][i]});
          const auto got = bench.run(safe ? "vec3 safeUnit(vec3)" : "vec3 unit(vec3)", {v});
          std::vector<double> errors;
          for (std::size_t i = 0; i < c[0].size(); ++i) {
            const glm::dvec3 truth = safeNormalize({c[0][i], c[1][i], -double(c[2][i])});
            double worst = 0;
            for (std::size_t k = 0; k < 3; ++k)
              worst = std::max(worst, absoluteError(got[3 * i + k], truth[int(k)]));
            errors.push_back(worst);
          }
          return errors;
        });
  }
}

void huntHighlight(Bench& bench, Record& record) {
  // Whole programs, at several exponents: two numbers each for the direction of the normal, that of
  // the light, and the place around the peak.
  const SearchRange turn{0, 1, {0.25f, 0.5f}};
  for (Shading shading : {Shading::phong, Shading::blinnPhong}) {
    for (double alpha : {20.0, 1e3, 1e5}) {
      const bool blinn = isBlinn(shading);
      Look look = bench.lit(shading);
      const PointScene scene(look, litMaterial(0, 1, alpha));
      const double bound = blinn ? 2 * lobeTolerance(4 * alpha) : lobeTolerance(alpha);
      expectHunted(
          record, std::string(shadingName(shading)) + ", exponent " + numberText(alpha),
          {turn, turn, turn, {0.3f, 1, {}}, turn, {0, 8, {0.5f, 1}}}, bound, [&](const Columns& c) {
            const auto direction = [](double a, double b) {
              const double z = 2 * b - 1, r = std::sqrt(std::max(0.0, 1 - z * z));
              return glm::dvec3(r * std::cos(2 * pi * a), r * std::sin(2 * pi * a), z);
            };
            Points points;
            for (std::size_t i = 0; i < c[0].size(); ++i) {
              const glm::dvec3 n = direction(c[0][i], c[1][i]);
              const glm::dvec3 side = safeNormalize(
                  glm::cross(n, std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
              const glm::dvec3 other = glm::cross(n, side);
              const double cosine = c[3][i], sine = std::sqrt(1 - cosine * cosine);
              const double a = 2 * pi * c[2][i];
              const glm::dvec3 l = cosine * n + sine * (std::cos(a) * side + std::sin(a) * other);
              const glm::dvec3 axis = blinn ? n : 2 * cosine * n - l;
              const double x = 1 - std::min(double(c[5][i]) / (blinn ? 4 * alpha : alpha), 1.0);
              const double b = 2 * pi * c[4][i];
              const glm::dvec3 u = safeNormalize(glm::cross(
                  axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
              const glm::dvec3 at =
                  x * axis + std::sqrt(std::max(0.0, 1 - x * x)) *
                                 (std::cos(b) * u + std::sin(b) * glm::cross(axis, u));
              const glm::dvec3 v = blinn ? 2 * glm::dot(at, l) * at - l : at;
              points.add(glm::vec3(n), glm::vec3(-v), glm::vec3(l));
            }
            const auto got = bench.programs().shade(scene, points);
            const auto truth = referenceShade(scene, points);
            std::vector<double> errors;
            // The half vector is off by the error of L + V divided by its length.
            for (std::size_t i = 0; i < got.size(); ++i)
              errors.push_back(
                  absoluteError(got[i].y, truth[i].y) *
                  (blinn ? std::min(1.0f, glm::length(points.lights[i] - points.positions[i]))
                         : 1.0f));
            return errors;
          });
    }
  }
}

void reflectanceStaysInRange(Bench& bench, Record& record) {
  // At grazing incidence and near the critical angle, where R is close to 1 and rounds.
  double low = 1, high = 0;
  Random random(67);
  for (int k = 0; k < 60; ++k) {
    const double n = 1 + std::pow(10, random.between(-7, 2.9));
    for (bool denser : {false, true}) {
      const PointScene scene(whiteRoom(bench, denser ? n : 1), boundary(denser ? 1 : n));
      std::vector<float> cosines{0, 1};
      const double critical = criticalCosine(n, 1);
      for (int i = 0; i < 1000; ++i) {
        cosines.push_back(float(std::exp(-24 * random.unit())));
        cosines.push_back(float(std::min(critical * (1 + std::exp(-17 * random.unit())), 1.0)));
        cosines.push_back(float(random.unit()));
      }
      for (float r : bench.programs().reflectance(scene, cosines, true)) {
        low = r >= low ? low : r;
        high = r <= high ? high : r;
      }
    }
  }
  record.within("lowest of 360000", low, 0, 1);
  record.within("highest", high, 0.9, 1);
}

}  // namespace glint::stability
