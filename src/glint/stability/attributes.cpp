// Group A: what vertex attributes and indices of a file may hold.

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/image/error.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/document.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// unit() and safeUnit() are off by 3 roundings of the square, halved by the root, the root's and
/// the quotient's: 2.1e-7.
constexpr double unitTolerance = 2.1e-7;

void expectVector(Record& record, const std::string& what, const glm::dvec3& got,
                  const glm::dvec3& expected, double tolerance) {
  Worst worst;
  const char* const names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) worst.add(got[i], expected[i], tolerance, names[i]);
  worst.into(record, what + ": " + vectorText(got));
}

std::vector<float> repeated(const glm::vec3& v, int count) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

/// The scene of a triangle whose three normals are `normal`, as the loader gives it.
Scene loadedWith(const glm::vec3& normal) {
  Document document;
  document.triangle(repeated(normal, 3));
  return document.load();
}

/// All programs draw the scene's triangle finite, and lit where `lit`.
void expectDrawn(Bench& bench, Record& record, const std::string& what, const Scene& scene,
                 bool lit = true) {
  for (Shading shading : everyShading) {
    Look look = bench.look(shading);
    look.cameraDirection = glm::dvec3(0, 0, -1);
    look.resolution = {16, 16};
    look.light = {directional({0.2, 0.3, 1})};
    Look edited = look;
    edited.material[""].specular = 0.5;
    edited.material[""].ior = 1;
    const Image image = bench.draw(scene, edited);
    const std::string name(shadingName(shading));
    record.finite(name + ": " + what, image);
    float brightest = 0;
    for (std::size_t i = 0; i < image.values.size(); i += 4)
      brightest = std::max(brightest, image.values[i]);
    if (lit) record.within(name + ": brightest pixel, " + what, brightest, 0.5, 10);
  }
}

/// A normal that stands for a direction: what file, shaders and reference make of it.
void expectDirection(Bench& bench, Record& record, const glm::vec3& v, const glm::dvec3& unit) {
  const std::string what = "normal " + vectorText(v);
  expectVector(record, what + " of a file", glm::dvec3(loadedWith(v).meshes.at(0).normals.at(0)),
               unit, 6e-8);
  expectVector(record, what + " in the reference", safeNormalize(glm::dvec3(v)), unit, 1e-15);
  const std::vector<float> got = bench.run("vec3 safeUnit(vec3)", {{v.x, v.y, v.z}});
  expectVector(record, what + " by safeUnit", {got[0], got[1], got[2]}, unit, unitTolerance);
}

/// A normal that stands for no direction: the face's takes its place.
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
  for (const char* function : {"vec3 unit(vec3)", "vec3 safeUnit(vec3)"}) {
    const std::vector<float> got = bench.run(function, {{0, 0, 0}});
    expectVector(record, std::string(function) + " of 0", {got[0], got[1], got[2]}, glm::dvec3(0),
                 0);
  }
  // A zero normal that reaches a shader all the same lights nothing.
  for (Shading shading : everyShading) {
    Look look = bench.look(shading);
    look.light = {directional({0, 0, 1})};
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
  // 1e-38 is subnormal: drivers may take it for 0, and the direction with it. The file's reader and
  // the reference keep it; so does a normal of a file on every driver, which is unit before upload.
  const glm::vec3 v(1e-38f, 1e-38f, 0);
  const glm::dvec3 unit = glm::dvec3(1, 1, 0) * std::sqrt(0.5);
  expectVector(record, "normal " + vectorText(v) + " of a file",
               glm::dvec3(loadedWith(v).meshes.at(0).normals.at(0)), unit, 6e-8);
  expectVector(record, "normal " + vectorText(v) + " in the reference",
               safeNormalize(glm::dvec3(v)), unit, 1e-7);
  const std::vector<float> got = bench.run("vec3 safeUnit(vec3)", {{v.x, v.y, v.z}});
  const glm::dvec3 shader(got[0], got[1], got[2]);
  record.that("safeUnit gives the direction or, where subnormals count as 0, nothing",
              shader == glm::dvec3(0) || glm::length(shader - unit) < 1e-6, vectorText(shader));
  const std::vector<float> normal = bench.run("vec3 safeUnit(vec3)", {{2e-38f, 2e-38f, 0}});
  expectVector(record, "safeUnit of normal numbers, (2e-38, 2e-38, 0)",
               {normal[0], normal[1], normal[2]}, unit, unitTolerance);
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
    Look look = parallel(bench.look(shading), v);
    look.light = {directional(l)};
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
    Look look = bench.look(shading);
    look.cameraDirection = glm::dvec3(0, 0, -1);
    look.light = {directional({0.2, 0.3, 1})};
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

void a11(Bench& bench, Record& record) {
  // Two equal corners; three in a line; both share a vertex with a good triangle, without normals
  // and with zero ones to be mended.
  for (bool normals : {false, true}) {
    Document document;
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0};
    nlohmann::json attributes = {{"POSITION", document.accessor("VEC3", positions)}};
    if (normals) attributes["NORMAL"] = document.accessor("VEC3", std::vector<float>(12, 0));
    document.show(
        {{"attributes", attributes}, {"indices", document.indices({0, 0, 1, 0, 1, 3, 0, 1, 2})}});
    const Scene scene = document.load();
    bool finite = true;
    for (const glm::vec3& n : scene.meshes.at(0).normals)
      finite = finite && std::abs(glm::length(glm::dvec3(n)) - 1) < 1e-6;
    const std::string what = normals ? "zero normals" : "no normals";
    record.that("every normal is unit, " + what, finite);
    expectDrawn(bench, record, "degenerate triangles, " + what, scene);
    Document good;
    good.triangle(normals ? std::vector<float>(9, 0) : std::vector<float>());
    Look look = bench.look();
    look.cameraDirection = glm::dvec3(0, 0, -1);
    look.cameraPosition = glm::dvec3(0.5, 0.5, 5);
    look.light = {directional({0, 0, 1})};
    record.alike("picture with them and without them, " + what, bench.draw(scene, look),
                 bench.draw(good.load(), look), 0);
  }
}

