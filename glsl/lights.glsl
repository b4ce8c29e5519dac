// Adds the lights whose highlight has one form. This file is included once for each form in use, with
// its own function names (ADD_LIGHTS, ADD_LIGHT), for the lights from ..._FROM to before ..._END. The
// constants that a form reads from the material, LOBE_SHAPE, are loaded before the loops. LOBE_OF is
// the form, a function of lobe.glsl, which comes before this file.

// Adds one light from the direction l. The only gate is N.L > 0, for diffuse and specular light; it
// comes before anything that could be 0/0 otherwise. `halfway` is L + V (Phong) or H
// (Blinn-Phong) if these are constant, and is not read otherwise. `even`: the exponent is 0, for which
// every form is 1 up to 90 degrees.
void ADD_LIGHT(inout LightSum sum, vec3 n, vec3 v, vec3 l, vec3 intensity, vec3 halfway,
               bool isConstant, vec2 shape, bool even) {
  float cosLight = dot(n, l);
  if (!(cosLight > 0.0)) return;
#if DIFFUSE
  sum.diffuse += intensity * cosLight;
#endif
#if LOBE
  vec3 between = isConstant ? halfway : l + v;
#if BLINN
  // For L = -V the half vector is undefined; there is no highlight.
  float square = dot(between, between);
  if (!(square > 1e-12)) return;
  vec3 h = isConstant ? between : between / sqrt(square);
#if LOBE_TAKES_COSINE
  float lobe = LOBE_OF(dot(n, h), shape);
#else
  float lambda = blinnLambda(n, h);
  float lobe = even ? float(lambda < 1.0) : LOBE_OF(lambda, shape);
#endif
#else
#if LOBE_TAKES_COSINE
  float lobe = LOBE_OF(dot(2.0 * cosLight * n - l, v), shape);
#else
  float lambda = phongLambda(n, between, cosLight);
  float lobe = even ? float(lambda < 1.0) : LOBE_OF(lambda, shape);
#endif
#endif
  sum.specular += intensity * lobe;
#endif
}

void ADD_LIGHTS(inout LightSum sum, vec3 position, vec3 n, vec3 v, Parameters p) {
  vec2 shape = LOBE_SHAPE;
  bool even = LOBE_EVEN;
#if DIRECTIONAL_END > DIRECTIONAL_FROM
  for (int i = DIRECTIONAL_FROM; i < DIRECTIONAL_END; ++i)
    ADD_LIGHT(sum, n, v, lights[i].position, lights[i].intensity, lights[i].halfway,
              bool(CONSTANT_VIEW), shape, even);
#endif
#if POINT_END > POINT_FROM
  for (int i = POINT_FROM; i < POINT_END; ++i)
  {
    vec3 way = lights[i].position - position, intensity = lights[i].intensity;
#if LIGHT_FALLOFF
    if (lights[i].fallsOff > 0.0) intensity *= lightFalloff(way, lights[i].inverseRange);
#endif
    ADD_LIGHT(sum, n, v, safeUnit(way), intensity, vec3(0.0), false, shape, even);
  }
#endif
#if SPOT_END > SPOT_FROM
  for (int i = SPOT_FROM; i < SPOT_END; ++i) {
    vec3 way = lights[i].position - position, l = safeUnit(way);
    // glTF's cone: 1 inside the inner angle, then the square of a linear ramp in the cosine, 0 outside.
    float cone = clamp((dot(-l, lights[i].axis) - lights[i].cosOuter) * lights[i].coneScale, 0.0, 1.0);
    vec3 intensity = lights[i].intensity * (cone * cone);
#if LIGHT_FALLOFF
    if (lights[i].fallsOff > 0.0) intensity *= lightFalloff(way, lights[i].inverseRange);
#endif
    ADD_LIGHT(sum, n, v, l, intensity, vec3(0.0), false, shape, even);
  }
#endif
}
