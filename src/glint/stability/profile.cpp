#include "glint/stability/profile.h"

#include <glad/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "glint/image/srgb.h"
#include "glint/render/probe_error.h"
#include "glint/render/probe_search.h"
#include "glint/shading/safe.h"
#include "glint/stability/profile_targets.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

using Column = std::vector<float>;

constexpr std::size_t rows = 200000;
constexpr float smallest = std::numeric_limits<float>::min();

/// Uniform over the floats from low to high, and the 1000 on either side of each of `specials`.
Column floatsFrom(float low, float high, const Column& specials = {}, unsigned seed = 41) {
  Random random(seed);
  Column column;
  const double a = floatOrder(low), b = floatOrder(high);
  for (std::size_t i = 0; i < rows; ++i)
    column.push_back(floatAtOrder(std::int32_t(a + (b - a) * random.unit())));
  for (float s : specials)
    for (int k = -1000; k <= 1000; ++k) column.push_back(std::clamp(stepFloat(s, k), low, high));
  return column;
}

/// The largest errors against the truth, in ulp, absolute, and as a share of what is allowed (at
/// the input `at`).
struct Measured {
  double ulp = 0, absolute = 0, share = 0;
  std::size_t at = 0;
};

template <typename Truth, typename Allowed>
Measured measure(const Column& got, Truth truth, Allowed allowed) {
  Measured m;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double exact = truth(i);
    const double error = absoluteError(got[i], exact);
    m.ulp = std::max(m.ulp, error / std::max(floatSpacing(exact), double(smallest) * 1e-7));
    m.absolute = std::max(m.absolute, error);
    const double share = error / allowed(i);
    if (share > m.share) m.share = share, m.at = i;
  }
  return m;
}

double largestError(const Column& got, const Column& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < got.size(); ++i)
    worst = std::max(worst, absoluteError(got[i], truth[i]));
  return worst;
}

enum class Unit { ulp, absolute };

Quality judged(const char* name, const char* measured, Unit unit, const Measured& m,
               const char* required, const char* touches) {
  const bool weak = !(m.share <= 1);
  const std::string verdict = weak ? "worse than required, by a factor of " + shortText(m.share)
                              : m.share < 0.5 ? "better than required"
                                              : "as required";
  if (unit == Unit::ulp)
    return {name, measured, shortText(m.ulp) + " ulp", required, verdict, touches, weak, -1, m.ulp};
  return {name, measured,  shortText(m.absolute) + " absolute", required, verdict, touches,
          weak, m.absolute};
}

Quality powQuality(Bench& bench) {
  Column x, y;
  Random random(43);
  for (std::size_t i = 0; i < rows; ++i) {
    const double exponent = std::pow(10, random.between(0, 6));
    y.push_back(float(exponent));
    x.push_back(float(std::exp(-8 * random.unit() / exponent)));
  }
  const Column got = bench.run("float power(float x, float y) { return pow(x, y); }", {x, y});
  const Measured m = measure(
      got, [&](std::size_t i) { return std::pow(double(x[i]), double(y[i])); },
      [&](std::size_t i) { return y[i] * std::log(2.0) * std::exp2(-21) + 1e-6; });
  Quality q = judged("pow", "x to 1, y to 1e6, x^y from 3e-4 to 1", Unit::absolute, m,
                     "as exp2(y log2(x)): off by y ln 2 2^-21 near 1",
                     "--highlight pow and --fresnel schlick alone");
  q.result += ", at pow(" + numberText(x[m.at]) + ", " + numberText(y[m.at]) + ")";
  if (m.absolute > 1 / 510.0) {
    q.weak = true;
    q.verdict += "; more than half a level of an 8-bit picture";
  }
  return q;
}

