// The sum of all lights at the point `position` (eye space) with unit normal n, unit direction to the
// viewer v and parameters p: for each form of the highlight, the lights that use it.
LightSum sumLights(vec3 position, vec3 n, vec3 v, Parameters p) {
  LightSum sum = LightSum(vec3(0.0), vec3(0.0));
#if LOBE_FORMS > 0
  addLights0(sum, position, n, v, p);
#endif
#if LOBE_FORMS > 1
  addLights1(sum, position, n, v, p);
#endif
#if LOBE_FORMS > 2
  addLights2(sum, position, n, v, p);
#endif
#if LOBE_FORMS > 3
  addLights3(sum, position, n, v, p);
#endif
  sum.diffuse = p.ambient * frame.ambientLight + p.diffuse * sum.diffuse;
  sum.specular *= p.specular;
  return sum;
}

// C diffuse + S specular, S = m_sm C + (1 - m_sm).
vec3 surfaceColor(LightSum sum, vec3 color, float metalness) {
  vec3 shine = metalness * color + (1.0 - metalness);
  return color * sum.diffuse + shine * sum.specular;
}

// The unit direction from the point `position` (eye space) to the viewer; +Z at the eye itself and
// where the square overflows.
vec3 toViewer(vec3 position) {
#if CONSTANT_VIEW
  return frame.toViewer;
#else
  float square = dot(position, position);
  return square > 0.0 && square < 3.0e38 ? position / -sqrt(square) : vec3(0.0, 0.0, 1.0);
#endif
}
