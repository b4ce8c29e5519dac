#include "glint/gltf/meshopt.h"

#if GLINT_MESHOPT
#include <meshoptimizer.h>
#endif

namespace glint::gltf {

#if GLINT_MESHOPT

bool hasMeshopt() { return true; }

std::string decodeMeshopt(const MeshoptStream& s, const std::vector<unsigned char>& packed,
                          std::vector<unsigned char>& plain) {
  const bool vertices = s.mode == "ATTRIBUTES", triangles = s.mode == "TRIANGLES";
  if (!vertices && !triangles && s.mode != "INDICES") return "has an unknown mode";
  // The decoder does not check these.
  if (s.stride == 0 || (vertices ? s.stride % 4 != 0 : s.stride != 2 && s.stride != 4))
    return "has a byteStride that is invalid for its mode";
  if (triangles && s.count % 3 != 0) return "has a count that is not a multiple of 3";
  if (s.count == 0) return {};
  const int result = vertices    ? meshopt_decodeVertexBuffer(plain.data(), s.count, s.stride,
                                                              packed.data(), packed.size())
                     : triangles ? meshopt_decodeIndexBuffer(plain.data(), s.count, s.stride,
                                                             packed.data(), packed.size())
                                 : meshopt_decodeIndexSequence(plain.data(), s.count, s.stride,
                                                               packed.data(), packed.size());
  if (result != 0) return "is damaged";
  if (s.filter == "NONE") return {};
  if (!vertices) return "has a filter that its mode does not allow";
  if (s.filter == "OCTAHEDRAL" && (s.stride == 4 || s.stride == 8)) {
    meshopt_decodeFilterOct(plain.data(), s.count, s.stride);
  } else if (s.filter == "QUATERNION" && s.stride == 8) {
    meshopt_decodeFilterQuat(plain.data(), s.count, s.stride);
  } else if (s.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(plain.data(), s.count, s.stride);
  } else {
    return "has a filter that its byteStride does not allow";
  }
  return {};
}

#else

bool hasMeshopt() { return false; }

std::string decodeMeshopt(const MeshoptStream&, const std::vector<unsigned char>&,
                          std::vector<unsigned char>&) {
  return "cannot be read by this build";
}

#endif

}  // namespace glint::gltf
