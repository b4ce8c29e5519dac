// Group I: interpolation and precision.

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/image/srgb.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

constexpr Shading perPixel[] = {Shading::phong, Shading::blinnPhong, Shading::environment};

/// A square that fills the picture, with these normals at its left and right edges, unchanged.
Mesh bent(const glm::vec3& left, const glm::vec3& right) {
  Mesh mesh = square({0, 0, 1}, 1);
  mesh.normals = {left, right, right, left};
  return mesh;
}

/// The middle of that square. The picture is 9 pixels across, so that this is a pixel's centre.
double middleOf(const Image& image, int channel = 0) { return image.row(4)[16 + channel]; }

void expectFaceNormal(Bench& bench, Record& record, const glm::vec3& left, const glm::vec3& right) {
  for (bool turned : {false, true})
    for (Shading shading : perPixel) {
      Look look = parallel(bench.lit(shading, {0, 0.6, 0.8}), {0, 0, 1}, 9);
      look.twoSided = turned;
      Mesh mesh = bent(left, right);
      mesh.normalsMayCancel = true;
      if (turned) mesh.indices = {0, 2, 1, 0, 3, 2};
      const Scene scene = sceneOf(mesh, litMaterial(1, 0, 1));
      const Image image = bench.draw(scene, look);
      const std::string name = std::string(shadingName(shading)) + (turned ? ", back" : ", front");
      record.finite(name, image);
      // Derivatives of positions of about 1 over steps of 0.2: 2^-24 * 8 / 0.2.
      record.near(name + ": lit by the face's normal in the middle", middleOf(image), 0.8, 4e-6);
      record.near(name + ": the reference's", middleOf(bench.reference(scene, look)), 0.8, 1e-7);
    }
}

void i1(Bench& bench, Record& record) {
  expectFaceNormal(bench, record, {1, 0, 0}, {-1, 0, 0});
  expectFaceNormal(bench, record, {0, 0.6f, 0.8f}, {0, -0.6f, -0.8f});
}

void i2(Bench& bench, Record& record) {
  expectFaceNormal(bench, record, {1, 0, 0}, {-1, 1e-20f, 0});
}

void i3(Bench& bench, Record& record) {
  const float s = float(std::sqrt(0.5));
  for (Shading shading : perPixel) {
    Look look = parallel(bench.lit(shading), {0, 0, 1}, 9);
    const Scene scene = sceneOf(bent({s, 0, s}, {-s, 0, s}), litMaterial(0, 1, 100));
    record.near(std::string(shadingName(shading)) + ": highlight in the middle",
                middleOf(bench.draw(scene, look), 1), 1, lobeTolerance(400));
    record.near("without renormalising the dot product's would be",
                std::pow(0.5 * 2 - 1 + 1e-300, 100), 0, 1e-15);
  }
}

/// Rounds to fp16: 11 bits, to nearest even, without the limits of its range.
double half(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  const int exponent = std::max(std::ilogb(x), -14);
  const double step = std::ldexp(1.0, exponent - 10);
  return std::nearbyint(x / step) * step;
}

glm::dvec3 half(const glm::dvec3& v) { return {half(v.x), half(v.y), half(v.z)}; }

double halfDot(const glm::dvec3& a, const glm::dvec3& b) {
  double sum = half(a.x * b.x);
  sum = half(sum + half(a.y * b.y));
  return half(sum + half(a.z * b.z));
}

void i4(Bench& bench, Record& record) {
  constexpr double alpha = 100;
  Random random(17);
  double dotError = 0, differenceError = 0;
  const auto normals = randomDirections(20000, 3), lights = randomDirections(20000, 4),
             sides = randomDirections(20000, 5);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 n = normals[i], l = glm::dot(n, lights[i]) > 0 ? lights[i] : -lights[i];
    const glm::dvec3 r = 2 * glm::dot(n, l) * n - l;
    const double rho = std::sqrt(2 * 8 * random.unit() / alpha);
    const glm::dvec3 v = std::cos(rho) * r + std::sin(rho) * safeNormalize(glm::cross(r, sides[i]));
    const double truth = std::pow(std::max(std::cos(rho), 0.0), alpha);
    // R and V as fp16 vectors, as if interpolated or computed in fp16.
    const glm::dvec3 hr = half(r), hv = half(v);
    dotError =
        std::max(dotError, std::abs(std::pow(std::max(halfDot(hr, hv), 0.0), alpha) - truth));
    const glm::dvec3 d = half(hr - hv);
    const double lambda = half(0.5 * halfDot(d, d));
    differenceError =
        std::max(differenceError, std::abs(std::exp(alpha * std::log1p(-lambda)) - truth));
  }
  // Each of D's components is off by 2^-11 of the larger vector's, half an ulp each: the lobe by
  // 0.61 sqrt(alpha) sqrt(3) 2^-11 at most, 5e-3 or 1.3 levels.
  record.within("fp16 difference form at exponent 100, levels", 255 * differenceError, 0, 1.3);
  record.within("fp16 dot product at exponent 100, levels", 255 * dotError, 10, 60);
  // OpenGL 3.3 has one precision: the qualifier changes nothing.
  const float small = std::exp2(-20.f);
  record.near(
      "a mediump sum on this driver",
      bench.run("float sum(float x) { mediump float y = x + 1.0; return y - 1.0; }", {{small}})[0],
      small, 0);
}

