// Vectors whose length may be anything.

// v / |v| through division and square root, which every driver rounds well; inversesqrt, and so
// normalize, differ between processors. The zero vector, and one whose square underflows, gives 0.
vec3 unit(vec3 v) {
  float square = dot(v, v);
  return square > 0.0 ? v / sqrt(square) : vec3(0.0);
}

// As unit, for any finite length: scaled by the largest component first, so that squares neither
// over- nor underflow.
vec3 safeUnit(vec3 v) {
  float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
  return size > 0.0 ? unit(v / size) : vec3(0.0);
}
