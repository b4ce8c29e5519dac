// The sum over the lights, without the surface's colours C and S.
struct LightSum {
  vec3 diffuse;   // m_a A + m_d sum of I N.L
  vec3 specular;  // m_s sum of I lobe
};

#if LIGHT_FALLOFF
// glTF's fall-off: 1 / d^2, and with a range down to 0 there. `way` is the vector to the light.
float lightFalloff(vec3 way, float perRange) {
  float square = max(dot(way, way), 1e-12), ratio = square * perRange * perRange;
  return clamp(1.0 - ratio * ratio, 0.0, 1.0) / square;
}
#endif
