// Draws the environment behind the model: one triangle that covers the whole tile.
#if VERTEX_STAGE
out vec2 vPicture;  // x and y of the ray at depth 1, eye space
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vPicture = corner * frame.rayScale + frame.rayOffset;
  gl_Position = vec4(corner, 0.0, 1.0);
}
#else
in vec2 vPicture;
out vec4 fragment;
void main() {
  vec3 ray = vec3(vPicture, -1.0);
  fragment = vec4(environmentRadiance(mat3(frame.worldFromEye) * ray, spreadOf(ray)), 1.0);
}
#endif