void i5(Bench& bench, Record& record) {
  const glm::dvec3 v(200, 200, 200);
  record.that("fp16 dot product of (200, 200, 200) overflows", halfDot(v, v) > 65504);
  const glm::dvec3 u = half(safeNormalize(v));
  record.near("of the vector normalised first", halfDot(u, u), 1, 2e-3);
  const std::vector<float> got = bench.run("vec3 unit(vec3)", {{2e18f, 2e18f, 2e18f}});
  record.near("unit() of (2e18, 2e18, 2e18) on this driver", got[0], std::sqrt(1 / 3.0), 2.1e-7);
}

void i6(Bench& bench, Record& record) {
  // All normals 0: per-pixel programs fall back to the face's normal, from derivatives.
  Mesh mesh = sphere(10, 5);
  for (bool mirrored : {false, true}) {
    Mesh faceless = mesh;
    for (glm::vec3& n : faceless.normals) n = glm::vec3(0);
    faceless.normalsMayCancel = true;
    Material paint = litMaterial(1, 0, 1);
    Look look = parallel(bench.lit(Shading::phong, {-0.4, 0.8, 0.6}), {0.3, 0.4, 1}, 33);
    const glm::dmat4 world = mirrored ? scaling({-1, 1, 1}) : glm::dmat4(1);
    look.shading = Shading::flat;
    const Image flat = bench.draw(sceneOf(mesh, paint, world), look);
    look.shading = Shading::phong;
    const Image derivatives = bench.draw(sceneOf(faceless, paint, world), look);
    record.alike(mirrored ? "a mirrored ball" : "a ball", derivatives, flat, 1e-3);
  }
  // Where a pixel is 1e-10 of the distance, the cross product's square leaves float's range.
  Look look = bench.lit(Shading::phong, {0, 0.6, 0.8});
  look.cameraPosition = glm::dvec3(0, 0, 1e7);
  look.cameraFocalPoint = glm::dvec3(0);
  look.cameraViewAngle = 1e-5;
  look.resolution = {2048, 2048};
  Mesh plane = square({0, 0, 1}, 0.01f);
  for (glm::vec3& n : plane.normals) n = glm::vec3(0);
  plane.normalsMayCancel = true;
  const Image image = bench.draw(sceneOf(plane, litMaterial(1, 0, 1)), look);
  // Positions of 1e-7 in units of the distance: their differences keep 12 bits.
  record.near("in a view of 1e-5 degrees", image.row(1024)[4 * 1024], 0.8, 2e-3);
}

void i7(Bench& bench, Record& record) {
  Look look = parallel(bench.lit(Shading::gouraud), {0, 0, 1}, 9);
  const Scene scene = sceneOf(bent({1, 0, 0}, {0, 0, 1}), litMaterial(1, 0, 1));
  const double middle = middleOf(bench.draw(scene, look));
  record.near("gouraud: linear light between 0 and 1", middle, 0.5, 8 * rounding);
  record.within("its code: 188 in linear light, 128 if interpolated after the curve",
                encodeSrgb8(float(middle)), 187, 188);
}

