// Texture look-up by GL's rules, written out. Drivers decode sRGB with errors of 1e-3, filter
// 8-bit texels with errors of 3e-3 and blend levels with errors of 4e-2, but return texels as they are
// in the file exactly; these take a quarter of the memory that floats would.

// How one texture of one material is looked up; constant in every call, so that unused code is removed.
struct Rule {
  int wrapS, wrapT;      // WRAP_...
  bool magnify, minify;  // linear instead of nearest
  int levels;            // LEVELS_...
  bool isData;           // numbers instead of sRGB
};
#define WRAP_REPEAT 0
#define WRAP_CLAMP 1
#define WRAP_MIRROR 2
#define LEVELS_NONE 0
#define LEVELS_NEAREST 1
#define LEVELS_LINEAR 2

#if CODED_TEXTURES
// The linear value of each sRGB code.
layout(std140) uniform CurveBlock {
  float linearOfCode[256];
};
#endif

vec4 texelAt(sampler2D image, int x, int y, int level, bool isData) {
  vec4 texel = texelFetch(image, ivec2(x, y), level);
#if CODED_TEXTURES
  if (!isData) {
    ivec3 code = ivec3(texel.rgb * 255.0 + 0.5);
    texel.rgb = vec3(linearOfCode[code.r], linearOfCode[code.g], linearOfCode[code.b]);
  }
#endif
  return texel;
}

// A coordinate along one side, wrapped into [0, 1], the range of the picture.
float wrapped(float place, int wrap) {
  if (wrap == WRAP_REPEAT) place -= floor(place);
  if (wrap == WRAP_MIRROR) {
    place -= 2.0 * floor(0.5 * place);
    place = min(place, 2.0 - place);
  }
  return clamp(place, 0.0, 1.0);
}

// The indices before the first and after the last texel; mirroring repeats the border, as clamping does.
int before(int i, int size, int wrap) { return i >= 0 ? i : wrap == WRAP_REPEAT ? size - 1 : 0; }
int after(int i, int size, int wrap) { return i < size ? i : wrap == WRAP_REPEAT ? 0 : size - 1; }

// Looks up one level of a picture of the size `whole` at a wrapped place.
vec4 levelAt(sampler2D image, Rule rule, ivec2 whole, int level, vec2 place, bool isLinear) {
  ivec2 size = max(whole >> level, 1);
  vec2 at = place * vec2(size);
  if (!rule.magnify && !rule.minify) {
    ivec2 texel = min(ivec2(at), size - 1);
    return texelAt(image, texel.x, texel.y, level, rule.isData);
  }
  // At the centre of a texel the linear filter gives that texel.
  if (rule.magnify != rule.minify && !isLinear) at = min(floor(at), vec2(size - 1)) + 0.5;
  at -= 0.5;
  vec2 corner = floor(at), share = at - corner;
  ivec2 low = ivec2(corner), high = low + 1;
  low = ivec2(before(low.x, size.x, rule.wrapS), before(low.y, size.y, rule.wrapT));
  high = ivec2(after(high.x, size.x, rule.wrapS), after(high.y, size.y, rule.wrapT));
  vec4 a = texelAt(image, low.x, low.y, level, rule.isData);
  vec4 b = texelAt(image, high.x, low.y, level, rule.isData);
  vec4 c = texelAt(image, low.x, high.y, level, rule.isData);
  vec4 d = texelAt(image, high.x, high.y, level, rule.isData);
  a += share.x * (b - a);
  c += share.x * (d - c);
  return a + share.y * (c - a);
}

// Looks up with a given level of detail, which must be the same for the four pixels of a square; above 0
// the texture is minified.
vec4 textureAtLevel(sampler2D image, Rule rule, vec2 place, float detail) {
  ivec2 whole = textureSize(image, 0);
  place = vec2(wrapped(place.x, rule.wrapS), wrapped(place.y, rule.wrapT));
  bool isLinear = detail > 0.0 ? rule.minify : rule.magnify;
  if (rule.levels == LEVELS_NONE) return levelAt(image, rule, whole, 0, place, isLinear);
  // The index of the last level, 1 x 1: the binary exponent of the longer side.
  int last = (floatBitsToInt(float(max(whole.x, whole.y))) >> 23) - 127;
  detail = clamp(detail, 0.0, float(last));
  if (rule.levels == LEVELS_NEAREST)
    return levelAt(image, rule, whole, max(int(ceil(detail + 0.5)) - 1, 0), place, isLinear);
  int fine = int(detail);
  float share = detail - float(fine);
  vec4 value = levelAt(image, rule, whole, fine, place, isLinear);
  return value + share * (levelAt(image, rule, whole, min(fine + 1, last), place, isLinear) - value);
}
