#include "glint/gltf/accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace glint::gltf {
namespace {

std::size_t bytesOf(int componentType) {
  return static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(componentType)));
}

/// The same as withComponent() for the types allowed for indices.
template <typename Use>
void withIndex(int componentType, const Use& use) {
  if (componentType == 5121) use(std::uint8_t());
  if (componentType == 5123) use(std::uint16_t());
  if (componentType == 5125) use(std::uint32_t());
}

template <typename Component>
Component load(const unsigned char* from) {
  Component value;
  std::memcpy(&value, from, sizeof value);  // elements need not be aligned
  return value;
}

/// Bytes from the first element to the end of the last, with `bytes` per element.
std::size_t spanOf(const AccessorView& view, std::size_t bytes) {
  return view.count > 0 ? (view.count - 1) * view.stride + bytes : 0;
}

void readInto(void* to, const AccessorView& view, std::size_t size) {
  if (!view.file->read(to, view.offset, size))
    view.messages->fail(view.label + " cannot be read from its file", "check the disk");
}

/// Copies all elements, which lie one behind another.
void copyInto(void* to, const AccessorView& view, std::size_t size) {
  if (view.data)
    std::memcpy(to, view.data, size);
  else
    readInto(to, view, size);
}

/// The first element; `room` holds the data if they come from a file. Null if there are no data.
const unsigned char* elementsOf(const AccessorView& view, std::size_t bytes,
                                std::vector<unsigned char>& room) {
  if (view.data || !view.file) return view.data;
  room.resize(spanOf(view, bytes));
  readInto(room.data(), view, room.size());
  return room.data();
}

std::size_t bytesOf(const AccessorView& view) {
  return bytesOf(view.componentType) * static_cast<std::size_t>(view.components);
}

}  // namespace

AccessorView openAccessor(const Document& document, int index, const std::string& label,
                          Budget& budget, const Messages& messages) {
  const tinygltf::Model& model = document.model;
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (const int buffer = document.absentBufferOf(index); buffer >= 0) {
    messages.fail(label + " lies in buffers[" + std::to_string(buffer) +
                  "], which has neither a uri nor a binary GLB chunk");
  }
  AccessorView view;
  view.count = accessor.count;
  view.componentType = accessor.componentType;
  view.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  view.normalized = accessor.normalized;
  const auto bytes = bytesOf(view.componentType) * static_cast<std::size_t>(view.components);
  view.stride = bytes;

  view.label = label;
  view.messages = &messages;

  const auto pointAt = [&](AccessorView& to, int viewIndex, std::uint64_t offset) {
    const ViewPlace& place = document.views[static_cast<std::size_t>(viewIndex)];
    const Document::Stretch& stretch = document.stretches[place.buffer];
    to.offset = place.offset + offset;
    if (stretch.bytes.empty())
      to.file = &document.buffers[place.buffer];
    else
      to.data = stretch.bytes.data() + (to.offset - stretch.first);
  };
  if (accessor.bufferView >= 0 && view.count > 0) {
    pointAt(view, accessor.bufferView, accessor.byteOffset);
    const auto& bufferView = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    if (bufferView.byteStride) view.stride = bufferView.byteStride;
    if (!accessor.sparse.isSparse) return view;
  }

  budget.read(view.count * bytes / 4);
  std::vector<unsigned char> elements(view.count * bytes), room;
  const unsigned char* from = view.count > 0 ? elementsOf(view, bytes, room) : nullptr;
  for (std::size_t i = 0; from && i < view.count; ++i) {
    std::memcpy(&elements[i * bytes], from + i * view.stride, bytes);
  }
  view.owned = std::move(elements);
  view.data = view.owned.data();
  view.file = nullptr;
  view.stride = bytes;
  if (!accessor.sparse.isSparse) return view;

  const auto& sparse = accessor.sparse;
  AccessorView part;
  part.label = label;
  part.messages = &messages;
  part.count = static_cast<std::size_t>(sparse.count);
  const auto open = [&](int viewIndex, int offset, std::size_t stride,
                        std::vector<unsigned char>& read) {
    part.data = nullptr;
    part.file = nullptr;
    part.stride = stride;
    pointAt(part, viewIndex, static_cast<std::uint64_t>(offset));
    return elementsOf(part, stride, read);
  };
  std::vector<unsigned char> indexRoom, valueRoom;
  if (part.count == 0) return view;
  const unsigned char* indices = open(sparse.indices.bufferView, sparse.indices.byteOffset,
                                      bytesOf(sparse.indices.componentType), indexRoom);
  const unsigned char* values =
      open(sparse.values.bufferView, sparse.values.byteOffset, bytes, valueRoom);
  withIndex(sparse.indices.componentType, [&](auto type) {
    using Index = decltype(type);
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
      const auto target = static_cast<std::size_t>(load<Index>(indices + i * sizeof(Index)));
      if (target >= view.count) {
        messages.fail(label + ", accessors[" + std::to_string(index) + "].sparse has the index " +
                      std::to_string(target) + " of " + std::to_string(view.count));
      }
      std::memcpy(&view.owned[target * bytes], values + i * bytes, bytes);
    }
  });
  return view;
}

