// Group G: camera, clipping and depth.

#include <algorithm>
#include <cmath>

#include "glint/gl/framebuffer.h"
#include "glint/image/error.h"
#include "glint/reference/renderer.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

/// A look from the origin along -Z.
Look fromOrigin(Bench& bench, double viewAngle, int width = 9, int height = 9) {
  Look look = bench.look();
  look.cameraPosition = glm::dvec3(0);
  look.cameraFocalPoint = glm::dvec3(0, 0, -1);
  look.cameraViewAngle = viewAngle;
  look.resolution = {width, height};
  return look;
}

/// Checks a green square at `near` in front of a red one at `far`, drawn in either order.
void expectOrder(Bench& bench, Record& record, double near, double far, glm::dvec2 range) {
  const float size = float(far);
  for (bool swapped : {false, true}) {
    Scene scene =
        sceneOf(square({0, 0, 1}, size), unlitMaterial({0, 1, 0}), translation({0, 0, -near}));
    Mesh behind = square({0, 0, 1}, size);
    behind.material = 1;
    scene.materials.push_back(unlitMaterial({1, 0, 0}));
    scene.meshes.push_back(behind);
    scene.instances.push_back({1, translation({0, 0, -far})});
    if (swapped) std::swap(scene.instances[0], scene.instances[1]);
    Look look = fromOrigin(bench, 30, 16, 16);
    look.clippingRange = range;
    const Image image = bench.draw(scene, look);
    int wrong = 0;
    for (std::size_t i = 0; i < image.values.size(); i += 4) wrong += image.values[i + 1] != 1;
    record.near(numberText(near) + " before " + numberText(far) + ", near and far " +
                    numberText(range.x) + ", " + numberText(range.y) +
                    (swapped ? ", the near one drawn last" : ", the near one drawn first") +
                    ": wrong pixels",
                wrong, 0, 0);
  }
}

void g1(Bench& bench, Record& record) { expectOrder(bench, record, 100, 100.1, {1e-3, 1e7}); }

void g2(Bench& bench, Record& record) { expectOrder(bench, record, 1000, 1000.01, {0.1, 1e4}); }

void g3(Bench&, Record& record) {
  record.refused(
      "--clipping-range ", {"1,1", "0,1", "-1,1", "2,1", "1,inf", "nan,1", "1"},
      [](const std::string& text) { parseRange(text); }, "NEAR,FAR with 0 < NEAR < FAR");
}

