#include "glint/gltf/draco.h"

#if GLINT_DRACO
#include <draco/compression/decode.h>
#endif

#include <cstring>

#include "glint/gltf/accessor.h"

namespace glint::gltf {

#if GLINT_DRACO

namespace {

template <typename Component>
bool convert(const draco::PointAttribute& attribute, std::size_t points, int components,
             std::vector<unsigned char>& bytes) {
  const std::size_t size = sizeof(Component) * static_cast<std::size_t>(components);
  bytes.resize(points * size);
  Component values[4] = {};
  for (std::size_t i = 0; i < points; ++i) {
    const auto point = draco::PointIndex(static_cast<std::uint32_t>(i));
    if (!attribute.ConvertValue<Component>(attribute.mapped_index(point),
                                           static_cast<std::int8_t>(components), values)) {
      return false;
    }
    std::memcpy(&bytes[i * size], values, size);
  }
  return true;
}

}  // namespace

bool hasDraco() { return true; }

struct DracoMesh::Decoded {
  std::unique_ptr<draco::Mesh> mesh;
};

DracoMesh::DracoMesh(const std::vector<unsigned char>& packed, std::uint64_t maxGrowth)
    : decoded_(std::make_unique<Decoded>()) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) {
    error_ = "is damaged";
    return;
  }
  decoded_->mesh = std::move(result).value();
  const std::uint64_t most = maxGrowth * (packed.size() + 64);
  if (decoded_->mesh->num_points() > most || decoded_->mesh->num_faces() > most)
    error_ = "expands to far more than its data allow";
}

DracoMesh::~DracoMesh() = default;

std::size_t DracoMesh::points() const { return decoded_->mesh->num_points(); }

std::string DracoMesh::readAttribute(std::uint32_t id, int componentType, const std::string& type,
                                     std::vector<unsigned char>& bytes) const {
  const draco::PointAttribute* const attribute = decoded_->mesh->GetAttributeByUniqueId(id);
  if (!attribute) return "names an attribute that the compressed mesh does not have";
  const int components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
  if (type != "SCALAR" && type != "VEC2" && type != "VEC3" && type != "VEC4")
    return "has an accessor that is not a vector";
  if (attribute->num_components() < components) return "has fewer components than its accessor";
  bool good = false;
  withComponent(componentType, [&](auto type) {
    good = convert<decltype(type)>(*attribute, points(), components, bytes);
  });
  return good ? "" : "has values that its accessor cannot represent";
}

std::vector<unsigned char> DracoMesh::indices() const {
  const draco::Mesh& mesh = *decoded_->mesh;
  std::vector<unsigned char> bytes(std::size_t(12) * mesh.num_faces());
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = face[k].value();
      std::memcpy(&bytes[12 * std::size_t(f) + 4 * k], &index, 4);
    }
  }
  return bytes;
}

#else

bool hasDraco() { return false; }

struct DracoMesh::Decoded {};
DracoMesh::DracoMesh(const std::vector<unsigned char>&, std::uint64_t)
    : error_("cannot be read by this build") {}
DracoMesh::~DracoMesh() = default;
std::size_t DracoMesh::points() const { return 0; }
std::string DracoMesh::readAttribute(std::uint32_t, int, const std::string&,
                                     std::vector<unsigned char>&) const {
  return error_;
}
std::vector<unsigned char> DracoMesh::indices() const { return {}; }

#endif

}  // namespace glint::gltf
