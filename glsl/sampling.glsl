// Where in its pixel a fragment is shaded, and how textures are looked up there.

#if LEVELS_OF_DETAIL
// The largest value that the pixels of a 2 x 2 square have. Drivers look up one level of detail for a
// square, whichever of its pixels' they take; with this all four have the same. To be called by all.
float mostOfSquare(float value) {
  vec2 toOther = 1.0 - 2.0 * mod(floor(gl_FragCoord.xy), 2.0);
  value = max(value, value + toOther.x * dFdx(value));
  return max(value, value + toOther.y * dFdy(value));
}
#endif

// Multisampled: the mean of the samples that the triangle covers, from the pixel's middle. That is the
// middle itself where it covers them all, as without multisampling, and never outside the triangle;
// and as the places of the two sides of an edge have the pixel's middle as their mean, surfaces look
// the same across edges within them. Drivers without GL_ARB_gpu_shader5 shade at their centroid.
#if SHADES_AT_OFFSET
in float vDistance;
vec2 shadingPlace = vec2(0.0);
bool inMiddle = true;
// Some drivers (llvmpipe of Mesa 22.3) divide at an offset by the 1/w of the pixel's middle. What that
// makes of w itself tells by how much all else is off; where they divide rightly this is 1.
float placeScale = 1.0;

void findShadingPlace() {
  int count = int(frame.ambientLight.a), covered = 0;
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
// With the true length of the footprint's axes: drivers are free to estimate it. `across` and `along`
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
