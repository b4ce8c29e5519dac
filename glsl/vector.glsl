// Vectors whose length may be anything.

// v / |v| through division and square root, which every driver rounds well; inversesqrt, and so
// normalize, differ between processors. For lengths from 1e-15 to 1e19; the zero vector, and one
// whose square under- or overflows or is no number, gives 0.
vec3 unit(vec3 v) {
  float square = dot(v, v);
  return square > 0.0 && square < 3.0e38 ? v / sqrt(square) : vec3(0.0);
}

// As unit, for any finite length: the very long and the very short are scaled first, by 2^-86 and
// 2^86, which rounds nothing. No division by the length itself: its reciprocal, which GPUs take,
// would be subnormal above 2^126. Subnormal components may count as 0.
vec3 safeUnit(vec3 v) {
  float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
  return unit(v * (size > 1.0995116e12 ? 1.2924697e-26 : size < 9.094947e-13 ? 7.7371252e25 : 1.0));
}

// Light or a colour as it arrives at a pixel. Neither is negative; but in a triangle almost without
// area, or with corners beyond all measure, a driver's interpolation may give anything, infinity and
// NaN too.
vec4 finiteOrZero(vec4 value) {
  return mix(vec4(0.0), min(value, 1e30), greaterThan(value, vec4(0.0)));
}