/// A floor under the eye from 4 behind it to 40 in front of it, coloured by position.
Scene floorScene() {
  Mesh mesh;
  mesh.positions = {{-4, -1, 4}, {4, -1, 4}, {4, -1, -40}, {-4, -1, -40}};
  mesh.normals.assign(4, glm::vec3(0, 1, 0));
  mesh.colors = {{0, 0, 1, 1}, {1, 0, 1, 1}, {1, 1, 1, 1}, {0, 1, 1, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return sceneOf(mesh, unlitMaterial(glm::dvec3(1)));
}

void g4(Bench& bench, Record& record) {
  Look look = fromOrigin(bench, 90, 32, 32);
  look.clippingRange = glm::dvec2(0.01, 100);
  const Scene scene = floorScene();
  const Image image = bench.draw(scene, look), truth = bench.reference(scene, look);
  record.finite("a floor through the near plane", image);
  // Attributes of up to 1 are divided by the interpolated 1/w, whose plane equation spans w from
  // 0.01 to 40: about 2^-24 * 44 of it.
  record.alike("colours against the reference", image, truth, 1e-5);
  for (Shading shading : everyShading) {
    Look lit = look;
    lit.shading = shading;
    lit.light = {directional({0, 1, 0})};
    Scene paint = scene;
    paint.materials[0] = litMaterial(1, 0.5, 20);
    record.finite(std::string(shadingName(shading)) + ": lit", bench.draw(paint, lit));
  }
}

void g5(Bench& bench, Record& record) {
  Mesh mesh;
  mesh.positions = {{-1, -1, -1}, {10, -10, -10}, {10, 10, -10}, {-1, 1, -1}};
  mesh.normals.assign(4, glm::vec3(0, 0, 1));
  mesh.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  const Scene scene = sceneOf(mesh, unlitMaterial(glm::dvec3(1)));
  Look look = fromOrigin(bench, 90);
  look.clippingRange = glm::dvec2(0.5, 20);
  // t = (0.5 / 10) / (0.5 / 1 + 0.5 / 10).
  record.near("middle of the picture", bench.draw(scene, look).row(4)[16], 1 / 11.0, 16 * rounding);
  record.near("the reference's", bench.reference(scene, look).row(4)[16], 1 / 11.0, 1e-7);
}

void expectFiniteCamera(Bench& bench, Record& record, const std::string& what, const Look& look) {
  const Scene scene = sceneOf(sphere(12, 6), litMaterial(1, 0.5, 20));
  const Camera camera = cameraFor(scene, boundsOf(scene), look);
  const glm::dmat3 gram = glm::transpose(camera.axes) * camera.axes;
  double worst = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double off = std::abs(gram[i][j] - (i == j));
      worst = off <= worst ? worst : off;
    }
  record.near(what + ": axes are orthonormal", worst, 0, 1e-14);
  record.that(what + ": 0 < near < far, finite",
              camera.near > 0 && camera.far > camera.near && std::isfinite(camera.far));
  record.finite(what + ": picture", bench.draw(scene, look));
}

void g6(Bench& bench, Record& record) {
  Look look = bench.lit();
  look.cameraPosition = look.cameraFocalPoint = glm::dvec3(0.5, 0.25, 0.125);
  expectFiniteCamera(bench, record, "eye at the focal point", look);
  look.cameraPosition = glm::dvec3(0, 5, 0);
  look.cameraFocalPoint = glm::dvec3(0);
  expectFiniteCamera(bench, record, "looking along the way up", look);
  look.cameraPosition = glm::dvec3(0, -5, 0);
  expectFiniteCamera(bench, record, "looking up", look);
  look.cameraPosition = glm::dvec3(0, 0, 5);
  look.cameraViewUp = glm::dvec3(0, 0, 1);
  expectFiniteCamera(bench, record, "way up along the view", look);
  record.refused(
      "--camera-direction 0,0,0", [&] { bench.take("camera-direction", "0,0,0"); },
      "has no direction");
}

void g7(Bench& bench, Record& record) {
  for (double angle : {1e-5, 1e-3, 179.0, 179.9}) {
    Look look = bench.lit();
    look.cameraViewAngle = angle;
    expectFiniteCamera(bench, record, "view angle " + numberText(angle), look);
  }
  record.refused(
      "--camera-view-angle ", {"0", "180", "-1", "nan"},
      [&](const std::string& text) { bench.take("camera-view-angle", text); },
      "is not a number from");
}

void g8(Bench& bench, Record& record) {
  record.refused(
      "--resolution ", {"0,0", "0,1", "1,0", "-1,1", "70000,1", "1.5,1"},
      [](const std::string& text) { parseResolution(text); }, "with each from 1 to 65535");
  for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(16384, 1), glm::ivec2(1, 16384)}) {
    Look look = bench.lit();
    look.resolution = size;
    look.cameraZoomFactor = 1e3;
    const Image image = bench.draw(sceneOf(sphere(12, 6), litMaterial(1, 0.5, 20)), look);
    const std::string what = std::to_string(size.x) + " x " + std::to_string(size.y);
    record.near(what + ": values", double(image.values.size()), 4.0 * size.x * size.y, 0);
    record.finite(what, image);
  }
}

void g9(Bench& bench, Record& record) {
  Look look = bench.look();
  look.cameraPosition = glm::dvec3(0);
  look.cameraFocalPoint = glm::dvec3(0, 0, -1);
  look.ambientLight = glm::dvec3(0.5);
  look.backgroundColor = glm::dvec3(0.25);
  Scene scene = sceneOf(sphere(24, 12), litMaterial(0, 0, 1));
  scene.materials[0].shading.ambient = 1;
  const Image outside = bench.draw(scene, look);
  record.near("from inside, one-sided: the background", outside.row(4)[16], 0.25, 0);
  look.twoSided = true;
  const Image inside = bench.draw(scene, look);
  record.near("from inside, two-sided: the back faces", inside.row(4)[16], 0.5, 1e-6);
  scene.materials[0].shading.diffuse = 0.5;
  for (Shading shading : everyShading) {
    look.shading = shading;
    look.light = {directional({0.3, 0.2, 1})};
    const Image image = bench.draw(scene, look), truth = bench.reference(scene, look);
    const std::string name(shadingName(shading));
    record.finite(name + ": from inside", image);
    record.near(name + ": the reference agrees", image.row(4)[16], truth.row(4)[16], 1e-5);
  }
}

