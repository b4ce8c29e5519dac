#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/gltf/document.h"

namespace glint::gltf {

/// Where an accessor's elements are: in the document's buffers; in `owned` if they had to be
/// assembled (sparse accessors and those without a buffer view); or in a file, from which gather(),
/// readFlat() and readIndices() read them, or fail.
struct AccessorView {
  const unsigned char* data = nullptr;
  const ByteSource* file = nullptr;  ///< set if `data` is null
  std::uint64_t offset = 0;          ///< of the first element in the file
  std::string label;                 ///< for messages: what it belongs to
  const Messages* messages = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  int componentType = 0;  ///< a glTF constant, from 5120 up
  int components = 0;     ///< 1 to 4, or 16 for MAT4
  bool normalized = false;
  std::vector<unsigned char> owned;
};

/// Calls `use` with a value of the C++ type of a glTF component type.
template <typename Use>
void withComponent(int componentType, const Use& use) {
  if (componentType == 5120) use(std::int8_t());
  if (componentType == 5121) use(std::uint8_t());
  if (componentType == 5122) use(std::int16_t());
  if (componentType == 5123) use(std::uint16_t());
  if (componentType == 5125) use(std::uint32_t());
  if (componentType == 5126) use(float());
}

/// Opens an accessor of a checked document. Fails if a sparse index is out of range; `label` names
/// in messages what it belongs to.
AccessorView openAccessor(const Document& document, int accessor, const std::string& label,
                          Budget& budget, const Messages& messages);

/// Which vertices of an accessor to read, and in which order.
struct VertexList {
  std::vector<std::uint32_t> ids;  ///< unused if `all`
  std::size_t count = 0;
  bool all = true;  ///< the vertices 0 to count-1

  std::size_t operator[](std::size_t i) const { return all ? i : ids[i]; }
};

/// Reads vectors. Integers are scaled to [0, 1] or [-1, 1] if the accessor is normalised or
/// `normalize` is set. Components that the accessor lacks keep the values of `fallback`; surplus
/// ones are dropped. Every id must be below the view's count. Vector is a glm vector of float or
/// double.
template <typename Vector>
std::vector<Vector> gather(const AccessorView& view, const VertexList& vertices,
                           bool normalize = false, const Vector& fallback = Vector(0));

/// All numbers of an accessor, element by element; integers scaled as in gather().
std::vector<double> readFlat(const AccessorView& view, bool normalize = false);

/// Reads an accessor of unsigned integers.
std::vector<std::uint32_t> readIndices(const AccessorView& view);

}  // namespace glint::gltf
