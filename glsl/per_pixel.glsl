// What the per-pixel programs get from the vertices: position (where something reads it) and normal.
VARYING VERTEX_OUT vec3 vNormal;
#if PIXEL_POSITION
VARYING VERTEX_OUT vec3 vPosition;
#endif

#if VERTEX_STAGE
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

// The interpolated normal, renormalised: interpolation shortens it, and a highlight's peak with it.
// Back faces that are drawn turn it to the viewer.
Pixel shadedPixel() {
#if PIXEL_POSITION
  vec3 position = vPosition;
#else
  vec3 position = vec3(0.0);
#endif
#if VANISHING_NORMAL
  // Vertex normals of this mesh are so far apart that they may cancel: then the face's stands in.
  vec3 face = safeUnit(cross(dFdx(vPosition), dFdy(vPosition)));
  if (!gl_FrontFacing) face = -face;
  vec3 n = dot(vNormal, vNormal) > 1e-6 ? unit(vNormal) : face;
#else
  vec3 n = unit(vNormal);
#endif
#if TWO_SIDED
  if (!gl_FrontFacing) n = -n;
#endif
  return Pixel(position, n, toViewer(position));
}
#endif
