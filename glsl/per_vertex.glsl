// flat and Gouraud shading pass the light from the vertex to the pixel without the colours, so that
// textures stay sharp; for two-sided faces, the light of both sides.
CARRIED VERTEX_OUT vec3 vDiffuse;
#if SPECULAR
CARRIED VERTEX_OUT vec3 vSpecular;
#endif
#if TWO_SIDED
CARRIED VERTEX_OUT vec3 vBackDiffuse;
#if SPECULAR
CARRIED VERTEX_OUT vec3 vBackSpecular;
#endif
#endif

#if TEXTURED_METALNESS
CARRIED VERTEX_OUT float vMetalness;
#endif

#if VERTEX_STAGE
void carryLight(vec3 point, vec3 n) {
  vec3 v = toViewer(point);
  Parameters p = parametersHere();
  LightSum sum = sumLights(point, n, v, p);
#if TEXTURED_METALNESS
  vMetalness = p.metalness;
#endif
  vDiffuse = sum.diffuse;
#if SPECULAR
  vSpecular = sum.specular;
#endif
#if TWO_SIDED
  sum = sumLights(point, -n, v, p);
  vBackDiffuse = sum.diffuse;
#if SPECULAR
  vBackSpecular = sum.specular;
#endif
#endif
}
#else
vec3 shade(vec4 base) {
  LightSum sum = LightSum(CARRIED_AT(vDiffuse), vec3(0.0));
#if SPECULAR
  sum.specular = CARRIED_AT(vSpecular);
#endif
#if TWO_SIDED
  if (!gl_FrontFacing) {
    sum.diffuse = CARRIED_AT(vBackDiffuse);
#if SPECULAR
    sum.specular = CARRIED_AT(vBackSpecular);
#endif
  }
#endif
#if TEXTURED_METALNESS
  float metalness = clamp(CARRIED_AT(vMetalness), 0.0, 1.0);
#else
  float metalness = material.metalness;
#endif
  return surfaceColor(LightSum(finiteOrZero(vec4(sum.diffuse, 0.0)).rgb, finiteOrZero(vec4(sum.specular, 0.0)).rgb),
                      base.rgb, metalness);
}
#endif
