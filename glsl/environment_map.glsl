// The environments: radiance from a direction in world space, +Y up. The built-in ones are polynomials
// of direction cosines; src/glint/shading/environment_map.h has the formulas and describes them.
#if ENVIRONMENT_MAP == ENVIRONMENT_STUDIO
// A rectangular light with soft edges: axis, right and up are orthonormal; extents are cosines.
float boxLight(vec3 d, vec3 axis, vec3 right, vec3 up, vec2 extent, float soft) {
  vec2 p = abs(vec2(dot(d, right), dot(d, up)));
  vec2 edge = 1.0 - smoothstep(extent - soft, extent + soft, p);
  return smoothstep(0.0, 0.3, dot(d, axis)) * edge.x * edge.y;
}
#endif

#if ENVIRONMENT_MAP > ENVIRONMENT_WHITE  // ENVIRONMENT_IMAGE
// The picture with its mip levels, made by src/glint/render/environment_image.h.
uniform sampler2D environmentImage;

// The angle of (x, y) from the x axis, in turns, to 1e-8 (Abramowitz and Stegun 4.4.49). A driver's
// atan may be off by more than a texel of a large picture.
float turnsOf(float y, float x) {
  float a = abs(x), b = abs(y), most = max(a, b);
  float t = most > 0.0 ? min(a, b) / most : 0.0, s = t * t;
  float angle = t * (1.0 + s * (-0.3333314528 + s * (0.1999355085 + s * (-0.1420889944 + s * (0.1065626393
              + s * (-0.0752896400 + s * (0.0429096138 + s * (-0.0161657367 + s * 0.0028662257))))))));
  float turns = angle * 0.15915494309;
  if (b > a) turns = 0.25 - turns;
  if (x < 0.0) turns = 0.5 - turns;
  return y < 0.0 ? -turns : turns;
}

// One level at a place, from 0 to 1 across and down. Beyond the row next to a pole is the same row on
// the opposite side of the pole.
vec3 environmentLevel(vec2 place, float level) {
  float rows = float(textureSize(environmentImage, int(level)).y);
  float beyond = 0.5 - min(place.y, 1.0 - place.y) * rows;
  vec3 here = textureLod(environmentImage, place, level).rgb;
  if (!(beyond > 0.0)) return here;
  vec2 across = vec2(place.x + 0.5, place.y);
  return mix(here, textureLod(environmentImage, across, level).rgb, beyond);
}

// The average over about `spread` radians around the direction.
vec3 environmentRadiance(vec3 direction, float spread) {
  vec3 d = safeUnit(direction);
  vec2 place = vec2(0.5 + turnsOf(d.x, -d.z), 2.0 * turnsOf(sqrt(d.x * d.x + d.z * d.z), d.y));
  vec2 size = vec2(textureSize(environmentImage, 0));
  float last = floor(log2(max(size.x, size.y)) + 1e-5);  // index of the last level: levels are halved down to 1 x 1
  float level = clamp(log2(spread * size.y * 0.18377630), 0.0, last);
  float fine = floor(level), share = level - fine;
  vec3 radiance = environmentLevel(place, fine);
  if (!(share > 0.0)) return radiance;
  return mix(radiance, environmentLevel(place, fine + 1.0), share);
}

#if !VERTEX_STAGE
// The largest angle by which the direction turns from a pixel to the next in its 2 x 2 square. All
// pixels of the square must call it.
float spreadOf(vec3 direction) {
  vec3 d = safeUnit(direction), x = dFdx(d), y = dFdy(d);
  return sqrt(mostOfSquare(max(dot(x, x), dot(y, y))));
}
#endif
#else
float spreadOf(vec3 direction) { return 0.0; }  // the built-in environments have no detail as fine as a pixel

vec3 environmentRadiance(vec3 direction) {
#if ENVIRONMENT_MAP == ENVIRONMENT_WHITE
  return vec3(1.0);
#elif ENVIRONMENT_MAP == ENVIRONMENT_SKY
  const vec3 sun = vec3(0.48, 0.64, 0.60);
  vec3 d = safeUnit(direction);
  float h = 1.0 - max(d.y, 0.0);
  vec3 air = mix(vec3(0.14, 0.32, 0.70), vec3(0.82, 0.90, 0.98), h * h * h);
  vec3 apart = d - sun;  // |d - sun|^2 / 2 = 1 - d.sun, accurate near the sun
  float g = max(dot(d, sun), 0.0), disc = smoothstep(0.002, 0.010, 0.5 * dot(apart, apart));
  float g2 = g * g, g4 = g2 * g2, g8 = g4 * g4, g16 = g8 * g8, g32 = g16 * g16;
  float glow = 0.30 * g8 + 0.55 * g32 * g32 + 1.2 * (1.0 - disc);
  vec3 ground = mix(vec3(0.46, 0.42, 0.36), vec3(0.26, 0.22, 0.18), max(-d.y, 0.0));
  return mix(ground, air + glow * vec3(1.0, 0.90, 0.74), smoothstep(-0.05, 0.05, d.y));
#else
  vec3 d = safeUnit(direction);
  float back = max(-d.z, 0.0), down = max(-d.y, 0.0);
  float wall = 0.24 + 0.45 * back * back;
  vec3 radiance = vec3(mix(0.07, wall, smoothstep(-0.22, 0.06, d.y)) + 0.30 * smoothstep(0.0, 1.0, d.y));
  radiance += vec3(0.26, 0.24, 0.21) * (down * down);
  // The overhead light, tilted to the front; the key light, front left; the strip, right.
  radiance += vec3(2.4, 2.4, 2.4) * boxLight(d, vec3(0.0, 0.96, 0.28), vec3(1.0, 0.0, 0.0),
                                             vec3(0.0, 0.28, -0.96), vec2(0.5, 0.24), 0.1);
  radiance += vec3(2.2, 2.3, 2.45) * boxLight(d, vec3(-0.768, 0.28, 0.576), vec3(0.6, 0.0, 0.8),
                                              vec3(0.224, 0.96, -0.168), vec2(0.2, 0.3), 0.06);
  radiance += vec3(2.1, 1.95, 1.75) * boxLight(d, vec3(0.9216, 0.28, 0.2688), vec3(0.28, 0.0, -0.96),
                                               vec3(-0.2688, 0.96, -0.0784), vec2(0.09, 0.42), 0.05);
  return radiance;
#endif
}

vec3 environmentRadiance(vec3 direction, float spread) { return environmentRadiance(direction); }
#endif
