// The inputs of the per-pixel programs from the vertices: position (if something reads it) and normal.
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
  // A mirroring transform reverses the handedness.
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
  vec3 position;  // eye space; zero if nothing reads it
  vec3 normal;    // unit
  vec3 view;      // unit, to the viewer
};

// The interpolated vertex values at a point of the surface.
struct Inputs {
  vec3 position, normal;
#if NORMAL_TEXTURE
  vec4 tangent, texel;  // texel: of the normal map
#endif
};

// The inputs at the position at which the fragment is shaded.
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
// The inputs at the centre of the pixel, wherever the fragment is shaded, for differences between pixels.
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
// normal map in the frame of the interpolated tangent and normal, as MikkTSpace requires.
vec3 surfaceNormal(Inputs at) {
  vec3 n = at.normal;
#if VANISHING_NORMAL
  // Vertex normals of this mesh differ so much that they may cancel; then the face's normal is used.
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

// The interpolated normal is renormalised, because interpolation shortens it and lowers the peak of
// the highlight. On back faces it is turned to the viewer.
Pixel shadedPixel(Inputs at) {
  vec3 n = unit(surfaceNormal(at));
#if TWO_SIDED
  if (!gl_FrontFacing) n = -n;
#endif
  return Pixel(at.position, n, toViewer(at.position));
}

Pixel shadedPixel() { return shadedPixel(inputsAtPlace()); }

// The material's parameters with which the pixel's lights are summed up.
#if SPECULAR_ANTIALIASING
Parameters pixelParameters();  // specular_filter.glsl
#else
Parameters pixelParameters() { return parametersHere(); }
#endif
#endif
