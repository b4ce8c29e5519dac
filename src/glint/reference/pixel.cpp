#include "glint/reference/pixel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/reference/samples.h"
#include "glint/shading/pbr_conversion.h"
#include "glint/shading/safe.h"

namespace glint::reference {
namespace {

// The perspective-correct mean of a vertex attribute, by weights over w.
template <typename Get>
auto mean(const Footprint& f, const glm::dvec3& weights, Get get) {
  const double w = 1 / (weights[0] + weights[1] + weights[2]);
  auto sum = weights[0] * get(f.vertex[0]);
  if (weights[1] != 0) sum += weights[1] * get(f.vertex[1]);
  if (weights[2] != 0) sum += weights[2] * get(f.vertex[2]);
  return w * sum;
}

template <typename Get>
auto mean(const Footprint& f, Get get) {
  return mean(f, f.weights, get);
}

// Uses one level of detail for the 2x2 square of pixels, from the largest of its four steps.
glm::dvec4 sampleTexture(const TextureSampler& sampler, std::span<const glm::dvec2> texcoords,
                         const Footprint& f) {
  const auto get = [&](std::uint32_t i) { return texcoords[i]; };
  std::array<glm::dvec2, 4> uv;
  for (std::size_t i = 0; i < 4; ++i) uv[i] = mean(f, f.square[i], get);
  return sampler.sample(mean(f, get), {uv[1] - uv[0], uv[2] - uv[0], uv[3] - uv[1], uv[3] - uv[2]});
}

glm::dvec3 emissionOf(const Item& item, const Footprint& f) {
  if (!item.emissionTexture) return item.emission;
  return item.emission *
         glm::dvec3(sampleTexture(*item.emissionTexture, item.emissionTexcoords, f));
}

// The interpolated normal, bent by the normal map: its texel is the direction in the frame of
// tangent, bitangent and normal, none of which is renormalised. `width`: Attributes::normalWidth.
glm::dvec3 normalOf(const Item& item, const Vertices& v, const Footprint& f,
                    const glm::dvec3& faceNormal, double* width = nullptr) {
  glm::dvec3 N = mean(f, [&](std::uint32_t i) { return v.normals[i]; });
  if (!item.normalTexture) return N;
  if (!(glm::dot(N, N) > 1e-6)) N = faceNormal;
  const glm::dvec4 tangent = mean(f, [&](std::uint32_t i) { return v.tangents[i]; });
  const glm::dvec3 T(tangent), B = tangent.w * glm::cross(N, T);
  const glm::dvec4 sampled = sampleTexture(*item.normalTexture, item.normalTexcoords, f);
  if (width) *width = item.normalScale * (1 - sampled.a);
  const glm::dvec3 texel(sampled);
  const glm::dvec3 m = (texel * 2.0 - 1.0) * glm::dvec3(item.normalScale, item.normalScale, 1);
  const glm::dvec3 bent = m.x * T + m.y * B + m.z * N;
  return glm::dot(bent, bent) > 1e-12 ? bent : N;
}

double edgeDistanceOf(const Footprint& f) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    nearest = std::min(nearest, f.weights[i] / std::hypot(f.dx[i], f.dy[i]));
  return nearest;
}

bool carriesLight(const Surface& s) { return !s.unlit && !isPerPixel(s.program); }

// The material's numbers, converted from glTF's physically based ones (pbr_conversion.h) with the
// texels that `texel` returns.
template <typename Texel>
Numbers numbersOf(const Item& item, Texel texel) {
  Numbers numbers = item.surface.numbers;
  const auto gives = [&](unsigned bit) { return (item.textured & bit) != 0; };
  PbrParameters pbr;
  pbr.metallic = item.parameters.metallic;
  pbr.roughness = item.parameters.roughness;
  double reflectance = item.parameters.reflectance;
  if (item.metallicRoughness) {
    const glm::dvec4 t = texel(*item.metallicRoughness);
    pbr.roughness *= t.g;
    pbr.metallic *= t.b;
  }
  if (item.specular) reflectance *= texel(*item.specular).a;
  const ConvertedParameters converted = convertPbr(pbr);
  if (gives(textured::exponent)) numbers.exponent = converted.exponent;
  if (gives(textured::metalness)) numbers.metalness = converted.metalness;
  if (gives(textured::diffuse)) numbers.diffuse = converted.diffuse;
  if (gives(textured::specular)) {
    const double m = std::clamp(pbr.metallic, 0.0, 1.0);
    const bool share = item.surface.normalization != Normalization::none;
    numbers.specular =
        (1 - m) * (share ? reflectance : highlightPeak(reflectance, converted.exponent)) +
        m * (share ? 1 : highlightPeak(1, converted.exponent));
  }
  if (gives(textured::ambient))
    numbers.ambient *= 1 + item.parameters.occlusionStrength * (texel(*item.occlusion).r - 1);
  if (gives(textured::transmission)) numbers.transmission *= texel(*item.transmission).r;
  return numbers;
}

Numbers numbersAt(const Item& item, const Footprint& f) {
  if (item.textured == 0) return item.surface.numbers;
  return numbersOf(item, [&](const Looked& looked) {
    return sampleTexture(looked.sampler, looked.texcoords, f);
  });
}

// At the mean of some vertices, from the full-size level: neither a vertex nor a face has a
// footprint.
Numbers numbersAt(const Item& item, std::span<const std::uint32_t> vertices) {
  if (item.textured == 0) return item.surface.numbers;
  return numbersOf(item, [&](const Looked& looked) {
    glm::dvec2 place(0.0);
    for (const std::uint32_t v : vertices) place += looked.texcoords[v] / double(vertices.size());
    return looked.sampler.sampleLevel(place, -1);
  });
}

}  // namespace

