#include "glint/stability/scenes.h"

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <span>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/gltf/scene_file.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"

namespace glint::stability {

Mesh square(const glm::dvec3& normal, float half) {
  Mesh mesh;
  mesh.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.normals.assign(4, glm::vec3(safeNormalize(normal)));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Mesh sphere(int around, int down) {
  Mesh mesh;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= around; ++i) {
      const double theta = pi * j / down, phi = 2 * pi * i / around;
      const glm::dvec3 p(std::sin(theta) * std::cos(phi), std::cos(theta),
                         -std::sin(theta) * std::sin(phi));
      mesh.positions.emplace_back(p);
      mesh.normals.emplace_back(safeNormalize(p));
    }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (around + 1) + i); };
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < around; ++i) {
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j)});
      if (j < down - 1)
        mesh.indices.insert(mesh.indices.end(), {at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  return mesh;
}

Mesh triangles(std::vector<glm::vec3> positions) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.indices.push_back(i);
  return mesh;
}

Scene sceneOf(Mesh mesh, Material material, const glm::dmat4& world) {
  Scene scene;
  scene.name = "case";
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(std::move(material));
  scene.instances.push_back({0, world});
  return scene;
}

Material unlitMaterial(const glm::dvec3& color) {
  Material material;
  material.shading.color = color;
  material.unlit = true;
  return material;
}

Look parallel(Look look, const glm::dvec3& toViewer, int pixels) {
  look.cameraPosition = toViewer * (4 / std::sqrt(glm::dot(toViewer, toViewer)));
  look.cameraFocalPoint = glm::dvec3(0);
  look.cameraViewAngle = 2 * std::atan(0.25) / degrees;
  look.cameraOrthographic = true;
  look.resolution = {pixels, pixels};
  return look;
}

Light directional(const glm::dvec3& toLight, const glm::dvec3& intensity) {
  Light light;
  light.direction = toLight;
  light.intensity = intensity;
  return light;
}

glm::dmat4 translation(const glm::dvec3& t) {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(t, 1);
  return m;
}

glm::dmat4 scaling(const glm::dvec3& s) {
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) m[i][i] = s[i];
  return m;
}

glm::dmat4 rotation(double angle) {
  const glm::dvec3 a = safeNormalize({0.3, 0.8, -0.5});
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0);
    e[i] = 1;
    m[i] = glm::dvec4(e * c + glm::cross(a, e) * s + a * (a[i] * (1 - c)), 0);
  }
  return m;
}

double Random::unit() {
  // Knuth's linear congruential generator; its upper 53 bits.
  state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
  return double(state_ >> 11) * (1.0 / 9007199254740992.0);
}

std::vector<glm::dvec3> randomDirections(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<glm::dvec3> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = random.between(-1, 1), phi = random.between(0, 2 * pi);
    const double r = std::sqrt(1 - z * z);
    all.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return all;
}

Document::Document() {
  std::error_code error;
  const auto base = std::filesystem::temp_directory_path(error);
  std::string name = (base / "glint-stability-XXXXXX").string();
  if (error || !mkdtemp(name.data()))
    throw InputError(
        "no temporary folder can be made: set TMPDIR to a folder that is there and can be "
        "written");
  folder_ = name;
}

Document::~Document() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

int Document::view(const void* data, std::size_t bytes) {
  const std::size_t offset = binary_.size();
  const auto* begin = static_cast<const unsigned char*>(data);
  binary_.insert(binary_.end(), begin, begin + bytes);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  return int(json["bufferViews"].size()) - 1;
}

int Document::accessor(const std::string& type, const std::vector<float>& values) {
  const std::size_t components = type == "SCALAR" ? 1 : std::size_t(type[3] - '0');
  json["accessors"].push_back({{"bufferView", view(values.data(), values.size() * 4)},
                               {"componentType", 5126},
                               {"type", type},
                               {"count", values.size() / components}});
  return int(json["accessors"].size()) - 1;
}

int Document::indices(const std::vector<std::uint32_t>& values) {
  json["accessors"].push_back({{"bufferView", view(values.data(), values.size() * 4)},
                               {"componentType", 5125},
                               {"type", "SCALAR"},
                               {"count", values.size()}});
  return int(json["accessors"].size()) - 1;
}

int Document::shorts(const std::string& type, const std::vector<std::uint16_t>& values) {
  const std::size_t components = std::size_t(type[3] - '0');
  json["accessors"].push_back({{"bufferView", view(values.data(), values.size() * 2)},
                               {"componentType", 5123},
                               {"type", type},
                               {"count", values.size() / components}});
  return int(json["accessors"].size()) - 1;
}

void Document::show(nlohmann::json primitive) {
  json["meshes"].push_back({{"primitives", {std::move(primitive)}}});
  json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
  json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
}

void Document::triangle(const std::vector<float>& normals) {
  nlohmann::json attributes = {{"POSITION", accessor("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})}};
  if (!normals.empty()) attributes["NORMAL"] = accessor("VEC3", normals);
  show({{"attributes", attributes}});
}

Scene Document::load() {
  nlohmann::json whole = json;
  if (!binary_.empty()) whole["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string text = whole.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<unsigned char> body = binary_;
  body.resize((body.size() + 3) / 4 * 4, 0);
  const auto number = [](std::size_t value) {
    const auto word = std::uint32_t(value);
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &word, 4);
    return bytes;
  };
  const std::size_t size = 12 + 8 + text.size() + (body.empty() ? 0 : 8 + body.size());
  std::string file = "glTF" + number(2) + number(size) + number(text.size()) + "JSON" + text;
  if (!body.empty()) {
    file += number(body.size()) + std::string("BIN\0", 4);
    file.append(body.begin(), body.end());
  }
  const std::string path = (folder_ / "case.glb").string();
  OutputFile output(path);
  output.write(std::as_bytes(std::span(file)));
  output.commit();
  return loadGltf(path);
}

}  // namespace glint::stability
