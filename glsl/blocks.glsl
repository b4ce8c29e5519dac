// The uniform blocks; src/glint/render/blocks.h has the same layout in C++ (std140).
// Eye space: the eye at the origin, looking along -Z, lengths in the camera's unit.

layout(std140) uniform FrameBlock {
  mat4 projection;       // eye to clip space of this tile
  mat4 worldFromEye;     // rotation to the environment's space (its own rotation included)
  vec3 toViewer;         // if it is the same everywhere
  float schlickExponent;
  vec3 ambientLight;     // A
  float sampleCount;     // per pixel
  vec2 rayScale, rayOffset;  // from the tile's x, y in [-1, 1] to the ray's x, y at depth 1
  vec4 samples[32];      // xy: sample positions in a pixel, from its centre
} frame;

struct Light {
  vec3 position;         // direction to the light (directional) or its position; eye space
  float inverseRange;    // 1 / range, 0 without a range
  vec3 intensity;        // I_m
  float fallsOff;        // 1 if it falls off with distance, else 0
  vec3 axis;             // spot: unit direction of its axis
  float cosOuter;        // spot: cosine of the outer angle
  vec3 halfway;          // directional and constant view: L + V (Phong) or H (Blinn-Phong)
  float coneScale;       // spot: 1 / (cos inner - cos outer)
};

#if LIGHTS > 0
layout(std140) uniform LightBlock {
  Light lights[LIGHTS];  // directional, then points, then spots; within each type the brightest first
};
#endif

#if INSTANCES > 1
struct Draw {
  mat4 eyeFromModel;
  mat3 normalMatrix;     // as below
  float normalScale, handedness;  // the same for all instances
};
layout(std140) uniform DrawBlock {
  Draw draws[INSTANCES];  // the instances of one draw call
};
#if VERTEX_STAGE
#define draw draws[gl_InstanceID]
#else
#define draw draws[0]
#endif
#else
layout(std140) uniform DrawBlock {
  mat4 eyeFromModel;
  mat3 normalMatrix;     // cofactors of eyeFromModel, scaled
  float normalScale;     // factor for the normal map's x and y
  float handedness;      // -1 if eyeFromModel mirrors, else 1
} draw;
#endif

layout(std140) uniform MaterialBlock {
  vec3 color;            // C
  float alpha;
  vec3 emission;
  float alphaCutoff;
  float ambient, diffuse, specular, exponent;  // m_a, m_d, m_s; exponent of the lobe
  float metalness, transmission;               // m_sm, t
  float normalReflectance;                     // R0, at normal incidence
  float rationalSlope;                         // k of the rational reflectance
  vec4 entering, leaving;                      // Boundary for front and for back faces
  vec2 lobe, secondLobe, thirdLobe, fourthLobe;  // constants of the lobe forms in use
  // Factors of the parameter textures; blinnFactor: the lobe's exponent divided by Phong's.
  float metallic, roughness, reflectance, occlusionStrength;
  float blinnFactor;
} material;
