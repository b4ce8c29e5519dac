#include "glint/budget/interpolation_bound.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "glint/budget/shaded_triangles.h"
#include "glint/image/task.h"
#include "glint/shading/angles.h"
#include "glint/shading/safe.h"

namespace glint {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
const double bentDirection = 2 / std::sqrt(3.0);  // |L''| in units of l^2

double squared(double x) { return x * x; }

// Bounds of a function over a triangle and of its derivatives along a path as long as an edge.
struct Derivatives {
  double most = 1, slope = 0, bend = 0;
};

Derivatives operator*(const Derivatives& f, const Derivatives& g) {
  return {f.most * g.most, f.slope * g.most + f.most * g.slope,
          f.bend * g.most + 2 * f.slope * g.slope + f.most * g.bend};
}

// The suprema over c in (0, 1] of the terms in the derivatives of c^a (4. of the header). In steps
// of x = a (1 - c), each varies by less than a percent from one sample to the next.
struct Steepness {
  double bend = 1, slope = 0;
  explicit Steepness(double a) {
    for (int i = 0; i <= 1000; ++i) {
      const double c = 1 - std::min(8.0 / a, 1.0) * i / 1000;
      const double sin2 = std::max(1 - c * c, 0.0), less = std::pow(c, a - 1);
      slope = std::max(slope, less * std::sqrt(sin2));
      if (a >= 2 && c > 0)
        bend = std::max(bend, less * (1 - c) / 2 + (a - 1) * std::pow(c, a - 2) * sin2);
    }
    bend *= 1.01;
    slope *= 1.01;
  }
};

// One light at one corner.
struct Corner {
  double cosine = 0;    // N.L
  double angle = 0;     // between R and V
  double distance = 0;  // to the light
  double axis = 0;      // -L.axis
};

// How one light reaches a triangle: its share of the full intensity, and how L turns.
struct LightOnTriangle {
  Derivatives share;
  double cap = 1;   // the largest share
  double step = 0;  // the error of `share` beyond the ramp of a spot
  double turn = 0;
  bool known = true;
};

using Corners = std::array<const Corner*, 3>;

// Empty if no light arrives; `cap` is infinite if there is no bound.
std::optional<LightOnTriangle> lightOnTriangle(const Light& light, const Triangle& triangle,
                                               const Corners& corners, Shading program) {
  LightOnTriangle onTriangle;
  onTriangle.known = triangle.known;
  if (light.type == Light::Type::directional || light.type == Light::Type::camera)
    return onTriangle;
  double near = unbounded, far = 0, low = 1, high = -1;
  for (const Corner* c : corners) {
    near = std::min(near, c->distance);
    far = std::max(far, c->distance);
    low = std::min(low, c->axis);
    high = std::max(high, c->axis);
  }
  const double least2 = squared(near) - squared(triangle.edge) / 3;
  if (!(least2 > 0)) {
    onTriangle.known = false;
    if (light.fallsOff) onTriangle.cap = unbounded;
    return onTriangle;
  }
  const double least = std::sqrt(least2), edge = triangle.edge;
  onTriangle.turn = edge / least;
  if (light.fallsOff) {
    const double r = light.range, window = r > 0 ? 1 / squared(squared(r)) : 0.0;
    if (r > 0 && least >= r) return std::nullopt;
    if (r > 0 && far > r) onTriangle.known = false;
    onTriangle.share = {1 / least2 - least2 * window,
                        2 * edge * (1 / (least * least2) + far * window),
                        2 * squared(edge) * (3 / squared(least2) + window)};
    onTriangle.cap = onTriangle.share.most;
  }
  if (light.type != Light::Type::spot) return onTriangle;
  const double bend = bentDirection * squared(onTriangle.turn);
  // The minimum is at a corner: a linear function over a convex one, where it is positive.
  high = std::min(high + bend / 6, 1.0);
  const double outer = std::cos(light.outerAngle * radians);
  const double inner = std::cos(light.innerAngle * radians), range = inner - outer;
  if (high <= outer) return std::nullopt;
  if (low >= inner && low > outer) return onTriangle;
  if (!(range > 0)) {
    onTriangle.known = false;
    return onTriangle;
  }
  const double from = std::max((low - outer) / range, 0.0), to = (high - outer) / range;
  const double beyond = std::max(to * to - 1, 0.0), missing = 1 - from * from;
  const bool full = program == Shading::gouraud && missing < beyond;
  if (program == Shading::gouraud) onTriangle.step = onTriangle.cap * std::min(beyond, missing);
  onTriangle.cap *= squared(std::min(to, 1.0));
  if (full) return onTriangle;
  const double aside = std::sqrt(1 - squared(std::max(low, 0.0)));  // sine of the largest angle
  const Derivatives ramp{to, onTriangle.turn * aside / range, bend / range};
  onTriangle.share = onTriangle.share * (ramp * ramp);
  return onTriangle;
}

struct Errors {
  double diffuse = 0, specular = 0;
  double most = 0;  // the most that the light brings
};

struct PowerLobe {
  double exponent;
  Steepness steepness;

