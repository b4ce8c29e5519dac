// environment: the Blinn-Phong sum, plus the reflection and refraction of the environment.
// If a dielectric needs it, reflectance(), a form of fresnel.glsl, is defined before this file.
#if !VERTEX_STAGE
vec3 environmentToward(vec3 eyeDirection, float spread) {
  return environmentRadiance(mat3(frame.worldFromEye) * eyeDirection, spread);
}

vec3 mirroredAt(Pixel p) { return 2.0 * dot(p.normal, p.view) * p.normal - p.view; }

#if REFRACTION
// The refracted direction: a component along the surface and one against the normal. In total
// reflection nothing is refracted; then the limit, the direction along the surface, is returned.
vec3 refractedAt(Pixel p, Boundary boundary) {
  vec3 along = (dot(p.normal, p.view) * p.normal - p.view) / sqrt(boundary.square);
  return along - sqrt(max(1.0 - dot(along, along), 0.0)) * p.normal;
}
#endif

vec3 shade(vec4 base) {
  Pixel at = shadedPixel();
#if SHADES_AT_OFFSET && ENVIRONMENT_MAP == ENVIRONMENT_IMAGE
  Pixel middle = shadedPixel(inputsInMiddle());
#else
  Pixel middle = at;
#endif
  Parameters p = pixelParameters();
  vec3 n = at.normal, v = at.view;
  vec3 sum = surfaceColor(sumLights(at.position, n, v, p), base.rgb, p.metalness);
  float cosine = dot(n, v);
  vec4 b = material.entering;
#if TWO_SIDED
  if (!gl_FrontFacing) b = material.leaving;
#endif
  Boundary boundary = Boundary(b.x, b.y, b.z, b.w);
  vec3 f = vec3(0.0);
#if DIELECTRIC
  f += (1.0 - p.metalness) * reflectance(cosine, boundary);
#endif
#if METAL
  float x = 1.0 - clamp(cosine, 0.0, 1.0), x2 = x * x;
  f += p.metalness * (base.rgb + (1.0 - base.rgb) * (x2 * x2 * x));
#endif
#if OUTPUT == OUTPUT_SUM || OUTPUT == OUTPUT_REFRACTION
  vec3 radiance = sum;
#else
  vec3 radiance = sum + f * environmentToward(mirroredAt(at), spreadOf(mirroredAt(middle)));
#endif
#if REFRACTION
  float t = p.transmission;
  radiance -= t * sum;
#if OUTPUT != OUTPUT_SUM && OUTPUT != OUTPUT_REFLECTION
  vec3 refracted = refractedAt(at, boundary);
  float spread = spreadOf(refractedAt(middle, boundary));
  // In total reflection nothing is refracted, even if a share of metal
  // reflects less than everything.
  if (refractedSquare(clamp(cosine, 0.0, 1.0), boundary) > 0.0) {
    radiance += t * (1.0 - f) * base.rgb * environmentToward(refracted, spread);
  }
#endif
#endif
  return radiance;
}
#endif
