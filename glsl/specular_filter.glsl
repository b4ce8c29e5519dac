// Specular anti-aliasing: widens the highlight by the variance of the normals in the pixel, and dims it
// to the same light. src/glint/shading/specular_filter.h has the same in double, and the sources.

#if TOKSVIG
// `variance` is that of the normals that the texel averages.
Parameters filteredParameters(Parameters p, float variance) {
  float filtered = p.exponent / (1.0 + EXPONENTS_PER_BLINN * p.exponent * variance);
  p.specular *= (1.0 + filtered) / (1.0 + p.exponent);
  p.exponent = filtered;
  return p;
}

#if !VERTEX_STAGE
// A scale of the normals' x and y also scales their standard deviation.
Parameters pixelParameters() {
  float width = draw.normalScale * (1.0 - inputsAtPlace().texel.a);
  return filteredParameters(parametersHere(), width * width);
}
#endif
#else
// `turn` is |dN/dx|^2 + |dN/dy|^2 of the unit normal, per pixel.
Parameters filteredParameters(Parameters p, float turn) {
  float inverse = 0.5 * EXPONENTS_PER_BLINN * p.exponent + 1.0;  // 1 / a^2
  float widening = min(2.0 * PIXEL_VARIANCE * turn, LARGEST_WIDENING);
  float filtered = max(inverse / (1.0 + inverse * widening), 1.0);
  p.exponent = (filtered - 1.0) * (2.0 / EXPONENTS_PER_BLINN);
  p.specular *= filtered / inverse;
  return p;
}

#if !VERTEX_STAGE
// The turn at the pixel's centre, the largest in its 2 x 2 square, within which drivers may take
// differences between any pixels.
float normalTurn() {
#if SHADES_AT_OFFSET
  vec3 n = shadedPixel(inputsInMiddle()).normal;
#else
  vec3 n = shadedPixel().normal;
#endif
  vec3 x = dFdx(n), y = dFdy(n);
  return mostOfSquare(dot(x, x) + dot(y, y));
}

Parameters pixelParameters() { return filteredParameters(parametersHere(), normalTurn()); }
#endif
#endif