glm::dvec4 baseColor(const Item& item, const Footprint& f) {
  glm::dvec4 base = item.color;
  if (!item.mesh->colors.empty()) {
    // Equal alphas of vertices must not round: a mask may cut at just this alpha.
    const glm::dvec4 start(0, 0, 0, item.mesh->colors[f.vertex[0]].a);
    base *=
        start + mean(f, [&](std::uint32_t i) { return glm::dvec4(item.mesh->colors[i]) - start; });
  }
  if (item.colorTexture) base *= sampleTexture(*item.colorTexture, item.colorTexcoords, f);
  return base;
}

void PixelShader::select(int item, std::uint32_t number) {
  if (item == item_ && number == number_) return;
  item_ = item;
  number_ = number;
  const Item& it = stage_.items[std::size_t(item)];
  const Vertices& v = stage_.vertices[it.vertices];
  primitive_ = makePrimitive(it, v, number).value_or(Primitive{});
  if (it.surface.unlit) return;
  if (primitive_.topology != Topology::triangles) {
    faceNormal_ = v.normals[primitive_.vertex[primitive_.topology == Topology::lines ? 1 : 0]];
    if (carriesLight(it.surface)) light();
    return;
  }
  // Edges come from model space, where differences of positions are exact.
  const auto& t = primitive_.vertex;
  const glm::dvec3 a(it.mesh->positions[t[0]]);
  const glm::dvec3 ab = v.eyeFromModel * (glm::dvec3(it.mesh->positions[t[1]]) - a);
  const glm::dvec3 ac = v.eyeFromModel * (glm::dvec3(it.mesh->positions[t[2]]) - a);
  faceNormal_ = safeNormalize(glm::cross(ab, ac));
  if (it.mirrored) faceNormal_ = -faceNormal_;
  if (faceNormal_ == glm::dvec3(0.0)) faceNormal_ = v.normals[t[2]];
  if (carriesLight(it.surface)) light();
}

