// Specular anti-aliasing: the highlight as wide as the normals of the pixel are apart, and dimmed to
// the same light. src/glint/shading/specular_filter.h has the same in double, and the sources.

// `turn` is |dN/dx|^2 + |dN/dy|^2 of the unit normal from pixel to pixel.
Parameters filteredParameters(Parameters p, float turn) {
  float inverse = 0.5 * EXPONENTS_PER_BLINN * p.exponent + 1.0;  // 1 / a^2
  float widening = min(2.0 * PIXEL_VARIANCE * turn, LARGEST_WIDENING);
  float filtered = max(inverse / (1.0 + inverse * widening), 1.0);
  p.exponent = (filtered - 1.0) * (2.0 / EXPONENTS_PER_BLINN);
  p.specular *= filtered / inverse;
  return p;
}

#if !VERTEX_STAGE
// Of the pixel's middle, the most of its square: drivers take differences as they like within it.
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
