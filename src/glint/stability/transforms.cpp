// Group B: transforms and scales, in whole pictures.

#include <algorithm>
#include <cmath>

#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

Look litLook(Bench& bench, Shading shading) {
  Look look = bench.lit(shading, {-1, 1, 1});
  look.ambientLight = glm::dvec3(0.25);
  look.resolution = {48, 48};
  return look;
}

/// Checks that two pictures are the same to within the tolerance. A triangle's edge may move across
/// a sample where coordinates are rounded differently, so `edges` pixels may differ by any amount.
void expectSamePicture(Record& record, const std::string& what, const Image& got,
                       const Image& expected, double tolerance, int edges) {
  int different = 0, covered = 0;
  double worst = 0;
  for (std::size_t i = 0; i < got.values.size(); i += 4) {
    double off = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = std::abs(double(got.values[i + k]) - expected.values[i + k]);
      off = d <= off ? off : d;
    }
    covered += expected.values[i] != 0;
    if (!(off <= tolerance))
      ++different;
    else
      worst = std::max(worst, off);
  }
  record.within(what + ": pixels that show the model", covered, 200, 48 * 48);
  record.within(what + ": pixels that differ", different, 0, edges);
  record.near(what + ": largest difference of the others", worst, 0, tolerance);
}

/// A pixel's error where all coordinates are rounded differently: normals and positions turn by
/// 2^-23, the highlight of exponent 4 * 30 moves by 0.61 sqrt(120) of that, a few times as much in
/// slivers.
constexpr double movedTolerance = 2e-5;

void expectFormula(Bench& bench, Record& record, const std::string& what, const glm::dmat4& world,
                   double tolerance) {
  const glm::dvec3 n = safeNormalize({0, 1, 1}), v = safeNormalize({0.2, 0.5, 1}),
                   l = safeNormalize({0.4, 0.9, 0.6});
  // By the inverse transpose in double, turned to the viewer on the back of the square.
  const glm::dmat3 inverse = glm::transpose(glm::inverse(glm::dmat3(world)));
  const double side = glm::dot(inverse * glm::dvec3(0, 0, 1), v) < 0 ? -1 : 1;
  const glm::dvec3 normal = safeNormalize(inverse * n) * side;
  const LightValues values = formulaValues(normal, l, v, 12);
  for (Shading shading : {Shading::gouraud, Shading::phong, Shading::blinnPhong}) {
    Look look = parallel(bench.lit(shading, l), v, 3);
    Scene scene = sceneOf(square(n, 20), litMaterial(0.6, 0.4, 12), world);
    scene.materials[0].doubleSided = true;
    const Image image = bench.draw(scene, look), truth = bench.reference(scene, look);
    const std::string name = std::string(shadingName(shading)) + ", " + what;
    const double lobe = isBlinn(shading) ? values.blinn : values.phong;
    record.near(name + ": highlight", image.row(1)[5],
                bench.lobeIsExact() ? 0.4 * lobe : truth.row(1)[5], tolerance);
    record.near(name + ": diffuse", image.row(1)[4] - image.row(1)[5], 0.6 * values.diffuse,
                tolerance);
    record.near(name + ": the reference's diffuse", truth.row(1)[4] - truth.row(1)[5],
                0.6 * values.diffuse, 2e-7);
  }
}

// The matrix's entries are rounded once and summed; its scales differ by a factor of at most 20.
const double unevenTolerance = lobeTolerance(48) + 24 * rounding;

void b1(Bench& bench, Record& record) {
  expectFormula(bench, record, "scale (1, 1, 10)", scaling({1, 1, 10}), unevenTolerance);
  expectFormula(bench, record, "the same, turned", rotation(0.7) * scaling({1, 1, 10}),
                unevenTolerance);
  expectFormula(bench, record, "scale (2, 0.5, 0.1), turned",
                rotation(0.3) * scaling({2, 0.5, 0.1}), unevenTolerance);
  const glm::dmat3 m(scaling({1, 1, 10}));
  const glm::dvec3 n = safeNormalize({0, 1, 1});
  const glm::dvec3 right = safeNormalize(glm::transpose(glm::inverse(m)) * n),
                   wrong = safeNormalize(m * n);
  record.near("M n is off by degrees", std::acos(glm::dot(right, wrong)) / degrees, 78.6, 0.05);
}

/// Compares the picture of the mirrored model with that of a model whose vertices are mirrored.
void expectMirror(Bench& bench, Record& record, const glm::dvec3& mirror) {
  Mesh turned = pebble();
  for (std::size_t i = 0; i < turned.positions.size(); ++i) {
    turned.positions[i] *= glm::vec3(mirror);
    turned.normals[i] *= glm::vec3(mirror);
  }
  if (mirror.x * mirror.y * mirror.z < 0)
    for (std::size_t i = 0; i < turned.indices.size(); i += 3)
      std::swap(turned.indices[i + 1], turned.indices[i + 2]);
  for (Shading shading : everyShading) {
    const Look look = litLook(bench, shading);
    expectSamePicture(record, std::string(shadingName(shading)),
                      bench.draw(sceneOf(pebble(), paint(), scaling(mirror)), look),
                      bench.draw(sceneOf(turned, paint()), look), movedTolerance, 4);
  }
  expectFormula(bench, record, "a mirror", scaling(mirror) * rotation(0.4), unevenTolerance);
}

