#include "glint/reference/scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "glint/reference/samples.h"
#include "glint/scene/lights.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/angles.h"
#include "glint/shading/safe.h"

namespace glint::reference {
namespace {

std::vector<Light> lightsFor(const Look& look, const Camera& camera) {
  const glm::dmat3 turn = glm::transpose(camera.axes);
  std::vector<Light> lights;
  // Lengths are in units of camera.unit; intensities that fall off with the square are scaled to
  // match.
  const std::vector<glint::Light> given = lightsOf(look);
  const std::vector<std::size_t> shining = shiningLights(given);
  for (std::size_t rank = 0; rank < shining.size(); ++rank) {
    const glint::Light& from = given[shining[rank]];
    Light light;
    light.number = int(shining[rank]);
    light.rank = int(rank);
    light.intensity = from.intensity;
    if (from.fallsOff) {
      light.fallsOff = true;
      light.range = from.range / camera.unit;
      light.intensity /= camera.unit * camera.unit;
    }
    switch (from.type) {
      case glint::Light::Type::camera:
        light.place = safeNormalize(from.direction);
        break;
      case glint::Light::Type::directional:
        light.place = turn * safeNormalize(from.direction);
        break;
      case glint::Light::Type::spot:
        light.axis = turn * safeNormalize(from.direction);
        light.cosInner = std::cos(from.innerAngle * radians);
        light.cosOuter = std::cos(from.outerAngle * radians);
        [[fallthrough]];
      case glint::Light::Type::point:
        light.type = from.type == glint::Light::Type::spot ? Light::Type::spot : Light::Type::point;
        light.place = turn * (from.position - camera.eye) / camera.unit;
        break;
    }
    lights.push_back(light);
  }
  std::ranges::sort(lights, {}, &Light::number);
  return lights;
}

Frame frameFor(const Look& look, const Camera& camera) {
  Frame frame;
  frame.lights = lightsFor(look, camera);
  frame.ambientLight = look.ambientLight;
  frame.constantView = camera.orthographic || look.viewer == Viewer::infinite;
  frame.environment = look.environment == Environment::studio ? BuiltinEnvironment::studio
                      : look.environment == Environment::sky  ? BuiltinEnvironment::sky
                                                              : BuiltinEnvironment::white;
  // The environment turns by +angle about +Y, so a direction is looked up turned by -angle.
  const double angle = look.environmentRotation * radians, c = std::cos(angle), s = std::sin(angle);
  const glm::dmat3 back(glm::dvec3(c, 0, s), glm::dvec3(0, 1, 0), glm::dvec3(-s, 0, c));
  frame.environmentFromEye = back * camera.axes;
  return frame;
}

// Normals transform by (M^-1)^T. The cofactors are that times the determinant, whose sign is
// removed again, and are finite even where M has no inverse.
glm::dmat3 normalMatrix(const glm::dmat3& m) {
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(m[i][j]));
  if (!(size > 0)) return glm::dmat3(1.0);
  const glm::dmat3 n = m * (1 / size);
  const glm::dmat3 cofactors(glm::cross(n[1], n[2]), glm::cross(n[2], n[0]),
                             glm::cross(n[0], n[1]));
  return glm::dot(n[0], cofactors[0]) < 0 ? -1.0 * cofactors : cofactors;
}

Vertices verticesOf(const Mesh& mesh, const glm::dmat4& world, const Camera& camera,
                    const glm::dmat4& toClip, const glm::ivec2& grid) {
  Vertices v;
  const glm::dmat3 linear(world), rotation = eyeRotation(camera);
  v.eyeFromModel = rotation * linear;
  const glm::dvec3 offset = rotation * (linear * mesh.origin + (glm::dvec3(world[3]) - camera.eye));
  const std::size_t count = mesh.positions.size();
  v.window.resize(count);
  v.depth.resize(count);
  v.eye.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    v.eye[i] = v.eyeFromModel * glm::dvec3(mesh.positions[i]) + offset;
    const glm::dvec4 clip = toClip * glm::dvec4(v.eye[i], 1.0);
    v.window[i] = {(clip.x + clip.w) * (0.5 * grid.x), (clip.y + clip.w) * (0.5 * grid.y), clip.w};
    v.depth[i] = clip.z;
  }
  const glm::dmat3 normals = normalMatrix(v.eyeFromModel);
  v.normals.reserve(mesh.normals.size());
  for (const glm::vec3& n : mesh.normals)
    v.normals.push_back(safeNormalize(normals * glm::dvec3(n)));
  // Seen in a mirror, a right-handed frame is left-handed.
  const double hand =
      glm::determinant(v.eyeFromModel / glm::length(v.eyeFromModel[0])) < 0 ? -1 : 1;
  v.tangents.reserve(mesh.tangents.size());
  for (const glm::vec4& t : mesh.tangents)
    v.tangents.emplace_back(safeNormalize(v.eyeFromModel * glm::dvec3(t)), hand * t.w);
  return v;
}

