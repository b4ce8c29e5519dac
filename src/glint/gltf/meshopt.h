#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace glint::gltf {

/// The EXT_meshopt_compression parameters of a stream.
struct MeshoptStream {
  std::uint64_t count = 0;   ///< number of elements
  std::uint64_t stride = 0;  ///< bytes per element, at most 256
  std::string mode;          ///< ATTRIBUTES, TRIANGLES or INDICES
  std::string filter;        ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

bool hasMeshopt();

/// Decodes into `plain`, which has count * stride bytes. Returns the error, or an empty string.
std::string decodeMeshopt(const MeshoptStream& stream, const std::vector<unsigned char>& packed,
                          std::vector<unsigned char>& plain);

}  // namespace glint::gltf
