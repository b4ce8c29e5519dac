// Normalising vectors of any length.

// v / |v| by division and square root, which every driver rounds well; inversesqrt, and therefore
// normalize, differ between processors. For lengths from 1e-15 to 1e19; 0 for the zero vector and
// for vectors whose square underflows, overflows or is NaN.
vec3 unit(vec3 v) {
  float square = dot(v, v);
  return square > 0.0 && square < 3.0e38 ? v / sqrt(square) : vec3(0.0);
}

// Like unit, for any finite length: very long and very short vectors are first scaled by 2^-86 and
// 2^86, without rounding. They are not divided by the length itself, because GPUs multiply by its
// reciprocal, which is subnormal above 2^126. Subnormal components may count as 0.
vec3 safeUnit(vec3 v) {
  float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
  return unit(v * (size > 1.0995116e12 ? 1.2924697e-26 : size < 9.094947e-13 ? 7.7371252e25 : 1.0));
}

// An interpolated light or colour. Neither can be negative; but in a triangle with almost no
// area, or with extremely distant corners, a driver's interpolation may give anything, including
// infinity and NaN.
vec4 finiteOrZero(vec4 value) {
  return mix(vec4(0.0), min(value, 1e30), greaterThan(value, vec4(0.0)));
}