void b2(Bench& bench, Record& record) { expectMirror(bench, record, {-1, 1, 1}); }
void b3(Bench& bench, Record& record) { expectMirror(bench, record, {-1, -1, -1}); }

void expectScale(Bench& bench, Record& record, double scale) {
  const glm::dmat4 place = rotation(0.4) * scaling({1, 1.5, 0.7});
  for (Shading shading : everyShading) {
    const auto drawn = [&](double s) {
      Look look = litLook(bench, shading);
      Light point;
      point.type = Light::Type::point;
      point.position = glm::dvec3(1, 2, 3) * s;
      look.light->push_back(point);
      return bench.draw(sceneOf(pebble(), paint(), scaling(glm::dvec3(s)) * place), look);
    };
    const std::string name(shadingName(shading));
    const Image one = drawn(1);
    expectSamePicture(record, name + ", scale " + numberText(scale), drawn(scale), one,
                      movedTolerance, 4);
    const double power = std::exp2(std::round(std::log2(scale)));
    record.alike(name + ", the power of two next to it, to the bit", drawn(power), one, 0);
  }
}

void b4(Bench& bench, Record& record) { expectScale(bench, record, 1e-20); }
void b5(Bench& bench, Record& record) { expectScale(bench, record, 1e20); }

void b6(Bench& bench, Record& record) {
  // Almost flat: the normal along the surface is 1e-25 long before it is made unit.
  for (Shading shading : {Shading::gouraud, Shading::phong}) {
    Look look = parallel(bench.lit(shading, {0.6, 0, 0.8}), {0, 0, 1}, 3);
    const Image image = bench.draw(
        sceneOf(square({1, 0, 0}, 20), litMaterial(1, 0, 1), scaling({1, 1, 1e-25})), look);
    record.near(std::string(shadingName(shading)) + ", scale (1, 1, 1e-25): diffuse",
                image.row(1)[4], 0.6, diffuseTolerance);
  }
  Material material = paint();
  material.doubleSided = true;
  material.shading.ior = 1;
  for (Shading shading : everyShading)
    for (const glm::dvec3& scale : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0)}) {
      Look look = parallel(litLook(bench, shading), {0, 0, 1}, 32);
      look.light = {directional({0, 0.6, 0.8})};
      const Image image = bench.draw(sceneOf(sphere(16, 8), material, scaling(scale)), look);
      const std::string name = std::string(shadingName(shading)) + ", scale " + vectorText(scale);
      record.finite(name, image);
      if (scale != glm::dvec3(1, 1, 0) || shading == Shading::flat) continue;
      // Flattened onto z = 0, the ball has that plane's normal on its front.
      const LightValues values = formulaValues({0, 0, 1}, {0, 0.6, 0.8}, {0, 0, 1}, 30);
      const double lobe = isBlinn(shading) ? values.blinn : values.phong;
      if (!bench.lobeIsExact()) continue;
      record.near(name + ": red near the middle", image.row(13)[18 * 4],
                  0.9 * (0.5 * 0.25 + 0.7 * 0.8) + 0.4 * lobe,
                  2 * lobeTolerance(120) + 16 * rounding);
    }
}

void b7(Bench& bench, Record& record) {
  glm::dmat4 shear(1);
  shear[2][0] = 0.8;
  shear[2][1] = -0.3;
  expectFormula(bench, record, "shear", shear, unevenTolerance);
  expectFormula(bench, record, "shear and scale, turned",
                rotation(0.5) * shear * scaling({1, 3, 1}), unevenTolerance);
}

void b8(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    const auto drawn = [&](const glm::dvec3& place, bool framed) {
      Look look = litLook(bench, shading);
      if (!framed) {
        look.cameraPosition = place + glm::dvec3(2, 1.5, 3);
        look.cameraFocalPoint = place;
        look.clippingRange = glm::dvec2(1, 8);
      }
      return bench.draw(sceneOf(pebble(), paint(), translation(place)), look);
    };
    const std::string name(shadingName(shading));
    const Image origin = drawn({0, 0, 0}, false);
    record.alike(name + ": at 1e6, to the bit", drawn({1e6, -1e6, 2e6}, false), origin, 0);
    record.alike(name + ": at 1e7, to the bit", drawn({1e7, 0, -3e7}, false), origin, 0);
    // The camera that glint chooses adds and halves coordinates far from the origin: an ulp of 1e7
    // is 1.9e-9.
    expectSamePicture(record, name + ": framed at 1e7", drawn({1e7, 1e7, -1e7}, true),
                      drawn({0, 0, 0}, true), movedTolerance, 4);
  }
}

