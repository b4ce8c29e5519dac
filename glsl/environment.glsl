// environment: the Blinn-Phong sum, plus what the surface reflects and refracts of the environment.
// reflectance() stands before it where a dielectric needs it: a form of fresnel.glsl.
#if !VERTEX_STAGE
vec3 environmentToward(vec3 eyeDirection, float spread) {
  return environmentRadiance(mat3(frame.worldFromEye) * eyeDirection, spread);
}

vec3 mirroredAt(Pixel p) { return 2.0 * dot(p.normal, p.view) * p.normal - p.view; }

#if REFRACTION
// Along the surface and against the normal. In total reflection, where nothing is refracted, along the
// surface, which is where the direction tends to.
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
  // Total reflection leaves nothing to refract, also where
  // a share of metal reflects less than all.
  if (refractedSquare(clamp(cosine, 0.0, 1.0), boundary) > 0.0) {
    radiance += t * (1.0 - f) * base.rgb * environmentToward(refracted, spread);
  }
#endif
#endif
  return radiance;
}
#endif