void elementary(Bench& bench, std::vector<Quality>& all) {
  const Column negative = floatsFrom(-100, -1e-6f, {-1, -0.5f});
  const Measured powers = measure(
      bench.run("float f(float x) { return exp2(x); }", {negative}),
      [&](std::size_t i) { return std::exp2(double(negative[i])); },
      [&](std::size_t i) {
        return (3 + 2 * std::abs(negative[i])) * floatSpacing(std::exp2(double(negative[i])));
      });
  all.push_back(judged("exp2", "x from -100 to 0", Unit::ulp, powers, "3 + 2 |x| ulp",
                       "the exact lobe, whose bound counts it: 3.6e-7 at most"));
  // The lobe's bound of 1e-6 counts on at most 3.6e-7 for values of at most 1.
  Quality& exponential = all.back();
  exponential.absolute = powers.absolute;
  exponential.result += ", " + shortText(powers.absolute) + " absolute";
  exponential.weak = powers.absolute > 3.6e-7;
  exponential.verdict += exponential.weak ? "; more than the lobe's bound counts on"
                                          : "; within what the lobe's bound counts on, 3.6e-7";
  const Column near = floatsFrom(0.5f, 2, {1, 0.5f, 2});
  all.push_back(judged("log2 near 1", "x from 1/2 to 2", Unit::absolute,
                       measure(
                           bench.run("float f(float x) { return log2(x); }", {near}),
                           [&](std::size_t i) { return std::log2(double(near[i])); },
                           [](std::size_t) { return std::exp2(-21); }),
                       "2^-21 absolute; relative to log2(x) nothing",
                       "--highlight pow; the exact lobe takes a series there"));
  const Column far = floatsFrom(1e-30f, 0.5f);
  all.push_back(
      judged("log2 elsewhere", "x from 1e-30 to 1/2", Unit::ulp,
             measure(
                 bench.run("float f(float x) { return log2(x); }", {far}),
                 [&](std::size_t i) { return std::log2(double(far[i])); },
                 [&](std::size_t i) { return 3 * floatSpacing(std::log2(double(far[i]))); }),
             "3 ulp", "the exact lobe where lambda > 1/2, whose bound counts it"));
  const Column positive = floatsFrom(1e-36f, 1e36f, {1, 2, 4});
  const auto reciprocalRoot = [&](std::size_t i) { return 1 / std::sqrt(double(positive[i])); };
  all.push_back(judged(
      "inversesqrt", "x from 1e-36 to 1e36", Unit::ulp,
      measure(bench.run("float f(float x) { return inversesqrt(x); }", {positive}), reciprocalRoot,
              [&](std::size_t i) { return 2 * floatSpacing(reciprocalRoot(i)); }),
      "2 ulp", "nothing: unit() divides by the root"));
  const auto root = [&](std::size_t i) { return std::sqrt(double(positive[i])); };
  all.push_back(judged("sqrt", "x from 1e-36 to 1e36", Unit::ulp,
                       measure(bench.run("float f(float x) { return sqrt(x); }", {positive}), root,
                               [&](std::size_t i) { return 4.5 * floatSpacing(root(i)); }),
                       "as 1 / inversesqrt(x): 4.5 ulp",
                       "unit vectors (2.1e-7 if rounded) and the exact reflectance"));
  const Column over = floatsFrom(1e-18f, 1e18f, {1, 3}), under = floatsFrom(1e-18f, 1e18f, {}, 43);
  Column divisor = under;
  divisor.resize(over.size(), 3);
  const auto quotient = [&](std::size_t i) { return double(over[i]) / divisor[i]; };
  all.push_back(
      judged("division", "x, y from 1e-18 to 1e18", Unit::ulp,
             measure(bench.run("float f(float x, float y) { return x / y; }", {over, divisor}),
                     quotient, [&](std::size_t i) { return 2.5 * floatSpacing(quotient(i)); }),
             "2.5 ulp", "unit vectors and the exact reflectance"));
  Column product = divisor;
  for (std::size_t i = 0; i < product.size(); ++i) product[i] = float(1 + i % 8191) / 4096;
  Column factor = floatsFrom(1e-3f, 1e3f);
  factor.resize(product.size(), 1);
  const auto sum = [&](std::size_t i) { return double(product[i]) * factor[i] + factor[i]; };
  all.push_back(judged(
      "sums and products", "x y + y", Unit::ulp,
      measure(bench.run("float f(float x, float y) { return x * y + y; }", {product, factor}), sum,
              [&](std::size_t i) { return 2 * floatSpacing(sum(i)); }),
      "each rounded correctly: 1 ulp of both", "everything"));
}

