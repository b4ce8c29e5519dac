#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace glint::gltf {

bool hasDraco();

/// A mesh compressed with KHR_draco_mesh_compression.
class DracoMesh {
 public:
  /// Decodes. If `error()` is not empty, there is no mesh. Refuses more than `maxGrowth` points or
  /// faces per byte.
  DracoMesh(const std::vector<unsigned char>& packed, std::uint64_t maxGrowth);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  const std::string& error() const { return error_; }
  std::size_t points() const;

  /// Reads the attribute with this id as tightly packed values of a glTF accessor. Returns the
  /// error, or an empty string.
  std::string readAttribute(std::uint32_t id, int componentType, const std::string& type,
                            std::vector<unsigned char>& bytes) const;

  /// 32-bit indices, three per triangle.
  std::vector<unsigned char> indices() const;

 private:
  struct Decoded;
  std::unique_ptr<Decoded> decoded_;
  std::string error_;
};

}  // namespace glint::gltf
