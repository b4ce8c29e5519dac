#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace glint::gltf {

bool hasDraco();

/// A mesh as KHR_draco_mesh_compression holds it.
class DracoMesh {
 public:
  /// Decodes; where `error()` is filled, there is no mesh. One of more than `maxGrowth` points or
  /// faces a byte is refused.
  DracoMesh(const std::vector<unsigned char>& packed, std::uint64_t maxGrowth);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  const std::string& error() const { return error_; }
  std::size_t points() const;

  /// The attribute of an id as the values of a glTF accessor, tightly packed. Gives what is wrong,
  /// or nothing.
  std::string readAttribute(std::uint32_t id, int componentType, const std::string& type,
                            std::vector<unsigned char>& bytes) const;

  /// 32-bit indices, three a triangle.
  std::vector<unsigned char> indices() const;

 private:
  struct Decoded;
  std::unique_ptr<Decoded> decoded_;
  std::string error_;
};

}  // namespace glint::gltf
