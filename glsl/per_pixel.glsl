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
  // A mirroring transform turns the handedness.
  vTangent = vec4(safeUnit(mat3(draw.eyeFromModel) * tangent.xyz), tangent.w * draw.handedness);
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

// What arrives at a point of the surface from the vertices.
struct Inputs {
  vec3 position, normal;
#if NORMAL_TEXTURE
  vec4 tangent, texel;  // texel: of the normal map
#endif
};

// Where the fragment is shaded.
Inputs inputsAtPlace() {
  Inputs at;
  at.position = vec3(0.0);
#if PIXEL_POSITION
  at.position = AT_PLACE(vPosition);
#endif
  at.normal = AT_PLACE(vNormal);
#if NORMAL_TEXTURE
  at.tangent = AT_PLACE(vTangent);
  at.texel = TEXTURE_AT(normalTexture, NORMAL_RULE, vNormalTexcoord);
#endif
  return at;
}

#if SHADES_AT_OFFSET
// In the middle of the pixel, wherever the fragment is shaded: what changes from pixel to pixel.
Inputs inputsInMiddle() {
  Inputs at;
  at.position = vec3(0.0);
#if PIXEL_POSITION
  at.position = vPosition;
#endif
  at.normal = vNormal;
#if NORMAL_TEXTURE
  at.tangent = vTangent;
  at.texel = textureAt(normalTexture, NORMAL_RULE, vNormalTexcoord, dFdx(vNormalTexcoord),
                       dFdy(vNormalTexcoord));
#endif
  return at;
}
#endif

// The normal of the front side before it is renormalised: the interpolated one, or that of the
// normal map in the frame of the interpolated tangent and normal, as MikkTSpace wants it.
vec3 surfaceNormal(Inputs at) {
  vec3 n = at.normal;
#if VANISHING_NORMAL
  // Vertex normals of this mesh are so far apart that they may cancel: then the face's stands in.
  vec3 face = safeUnit(cross(dFdx(vPosition), dFdy(vPosition)));
  if (!gl_FrontFacing) face = -face;
  if (!(dot(n, n) > 1e-6)) n = face;
#endif
#if NORMAL_TEXTURE
  vec3 m = 2.0 * at.texel.xyz - 1.0;
  m.xy *= draw.normalScale;
  vec3 mapped = m.x * at.tangent.xyz + m.y * at.tangent.w * cross(n, at.tangent.xyz) + m.z * n;
  if (dot(mapped, mapped) > 1e-12) n = mapped;
#endif
  return n;
}

// The interpolated normal, renormalised: interpolation shortens it, and a highlight's peak with it.
// Back faces that are drawn turn it to the viewer.
Pixel shadedPixel(Inputs at) {
  vec3 n = unit(surfaceNormal(at));
#if TWO_SIDED
  if (!gl_FrontFacing) n = -n;
#endif
  return Pixel(at.position, n, toViewer(at.position));
}

Pixel shadedPixel() { return shadedPixel(inputsAtPlace()); }

// The material's numbers for the pixel's lights.
#if SPECULAR_ANTIALIASING
Parameters pixelParameters();  // specular_filter.glsl
#else
Parameters pixelParameters() { return parametersHere(); }
#endif
#endif
