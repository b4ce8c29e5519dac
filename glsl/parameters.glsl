// The numbers of the material at one point: at a pixel, a vertex or a face.
struct Parameters {
  float ambient, diffuse, specular;  // m_a, m_d, m_s
  float exponent;                    // of the lobe
  float metalness, transmission;     // m_sm, t
};

#if PARAMETER_TEXTURES
Parameters parametersHere();  // parameter_textures.glsl
#else
Parameters parametersHere() {
  vec4 strength = material.strength;
  return Parameters(strength.x, strength.y, strength.z, strength.w, material.surface.x,
                    material.surface.y);
}
#endif
