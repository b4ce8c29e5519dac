#include "glint/render/draw_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "glint/scene/lights.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/angles.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"
#include "glint/shading/normalization.h"

namespace glint {
namespace {

glm::dvec3 unit(const glm::dvec3& v) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0)) return glm::dvec3(0.0);
  const glm::dvec3 w = v / size;
  return w / std::sqrt(glm::dot(w, w));
}

// Eye-space positions beyond what float can square would only become infinities; at such distances
// only the direction counts.
glm::vec3 eyePosition(const glm::dvec3& world, const Camera& camera, const glm::dmat3& rotation) {
  const glm::dvec3 p = rotation * (world - camera.eye);
  const double limit = 1e15;
  const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return glm::vec3(size > limit ? p * (limit / size) : p);
}

int order(Light::Type type) {
  return type == Light::Type::point ? 1 : type == Light::Type::spot ? 2 : 0;
}

void addLights(DrawList& list, const Look& look) {
  const Camera& camera = list.camera;
  const std::vector<Light> lights = lightsOf(look);
  for (const std::size_t number : shiningLights(lights)) list.lightNumbers.push_back(int(number));
  std::ranges::stable_sort(list.lightNumbers, {},
                           [&](int number) { return order(lights[std::size_t(number)].type); });
  const glm::dmat3 rotation = eyeRotation(camera), directions = glm::transpose(camera.axes);
  const bool blinn = usesBlinn(look.shading);
  for (const int number : list.lightNumbers) {
    const Light& light = lights[std::size_t(number)];
    LightEntry e;
    e.intensity = light.intensity;
    if (order(light.type) == 0) {
      const glm::dvec3 l = light.type == Light::Type::camera ? unit(light.direction)
                                                             : directions * unit(light.direction);
      e.position = l;
      // L + V for the constant direction to the viewer, +Z; H = (L + V) / |L + V|, 0 where L = -V.
      const glm::dvec3 between = l + glm::dvec3(0, 0, 1);
      const bool opposed = !(glm::dot(between, between) > 1e-12);
      const glm::dvec3 half = opposed ? glm::dvec3(0.0) : unit(between);
      e.halfway = blinn ? half : between;
    } else {
      e.position = eyePosition(light.position, camera, rotation);
    }
    if (light.fallsOff) {  // distances are multiples of camera.unit
      const double square = camera.unit * camera.unit;
      e.intensity = glm::min(light.intensity / square, 1e30);
      e.fallsOff = 1;
      e.inverseRange = light.range > 0 ? float(std::min(camera.unit / light.range, 1e15)) : 0;
    }
    if (light.type == Light::Type::spot) {
      const double outer = std::cos(light.outerAngle * radians);
      e.axis = directions * unit(light.direction);
      e.cosOuter = float(outer);
      e.coneScale = float(1 / (std::cos(light.innerAngle * radians) - outer));
    }
    list.lights.push_back(e);
  }
}

glm::vec4 boundary(const FresnelConstants& c) {
  const double critical = c.e < 0 ? std::sqrt(-c.e) : 0.0;
  return {float(c.e), float(c.nSquared), float(critical), float(critical - float(critical))};
}

// What a form of the lobe reads in place of the exponent (glsl/lobe.glsl).
glm::vec2 lobeConstants(const HighlightForm& form, double exponent) {
  const auto shape = row(form.form).shape;
  return shape ? glm::vec2(shape(exponent, form.gamma)) : glm::vec2(0);
}

