// GL pictures compared with the double-precision reference: shipped models, every form, points and
// lines.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "comparison.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"
#include "reference_scenes.h"

namespace glint::test::reference_gl_test {

TEST_P(AgainstReference, ShippedModels) {
  std::vector<std::string> models;
  for (const char* name : {"sphere.glb", "torus.glb", "teapot.glb"})
    models.push_back(std::string(GLINT_SOURCE_DIR "/models/") + name);
  if (const char* more = std::getenv("GLINT_REFERENCE_MODELS"))
    for (const auto& entry : std::filesystem::directory_iterator(more))
      if (entry.path().extension() == ".glb") models.push_back(entry.path());
  printHeading();
  for (const std::string& path : models)
    for (Shading shading : allPrograms) {
      Look look = lookWith(shading, 256);
      if (const char* size = std::getenv("GLINT_REFERENCE_SIZE"))
        look.resolution = glm::ivec2(std::atoi(size));
      Model model = modelOf(loadGltf(path), look);
      const Comparison c = compare(stage().renderer(), model, look);
      const std::string name = std::filesystem::path(path).filename();
      print(name, shading, c, wholeBound(c));
      if (model.images.empty()) {
        expectAccurate(name, look, c);
      }
    }
}

// Every form of lobe and reflectance, drawn by both.
TEST_P(AgainstReference, EveryForm) {
  Model model = modelOf(shippedScene("torus"), {});
  for (Material& m : model.scene.materials) m.shading.transmission = 0.6;
  printHeading();
  for (const std::string& form : highlightTexts()) {
    const HighlightForms highlight = parseHighlights(form, "form");
    const int gamma = highlight.brightest.gamma;
    if (gamma != 0 && gamma != 4) continue;
    for (Shading shading : {Shading::gouraud, Shading::phong, Shading::blinnPhong}) {
      Look look = lookWith(shading, 100);
      look.highlight = highlight;
      const Comparison c = compare(stage().renderer(), model, look);
      print(form, shading, c, wholeBound(c));
      expectAccurate(form, look, c);
    }
  }
  // Forms by light: from the brightest to the dimmest, a point, a directional light, a spot and
  // another.
  for (const std::string form :
       {"exact/2,lyon:4", "lyon:1/1,pow/1,pade:4/1,none", "none/1,lyon-cross:2/2,gaussian"})
    for (const Shading shading : allPrograms) {
      Look look = lookWith(shading, 100);
      look.light.emplace();
      look.highlight = parseHighlights(form, "form");
      // Some lamps have fall-off and some do not.
      for (const char* light :
           {"spot:2,2,3:-2,-2,-3:10,40:4,3,3:falloff", "point:-2,2,2:0.7,0.9,0.5",
            "point:0,3,2:7,8,5:falloff,9", "spot:-2,2,3:2,-2,-3:10,40:0.4,0.3,0.3",
            "directional:1,1,1:0.3,0.2,0.2", "directional:0,1,2:0.6,0.5,0.5"})
        look.light->push_back(parseLight(light));
      const Comparison c = compare(stage().renderer(), model, look);
      print(form, shading, c, wholeBound(c));
      expectAccurate(form, look, c);
    }
  for (const std::string_view form : fresnelTexts())
    for (const bool other : {false, true}) {
      Look look = lookWith(Shading::environment, 100);
      look.fresnel = parseFresnel(std::string(form), "form");
      look.environment = Environment::sky;
      look.twoSided = true;
      look.material[""].metalness = 0.3;
      if (other) {
        look.mediumIor = 1.7;
        look.schlickExponent = 4.5;
      }
      const Comparison c = compare(stage().renderer(), model, look);
      print(std::string(form), look.shading, c, wholeBound(c));
      expectAccurate(std::string(form), look, c);
    }
}

// Points and lines, whose rules leave the driver more freedom: the same pixels unless a tie is
// near.
TEST_P(AgainstReference, PointsAndLines) {
  Mesh points, lines;
  points.topology = Topology::points;
  lines.topology = Topology::lines;
  for (int i = 0; i < 40; ++i) {
    const float a = 0.7f * float(i), r = 0.07f * float(i);
    points.positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.1f * std::sin(3 * a));
    points.indices.push_back(std::uint32_t(i));
    lines.positions.push_back(points.positions.back() * 1.3f);
    lines.indices.push_back(std::uint32_t(i));
  }
  Scene scene = scenes::sceneOf({{points, {}}, {lines, {}}});
  const Look look = lookWith(Shading::phong, 150);
  const Image truth = ReferenceRenderer(scene, {}, boundsOf(scene), look).draw();
  const Image drawn = draw(scene, look);
  int covered = 0, other = 0;
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 150; ++x) {
      covered += pixel(truth, x, y).a > 0;
      other += pixel(truth, x, y).a != pixel(drawn, x, y).a;
    }
  std::printf("points and lines: %d pixels, %d of them differ\n", covered, other);
  EXPECT_GT(covered, 300);
  EXPECT_LE(other, covered / 50);
}

// Those of reference_special_gl_test.cpp, too.
INSTANTIATE_TEST_SUITE_P(Backends, AgainstReference, softwareBackends(), nameOfBackend);

}  // namespace glint::test::reference_gl_test