namespace {

/// The factor for an integer: 1 or, for normalised values, the reciprocal of its type's maximum.
template <typename Component>
double scaleOf(const AccessorView& view, bool normalize) {
  if constexpr (!std::is_floating_point_v<Component>) {
    // -128 and -127 both mean -1.
    if (normalize || view.normalized) return 1.0 / std::numeric_limits<Component>::max();
  }
  return 1;
}

}  // namespace

template <typename Vector>
std::vector<Vector> gather(const AccessorView& view, const VertexList& vertices, bool normalize,
                           const Vector& fallback) {
  using Real = typename Vector::value_type;
  std::vector<Vector> result(vertices.count, fallback);
  const int length = std::min<int>(Vector::length(), view.components);
  if (vertices.count == 0) return result;
  // If the layouts are equal, directly to the destination.
  if (std::is_same_v<Real, float> && view.componentType == 5126 && vertices.all &&
      view.components == Vector::length() && view.stride == sizeof(Vector)) {
    copyInto(result.data(), view, vertices.count * sizeof(Vector));
    return result;
  }
  std::vector<unsigned char> room;
  const unsigned char* data = elementsOf(view, bytesOf(view), room);
  withComponent(view.componentType, [&](auto type) {
    using Component = decltype(type);
    const double scale = scaleOf<Component>(view, normalize);
    const double least = scale != 1 ? -1.0 : std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < vertices.count; ++i) {
      const unsigned char* from = data + vertices[i] * view.stride;
      for (int k = 0; k < length; ++k) {
        const auto value = load<Component>(from + static_cast<std::size_t>(k) * sizeof(Component));
        if constexpr (std::is_floating_point_v<Component>) {
          result[i][k] = value;
        } else {
          result[i][k] = static_cast<Real>(std::max(value * scale, least));
        }
      }
    }
  });
  return result;
}

template std::vector<glm::vec2> gather(const AccessorView&, const VertexList&, bool,
                                       const glm::vec2&);
template std::vector<glm::vec3> gather(const AccessorView&, const VertexList&, bool,
                                       const glm::vec3&);
template std::vector<glm::vec4> gather(const AccessorView&, const VertexList&, bool,
                                       const glm::vec4&);
template std::vector<glm::dvec3> gather(const AccessorView&, const VertexList&, bool,
                                        const glm::dvec3&);
template std::vector<glm::dvec4> gather(const AccessorView&, const VertexList&, bool,
                                        const glm::dvec4&);

std::vector<double> readFlat(const AccessorView& view, bool normalize) {
  const auto width = static_cast<std::size_t>(view.components);
  std::vector<double> numbers(view.count * width);
  std::vector<unsigned char> room;
  const unsigned char* data = elementsOf(view, bytesOf(view), room);
  withComponent(view.componentType, [&](auto type) {
    using Component = decltype(type);
    const double scale = scaleOf<Component>(view, normalize);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const unsigned char* from = data + i / width * view.stride + i % width * sizeof(Component);
      const double value = static_cast<double>(load<Component>(from)) * scale;
      numbers[i] = scale != 1 ? std::max(value, -1.0) : value;
    }
  });
  return numbers;
}

std::vector<std::uint32_t> readIndices(const AccessorView& view) {
  std::vector<std::uint32_t> indices(view.count);
  if (view.count == 0) return indices;
  if (view.componentType == 5125 && view.stride == sizeof(std::uint32_t)) {
    copyInto(indices.data(), view, view.count * sizeof(std::uint32_t));
    return indices;
  }
  std::vector<unsigned char> room;
  const unsigned char* data = elementsOf(view, bytesOf(view), room);
  withIndex(view.componentType, [&](auto type) {
    using Component = decltype(type);
    for (std::size_t i = 0; i < view.count; ++i) {
      indices[i] = static_cast<std::uint32_t>(load<Component>(data + i * view.stride));
    }
  });
  return indices;
}

}  // namespace glint::gltf