void g10(Bench& bench, Record& record) {
  const Scene scene = sceneOf(sphere(12, 6), litMaterial(1, 0.5, 20));
  Look look = bench.lit(Shading::phong, {0.3, 0.2, 1});
  look.resolution = {24, 20};
  // A reference is drawn row by row and belongs to one size: after a change it starts again.
  Image rows;
  ReferenceRenderer left(scene, {}, boundsOf(scene), look, 1);
  left.drawRows(0, 7, rows);
  record.near("rows done before the change", left.rowsDone(), 7, 0);
  look.resolution = {32, 16};
  const Image whole = bench.reference(scene, look);
  ReferenceRenderer again(scene, {}, boundsOf(scene), look, 1);
  record.near("rows done after it", again.rowsDone(), 0, 0);
  Image pieces{32, 16, {}};
  for (int y = 0; y < 16; y += 5) {
    again.drawRows(y, std::min(5, 16 - y), rows);
    pieces.values.insert(pieces.values.end(), rows.values.begin(), rows.values.end());
  }
  record.alike("in pieces against at once", pieces, whole, 0);
  // The driver's target shrinks and grows with the picture and keeps nothing of the previous one.
  Look large = look;
  large.resolution = {48, 40};
  const Image first = bench.draw(scene, look);
  const Image between = bench.draw(scene, large);
  record.alike("the driver's picture after another size", bench.draw(scene, look), first, 0);
  record.near("values of the larger one", double(between.values.size()), 4.0 * 48 * 40, 0);
}

void g11(Bench& bench, Record& record) {
  const int most = maxSamples();
  record.within("samples of the driver", most, 1, 1024);
  if (most < 2) return;
  // Normals that turn by 170 degrees over thin triangles: extrapolated to a pixel's centre outside
  // the triangle they would turn past the back.
  Mesh mesh = thinTriangles(0.01f);
  const glm::vec3 left = glm::vec3(safeNormalize({-1, 0, 0.09})),
                  right = glm::vec3(safeNormalize({1, 0, 0.09}));
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) mesh.normals[i] = i % 3 == 1 ? right : left;
  for (bool mayCancel : {false, true})
    for (Shading shading : everyShading) {
      Look look = parallel(bench.lit(shading, {0, 0.2, 1}), {0, 0, 1}, 16);
      look.antiAliasing = {AntiAliasing::Mode::msaa, std::min(most, 4)};
      Mesh own = mesh;
      own.normalsMayCancel = mayCancel;
      const Scene scene = sceneOf(own, litMaterial(0.5, 0.5, 8));
      const Image image = bench.draw(scene, look);
      const std::string name =
          std::string(shadingName(shading)) + (mayCancel ? ", normals may cancel" : "");
      record.finite(name, image);
      float low = 0, high = 0;
      for (std::size_t i = 0; i < image.values.size(); i += 4) {
        low = std::min(low, image.values[i]);
        high = std::max(high, image.values[i]);
      }
      record.within(name + ": lowest", low, 0, 0);
      record.within(name + ": highest", high, 0.01, 1.000001);
      record.that(name + ": shaded within the triangle",
                  makeDrawList(scene, boundsOf(scene), look).items.at(0).variant.multisampled);
    }
}

const Case cameraTable[] = {
    {"G1", "near and far 1e-3 and 1e7, objects at 100 and 100.1", "in order", "exact",
     "a 24-bit step there is 0.6", "depth is a reversed float where the driver has clip control",
     g1},
    {"G2", "near and far 0.1 and 1e4, objects at 1000 and 1000.01", "in order", "exact",
     "a 24-bit step there is 0.6", "depth is a reversed float where the driver has clip control",
     g2},
    {"G3", "near = far, near <= 0, far < near, infinite, NaN", "refused", "exact",
     "division by zero", "", g3},
    {"G4", "a floor through the near plane and behind the eye", "clipped, perspective-correct",
     "1e-5: w from 0.01 to 40 in one plane equation", "NaN for w <= 0", "", g4},
    {"G5", "w from 1 to 10 across the picture", "1/11 in the middle", "16 roundings",
     "interpolation linear on the screen gives 1/2", "", g5},
    {"G6", "eye at the focal point; way up along the view", "finite axes", "1e-14",
     "the cross product is 0", "another axis takes the place of the undefined one", g6},
    {"G7", "view angle 1e-5 to 179.9 degrees; 0, 180", "finite; refused", "exact", "tan", "", g7},
    {"G8", "0 x 0; 1 x 1; 16384 x 1; 1 x 16384", "refused; drawn", "exact", "division", "", g8},
    {"G9", "camera inside the model", "background; back faces where two-sided", "1e-6; 1e-5", "–",
     "back faces are drawn for two-sided materials or with --two-sided, and lit from their side",
     g9},
    {"G10", "another size while a reference is made row by row", "it begins anew; nothing is left",
     "exact", "rows of two sizes in one picture",
     "a reference belongs to one scene, look and size: a change makes a new one", g10},
    {"G11", "multisampling, normals that turn by 170 degrees over thin triangles",
     "finite, between 0 and the peak", "exact; 1e-6", "extrapolation outside the triangle",
     "shaded at the mean of the samples covered, which lies inside", g11},
};

}  // namespace

std::span<const Case> cameraCases() { return cameraTable; }

}  // namespace glint::stability
