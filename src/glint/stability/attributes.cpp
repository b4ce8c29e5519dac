// Group A: what a file's vertex attributes and indices may hold. This file has the cases of normals
// and the list of all cases; those of positions and indices are in geometry.cpp.

#include <cmath>
#include <limits>

#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/document.h"
#include "glint/stability/geometry.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// unit() and safeUnit() are off by 3 roundings of the square, halved by the root, and by those of
/// the root and the quotient: 2.1e-7.
constexpr double unitTolerance = 2.1e-7;

/// The scene of a triangle whose three normals are `normal`, as the loader returns it.
Scene loadedWith(const glm::vec3& normal) {
  Document document;
  document.triangle(repeated(normal, 3));
  return document.load();
}

/// Checks what file, shaders and reference make of a normal that has a direction.
void expectDirection(Bench& bench, Record& record, const glm::vec3& v, const glm::dvec3& unit) {
  const std::string what = "normal " + vectorText(v);
  expectVector(record, what + " of a file", glm::dvec3(loadedWith(v).meshes.at(0).normals.at(0)),
               unit, 6e-8);
  expectVector(record, what + " in the reference", safeNormalize(glm::dvec3(v)), unit, 1e-15);
  expectVector(record, what + " by safeUnit",
               bench.runVector("vec3 safeUnit(vec3)", {{v.x, v.y, v.z}}), unit, unitTolerance);
}

/// Checks that the face's normal replaces one without a direction.
void expectFaceNormal(Bench& bench, Record& record, const glm::vec3& v) {
  const std::string what = "normal " + vectorText(v);
  const Scene scene = loadedWith(v);
  for (const glm::vec3& n : scene.meshes.at(0).normals)
    expectVector(record, what + " of a file", glm::dvec3(n), {0, 0, 1}, 0);
  record.that("a warning tells of it", !scene.warnings.empty());
  expectVector(record, what + " in the reference", safeNormalize(glm::dvec3(v)), glm::dvec3(0), 0);
  expectDrawn(bench, record, what, scene);
}

void a1(Bench& bench, Record& record) {
  expectFaceNormal(bench, record, {0, 0, 0});
  for (const char* function : {"vec3 unit(vec3)", "vec3 safeUnit(vec3)"})
    expectVector(record, std::string(function) + " of 0", bench.runVector(function, {{0, 0, 0}}),
                 glm::dvec3(0), 0);
  // A surface with a zero normal that reaches a shader anyway is not lit.
  for (Shading shading : everyShading) {
    Look look = bench.lit(shading);
    Points points;
    points.add({0, 0, 0}, {0, 0, -1});
    const glm::vec3 got = bench.programs().shade({look, litMaterial(1, 1, 0)}, points)[0];
    expectVector(record, std::string(shadingName(shading)) + " with normal 0", glm::dvec3(got),
                 glm::dvec3(0), 0);
  }
}

void a2(Bench& bench, Record& record) { expectDirection(bench, record, {1e-20f, 0, 0}, {1, 0, 0}); }

void a3(Bench& bench, Record& record) {
  expectDirection(bench, record, {1e-23f, 2e-23f, 2e-23f}, glm::dvec3(1, 2, 2) / 3.0);
}

void a4(Bench& bench, Record& record) {
  // 1e-38 is subnormal: drivers may treat it as 0, and the direction is lost. The file's reader and
  // the reference keep it, and so does every driver for a file's normal, which is unit before
  // upload.
  const glm::vec3 v(1e-38f, 1e-38f, 0);
  const glm::dvec3 unit = glm::dvec3(1, 1, 0) * std::sqrt(0.5);
  expectVector(record, "normal " + vectorText(v) + " of a file",
               glm::dvec3(loadedWith(v).meshes.at(0).normals.at(0)), unit, 6e-8);
  expectVector(record, "normal " + vectorText(v) + " in the reference",
               safeNormalize(glm::dvec3(v)), unit, 1e-7);
  const glm::dvec3 shader = bench.runVector("vec3 safeUnit(vec3)", {{v.x, v.y, v.z}});
  record.that("safeUnit gives the direction or, where subnormals count as 0, nothing",
              shader == glm::dvec3(0) || glm::length(shader - unit) < 1e-6, vectorText(shader));
  expectVector(record, "safeUnit of normal numbers, (2e-38, 2e-38, 0)",
               bench.runVector("vec3 safeUnit(vec3)", {{2e-38f, 2e-38f, 0}}), unit, unitTolerance);
  expectDrawn(bench, record, "normal " + vectorText(v), loadedWith(v), false);
}

void a5(Bench& bench, Record& record) {
  expectDirection(bench, record, {1e20f, 1e20f, 0}, glm::dvec3(1, 1, 0) * std::sqrt(0.5));
}

void a6(Bench& bench, Record& record) {
  expectDirection(bench, record, {3e38f, 3e38f, 3e38f}, glm::dvec3(std::sqrt(1 / 3.0)));
}

void a7(Bench& bench, Record& record) {
  for (const glm::vec3& v : {glm::vec3(infinity, 0, 0), glm::vec3(nan, 0, 0), glm::vec3(1, 2, nan)})
    expectFaceNormal(bench, record, v);
}

void a8(Bench& bench, Record& record) { expectFaceNormal(bench, record, {-0.0f, 0, 0}); }

