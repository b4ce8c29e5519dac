#include "glint/stability/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/image/error.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/document.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

/// By the red channel.
float brightest(const Image& image) {
  float most = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4) most = std::max(most, image.values[i]);
  return most;
}

}  // namespace

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

void expectDrawn(Bench& bench, Record& record, const std::string& what, const Scene& scene,
                 bool lit) {
  for (Shading shading : everyShading) {
    Look look = bench.lit(shading, {0.2, 0.3, 1});
    look.cameraDirection = glm::dvec3(0, 0, -1);
    look.resolution = {16, 16};
    Look edited = look;
    edited.material[""].specular = 0.5;
    edited.material[""].ior = 1;
    const Image image = bench.draw(scene, edited);
    const std::string name(shadingName(shading));
    record.finite(name + ": " + what, image);
    if (lit) record.within(name + ": brightest pixel, " + what, brightest(image), 0.5, 10);
  }
}

void a11(Bench& bench, Record& record) {
  // A triangle with two equal corners and one with three in a line, which share vertices with a
  // good triangle; without normals, and with zero ones to be replaced.
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
    Look look = bench.lit();
    look.cameraDirection = glm::dvec3(0, 0, -1);
    look.cameraPosition = glm::dvec3(0.5, 0.5, 5);
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
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity()}) {
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
    Look look = bench.lit();
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
      "there are only 3 vertices");
  record.refused(
      "index -1, which is 2^32 - 1",
      [&] {
        load({0, 1, 0xffffffffu});
      },
      "there are only 3 vertices");
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
  record.near("brightest pixel", brightest(bench.draw(scene, bench.look())), 0, 0);
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
  // A triangle of the first vertices and one of the last: an index that loses bits would take the
  // first for the last.
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

}  // namespace glint::stability