  double value(double angle) const {
    const double c = std::cos(angle);
    return c > 0 ? std::pow(c, exponent) : 0.0;
  }
  // `turn` is how far R and V turn, `bent` bounds their second derivatives. For exponents below 2
  // `bend` is six times the error, and below 1 `slope` is 3/2 of the change over 2/3 of an edge.
  Derivatives over(double most, double turn, double bent) const {
    const double a = exponent;
    if (turn == 0) return {most, 0, 0};
    const double hoelder = 6 * std::pow(squared(turn) / 3, a / 2);
    if (a < 1) return {most, 1.5 * std::pow(2 * turn / 3, a), hoelder};
    const double slope = a * steepness.slope * turn;
    if (a < 2) return {most, slope, a * (squared(turn) + bent) + hoelder};
    return {most, slope, a * (steepness.bend * squared(turn) + steepness.slope * bent)};
  }
};

double nearestAngle(const Corners& corners, double turn) {
  double least = unbounded, most = 0;
  for (const Corner* c : corners) {
    least = std::min(least, c->angle);
    most = std::max(most, c->angle);
  }
  return std::max({least - 2 * turn / 3, most - turn, 0.0});
}

Errors errorsOf(const Light& light, const Triangle& triangle, const Corners& corners,
                const PowerLobe& lobe, double offFace, Shading program) {
  const std::optional<LightOnTriangle> found = lightOnTriangle(light, triangle, corners, program);
  if (!found) return {};
  const LightOnTriangle& onTriangle = *found;
  const double l = onTriangle.turn, w = triangle.turn, v = triangle.view;
  double low = 1, high = -1;
  for (const Corner* c : corners) {
    low = std::min(low, c->cosine);
    high = std::max(high, c->cosine);
  }
  Errors e;
  e.most = onTriangle.cap;
  e.diffuse = e.specular = onTriangle.cap;
  if (!onTriangle.known) return e;
  const double kink = high > 0 && low < 0 ? high * low / (low - high) : 0.0;
  const double bent = 2 * triangle.chord * l + bentDirection * l * l;
  low -= bent / 6;
  high += bent / 6;
  if (high <= 0) return {};

  const double facing = std::min(high / (1 - triangle.shorter), 1.0);
  const Derivatives cosine{std::min(std::max(high, -low), 1.0), triangle.chord + l, bent};
  const double turn = 2 * w + l + v;
  const double brightest = lobe.value(nearestAngle(corners, turn));
  const Derivatives highlight =
      lobe.over(brightest, turn, 2 * w * w + 4 * w * l + l * l + v * v + 2 * triangle.bent);
  double diffuse = 0, specular = 0;
  if (program == Shading::flat) {
    diffuse = (onTriangle.share * cosine).slope * 2 / 3 + onTriangle.cap * offFace;
    specular = low <= 0 ? onTriangle.cap : (onTriangle.share * highlight).slope * 2 / 3;
    specular +=
        onTriangle.cap * (lobe.exponent < 1 ? std::pow(2 * offFace, lobe.exponent)
                                            : 2 * offFace * lobe.exponent * lobe.steepness.slope);
  } else {
    diffuse = (onTriangle.share * cosine).bend / 6 + onTriangle.step * facing +
              onTriangle.share.most * std::max(kink, triangle.shorter * facing);
    specular = (onTriangle.share * highlight).bend / 6 + onTriangle.step * brightest;
    if (low <= 0) {
      double open = 0, closed = 0;
      for (const Corner* c : corners)
        (c->cosine > 0 ? open : closed) =
            std::max(c->cosine > 0 ? open : closed, lobe.value(c->angle));
      specular = std::max(specular + onTriangle.cap * closed, onTriangle.cap * open);
    }
  }
  e.diffuse = std::min(diffuse, onTriangle.cap * facing);
  e.specular = std::min(specular, onTriangle.cap * brightest);
  return e;
}

// The corners at these vertices.
std::vector<Corner> cornersOf(const ShadedTriangles& set,
                              const std::vector<std::uint32_t>& vertices, const Light& light,
                              const PlacedMesh& p, double side) {
  const Camera& camera = p.camera;
  std::vector<Corner> corners(vertices.size());
  const bool placed = light.type == Light::Type::point || light.type == Light::Type::spot;
  const glm::dvec3 from = light.position - camera.eye, axis = safeNormalize(light.direction);
  const glm::dvec3 direction = light.type == Light::Type::camera ? camera.axes * axis : axis;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3& point = set.points[vertices[i]];
    Corner& c = corners[i];
    const glm::dvec3 way = from - point;
    const glm::dvec3 L = placed ? safeNormalize(way) : direction;
    const glm::dvec3 V = p.variant.constantView ? camera.axes[2] : safeNormalize(-point);
    const glm::dvec3 N = side * set.normals[vertices[i]];
    c.cosine = glm::dot(N, L);
    if (p.variant.specular)
      c.angle = std::acos(std::clamp(glm::dot(2 * c.cosine * N - L, V), -1.0, 1.0));
    if (!placed) continue;
    c.distance = glm::length(way);
    c.axis = -glm::dot(L, axis);
  }
  return corners;
}

