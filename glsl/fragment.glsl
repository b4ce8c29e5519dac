// The fragment stage of every program: colours from material, vertices and textures, then the
// program's own shading.
#if VERTEX_COLORS
VARYING in vec4 vColor;
#endif
#if COLOR_TEXTURE
VARYING in vec2 vColorTexcoord;
uniform sampler2D colorTexture;
#endif
#if EMISSION_TEXTURE
VARYING in vec2 vEmissionTexcoord;
uniform sampler2D emissionTexture;
#endif
#if PARAMETER_PLACES > 0 && PER_PIXEL
VARYING in vec2 vParameterTexcoords[PARAMETER_PLACES];
#endif
out vec4 fragment;  // linear; straight alpha

void main() {
#if SHADES_AT_OFFSET
  findShadingPlace();
#endif
  vec4 base = vec4(material.color, material.alpha);
#if VERTEX_COLORS
  vec4 ofVertices = AT_PLACE(vColor);
#if ALPHA_MASK
  ofVertices.a = 1.0 - ofVertices.a;  // as vertex.glsl passes it
#endif
  base *= finiteOrZero(ofVertices);
#endif
#if COLOR_TEXTURE
  base *= TEXTURE_AT(colorTexture, COLOR_RULE, vColorTexcoord);
#endif
#if ALPHA_MASK
  if (base.a < material.alphaCutoff) discard;
#endif
  vec3 emission = vec3(0.0);
#if EMISSION
  emission = material.emission;
#if EMISSION_TEXTURE
  emission *= TEXTURE_AT(emissionTexture, EMISSION_RULE, vEmissionTexcoord).rgb;
#endif
#endif
#if OUTPUT == OUTPUT_COLOR
  fragment = base;
#elif OUTPUT == OUTPUT_EMISSION
  fragment = vec4(emission, 1.0);
#elif OUTPUT == OUTPUT_DEPTH
  fragment = vec4(gl_FragCoord.z, gl_FragCoord.w, 0.0, 1.0);
#elif OUTPUT == OUTPUT_IDS
  fragment = vec4(material.emission, 1.0);
#elif OUTPUT != OUTPUT_RADIANCE && UNLIT
  fragment = vec4(0.0, 0.0, 0.0, 1.0);  // unlit surfaces have neither normal nor position here
#elif OUTPUT == OUTPUT_NORMAL
#if NORMAL_TEXTURE
  fragment = vec4(surfaceNormal(inputsAtPlace()), gl_FrontFacing ? 1.0 : -1.0);
#else
  fragment = vec4(AT_PLACE(vNormal), gl_FrontFacing ? 1.0 : -1.0);
#endif
#elif OUTPUT == OUTPUT_SHADING_NORMAL
  fragment = vec4(shadedPixel().normal, 1.0);
#elif OUTPUT == OUTPUT_POSITION
  fragment = vec4(AT_PLACE(vPosition), 1.0);
#else
#if UNLIT
  vec3 radiance = base.rgb + emission;
#else
  vec3 radiance = shade(base) + emission;
#endif
#if ALPHA_BLEND
  fragment = vec4(radiance, base.a);
#else
  fragment = vec4(radiance, 1.0);
#endif
#endif
}