MaterialBlock materialBlock(const Material& material, const Variant& variant, const Look& look) {
  const ShadingParameters& s = material.shading;
  MaterialBlock block;
  block.color = s.color;
  block.alpha = float(material.alpha);
  block.emission = material.emission;
  block.alphaCutoff = float(material.alphaCutoff);
  const double exponent = lobeExponent(material, look);
  block.ambient = float(s.ambient);
  block.diffuse = float(s.diffuse);
  const Normalization normalization = variant.normalized ? Normalization::none : look.normalization;
  block.specular =
      float(s.specular * lobeNormalization(normalization, usesBlinn(look.shading), exponent));
  block.exponent = float(exponent);
  block.lobe = lobeConstants(variant.highlight, exponent);
  glm::vec2* const dimmer[] = {&block.secondLobe, &block.thirdLobe, &block.fourthLobe};
  static_assert(std::size(dimmer) == HighlightForms::mostDimmer);
  for (std::size_t i = 0; i < variant.dimmer.size(); ++i)
    *dimmer[i] = lobeConstants(variant.dimmer[i].form, exponent);
  const FresnelSides sides = fresnelSides(s.ior, look.mediumIor);
  const double k =
      variant.fresnel == Fresnel::rational ? rationalMinimax(look.mediumIor, s.ior) : 0.0;
  block.metalness = float(s.metalness);
  block.transmission = float(s.transmission);
  block.normalReflectance = float(sides.entering.r0);
  block.rationalSlope = float(k);
  const ParameterTextures& t = material.parameterTextures;
  block.metallic = float(t.metallic);
  block.roughness = float(t.roughness);
  block.reflectance = float(t.reflectance);
  block.occlusionStrength = float(t.occlusionStrength);
  block.blinnFactor = float(usesBlinn(look.shading) ? look.blinnFactor : 1.0);
  block.entering = boundary(sides.entering);
  block.leaving = boundary(sides.leaving);
  return block;
}

std::vector<glm::vec4> lobeTablesOf(const Variant& v, double exponent) {
  std::vector<glm::vec4> tables;
  const auto add = [&](const HighlightForm& form) {
    for (int row = 0; row < lobeTableRows(form); ++row) {
      glm::vec4& entries = tables.emplace_back(1);
      for (int k = 0; k < 4; ++k)
        entries[k] = lobeTableEntry(std::min(4 * row + k, form.gamma), exponent, form.gamma);
    }
  };
  if (!v.specular) return tables;
  add(v.highlight);
  for (const Variant::Dimmer& each : v.dimmer) add(each.form);
  return tables;
}

// Model to eye space in double up to the last step. The normal matrix is the rotation itself where
// the scale is uniform, else the cofactors; both are scaled to entries of about 1.
DrawBlock drawBlock(const Mesh& mesh, const glm::dmat4& world, const Camera& camera) {
  const glm::dmat3 rotation = eyeRotation(camera), linear(world);
  const glm::dmat3 toEye = rotation * linear;
  const glm::dvec3 offset = rotation * (linear * mesh.origin + (glm::dvec3(world[3]) - camera.eye));
  DrawBlock block;
  block.eyeFromModel = glm::mat4(glm::mat3(toEye));
  block.eyeFromModel[3] = glm::vec4(glm::vec3(offset), 1);

  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(toEye[i][j]));
  if (!(size > 0)) return block;
  const glm::dmat3 m = toEye * (1 / size);
  glm::dmat3 normals;
  if (isSimilarity(m)) {
    normals = m * (1 / glm::length(m[0]));
  } else {
    normals = glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    if (glm::dot(m[0], normals[0]) < 0) normals = -normals;
    double largest = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(normals[i][j]));
    if (largest > 0) normals *= 1 / largest;
  }
  block.normalMatrix = glm::mat3x4(glm::mat3(normals));
  return block;
}

// Whether the determinant is negative; its columns are scaled so that it neither under- nor
// overflows.
bool isMirrored(const glm::dmat4& world) {
  return glm::dot(unit(world[0]), glm::cross(unit(world[1]), unit(world[2]))) < 0;
}

void setDepth(DrawItem& item, const Mesh& mesh) {
  item.low = glm::vec3(std::numeric_limits<float>::infinity());
  item.high = -item.low;
  for (std::uint32_t i : mesh.indices) {
    item.low = glm::min(item.low, mesh.positions[i]);
    item.high = glm::max(item.high, mesh.positions[i]);
  }
  const glm::dvec3 center = (glm::dvec3(item.low) + glm::dvec3(item.high)) * 0.5;
  item.depth = -(glm::dmat4(item.draw.eyeFromModel) * glm::dvec4(center, 1)).z;
}

bool finite(const glm::mat4& m) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) return false;
  return true;
}

}  // namespace

