// Public sample models, valid and damaged ones, from the folder in GLINT_ASSETS.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"

namespace gltf_assets_test {

namespace fs = std::filesystem;

fs::path assets() {
  const char* folder = std::getenv("GLINT_ASSETS");
  return folder ? folder : "";
}

std::vector<fs::path> modelsBelow(const fs::path& folder) {
  std::vector<fs::path> models;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path ending = entry.path().extension();
    if (ending == ".gltf" || ending == ".glb") models.push_back(entry.path());
  }
  return models;
}

/// Triangles drawn, counting each instance.
std::size_t triangles(const glint::Scene& scene) {
  std::size_t count = 0;
  for (const glint::Instance& instance : scene.instances) {
    const glint::Mesh& mesh = scene.meshes.at(static_cast<std::size_t>(instance.mesh));
    if (mesh.topology == glint::Topology::triangles) count += mesh.indices.size() / 3;
  }
  return count;
}

/// The invariants that scene.h promises for every scene.
void expectSound(const glint::Scene& scene) {
  ASSERT_FALSE(scene.materials.empty());
  for (const glint::Mesh& mesh : scene.meshes) {
    const std::size_t count = mesh.positions.size();
    ASSERT_FALSE(mesh.indices.empty());
    for (const auto index : mesh.indices) ASSERT_LT(index, count);
    for (const auto& p : mesh.positions) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
    if (mesh.topology == glint::Topology::triangles) {
      ASSERT_EQ(mesh.normals.size(), count);
      // Each component is rounded to float: 3 * 2^-25 of the length; the tolerance is three times
      // that.
      for (const auto& n : mesh.normals) ASSERT_NEAR(glm::length(glm::dvec3(n)), 1, 3e-7);
    }
    if (!mesh.colors.empty()) {
      ASSERT_EQ(mesh.colors.size(), count);
    }
    for (const auto& set : mesh.texcoords) {
      if (!set.empty()) {
        ASSERT_EQ(set.size(), count);
      }
    }
    ASSERT_LT(static_cast<std::size_t>(mesh.material), scene.materials.size());
  }
  for (const glint::Material& material : scene.materials) {
    for (const auto& texture : {material.colorTexture, material.emissionTexture}) {
      if (texture) {
        ASSERT_LT(static_cast<std::size_t>(texture->image), scene.images.size());
      }
    }
  }
  for (const std::string& warning : scene.warnings) {
    EXPECT_EQ(warning.find('\n'), std::string::npos) << warning;
  }
}

TEST(GltfAssets, SampleModelsLoadWhole) {
  ASSERT_FALSE(assets().empty()) << "set GLINT_ASSETS to the folder of the sample models";
  const std::map<std::string, std::size_t> known = {
      {"Box.glb", 12},
      {"BoxInterleaved.glb", 12},
      {"BoxTextured.glb", 12},
      {"BoxVertexColors.glb", 12},
      {"TriangleWithoutIndices.gltf", 1},
      {"SimpleMeshes.gltf", 2},
      {"SimpleSparseAccessor.gltf", 12},
      {"Cameras.gltf", 2},
      {"TwoSidedPlane.gltf", 2},
      {"AnimatedMorphCube.glb", 12},
      {"RiggedSimple.glb", 188},
      {"CesiumMan.glb", 4672},
      {"Monster.glb", 884},
      {"Suzanne.gltf", 3936},
      {"Duck.glb", 4212},
      {"2CylinderEngine.glb", 110342},  // excluding 11154 that use a vertex twice
      {"DamagedHelmet.glb", 15452},
  };
  std::size_t found = 0;
  for (const fs::path& model : modelsBelow(assets() / "models")) {
    SCOPED_TRACE(model.string());
    const glint::Scene scene = glint::loadGltf(model);
    expectSound(scene);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    const auto expected = known.find(model.filename().string());
    if (expected == known.end()) continue;
    EXPECT_EQ(triangles(scene), expected->second);
    ++found;
  }
  EXPECT_EQ(found, known.size());
}

TEST(GltfAssets, DamagedModelsLoadOrFailInOneLine) {
  ASSERT_FALSE(assets().empty()) << "set GLINT_ASSETS to the folder of the sample models";
  const std::vector<fs::path> models = modelsBelow(assets() / "malformed");
  EXPECT_FALSE(models.empty());
  for (const fs::path& model : models) {
    SCOPED_TRACE(model.string());
    try {
      const glint::Scene scene = glint::loadGltf(model);
      expectSound(scene);
      for (const auto& warning : scene.warnings) {
        std::printf("%s: warning: %s\n", model.filename().c_str(), warning.c_str());
      }
    } catch (const glint::InputError& error) {
      const std::string line = error.what();
      std::printf("%s\n", line.c_str());
      EXPECT_EQ(line.rfind(model.string() + ": ", 0), 0u) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

}  // namespace gltf_assets_test
