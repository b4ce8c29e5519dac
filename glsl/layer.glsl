// Finds the depth of the next layer of blended surfaces, from the back: among all surfaces nearer than
// the previous layer (at first, the opaque surfaces), the depth test keeps the farthest, at every sample.
#if VERTEX_STAGE
layout(location = 0) in vec3 position;
invariant gl_Position;  // to give the same depth as in vertex.glsl
void main() {
  vec4 eye = draw.eyeFromModel * vec4(position, 1.0);
  gl_Position = frame.projection * eye;
}
#else
#if MULTISAMPLED
uniform sampler2DMS behind;
#else
uniform sampler2D behind;
#endif
void main() {
#if MULTISAMPLED
  float depth = texelFetch(behind, ivec2(gl_FragCoord.xy), gl_SampleID).r;
#else
  float depth = texelFetch(behind, ivec2(gl_FragCoord.xy), 0).r;
#endif
#if REVERSED_DEPTH
  if (!(gl_FragCoord.z > depth)) discard;
#else
  if (!(gl_FragCoord.z < depth)) discard;
#endif
}
#endif
