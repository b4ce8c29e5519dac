// The vertex stage of every program.
layout(location = 0) in vec3 position;
#if !UNLIT
layout(location = 1) in vec3 normal;  // of the vertex, or with flat shading of the face
#endif
#if VERTEX_COLORS
layout(location = 2) in vec4 vertexColor;
VARYING out vec4 vColor;
#endif
#if COLOR_TEXTURE
layout(location = 3) in vec2 colorTexcoord;
VARYING out vec2 vColorTexcoord;
#endif
#if EMISSION_TEXTURE
layout(location = 4) in vec2 emissionTexcoord;
VARYING out vec2 vEmissionTexcoord;
#endif
#if PARAMETER_PLACES > 0
// The coordinates for the parameter textures; for flat shading, those at the face's centroid.
layout(location = 8) in vec2 parameterTexcoords[PARAMETER_PLACES];
#if PER_PIXEL
VARYING out vec2 vParameterTexcoords[PARAMETER_PLACES];
#endif
#endif
#if NORMAL_TEXTURE
layout(location = 6) in vec4 tangent;
layout(location = 7) in vec2 normalTexcoord;
#endif

#if SHADES_AT_OFFSET
out float vDistance;  // w of clip space
#endif

#if !UNLIT
// Multiplying by the cofactor matrix keeps normals perpendicular under any transform. If the transform
// is a rotation with a uniform scale, they stay unit vectors and need no division.
vec3 eyeNormal() {
  vec3 n = draw.normalMatrix * normal;
#if UNEVEN_SCALE
  n = safeUnit(n);
#endif
  return n;
}
#endif

#if ALPHA_BLEND
invariant gl_Position;  // to give the same depth as in layer.glsl
#endif

void main() {
  vec4 eye = draw.eyeFromModel * vec4(position, 1.0);
  gl_Position = frame.projection * eye;
#if SHADES_AT_OFFSET
  vDistance = gl_Position.w;
#endif
#if VERTEX_COLORS
  vColor = vertexColor;
#if ALPHA_MASK
  // A mask may cut at just the alpha of opaque vertices: interpolated zeros are exact, ones not.
  vColor.a = 1.0 - vertexColor.a;
#endif
#endif
#if COLOR_TEXTURE
  vColorTexcoord = colorTexcoord;
#endif
#if EMISSION_TEXTURE
  vEmissionTexcoord = emissionTexcoord;
#endif
#if PARAMETER_PLACES > 0 && PER_PIXEL
  vParameterTexcoords = parameterTexcoords;
#endif
#if !UNLIT
  passVertex(eye.xyz, eyeNormal());
#if NORMAL_TEXTURE
  passTangent(tangent, normalTexcoord);
#endif
#endif
}
