// What the per-pixel programs get from the vertices: position (where something reads it) and normal.
VARYING VERTEX_OUT vec3 vNormal;
#if PIXEL_POSITION
VARYING VERTEX_OUT vec3 vPosition;
#endif
#if NORMAL_TEXTURE
VARYING VERTEX_OUT vec4 vTangent;
VARYING VERTEX_OUT vec2 vNormalTexcoord;
uniform sampler2D normalTexture;
#endif

#if VERTEX_STAGE
#if NORMAL_TEXTURE
void passTangent(vec4 tangent, vec2 texcoord) {
  // A mirroring transform, whose sign stands in the corner, turns the handedness.
  vTangent = vec4(safeUnit(mat3(draw.eyeFromModel) * tangent.xyz), tangent.w * draw.normalMatrix[3][3]);
  vNormalTexcoord = texcoord;
}
#endif

void passVertex(vec3 eye, vec3 n) {
  vNormal = n;
#if PIXEL_POSITION
  vPosition = eye;
#endif
}
#else
struct Pixel {
  vec3 position;  // eye space; zero where nothing reads it
  vec3 normal;    // unit
  vec3 view;      // unit, to the viewer
};

// The normal of the front side before it is renormalised: the interpolated one, or that of the
// normal map in the frame of the interpolated tangent and normal, as MikkTSpace wants it.
vec3 surfaceNormal() {
  vec3 n = vNormal;
#if VANISHING_NORMAL
  // Vertex normals of this mesh are so far apart that they may cancel: then the face's stands in.
  vec3 face = safeUnit(cross(dFdx(vPosition), dFdy(vPosition)));
  if (!gl_FrontFacing) face = -face;
  if (!(dot(n, n) > 1e-6)) n = face;
#endif
#if NORMAL_TEXTURE
  vec3 m = 2.0 * texture(normalTexture, vNormalTexcoord).xyz - 1.0;
  m.xy *= draw.normalMatrix[3][0];
  vec3 mapped = m.x * vTangent.xyz + m.y * vTangent.w * cross(n, vTangent.xyz) + m.z * n;
  if (dot(mapped, mapped) > 1e-12) n = mapped;
#endif
  return n;
}

// The interpolated normal, renormalised: interpolation shortens it, and a highlight's peak with it.
// Back faces that are drawn turn it to the viewer.
Pixel shadedPixel() {
#if PIXEL_POSITION
  vec3 position = vPosition;
#else
  vec3 position = vec3(0.0);
#endif
  vec3 n = unit(surfaceNormal());
#if TWO_SIDED
  if (!gl_FrontFacing) n = -n;
#endif
  return Pixel(position, n, toViewer(position));
}
#endif
