// What the CPU tells the shaders; src/glint/render/blocks.h has the same layout in C++ (std140).
// Eye space: the eye at the origin, looking along -Z, in units of the camera's unit.

layout(std140) uniform FrameBlock {
  mat4 projection;       // eye to clip space of this tile
  mat4 worldFromEye;     // rotation to the environment's space (its own rotation included)
  vec4 view;             // xyz: to the viewer, where that is one direction; w: Schlick's exponent
  vec4 ambientLight;     // rgb: A; a: samples of a pixel
  vec4 rays;             // tile's x, y in [-1, 1] to the ray's x, y at distance 1: scale, offset
  vec4 samples[32];      // xy: where in a pixel they lie, from its middle
} frame;

struct Light {
  vec4 position;         // xyz: to the light (directional) or where it is, eye space; w: 1 / range or 0
  vec4 intensity;        // rgb: I_m; w: 1 if it falls off with distance, else 0
  vec4 axis;             // spot: xyz along its axis, w: cosine of the outer angle
  vec4 constant;         // directional and constant view: xyz: L + V, or H; w: spot's 1 / (cos inner - cos outer)
};

#if LIGHTS > 0
layout(std140) uniform LightBlock {
  Light lights[LIGHTS];  // directional ones first, then points, then spots; of each the brightest first
};
#endif

layout(std140) uniform DrawBlock {
  mat4 eyeFromModel;
  mat4 normalMatrix;     // cofactors of eyeFromModel, scaled; its columns' xyz; 4th: scale of the normal map, 0, 0, -1 if mirrored
} draw;

layout(std140) uniform MaterialBlock {
  vec4 color;            // rgb: C, a: alpha
  vec4 emission;         // rgb; a: alpha cutoff
  vec4 strength;         // m_a, m_d, m_s, exponent of the lobe
  vec4 surface;          // metalness, transmission, R0, k of the rational reflectance
  vec4 entering;         // Boundary of front faces
  vec4 leaving;          // Boundary of back faces
  vec4 lobe;             // xy: constants of the lobe's form; zw: of the second form in use
  vec4 dimmerLobe;       // of the third and the fourth
  vec4 textured;         // what textures multiply: metallic, roughness, reflectance, strength of occlusion
  vec4 detail;           // x: the lobe's exponent over Phong's
} material;
