// The material's parameters if textures give some of them, for the stage that sums up the lights.
// Each ..._PLACE holds the coordinates at which a texture is looked up.
#if METALLIC_ROUGHNESS_TEXTURE
uniform sampler2D metallicRoughnessTexture;
#endif
#if OCCLUSION_TEXTURE
uniform sampler2D occlusionTexture;
#endif
#if SPECULAR_TEXTURE
uniform sampler2D specularTexture;
#endif
#if TRANSMISSION_TEXTURE
uniform sampler2D transmissionTexture;
#endif

// A vertex or a face has no neighbours from which a level of detail could be derived.
#if VERTEX_STAGE
#define TEXEL(image, rule, place) textureAtLevel(image, rule, place, 0.0)
#else
#define TEXEL(image, rule, place) TEXTURE_AT(image, rule, place)
#endif

Parameters parametersHere() {
  Parameters p = materialParameters();
  float metallic = material.metallic, roughness = material.roughness;
#if METALLIC_ROUGHNESS_TEXTURE
  vec4 texel = TEXEL(metallicRoughnessTexture, METALLIC_ROUGHNESS_RULE, METALLIC_ROUGHNESS_PLACE);
  metallic *= texel.b;
  roughness *= texel.g;
#endif
#if TEXTURED_METALNESS
  p.metalness = metallic;
#endif
#if TEXTURED_DIFFUSE
  p.diffuse = mix(1.0, METAL_DIFFUSE, metallic);
#endif
#if TEXTURED_EXPONENT || TEXTURED_SPECULAR
  // Phong's exponent, as in src/glint/shading/pbr_conversion.h.
  float width = max(roughness, SMALLEST_ROUGHNESS), square = width * width;
  float exponent = max(0.5 / (square * square) - 0.5, 0.0);
#endif
#if TEXTURED_EXPONENT
  p.exponent = material.blinnFactor * exponent;
#endif
#if TEXTURED_SPECULAR
  float reflectance = material.reflectance;
#if SPECULAR_TEXTURE
  reflectance *= TEXEL(specularTexture, SPECULAR_RULE, SPECULAR_PLACE).a;
#endif
#if NORMALIZED
  p.specular = mix(reflectance, 1.0, metallic);
#else
  // The peaks of the lobe for a dielectric and for a metal.
  float blinn = 4.0 * exponent, metal = (blinn / 8.0) * (blinn / (blinn + 8.0));
  float dielectric = reflectance * metal;
  p.specular = mix(dielectric / (1.0 + dielectric), metal / (1.0 + metal), metallic);
#endif
#endif
#if NORMALIZED
  p.specular *= NORMALIZATION(p.exponent);
#endif
#if TEXTURED_AMBIENT
  float occlusion = TEXEL(occlusionTexture, OCCLUSION_RULE, OCCLUSION_PLACE).r;
  p.ambient *= 1.0 + material.occlusionStrength * (occlusion - 1.0);
#endif
#if TEXTURED_TRANSMISSION
  p.transmission *= TEXEL(transmissionTexture, TRANSMISSION_RULE, TRANSMISSION_PLACE).r;
#endif
  return p;
}