void a9(Bench& bench, Record& record) {
  // The shading normal leans 60 degrees from the face's, away from the viewer's side or the
  // light's.
  const glm::dvec3 v = safeNormalize({-0.9, 0, 0.3}), l = safeNormalize({0.6, 0, 0.8});
  const glm::dvec3 n = safeNormalize({0.86, 0, 0.5});
  for (Shading shading :
       {Shading::gouraud, Shading::phong, Shading::blinnPhong, Shading::environment}) {
    Look look = parallel(bench.lit(shading, l), v);
    const Scene scene = sceneOf(square(n, 20), litMaterial(0.5, 1, 3));
    const LightValues values = formulaValues(n, l, v, 3);
    const Image image = bench.draw(scene, look), truth = bench.reference(scene, look);
    const std::string name(shadingName(shading));
    const double lobe = isBlinn(shading) ? values.blinn : values.phong;
    const double expected = bench.lobeIsExact() ? lobe : truth.row(4)[17];
    record.near(name + ": highlight with N.V = " + numberText(glm::dot(n, v)), image.row(4)[17],
                expected, 2 * lobeTolerance(12));
    record.near(name + ": diffuse", image.row(4)[16] - image.row(4)[17], 0.5 * values.diffuse,
                2 * diffuseTolerance);
  }
}

void a10(Bench& bench, Record& record) {
  const glm::vec3 n(0.48f, 0.6f, 0.64f);
  const auto drawn = [&](float length, Shading shading) {
    const Scene scene = loadedWith(n * length);
    Look look = bench.lit(shading, {0.2, 0.3, 1});
    look.cameraDirection = glm::dvec3(0, 0, -1);
    look.material[""].specular = 0.5;
    return bench.draw(scene, look);
  };
  for (Shading shading : everyShading)
    for (float length : {0.5f, 2.0f, 1e-6f, 1e6f})
      // Powers of two change no bit; other lengths round the file's floats once more.
      record.alike(std::string(shadingName(shading)) + ": normals of length " + numberText(length),
                   drawn(length, shading), drawn(1, shading),
                   length == 0.5f || length == 2 ? 0 : 2 * lobeTolerance(400));
}

constexpr const char* faceNormal =
    "a normal without direction is replaced by the mean of the adjacent faces' on loading, with a "
    "warning";
constexpr const char* anyLength = "2.1e-7: 3.5 roundings; 6e-8 of a file's floats";

const Case attributeTable[] = {
    {"A1", "vertex normal (0, 0, 0)", "the face's normal, finite", "exact", "normalize(0) is NaN",
     faceNormal, a1},
    {"A2", "normal (1e-20, 0, 0)", "(1, 0, 0)", anyLength, "its square is subnormal", "", a2},
    {"A3", "normal (1e-23, 2e-23, 2e-23)", "(1/3, 2/3, 2/3)", anyLength,
     "squares underflow: normalize gives infinities", "", a3},
    {"A4", "normal (1e-38, 1e-38, 0)", "(0.7071, 0.7071, 0)", anyLength,
     "normalize gives infinities and NaN",
     "on the driver subnormal numbers may count as 0; files' normals are unit before upload", a4},
    {"A5", "normal (1e20, 1e20, 0)", "(0.7071, 0.7071, 0)", anyLength,
     "the sum of squares overflows: normalize gives 0, silently black", "", a5},
    {"A6", "normal (3e38, 3e38, 3e38)", "(0.57735, 0.57735, 0.57735)", anyLength, "as A5", "", a6},
    {"A7", "normals (inf, 0, 0), (NaN, 0, 0), (1, 2, NaN)", "the face's normal", "exact",
     "no scaling cures them", faceNormal, a7},
    {"A8", "normal (-0, 0, 0)", "as A1", "exact", "the sign of zero", faceNormal, a8},
    {"A9", "normal turned away from the face's front", "lit by the shading normal",
     "twice 1e-6 + 4e-7 sqrt(exponent): a rotation and a normalisation", "frequent in real meshes",
     "the gate is N.L > 0 with the shading normal; N.V is not asked", a9},
    {"A10", "normals of length 0.5, 2, 1e-6, 1e6", "the picture of unit normals",
     "exact for powers of two, else as rounded inputs", "only normalize in the shader is trusted",
     "", a10},
    {"A11", "degenerate triangles: two equal corners, three in a line",
     "not drawn, all normals unit", "exact", "their face normal is 0/0", "", a11},
    {"A12", "sliver 1 x 1e-7, also far from its origin", "(0, 0, 1)", "exact",
     "the cross product cancels", "face normals are formed in double", a12},
    {"A13", "position NaN or infinite in one vertex", "its triangle dropped, the rest intact",
     "exact", "one NaN poisons boxes and camera", "dropped with a warning", a13},
    {"A14", "index out of range, -1, count not divisible by 3", "refused with a message", "exact",
     "reads out of bounds", "what makes no whole triangle at the end is left out with a warning",
     a14},
    {"A15", "0 triangles, 1 triangle, an empty file", "background alone", "exact",
     "framing divides by the size of an empty box", "", a15},
    {"A16", "all vertices identical", "nothing drawn, camera finite", "exact", "radius 0", "", a16},
    {"A17", "two coincident triangles of opposite winding", "one picture, whatever the driver",
     "exact", "z-fighting",
     "one-sided: the one that faces the viewer; two-sided: the first drawn stays in front", a17},
    {"A18", "no normals in the file", "face normals", "exact", "–",
     "flat faces, as glTF prescribes", a18},
    {"A19", "2^16 + 3 and 2^24 + 1 vertices", "both ends drawn", "exact",
     "16-bit or float arithmetic of indices", "", a19},
};

}  // namespace

std::span<const Case> attributeCases() { return attributeTable; }

}  // namespace glint::stability