// The factors of all lights' errors.
struct Weights {
  glm::dvec3 matte, shine;
  glm::dvec3 ambient;  // the error of the ambient light
};

// The largest error on consecutive triangles, for one of their sides.
double worstOf(const ShadedTriangles& set, std::size_t begin, std::size_t end, const PlacedMesh& p,
               const PowerLobe& lobe, const Weights& weights, double side, Shading program) {
  std::vector<std::uint32_t> vertices;
  for (std::size_t i = begin; i < end; ++i)
    vertices.insert(vertices.end(), set.triangles[i].corners.begin(),
                    set.triangles[i].corners.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<std::array<std::size_t, 3>> places;
  for (std::size_t i = begin; i < end; ++i) {
    std::array<std::size_t, 3>& place = places.emplace_back();
    for (std::size_t j = 0; j < 3; ++j)
      place[j] = std::size_t(std::ranges::lower_bound(vertices, set.triangles[i].corners[j]) -
                             vertices.begin());
  }
  std::vector<glm::dvec3> errors(end - begin, weights.ambient);
  for (const Light& light : p.lights) {
    const std::vector<Corner> corners = cornersOf(set, vertices, light, p, side);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const auto& [a, b, c] = places[i];
      const Errors e =
          errorsOf(light, set.triangles[begin + i], {&corners[a], &corners[b], &corners[c]}, lobe,
                   set.offFace, program);
      if (!(e.most < unbounded)) return unbounded;
      // The driver interpolates the carried light: a few roundings of it.
      errors[i] += light.intensity * (weights.matte * (e.diffuse + 4e-6 * e.most) +
                                      weights.shine * (e.specular + 4e-6 * e.most));
    }
  }
  double worst = 0;
  for (const glm::dvec3& error : errors) worst = std::max(worst, largest(error));
  return worst;
}

}  // namespace

double interpolationBound(const PlacedMesh& p, Shading program, double enough) {
  const Variant& v = p.variant;
  if (v.textured != 0) return unbounded;  // per face or vertex, the texture is sampled elsewhere
  if (v.directionalLights + v.pointLights + v.spotLights == 0) return 0;
  if (v.normalTexture || v.specularAntialiasing) return unbounded;  // only per pixel
  const ShadedTriangles set = shadedTriangles(p, program);
  if (set.offFace > flatLimit) return unbounded;
  const ShadingParameters& m = p.material.shading;
  const PowerLobe lobe{m.exponent, Steepness(std::max(m.exponent, 1.0))};
  glm::vec4 most(1);
  if (v.vertexColors) {
    most = glm::vec4(0);
    for (const glm::vec4& color : p.mesh.colors) most = glm::max(most, color);
  }
  const glm::dvec3 C = m.color * glm::dvec3(most), S = m.metalness * C + (1 - m.metalness);
  const glm::dvec3 matte = v.diffuse ? m.diffuse * C : glm::dvec3(0.0);
  const glm::dvec3 shine = v.specular ? m.specular * S : glm::dvec3(0.0);

  const Weights weights{matte, shine, 4e-6 * m.ambient * C * p.look.ambientLight};

  constexpr std::size_t blockLength = 1024;
  const std::size_t blocks = (set.triangles.size() + blockLength - 1) / blockLength;
  std::atomic<double> worst = 0;
  inParallel(0, v.twoSided ? 2 * blocks : blocks, [&](std::size_t i, int) {
    if (worst > enough) return;
    const std::size_t begin = i % blocks * blockLength;
    const double found = worstOf(set, begin, std::min(begin + blockLength, set.triangles.size()), p,
                                 lobe, weights, i < blocks ? 1.0 : -1.0, program);
    double before = worst;
    while (found > before && !worst.compare_exchange_weak(before, found)) {
    }
  });
  return worst;
}

}  // namespace glint