DrawList makeDrawList(const Scene& scene, const Bounds& bounds, const Look& given) {
  const Look look = withFileLights(scene, given);
  checkMaterialNames(scene, look);
  DrawList list;
  list.camera = cameraFor(scene, bounds, look);
  list.environment = environmentImageFor(look);
  addLights(list, look);
  const double turn = -look.environmentRotation * radians, c = std::cos(turn), s = std::sin(turn);
  const glm::dmat3 rotation(c, 0, -s, 0, 1, 0, s, 0, c);
  list.frame.worldFromEye = glm::mat4(glm::mat3(rotation * list.camera.axes));
  list.frame.schlickExponent = float(look.schlickExponent);
  list.frame.ambientLight = glm::vec4(glm::vec3(look.ambientLight), 0);

  std::vector<Material> materials;
  for (const Material& material : scene.materials)
    materials.push_back(editedMaterial(material, look));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material& material = materials[std::size_t(mesh.material)];
    DrawItem item;
    item.mesh = instance.mesh;
    item.material = mesh.material;
    item.instance = int(i);
    item.draw = drawBlock(mesh, instance.world, list.camera);
    if (!finite(item.draw.eyeFromModel)) continue;  // beyond the range of float
    item.variant = variantFor(mesh, material, instance.world, look, list.camera.orthographic);
    item.materialBlock = materialBlock(material, item.variant, look);
    item.lobeTables = lobeTablesOf(item.variant, lobeExponent(material, look));
    item.mirrored = isMirrored(instance.world);
    item.draw.normalScale = float(material.normalScale);
    item.draw.handedness = item.mirrored ? -1 : 1;
    const bool both = material.doubleSided || look.twoSided || mesh.topology != Topology::triangles;
    item.faces = both ? FaceSide::both : FaceSide::front;
    item.blended = item.variant.alphaBlend;
    if (item.blended) setDepth(item, mesh);
    list.items.push_back(item);
  }
  std::stable_sort(list.items.begin(), list.items.end(), [](const DrawItem& a, const DrawItem& b) {
    if (a.blended != b.blended) return b.blended;
    return a.blended && a.depth > b.depth;
  });
  return list;
}

std::vector<DrawCall> drawCalls(const std::vector<DrawItem>& items) {
  // Fewer are drawn one by one, with the program that everything else uses: a program for instances
  // costs more to compile than it saves.
  constexpr std::size_t fewest = 8;
  const auto alike = [](const DrawItem& a, const DrawItem& b) {
    return !a.blended && !b.blended && a.mesh == b.mesh && a.material == b.material &&
           a.mirrored == b.mirrored && a.faces == b.faces && a.variant == b.variant &&
           std::memcmp(&a.materialBlock, &b.materialBlock, sizeof a.materialBlock) == 0 &&
           a.draw.normalScale == b.draw.normalScale;
  };
  std::vector<DrawCall> calls;
  for (std::size_t i = 0; i < items.size();) {
    std::size_t end = i + 1;
    while (end < items.size() && end - i < mostInstances && alike(items[i], items[end])) ++end;
    if (end - i < fewest) end = i + 1;
    calls.push_back({i, end - i});
    i = end;
  }
  return calls;
}

std::vector<int> imagesRead(const Scene& scene, const Look& given) {
  const Look look = withFileLights(scene, given);
  std::set<int> images;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material material = editedMaterial(scene.materials[std::size_t(mesh.material)], look);
    // Whether a texture is read does not depend on the camera.
    const Variant v = variantFor(mesh, material, instance.world, look, false);
    if (v.colorTexture) images.insert(material.colorTexture->image);
    if (v.emissionTexture) images.insert(material.emissionTexture->image);
    if (v.normalTexture) images.insert(material.normalTexture->image);
    const ParameterTextures& t = material.parameterTextures;
    if (v.metallicRoughnessTexture) images.insert(t.metallicRoughness->image);
    if (v.occlusionTexture) images.insert(t.occlusion->image);
    if (v.specularTexture) images.insert(t.specular->image);
    if (v.transmissionTexture) images.insert(t.transmission->image);
  }
  return {images.begin(), images.end()};
}

}  // namespace glint
