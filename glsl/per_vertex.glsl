// What flat and Gouraud shading carry from the vertex to the pixel: the light without the colours,
// so that textures stay sharp. Both sides of faces that show both.
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

#if VERTEX_STAGE
void carryLight(vec3 point, vec3 n) {
  vec3 v = toViewer(point);
  LightSum sum = sumLights(point, n, v);
  vDiffuse = sum.diffuse;
#if SPECULAR
  vSpecular = sum.specular;
#endif
#if TWO_SIDED
  sum = sumLights(point, -n, v);
  vBackDiffuse = sum.diffuse;
#if SPECULAR
  vBackSpecular = sum.specular;
#endif
#endif
}
#else
// Light is not negative. In a triangle almost without area, or whose corners lie beyond all measure,
// a driver's interpolation may give anything, infinity and what is no number too.
vec3 arrived(vec3 light) {
  return mix(vec3(0.0), min(light, 1e30), greaterThan(light, vec3(0.0)));
}

vec3 shade(vec4 base) {
  LightSum sum = LightSum(vDiffuse, vec3(0.0));
#if SPECULAR
  sum.specular = vSpecular;
#endif
#if TWO_SIDED
  if (!gl_FrontFacing) {
    sum.diffuse = vBackDiffuse;
#if SPECULAR
    sum.specular = vBackSpecular;
#endif
  }
#endif
  return surfaceColor(LightSum(arrived(sum.diffuse), arrived(sum.specular)), base.rgb);
}
#endif
