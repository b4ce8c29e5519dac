// What the CPU tells the shaders; src/glint/render/blocks.h has the same layout in C++ (std140).
// Eye space: the eye at the origin, looking along -Z, in units of the camera's unit.

layout(std140) uniform FrameBlock {
  mat4 projection;       // eye to clip space of this tile
  mat4 worldFromEye;     // rotation to the environment's space (its own rotation included)
  vec3 toViewer;         // where that is one direction
  float schlickExponent;
  vec3 ambientLight;     // A
  float sampleCount;     // of a pixel
  vec2 rayScale, rayOffset;  // tile's x, y in [-1, 1] to the ray's x, y at distance 1
  vec4 samples[32];      // xy: where in a pixel they lie, from its middle
} frame;

struct Light {
  vec3 position;         // to the light (directional) or where it is, eye space
  float inverseRange;    // 1 / range, 0 without one
  vec3 intensity;        // I_m
  float fallsOff;        // 1 if it falls off with distance, else 0
  vec3 axis;             // spot: along its axis
  float cosOuter;        // spot: cosine of the outer angle
  vec3 halfway;          // directional and constant view: L + V (Phong) or H (Blinn-Phong)
  float coneScale;       // spot: 1 / (cos inner - cos outer)
};

#if LIGHTS > 0
layout(std140) uniform LightBlock {
  Light lights[LIGHTS];  // directional ones first, then points, then spots; of each the brightest first
};
#endif

#if INSTANCES > 1
struct Draw {
  mat4 eyeFromModel;
  mat3 normalMatrix;     // as below
  float normalScale, handedness;  // the same for all
};
layout(std140) uniform DrawBlock {
  Draw draws[INSTANCES];  // the places of one call
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
  float normalScale;     // of the normal map's x and y
  float handedness;      // -1 if eyeFromModel mirrors, else 1
} draw;
#endif

layout(std140) uniform MaterialBlock {
  vec3 color;            // C
  float alpha;
  vec3 emission;
  float alphaCutoff;
  float ambient, diffuse, specular, exponent;  // m_a, m_d, m_s; of the lobe
  float metalness, transmission;               // m_sm, t
  float normalReflectance;                     // R0, at normal incidence
  float rationalSlope;                         // k of the rational reflectance
  vec4 entering, leaving;                      // Boundary of front and of back faces
  vec2 lobe, secondLobe, thirdLobe, fourthLobe;  // constants of the forms of the lobe in use
  // What textures multiply; and the lobe's exponent over Phong's.
  float metallic, roughness, reflectance, occlusionStrength;
  float blinnFactor;
} material;