void vectors(Bench& bench, std::vector<Quality>& all) {
  const auto error = [&](const char* function, double low, double high) {
    Column v;
    const auto directions = randomDirections(50000, 7);
    Random random(47);
    std::vector<glm::dvec3> truth;
    for (const glm::dvec3& d : directions) {
      const glm::vec3 x(d * std::pow(10, random.between(low, high)));
      v.insert(v.end(), {x.x, x.y, x.z});
      truth.push_back(safeNormalize(glm::dvec3(x)));
    }
    const Column got = bench.run(function, {v});
    double worst = 0;
    for (std::size_t i = 0; i < got.size(); ++i)
      worst = std::max(worst, absoluteError(got[i], truth[i / 3][int(i % 3)]));
    return worst;
  };
  constexpr const char* normalize = "vec3 f(vec3 v) { return normalize(v); }";
  const double usual = error(normalize, -15, 15), any = error(normalize, -37, 38);
  all.push_back(
      {"normalize", "lengths 1e-15 to 1e15; 1e-37 to 1e38",
       shortText(usual) + " absolute; " + (std::isinf(any) ? "infinite or NaN" : shortText(any)),
       "as x inversesqrt(dot(x, x)): nothing where the square leaves the range",
       any > 1e-3 ? "usable only where the square stays in range" : "usable for every length",
       "nothing: unit() and safeUnit() stand for it (" +
           shortText(error("vec3 safeUnit(vec3)", -30, 38)) + " for lengths 1e-30 to 1e38)",
       any > 1e-3});
  const Column tiny{1e-40f};
  const float kept = bench.run("float f(float x) { return x; }", {tiny})[0];
  const float made = bench.run("float f(float x) { return x * 0.5; }", {{smallest}})[0];
  all.push_back({"subnormal numbers", "1e-40 read, 2^-127 made",
                 std::string(kept != 0 ? "kept" : "taken for 0") + " when read, " +
                     (made != 0 ? "kept" : "0") + " when made",
                 "may be taken for 0", kept != 0 ? "more than required" : "as required",
                 "case A4: normals below 1.2e-38 on the driver; files' are unit before it"});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float zero = bench.run("float f(float x, float y) { return pow(x, y); }", {{0}, {0}})[0];
  all.push_back({"pow(0, 0)", "the value", numberText(zero), "undefined",
                 zero == 1 ? "as in C" : "not as in C",
                 "nothing: lobePow asks for a positive base first"});
  const auto lost = [&](const char* function) {
    const float x = bench.run(function, {{nan}})[0];
    return std::isnan(x) ? std::string("NaN") : numberText(x);
  };
  const std::string maximum = lost("float f(float x) { return max(x, 0.0); }"),
                    minimum = lost("float f(float x) { return min(x, 1.0); }"),
                    clamped = lost("float f(float x) { return clamp(x, 0.0, 1.0); }"),
                    power = lost("float f(float x) { return pow(x, 2.0); }");
  all.push_back({"NaN", "max(NaN, 0), min(NaN, 1), clamp(NaN, 0, 1), pow(NaN, 2)",
                 maximum + ", " + minimum + ", " + clamped + ", " + power, "undefined",
                 maximum == "NaN" ? "NaN is kept" : "NaN may vanish",
                 "the count of NaN pixels: inputs are "
                 "checked, so that none is made"});
  // x^2 minus its rounded value is 0, unless the two are one fused operation.
  const Column x = floatsFrom(1, 2);
  Column square;
  for (float a : x) square.push_back(a * a);
  const Column rest = bench.run("float f(float x, float y) { return x * x - y; }", {x, square});
  const auto fused = std::count_if(rest.begin(), rest.end(), [](float r) { return r != 0; });
  all.push_back({"fused multiply-add", "x x - fl(x x) over 200000 floats",
                 fused > 0 ? std::to_string(fused) + " differ from 0: fused" : "0: not fused",
                 "either may be", fused > 0 ? "products are kept exact" : "each is rounded",
                 "the last bits of every picture; no bound"});
}

