#include "glint/study/scene.h"

#include "glint/shading/angles.h"
#include "models/mesh.h"

namespace glint {

StudyScene::StudyScene(Scene given, const Look& look) : scene(std::move(given)) {
  bounds = boundsOf(scene);
  Look all = look;  // every filter is studied, whatever the look says
  all.specularAntialiasing = SpecularAntialiasing::toksvig;
  images = decodeImages(scene, all);
}

StudyScene::StudyScene(Scene given, DecodedImages decoded)
    : scene(std::move(given)), bounds(boundsOf(scene)), images(std::move(decoded)) {}

Scene sceneOf(const char* name, Mesh mesh, const Material& material) {
  Scene scene;
  scene.name = name;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({0, glm::dmat4(1.0)});
  scene.materials = {material, Material{}};
  scene.materials.back().name = "#default";
  return scene;
}

Scene sphereScene(int level, const ShadingParameters& shading) {
  const models::Mesh from = models::icosphere(level);
  Mesh mesh;
  mesh.positions = from.positions;
  mesh.normals = from.positions;
  mesh.indices = from.indices;
  Material material;
  material.name = "Sphere";
  material.shading = shading;
  return sceneOf("sphere", std::move(mesh), material);
}

std::vector<Light> spreadLights(int count, double degrees, Light::Type type) {
  std::vector<Light> lights;
  const double low = std::cos(degrees * radians);
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (1 - low) * (i + 0.5) / count, r = std::sqrt(1 - z * z);
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    Light& light = lights.emplace_back();
    light.type = type;
    light.direction = {r * std::cos(turn), r * std::sin(turn), z};
    light.intensity = glm::dvec3(1.0 / count);
  }
  return lights;
}

ShadingParameters sphereMaterial() {
  ShadingParameters plastic;
  plastic.diffuse = 0.8;
  plastic.specular = 0.5;
  plastic.exponent = 40;
  plastic.color = {0.7, 0.05, 0.03};
  return plastic;
}

}  // namespace glint