Surface surfaceFor(const Material& material, const Variant& variant, const Look& look) {
  Surface s;
  s.program = programOf(look);
  s.unlit = variant.unlit;
  s.twoSided = material.doubleSided || look.twoSided;
  const HighlightForms highlight = material.highlight.value_or(look.highlight);
  const auto lobe = [](const HighlightForm& form, int from) {
    return Surface::Lobe{form.form, std::max(form.gamma, 1), from};
  };
  s.lobes = {lobe(highlight.brightest, 0)};
  for (const HighlightForms::Dimmer& each : highlight.dimmer)
    s.lobes.push_back(lobe(each.form, each.from));
  s.fresnel = material.fresnel.value_or(look.fresnel);
  const ShadingParameters& m = material.shading;
  s.numbers = {m.ambient, m.diffuse, m.specular, m.exponent, m.metalness, m.transmission};
  s.blinnFactor = look.blinnFactor;
  s.normalization = look.normalization;
  if (variant.specularAntialiasing) s.filter = look.specularAntialiasing;
  s.schlickExponent = look.schlickExponent;
  s.ior = material.shading.ior;
  s.mediumIor = look.mediumIor;
  s.sides = fresnelSides(s.ior, s.mediumIor);
  if (s.fresnel == Fresnel::rational) s.rationalSlope = rationalMinimax(s.mediumIor, s.ior);
  return s;
}

std::vector<glm::dvec2> texcoordsOf(const Mesh& mesh, const Texture& texture) {
  std::vector<glm::dvec2> places;
  if (std::size_t(texture.texcoord) >= mesh.texcoords.size()) return places;
  const glm::dmat3x2& t = texture.transform;
  for (const glm::vec2& place : mesh.texcoords[std::size_t(texture.texcoord)])
    places.push_back(double(place.x) * t[0] + double(place.y) * t[1] + t[2]);
  return places;
}

TextureSampler samplerFor(const Texture& texture, const Scene& scene, const DecodedImages& images) {
  const DecodedImage& decoded = images.at(texture.image);
  return {decoded.image, decoded.mipLevels, texture.sampler,
          scene.images[std::size_t(texture.image)].isData};
}

Item itemFor(const DrawItem& from, const Scene& scene, const DecodedImages& images,
             const Look& look) {
  const Material material = editedMaterial(scene.materials[std::size_t(from.material)], look);
  Item item;
  item.mesh = &scene.meshes[std::size_t(from.mesh)];
  item.surface = surfaceFor(material, from.variant, look);
  item.color = glm::dvec4(material.shading.color, material.alpha);
  item.mask = material.alphaMode == AlphaMode::mask;
  item.alphaCutoff = material.alphaCutoff;
  item.blended = from.blended;
  item.mirrored = from.mirrored;
  item.faces = from.faces;
  // Only what the variant reads is decoded, and it reads no texture without coordinates.
  if (from.variant.colorTexture) {
    item.colorTexture = samplerFor(*material.colorTexture, scene, images);
    item.colorTexcoords = texcoordsOf(*item.mesh, *material.colorTexture);
  }
  if (from.variant.emission) item.emission = material.emission;
  if (from.variant.emissionTexture) {
    item.emissionTexture = samplerFor(*material.emissionTexture, scene, images);
    item.emissionTexcoords = texcoordsOf(*item.mesh, *material.emissionTexture);
  }
  if (item.surface.unlit) return item;
  if (from.variant.normalTexture) {
    item.normalTexture = samplerFor(*material.normalTexture, scene, images);
    item.normalTexcoords = texcoordsOf(*item.mesh, *material.normalTexture);
    item.normalScale = material.normalScale;
  }
  item.textured = from.variant.textured;
  item.parameters = material.parameterTextures;
  const auto take = [&](std::optional<Looked>& to, bool read,
                        const std::optional<Texture>& texture) {
    if (read) to = Looked{samplerFor(*texture, scene, images), texcoordsOf(*item.mesh, *texture)};
  };
  take(item.metallicRoughness, from.variant.metallicRoughnessTexture,
       item.parameters.metallicRoughness);
  take(item.occlusion, from.variant.occlusionTexture, item.parameters.occlusion);
  take(item.specular, from.variant.specularTexture, item.parameters.specular);
  take(item.transmission, from.variant.transmissionTexture, item.parameters.transmission);
  return item;
}

}  // namespace

Stage::Stage(const Scene& scene, const DecodedImages& images, const DrawList& list,
             const Look& look)
    : frame(frameFor(withFileLights(scene, look), list.camera)), camera(list.camera) {
  frame.image = list.environment.get();
  const bool ssaa = look.antiAliasing.mode == AntiAliasing::Mode::ssaa;
  const int scale = ssaa ? look.antiAliasing.count : 1;
  grid = look.resolution * scale;
  samples = samplePattern(look.antiAliasing);
  const glm::dmat4 toClip = projection(camera, glm::dvec2(0.0), glm::dvec2(1.0), true);
  std::map<int, std::size_t> placed;  // by instance: where its vertices are
  for (const DrawItem& from : list.items) {
    Item& item = items.emplace_back(itemFor(from, scene, images, look));
    item.thickness = scale;
    item.multisampled = !samples.empty();
    const auto [place, isNew] = placed.try_emplace(from.instance, vertices.size());
    item.vertices = place->second;
    if (!isNew) continue;
    const glm::dmat4& world = scene.instances[std::size_t(from.instance)].world;
    vertices.push_back(verticesOf(*item.mesh, world, camera, toClip, grid));
  }
}

glm::dvec3 Stage::ray(double x, double y) const {
  if (camera.orthographic) return {0, 0, -1};
  const double up = 2 * y / grid.y - 1 + camera.shift.y;
  const double right = 2 * x / grid.x - 1 + camera.shift.x;
  return {right * camera.halfHeight * camera.aspect, up * camera.halfHeight, -1};
}

}  // namespace glint::reference
