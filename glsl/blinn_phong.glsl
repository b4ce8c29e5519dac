// blinn-phong: the Blinn-Phong sum per pixel, with the interpolated normal.
#if !VERTEX_STAGE
vec3 shade(vec4 base) {
  Pixel p = shadedPixel();
  return surfaceColor(sumLights(p.position, p.normal, p.view), base.rgb);
}
#endif