/// Measures a square across the view, tilted in depth, with colours.
void interpolation(Bench& bench, std::vector<Quality>& all) {
  Mesh mesh;
  mesh.positions = {{-1, -1, -1}, {8, -8, -8}, {8, 8, -8}, {-1, 1, -1}};
  mesh.normals.assign(4, glm::vec3(0, 0, 1));
  mesh.colors = {{0, 0, 1, 1}, {1, 0, 0.5f, 1}, {1, 1, 0.25f, 1}, {0, 1, 0.125f, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  const Scene scene = sceneOf(mesh, unlitMaterial(glm::dvec3(1)));
  Look look = bench.look();
  look.cameraPosition = glm::dvec3(0);
  look.cameraFocalPoint = glm::dvec3(0, 0, -1);
  look.cameraViewAngle = 90;
  look.clippingRange = glm::dvec2(0.5, 20);
  look.resolution = {256, 256};
  const Image got = bench.draw(scene, look), truth = bench.reference(scene, look);
  double worst = largestError(got.values, truth.values);
  GLint subpixel = 0;
  glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel);
  all.push_back({"interpolation", "colours of 0 to 1 over 256 pixels, w from 1 to 8",
                 shortText(worst) + " absolute, vertices on a grid of 2^-" +
                     std::to_string(subpixel) + " pixels",
                 "not stated", worst < 1e-5 ? "good" : "coarse",
                 "every picture: docs/accuracy.md tells it from shading", worst > 1e-4, worst});

  // dFdx of a linear function over neighbouring fragments; and of squares, which shows the step.
  Column line, squares;
  for (int i = 0; i < 1024; ++i) {
    line.push_back(float(i) * 0.125f);
    squares.push_back(float(i) * float(i));
  }
  const Column slope = bench.run("float f(float x) { return dFdx(x); }", {line});
  double off = 0;
  for (float s : slope) off = std::max(off, std::abs(s - 0.125));
  const Column steps = bench.run("float f(float x) { return dFdx(x); }", {squares});
  const bool pairs = steps[0] == steps[1] && steps[2] == steps[3] && steps[1] != steps[2];
  all.push_back({"derivatives", "dFdx of a line and of squares",
                 "line " + shortText(off) + " off; " +
                     (pairs ? "one for each pair of fragments" : "one for each fragment"),
                 "an approximation", off == 0 ? "exact where it can be" : "coarse",
                 "face normals where vertex normals cancel (I1, I6)", off > 1e-5});
}

void textures(Bench& bench, std::vector<Quality>& all) {
  Scene scene = sceneOf(square({0, 0, 1}, 1), unlitMaterial(glm::dvec3(1)));
  scene.meshes[0].texcoords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  scene.images.push_back({"profile", {}});
  Texture texture;
  texture.sampler = {Filter::nearest, Filter::nearest, MipFilter::none, Wrap::clampToEdge,
                     Wrap::clampToEdge};
  scene.materials[0].colorTexture = texture;
  // Each code once with nearest filtering: only decoding.
  DecodedImages codes;
  codes[0].image = {16, 16, 4, {}};
  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 4; ++k) codes[0].image.values.push_back(std::uint8_t(k == 3 ? 255 : i));
  const Image decoded = bench.draw(scene, parallel(bench.look(), {0, 0, 1}, 16), codes);
  double worst = 0;
  for (std::size_t i = 0; i < 256; ++i)
    worst = std::max(worst, absoluteError(decoded.values[4 * i], srgbDecoded[i]));
  all.push_back({"sRGB textures", "the 256 codes, nearest filter", shortText(worst) + " absolute",
                 "the curve; no precision stated", worst < 1e-6 ? "exact" : "rounded",
                 "colours of textures", worst > 2e-3, worst});

  scene.materials[0].colorTexture->sampler.magnify = Filter::linear;
  scene.materials[0].colorTexture->sampler.minify = Filter::linear;
  DecodedImages noise;
  noise[0].image = {8, 8, 4, {}};
  Random random(53);
  for (int i = 0; i < 256; ++i)
    noise[0].image.values.push_back(std::uint8_t(i % 4 == 3 ? 255 : random.below(256)));
  const Look look = parallel(bench.look(), {0, 0, 1}, 200);
  const Image got = bench.draw(scene, look, noise), truth = bench.reference(scene, look, noise);
  worst = largestError(got.values, truth.values);
  all.push_back({"texture filtering", "bilinear, sRGB, 8 x 8 texels of noise over 200 pixels",
                 shortText(worst) + " absolute", "not stated: weights of a few bits are allowed",
                 worst < 5e-4 ? "fine weights" : "coarse weights",
                 "colours of textures; error budgets are of shading, not of filtering",
                 worst > 1e-2, worst});
}

}  // namespace

std::vector<Quality> measureProfile(Bench& bench) {
  std::vector<Quality> all{powQuality(bench)};
  elementary(bench, all);
  vectors(bench, all);
  interpolation(bench, all);
  textures(bench, all);
  measureTargets(all);
  return all;
}

std::string profileText(const std::vector<Quality>& all) {
  std::string text = "the driver, apart from glint:\n";
  for (const Quality& q : all) {
    std::string name = q.name;
    name.resize(20, ' ');
    text += std::string(q.weak ? "! " : "  ") + name + q.result + "; required: " + q.required +
            "; " + q.verdict + "; touches: " + q.touches + "\n";
  }
  return text;
}

nlohmann::ordered_json profileJson(const std::vector<Quality>& all) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Quality& q : all) {
    nlohmann::ordered_json one{{"name", q.name}, {"measured", q.measured}, {"result", q.result}};
    if (q.ulp >= 0 && std::isfinite(q.ulp)) one["ulp"] = q.ulp;
    if (q.absolute >= 0 && std::isfinite(q.absolute)) one["absolute"] = q.absolute;
    one["required"] = q.required;
    one["verdict"] = q.verdict;
    one["weak"] = q.weak;
    one["touches"] = q.touches;
    list.push_back(one);
  }
  return list;
}

}  // namespace glint::stability