void b9(Bench& bench, Record& record) {
  for (Shading shading : everyShading) {
    const auto drawn = [&](double shift) {
      Look look = litLook(bench, shading);
      look.cameraPosition = glm::dvec3(1e7 + shift, 0, 0);
      look.cameraFocalPoint = glm::dvec3(shift, 0, 0);
      look.cameraViewAngle = 1e-5;
      return bench.draw(sceneOf(pebble(), paint(), translation({shift, 0, 0})), look);
    };
    const std::string name(shadingName(shading));
    const Image one = drawn(0);
    record.finite(name, one);
    // Nothing jitters: moved together by whole units, the picture is the same to the bit.
    record.alike(name + ": all moved by 1024", drawn(1024), one, 0);
    // From this distance the view is parallel: 1e7 tan(5e-6 degrees) = 0.873 to the upper edge.
    Look look = litLook(bench, shading);
    look.cameraPosition = glm::dvec3(1e3, 0, 0);
    look.cameraFocalPoint = glm::dvec3(0);
    look.cameraViewAngle = 2 * std::atan(1e4 * std::tan(5e-6 * degrees)) / degrees;
    look.cameraOrthographic = true;
    expectSamePicture(record, name + ": against the parallel view", one,
                      bench.draw(sceneOf(pebble(), paint()), look), 1e-4, 8);
  }
}

void b10(Bench& bench, Record& record) {
  // In float, as an animation may accumulate it: the columns' lengths drift, and are a real if
  // uneven scale.
  const double angle = 2 * pi / 1000;
  const glm::mat3 step(rotation(angle));
  glm::mat3 sum(1);
  for (int i = 0; i < 1000000; ++i) sum = step * sum;
  const double length = glm::length(glm::dvec3(sum[0]));
  record.that("the columns have drifted to a length of " + numberText(length),
              std::abs(length - 1) > 1e-6 && std::abs(length - 1) < 0.5);
  expectFormula(bench, record, "a rotation accumulated 1e6 times", glm::dmat4(glm::dmat3(sum)),
                unevenTolerance);
  // The camera's axes are recomputed from position and up vector: orthonormal whatever the input.
  Look look = bench.look();
  look.cameraDirection = glm::dvec3(sum[0]) * 1e-3;
  look.cameraViewUp = glm::dvec3(sum[1]) * 1e3;
  const Scene scene = sceneOf(square());
  const glm::dmat3 axes = cameraFor(scene, boundsOf(scene), look).axes;
  const glm::dmat3 gram = glm::transpose(axes) * axes;
  double worst = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(gram[i][j] - (i == j)));
  record.near("the camera's axes are orthonormal", worst, 0, 1e-15);
}

constexpr const char* unevenText =
    "1e-6 + 4e-7 sqrt(48) and 24 roundings: the matrix's entries are rounded once and summed";
constexpr const char* movedText =
    "2e-5: all coordinates rounded anew; 4 pixels at edges may be any";

const Case transformTable[] = {
    {"B1", "scale (1, 1, 10), normal (0, 1, 1)",
     "by the inverse transpose; M n is 78.6 degrees off", unevenText, "the normal matrix", "", b1},
    {"B2", "mirror diag(-1, 1, 1)", "as the mirrored model; front faces stay front", movedText,
     "a negative determinant flips winding and cofactors", "", b2},
    {"B3", "scale -1 in all axes", "as B2", movedText, "the determinant is -1", "", b3},
    {"B4", "everything scaled by 1e-20", "the same picture; by 2^-66 to the bit", movedText,
     "the determinant 1e-60 underflows",
     "eye space is measured in a power of two near the distance", b4},
    {"B5", "everything scaled by 1e20", "the same picture; by 2^66 to the bit", movedText,
     "squares overflow", "eye space is measured in a power of two near the distance", b5},
    {"B6", "singular scales (1, 1, 0), (1, 0, 0), 0", "finite; flat with the cofactors' normal",
     "twice 1e-6 + 4e-7 sqrt(120)", "there is no inverse", "", b6},
    {"B7", "shear", "by the inverse transpose", unevenText, "rotation-only normal matrices fail",
     "", b7},
    {"B8", "the model at 1e7 from the origin", "as at the origin, to the bit",
     "exact; framed by glint 2e-5", "float's spacing is 1 there", "the eye is subtracted in double",
     b8},
    {"B9", "camera 1e7 away, view angle 1e-5 degrees", "stable; as the parallel view",
     "exact; 1e-4: the view's angle", "jitter", "", b9},
    {"B10", "a rotation accumulated 1e6 times in float", "normals by the inverse transpose of it",
     unevenText, "lengths drift",
     "a file's matrix is taken as it stands; the camera's axes are made orthonormal", b10},
};

}  // namespace

std::span<const Case> transformCases() { return transformTable; }

}  // namespace glint::stability
