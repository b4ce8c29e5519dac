// gouraud: the sum per vertex, interpolated in linear light.
#if VERTEX_STAGE
void passVertex(vec3 eye, vec3 n) { carryLight(eye, n); }
#endif
