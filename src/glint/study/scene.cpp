#include "glint/study/scene.h"

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

Scene sphereScene(int level, const ShadingParameters& shading) {
  const models::Mesh from = models::icosphere(level);
  Mesh mesh;
  mesh.positions = from.positions;
  mesh.normals = from.positions;
  mesh.indices = from.indices;
  Material material;
  material.name = "Sphere";
  material.shading = shading;
  Scene scene;
  scene.name = "sphere";
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({0, glm::dmat4(1.0)});
  scene.materials = {material, Material{}};
  scene.materials.back().name = "#default";
  return scene;
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
