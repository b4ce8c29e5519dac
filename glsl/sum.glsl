// The sum over the lights, without the colours C and S: what the light brings, not the surface.
struct LightSum {
  vec3 diffuse;   // m_a A + m_d sum of I N.L
  vec3 specular;  // m_s sum of I lobe
};

#if SPECULAR && HIGHLIGHT != HIGHLIGHT_POW
// The form of this variant; pow alone takes the cosine itself. `shape` is lobeShape().
float lobeOf(float lambda, vec2 shape) {
#if HIGHLIGHT == HIGHLIGHT_INTEGER
  return lobeInteger(lambda, LOBE_POWER);
#elif HIGHLIGHT == HIGHLIGHT_LYON || HIGHLIGHT == HIGHLIGHT_LYON_TUNED
  return lobeLyon(lambda, shape.x, LOBE_POWER);
#elif HIGHLIGHT == HIGHLIGHT_LYON_CROSS
  return lobeLyonCross(lambda, shape.x, LOBE_POWER);
#elif HIGHLIGHT == HIGHLIGHT_PADE
  return lobePade(lambda, shape.x, shape.y, LOBE_POWER);
#elif HIGHLIGHT == HIGHLIGHT_GAUSSIAN
  return lobeGaussian(lambda, shape.x);
#else
  return lobeExact(lambda, shape.x);
#endif
}
#endif

// What the lobe's form reads of the material: once, before the loop over the lights.
vec2 lobeShape() {
#if SPECULAR && (HIGHLIGHT == HIGHLIGHT_EXACT || HIGHLIGHT == HIGHLIGHT_POW)
  return material.strength.ww;
#elif SPECULAR
  return material.lobe.xy;
#else
  return vec2(0.0);
#endif
}

// Adds one light from the direction l. The gate is N.L > 0 alone, for diffuse and specular light,
// and stands before anything that would be 0/0 behind it. `constant` is L + V (Phong) or H
// (Blinn-Phong) where those are constant, and is not read otherwise.
void addLight(inout LightSum sum, vec3 n, vec3 v, vec3 l, vec3 intensity, vec3 constant,
              bool isConstant, vec2 shape) {
  float cosLight = dot(n, l);
  if (!(cosLight > 0.0)) return;
#if DIFFUSE
  sum.diffuse += intensity * cosLight;
#endif
#if SPECULAR
  vec3 between = isConstant ? constant : l + v;
#if BLINN
  // Where L = -V the half vector is undefined and the light grazes: no highlight.
  float square = dot(between, between);
  if (!(square > 1e-12)) return;
  vec3 h = isConstant ? between : between / sqrt(square);
#if HIGHLIGHT == HIGHLIGHT_POW
  float lobe = lobePow(dot(n, h), shape.x);
#else
  float lobe = lobeOf(blinnLambda(n, h), shape);
#endif
#else
#if HIGHLIGHT == HIGHLIGHT_POW
  float lobe = lobePow(dot(2.0 * cosLight * n - l, v), shape.x);
#else
  float lobe = lobeOf(phongLambda(n, between, cosLight), shape);
#endif
#endif
  sum.specular += intensity * lobe;
#endif
}

#if LIGHT_FALLOFF
// glTF's lamps: 1 / d^2, and with a range down to 0 there. `way` leads to the light.
float lightFalloff(vec3 way, float perRange) {
  float square = max(dot(way, way), 1e-12), ratio = square * perRange * perRange;
  return clamp(1.0 - ratio * ratio, 0.0, 1.0) / square;
}
#endif

// All lights at the point `position` (eye space) with unit normal n and unit direction to the viewer
// v.
LightSum sumLights(vec3 position, vec3 n, vec3 v) {
  LightSum sum = LightSum(vec3(0.0), vec3(0.0));
  vec2 shape = lobeShape();
#if DIRECTIONAL_LIGHTS > 0
  for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i)
    addLight(sum, n, v, lights[i].position.xyz, lights[i].intensity.rgb, lights[i].constant.xyz,
             bool(CONSTANT_VIEW), shape);
#endif
#if POINT_LIGHTS > 0
  for (int i = DIRECTIONAL_LIGHTS; i < DIRECTIONAL_LIGHTS + POINT_LIGHTS; ++i)
  {
    vec3 way = lights[i].position.xyz - position, intensity = lights[i].intensity.rgb;
#if LIGHT_FALLOFF
    intensity *= lightFalloff(way, lights[i].position.w);
#endif
    addLight(sum, n, v, safeUnit(way), intensity, vec3(0.0), false, shape);
  }
#endif
#if SPOT_LIGHTS > 0
  for (int i = DIRECTIONAL_LIGHTS + POINT_LIGHTS; i < LIGHTS; ++i) {
    vec3 way = lights[i].position.xyz - position, l = safeUnit(way);
    // glTF's cone: full inside the inner angle, the square of a ramp in the cosine to the outer one.
    float cone = clamp((dot(-l, lights[i].axis.xyz) - lights[i].axis.w) * lights[i].constant.w, 0.0, 1.0);
    vec3 intensity = lights[i].intensity.rgb * (cone * cone);
#if LIGHT_FALLOFF
    intensity *= lightFalloff(way, lights[i].position.w);
#endif
    addLight(sum, n, v, l, intensity, vec3(0.0), false, shape);
  }
#endif
  sum.diffuse = material.strength.x * frame.ambientLight.rgb + material.strength.y * sum.diffuse;
  sum.specular *= material.strength.z;
  return sum;
}

// C diffuse + S specular, S = m_sm C + (1 - m_sm).
vec3 surfaceColor(LightSum sum, vec3 color) {
  vec3 shine = material.surface.x * color + (1.0 - material.surface.x);
  return color * sum.diffuse + shine * sum.specular;
}

// To the viewer from the point `position` (eye space). At the eye itself, and where its square
// overflows: towards +Z.
vec3 toViewer(vec3 position) {
#if CONSTANT_VIEW
  return frame.view.xyz;
#else
  float square = dot(position, position);
  return square > 0.0 && square < 3.0e38 ? position / -sqrt(square) : vec3(0.0, 0.0, 1.0);
#endif
}