// Computes the light, on the side that is seen, that flat shading carries from the face's centroid
// and Gouraud shading from the vertices.
void PixelShader::light() {
  const Item& item = stage_.items[std::size_t(item_)];
  const Vertices& v = stage_.vertices[item.vertices];
  const auto& t = primitive_.vertex;
  const double side = item.surface.twoSided && !primitive_.front ? -1 : 1;
  if (item.surface.program == Shading::flat) {
    glm::dvec3 centroid = (v.eye[t[0]] + v.eye[t[1]] + v.eye[t[2]]) / 3.0;
    std::span<const std::uint32_t> corners = t;
    if (primitive_.topology == Topology::lines)
      corners = corners.subspan(1, 1);  // GL's provoking vertex
    if (primitive_.topology == Topology::points) corners = corners.subspan(0, 1);
    if (corners.size() == 1) centroid = v.eye[corners[0]];
    numbers_[0] = numbersAt(item, corners);
    carried_[0] = lightAt(stage_.frame, item.surface, numbers_[0], centroid, side * faceNormal_);
    return;
  }
  const std::size_t corners = primitive_.topology == Topology::points  ? 1
                              : primitive_.topology == Topology::lines ? 2
                                                                       : 3;
  for (std::size_t i = 0; i < corners; ++i) {
    numbers_[i] = numbersAt(item, std::span(&t[i], 1));
    carried_[i] =
        lightAt(stage_.frame, item.surface, numbers_[i], v.eye[t[i]], side * v.normals[t[i]]);
  }
}

Attributes PixelShader::attributes(int itemNumber, std::uint32_t number, int column, int row) {
  select(itemNumber, number);
  const Item& item = stage_.items[std::size_t(itemNumber)];
  const Vertices& v = stage_.vertices[item.vertices];
  const double middleX = column + 0.5, middleY = stage_.grid.y - row - 0.5;
  const Footprint f = primitive_.fragment(
      column, row, stage_.grid.y, shadingPlace(primitive_, stage_.samples, middleX, middleY));
  Attributes a;
  a.item = itemNumber;
  a.primitive = number;
  a.front = primitive_.front;
  a.depth = f.depth;
  if (primitive_.topology == Topology::triangles) a.edgeDistance = edgeDistanceOf(f);
  const double w = 1 / (f.weights[0] + f.weights[1] + f.weights[2]);
  a.barycentrics = f.weights * w;
  a.base = baseColor(item, f);
  const auto positionAt = [&](const Footprint& at) {
    return mean(at, [&](std::uint32_t i) { return v.eye[i]; });
  };
  const auto normalAt = [&](const Footprint& at) { return normalOf(item, v, at, faceNormal_); };
  a.position = positionAt(f);
  a.emission = emissionOf(item, f);
  if (item.surface.unlit) return a;
  a.faceNormal = faceNormal_;
  const bool toksvig = item.surface.filter == SpecularAntialiasing::toksvig;
  a.normal = normalOf(item, v, f, faceNormal_, toksvig ? &a.normalWidth : nullptr);
  if ((stage_.frame.image && item.surface.program == Shading::environment) ||
      item.surface.filter == SpecularAntialiasing::kaplanyan) {
    for (std::size_t i = 0; i < 4; ++i) {
      Footprint at = f;
      at.weights = f.square[i];
      a.square[i] = {positionAt(at), normalAt(at)};
    }
  }
  if (item.surface.program == Shading::flat) {
    a.numbers = numbers_[0];
    a.matte = carried_[0].matte;
    a.specular = carried_[0].specular;
  } else if (item.surface.program == Shading::gouraud) {
    a.numbers.metalness = 0;
    for (int i = 0; i < 3; ++i) {
      if (a.barycentrics[i] == 0) continue;  // points and lines have fewer corners
      a.matte += a.barycentrics[i] * carried_[std::size_t(i)].matte;
      a.specular += a.barycentrics[i] * carried_[std::size_t(i)].specular;
      a.numbers.metalness += a.barycentrics[i] * numbers_[std::size_t(i)].metalness;
    }
  } else {
    a.numbers = numbersAt(item, f);
  }
  return a;
}

glm::dvec4 PixelShader::fragment(int itemNumber, std::uint32_t number, int column, int row) {
  const Attributes a = attributes(itemNumber, number, column, row);
  const Item& item = stage_.items[std::size_t(itemNumber)];
  const Terms terms = shade(stage_.frame, item.surface, a);
  return {terms.radiance, item.blended ? a.base.a : 1.0};
}

}  // namespace glint::reference