void i8(Bench& bench, Record& record) {
  // About 1.5 pixels a triangle; positions and normals are interpolated over so few samples that
  // their plane equations lose digits: 1e-4 of a unit, times the lobe's slope sqrt(20) 0.61.
  for (Shading shading : perPixel) {
    Look look = parallel(bench.lit(shading, {0.3, 0.5, 1}), {0.2, 0.1, 1}, 40);
    const Scene scene = sceneOf(sphere(48, 24), litMaterial(0.5, 0.5, 5));
    const Image image = bench.draw(scene, look), truth = bench.reference(scene, look);
    const std::string name(shadingName(shading));
    record.finite(name, image);
    int different = 0;
    float high = 0;
    for (std::size_t i = 0; i < image.values.size(); i += 4) {
      different += !(std::abs(image.values[i] - truth.values[i]) <= 3e-4);
      high = std::max(high, image.values[i]);
    }
    record.within(name + ": pixels apart from the reference, but for 12 at edges", different, 0,
                  12);
    record.within(name + ": highest", high, 0.5, 1.000001);
  }
}

void i9(Bench& bench, Record& record) {
  const Scene scene = sceneOf(sphere(24, 12), litMaterial(0.5, 0.5, 50));
  for (Shading shading : everyShading) {
    Look look = bench.lit(shading, {0.3, 0.5, 1});
    look.resolution = {32, 32};
    const Image first = bench.draw(scene, look);
    const std::string name(shadingName(shading));
    record.alike(name + ": drawn again", bench.draw(scene, look), first, 0);
    Renderer fresh(bench.sources());
    GpuScene gpu(scene, {});
    record.alike(name + ": by another renderer", fresh.draw(gpu, boundsOf(scene), look), first, 0);
  }
}

void i10(Bench& bench, Record& record) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Scene scene = sceneOf(square(), litMaterial(1, 0.5, 20));
  for (Shading shading : everyShading) {
    Look look = parallel(bench.lit(shading));
    DrawList list = makeDrawList(scene, boundsOf(scene), look);
    list.items.at(0).materialBlock.color.x = nan;
    const Image image = bench.draw(scene, look, list);
    std::vector<std::uint8_t> codes(image.values.size());
    const std::size_t count =
        encodeSrgb8(image.values.data(), image.values.size() / 4, 1, codes.data());
    record.near(std::string(shadingName(shading)) + ": pixels counted as NaN", double(count), 64,
                0);
  }
  // Since NaN may vanish on the way (max(NaN, 0) is 0 on some drivers), it is refused at the input.
  record.refused("--material ", {"exponent=nan"}, takeMaterial, "is not a number");
}

const Case interpolationTable[] = {
    {"I1", "normals N and -N along an edge", "the face's normal in the middle, finite",
     "4e-6: derivatives of positions", "their mean is 0",
     "where the interpolated normal's square is at most 1e-6 the face's stands in", i1},
    {"I2", "normals (1, 0, 0) and (-1, 1e-20, 0)", "as I1", "4e-6: derivatives of positions",
     "the square 2.5e-41 underflows",
     "where the interpolated normal's square is at most 1e-6 the face's stands in", i2},
    {"I3", "normals 90 degrees apart, exponent 100", "highlight 1 in the middle",
     "1e-6 + 4e-7 sqrt(400)", "the mean's length is 0.7071: without renormalising 0", "", i3},
    {"I4", "fp16, exponent 100, 20000 geometries",
     "difference form 1.3 levels, dot form 10 and more", "0.61 sqrt(3 alpha) 2^-11",
     "mediump on a phone", "all shaders compute in 32 bits; fp16 is emulated on the CPU", i4},
    {"I5", "fp16 dot product of vectors longer than 147", "overflow; normalised first none",
     "2e-3: 11 bits", "65504 is the largest fp16 number", "", i5},
    {"I6", "face normals by derivatives and by faces, mirrored too", "the same", "1e-3 rad",
     "noise of derivatives; the sign comes from facing", "", i6},
    {"I7", "Gouraud from 0 to 1", "0.5 in linear light: code 188", "8 roundings",
     "interpolated after the curve it is 128", "", i7},
    {"I8", "triangles of a pixel", "the interpolated normal, within the triangle",
     "3e-4; 12 pixels at edges may be any", "extrapolation", "", i8},
    {"I9", "the same picture twice, and by another renderer", "the same bits", "exact",
     "baselines rest on it", "", i9},
    {"I10", "NaN planted in a uniform", "every pixel counted", "exact",
     "max(NaN, 0) is 0 on some drivers: NaN can vanish",
     "NaN is refused at the input and counted at the output", i10},
};

}  // namespace

std::span<const Case> interpolationCases() { return interpolationTable; }

}  // namespace glint::stability
