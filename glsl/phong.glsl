// phong: the Phong sum per pixel, with the interpolated normal.
#if !VERTEX_STAGE
vec3 shade(vec4 base) {
  Pixel at = shadedPixel();
  Parameters p = pixelParameters();
  return surfaceColor(sumLights(at.position, at.normal, at.view, p), base.rgb, p.metalness);
}
#endif