void a12(Bench& bench, Record& record) {
  Document document;
  document.show({{"attributes",
                  {{"POSITION", document.accessor("VEC3", {0, 0, 0, 1, 0, 0, 0.5f, 1e-7f, 0})}}}});
  const Scene scene = document.load();
  expectVector(record, "face normal of a sliver 1 x 1e-7",
               glm::dvec3(scene.meshes.at(0).normals.at(0)), {0, 0, 1}, 0);
  Document tilted;  // far from its origin, where the cross product cancels
  tilted.show({{"attributes",
                {{"POSITION", tilted.accessor("VEC3", {1000, 1000, 1000, 1001, 1000, 1000, 1000.5f,
                                                       1000.0001f, 1000})}}}});
  expectVector(record, "the same far from its origin",
               glm::dvec3(tilted.load().meshes.at(0).normals.at(0)), {0, 0, 1}, 0);
  expectDrawn(bench, record, "a sliver", scene, false);
}

void a13(Bench& bench, Record& record) {
  for (float bad : {nan, infinity, -infinity}) {
    Document document;
    document.show(
        {{"attributes",
          {{"POSITION", document.accessor("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, bad, 0, 0})},
           {"NORMAL", document.accessor("VEC3", repeated({0, 0, 1}, 4))}}},
         {"indices", document.indices({0, 1, 2, 0, 1, 3})}});
    const Scene scene = document.load();
    const std::string what = "a vertex at " + numberText(bad);
    record.near(what + ": triangles left", double(scene.meshes.at(0).indices.size()) / 3, 1, 0);
    record.that("a warning tells of it", !scene.warnings.empty());
    const Bounds bounds = boundsOf(scene);
    record.near(what + ": radius of what is drawn", bounds.radius, std::sqrt(0.5), 1e-9);
    Document good;
    good.triangle(repeated({0, 0, 1}, 3));
    Look look = bench.look();
    look.light = {directional({0, 0, 1})};
    record.alike(what + ": picture against that without it", bench.draw(scene, look),
                 bench.draw(good.load(), look), 0);
  }
}

void a14(Bench&, Record& record) {
  const auto load = [](const std::vector<std::uint32_t>& indices) {
    Document document;
    document.triangle(repeated({0, 0, 1}, 3));
    document.json["meshes"][0]["primitives"][0]["indices"] = document.indices(indices);
    return document.load();
  };
  record.refused(
      "index 3 of 3 vertices",
      [&] {
        load({0, 1, 3});
      },
      "there are 3 vertices");
  record.refused(
      "index -1, which is 2^32 - 1",
      [&] {
        load({0, 1, 0xffffffffu});
      },
      "there are 3 vertices");
  const Scene scene = load({0, 1, 2, 0});
  record.near("4 indices: triangles drawn", double(scene.meshes.at(0).indices.size()), 3, 0);
  record.that("a warning tells of the rest", !scene.warnings.empty());
}

void a15(Bench& bench, Record& record) {
  Document none;
  none.json["scenes"] = {{{"nodes", nlohmann::json::array()}}};
  Document one;
  one.triangle(repeated({0, 0, 1}, 3));
  Document degenerate;
  degenerate.show(
      {{"attributes", {{"POSITION", degenerate.accessor("VEC3", {0, 0, 0, 1, 0, 0})}}}});
  for (Document* document : {&none, &degenerate}) {
    const Scene scene = document->load();
    Look look = bench.look();
    look.backgroundColor = glm::dvec3(0.25);
    const Image image = bench.draw(scene, look);
    record.finite("nothing to draw", image);
    record.alike("the background alone", image, Image{8, 8, std::vector<float>(image.values), {}},
                 0);
    record.near("its colour", image.values[0], 0.25, 0);
    record.near("the reference's", bench.reference(scene, look).values[0], 0.25, 0);
  }
  expectDrawn(bench, record, "one triangle", one.load());
}

void a16(Bench& bench, Record& record) {
  Document document;
  document.show({{"attributes",
                  {{"POSITION", document.accessor("VEC3", repeated({3, -2, 1}, 3))},
                   {"NORMAL", document.accessor("VEC3", repeated({0, 0, 1}, 3))}}}});
  const Scene scene = document.load();
  record.near("radius", boundsOf(scene).radius, 0, 0);
  const Camera camera = cameraFor(scene, boundsOf(scene), bench.look());
  record.that("the camera is finite", std::isfinite(camera.near) && std::isfinite(camera.far) &&
                                          camera.near > 0 && camera.far > camera.near &&
                                          std::isfinite(glm::dot(camera.eye, camera.eye)));
  const Image image = bench.draw(scene, bench.look());
  float brightest = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    brightest = std::max(brightest, image.values[i]);
  record.near("brightest pixel", brightest, 0, 0);
}

void a17(Bench& bench, Record& record) {
  // Red faces the viewer, green is the same triangle turned over.
  Scene scene = sceneOf(square(), unlitMaterial({1, 0, 0}));
  Mesh back = square();
  back.indices = {0, 2, 1, 0, 3, 2};
  back.material = 1;
  scene.materials.push_back(unlitMaterial({0, 1, 0}));
  scene.meshes.push_back(back);
  scene.instances.push_back({1, glm::dmat4(1)});
  for (bool swapped : {false, true}) {
    if (swapped) std::swap(scene.instances[0], scene.instances[1]);
    for (bool twoSided : {false, true}) {
      Look look = parallel(bench.look());
      look.twoSided = twoSided;
      const Image image = bench.draw(scene, look), truth = bench.reference(scene, look);
      // One-sided, only the front face shows; two-sided, what is drawn first stays in front.
      const bool red = !twoSided || !swapped;
      const std::string what = std::string(twoSided ? "two-sided" : "one-sided") +
                               (swapped ? ", back one first" : ", front one first");
      int wrong = 0;
      for (std::size_t i = 0; i < image.values.size(); i += 4)
        wrong += image.values[i] != (red ? 1.f : 0.f);
      record.near("pixels of the other triangle, " + what, wrong, 0, 0);
      record.alike("the reference agrees, " + what, image, truth, 0);
    }
  }
}

void a18(Bench& bench, Record& record) {
  Document document;
  document.show({{"attributes",
                  {{"POSITION", document.accessor("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1})}}},
                 {"indices", document.indices({0, 1, 2, 0, 3, 1})}});
  const Scene scene = document.load();
  const Mesh& mesh = scene.meshes.at(0);
  record.near("vertices, one for each corner", double(mesh.positions.size()), 6, 0);
  expectVector(record, "first face", glm::dvec3(mesh.normals.at(1)), {0, 0, 1}, 0);
  expectVector(record, "second face", glm::dvec3(mesh.normals.at(4)), {0, -1, 0}, 0);
  expectDrawn(bench, record, "a file without normals", scene);
}

void a19(Bench& bench, Record& record) {
  // A red triangle of the first vertices and a green one of the last: an index that loses bits
  // would take the first for the last.
  for (std::size_t count : {(std::size_t(1) << 16) + 3, (std::size_t(1) << 24) + 1}) {
    Mesh mesh;
    mesh.positions.assign(count, glm::vec3(0));
    const std::size_t last = count - 3;
    const glm::vec3 left[] = {{-1, -1, 0}, {0, -1, 0}, {-1, 1, 0}}, move(1, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.positions[k] = left[k];
      mesh.positions[last + k] = left[k] + move;
    }
    mesh.indices = {0, 1, 2, std::uint32_t(last), std::uint32_t(last + 1), std::uint32_t(last + 2)};
    const Image image =
        bench.draw(sceneOf(std::move(mesh), unlitMaterial({1, 1, 1})), parallel(bench.look()));
    const std::string what = std::to_string(count) + " vertices: ";
    record.near(what + "left triangle", image.row(6)[0], 1, 0);
    record.near(what + "right triangle", image.row(6)[16], 1, 0);
    record.near(what + "between them", image.row(1)[12], 0, 0);
  }
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
