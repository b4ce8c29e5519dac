#pragma once

// The uniform blocks of glsl/blocks.glsl, std140: vec4 and mat4 alone, so that both layouts are
// the same by construction.

#include <glm/glm.hpp>

namespace glint {

struct FrameBlock {
  glm::mat4 projection{1};
  glm::mat4 worldFromEye{1};
  glm::vec4 view{0, 0, 1, 5};
  glm::vec4 ambientLight{0};
  glm::vec4 rays{0};
  glm::vec4 samples[32] = {};
};
static_assert(sizeof(FrameBlock) == 688);

/// Of each code of sRGB the linear value, in x: a row of an array takes 16 bytes.
struct CurveBlock {
  glm::vec4 linearOfCode[256];
};
static_assert(sizeof(CurveBlock) == 4096);

struct LightEntry {
  glm::vec4 position{0};
  glm::vec4 intensity{0};
  glm::vec4 axis{0};
  glm::vec4 constant{0};
};
static_assert(sizeof(LightEntry) == 64);

struct DrawBlock {
  glm::mat4 eyeFromModel{1};
  glm::mat4 normalMatrix{1};
};
static_assert(sizeof(DrawBlock) == 128);

struct MaterialBlock {
  glm::vec4 color{1};
  glm::vec4 emission{0};
  glm::vec4 strength{0};
  glm::vec4 surface{0};
  glm::vec4 entering{0};
  glm::vec4 leaving{0};
  glm::vec4 lobe{0};
  glm::vec4 dimmerLobe{0};
  glm::vec4 textured{0};
  glm::vec4 detail{0};
};
static_assert(sizeof(MaterialBlock) == 160);

}  // namespace glint
