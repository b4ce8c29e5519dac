#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/gltf/document.h"

namespace glint::gltf {

/// Where the elements of an accessor lie: in the document's buffers; in `owned` where they had to
/// be put together (sparse accessors and those of zeros); or in a file, from which gather(),
/// readFlat() and readIndices() read them, or fail.
struct AccessorView {
  const unsigned char* data = nullptr;
  const ByteSource* file = nullptr;  ///< where `data` is null
  std::uint64_t offset = 0;          ///< of the first element in the file
  std::string label;                 ///< of what it belongs to, in messages
  const Messages* messages = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  int componentType = 0;  ///< as in glTF, 5120 and on
  int components = 0;     ///< 1 to 4, or 16 for MAT4
  bool normalized = false;
  std::vector<unsigned char> owned;
};

/// Opens an accessor of a checked document. Fails where a sparse index is out of range; `label`
/// says in messages what it belongs to.
AccessorView openAccessor(const Document& document, int accessor, const std::string& label,
                          Budget& budget, const Messages& messages);

/// Which vertices of an accessor to read, in which order.
struct VertexList {
  std::vector<std::uint32_t> ids;  ///< unused where `all`
  std::size_t count = 0;
  bool all = true;  ///< the vertices 0 to count-1

  std::size_t operator[](std::size_t i) const { return all ? i : ids[i]; }
};

/// Reads vectors, whole numbers scaled to [0, 1] or [-1, 1] where the accessor says so or where
/// `normalize` demands it. Components that the accessor lacks stay at `fallback`; those too many
/// are left out. Every id is below the view's count. Vector is one of glm's, of float or double.
template <typename Vector>
std::vector<Vector> gather(const AccessorView& view, const VertexList& vertices,
                           bool normalize = false, const Vector& fallback = Vector(0));

/// All numbers of an accessor, element by element; whole ones scaled as by gather.
std::vector<double> readFlat(const AccessorView& view, bool normalize = false);

/// Reads an accessor of unsigned whole numbers.
std::vector<std::uint32_t> readIndices(const AccessorView& view);

}  // namespace glint::gltf
