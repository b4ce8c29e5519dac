#pragma once

// The uniform blocks of glsl/blocks.glsl, where each member is described. std140 lays them out as
// C++ does: every vec3 is followed by a float, and vec2s come in pairs.

#include <glm/glm.hpp>

namespace glint {

struct FrameBlock {
  glm::mat4 projection{1};
  glm::mat4 worldFromEye{1};
  glm::vec3 toViewer{0, 0, 1};
  float schlickExponent = 5;
  glm::vec3 ambientLight{0};
  float sampleCount = 0;
  glm::vec2 rayScale{0}, rayOffset{0};
  glm::vec4 samples[32] = {};
};
static_assert(sizeof(FrameBlock) == 688);

/// The linear value of each sRGB code, in x: std140 pads array elements to 16 bytes.
struct CurveBlock {
  glm::vec4 linearOfCode[256];
};
static_assert(sizeof(CurveBlock) == 4096);

struct LightEntry {
  glm::vec3 position{0};
  float inverseRange = 0;
  glm::vec3 intensity{0};
  float fallsOff = 0;
  glm::vec3 axis{0};
  float cosOuter = 0;
  glm::vec3 halfway{0};
  float coneScale = 0;
};
static_assert(sizeof(LightEntry) == 64);

struct DrawBlock {
  glm::mat4 eyeFromModel{1};
  glm::mat3x4 normalMatrix{1};  // std140's mat3: columns of four floats, the last unused
  float normalScale = 1;
  float handedness = 1;
  float unused[2] = {};
};
static_assert(sizeof(DrawBlock) == 128);

struct MaterialBlock {
  glm::vec3 color{1};
  float alpha = 1;
  glm::vec3 emission{0};
  float alphaCutoff = 0;
  float ambient = 0, diffuse = 0, specular = 0, exponent = 0;
  float metalness = 0, transmission = 0, normalReflectance = 0, rationalSlope = 0;
  glm::vec4 entering{0}, leaving{0};
  glm::vec2 lobe{0}, secondLobe{0}, thirdLobe{0}, fourthLobe{0};
  float metallic = 0, roughness = 0, reflectance = 0, occlusionStrength = 0;
  float blinnFactor = 0;
  float unused[3] = {};
};
static_assert(sizeof(MaterialBlock) == 160);

}  // namespace glint
