// flat: the sum once per face, at its centroid, with the face's normal. The last vertex of each
// triangle (GL's provoking vertex) has both as attributes.
#if VERTEX_STAGE
layout(location = 5) in vec3 faceCenter;

void passVertex(vec3 eye, vec3 n) {
  carryLight((draw.eyeFromModel * vec4(faceCenter, 1.0)).xyz, n);
}
#endif
