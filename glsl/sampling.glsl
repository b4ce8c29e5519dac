// The position in its pixel at which a fragment is shaded, and the texture look-up there.

#if LEVELS_OF_DETAIL
// The largest value among the pixels of a 2 x 2 square. Drivers use the same level of detail for the
// whole square, from an unspecified one of its pixels; with this all four agree. All four must call it.
float mostOfSquare(float value) {
  vec2 toOther = 1.0 - 2.0 * mod(floor(gl_FragCoord.xy), 2.0);
  value = max(value, value + toOther.x * dFdx(value));
  return max(value, value + toOther.y * dFdy(value));
}
#endif

// With multisampling, a fragment is shaded at the mean position of the covered samples, relative to the
// pixel's centre. This is the centre itself if all are covered, as without multisampling, and it is
// never outside the triangle. The mean of the positions on both sides of an edge is the pixel's centre,
// so edges inside a surface are not visible. Drivers without GL_ARB_gpu_shader5 use their centroid.
#if SHADES_AT_OFFSET
in float vDistance;
vec2 shadingPlace = vec2(0.0);
bool inMiddle = true;
// Some drivers (llvmpipe of Mesa 22.3) divide values at an offset by the 1/w of the pixel's centre.
// Interpolating w itself gives the factor that corrects this; it is 1 for correct drivers.
float placeScale = 1.0;

void findShadingPlace() {
  int count = int(frame.sampleCount), covered = 0;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < count; ++i)
    if ((gl_SampleMaskIn[0] >> i & 1) != 0) {
      sum += frame.samples[i].xy;
      ++covered;
    }
  inMiddle = covered == 0 || covered == count;
  shadingPlace = inMiddle ? vec2(0.0) : sum / float(covered);
  vec2 slope = vec2(dFdx(gl_FragCoord.w), dFdy(gl_FragCoord.w));
  float inverse = gl_FragCoord.w + dot(slope, shadingPlace);
  placeScale = 1.0 / (inverse * interpolateAtOffset(vDistance, shadingPlace));
}
#define AT_PLACE(varying) (inMiddle ? varying : placeScale * interpolateAtOffset(varying, shadingPlace))
#else
#define AT_PLACE(varying) varying
#endif

#if TEXTURES
// Uses the true length of the footprint's axes, which drivers may only estimate. `across` and `along`
// are the change of `place` to the next pixel.
vec4 textureAt(sampler2D image, Rule rule, vec2 place, vec2 across, vec2 along) {
  vec2 size = vec2(textureSize(image, 0));
  across *= size;
  along *= size;
  float square = min(max(dot(across, across), dot(along, along)), 1e30);
  square = mostOfSquare(square);
  return textureAtLevel(image, rule, place, square > 0.0 ? 0.5 * log2(square) : -1.0);
}
#define TEXTURE_AT(image, rule, varying) \
  textureAt(image, rule, AT_PLACE(varying), dFdx(varying), dFdy(varying))
#endif
