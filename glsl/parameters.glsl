// The parameters of the material at one point: a pixel, a vertex or a face.
struct Parameters {
  float ambient, diffuse, specular;  // m_a, m_d, m_s
  float exponent;                    // of the lobe
  float metalness, transmission;     // m_sm, t
};

Parameters materialParameters() {
  return Parameters(material.ambient, material.diffuse, material.specular, material.exponent,
                    material.metalness, material.transmission);
}

#if PARAMETER_TEXTURES
Parameters parametersHere();  // parameter_textures.glsl
#else
Parameters parametersHere() {
  return materialParameters();
}
#endif
