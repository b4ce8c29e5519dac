#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "glint/gltf/file.h"
#include "glint/gltf/json.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// Where a buffer view lies.
struct ViewPlace {
  std::size_t buffer = 0;
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// A glTF file, checked, with what its accessors refer to in memory.
struct Document {
  std::filesystem::path path;
  /// Accessors, buffer views, meshes, nodes, skins and scenes, without the buffers' bytes.
  tinygltf::Model model;
  /// Materials, textures, samplers, images and cameras, as they stand in the file: tinygltf cuts
  /// large numbers down to 32 bits and would read images that nothing shows.
  Json json;
  /// What extensions say of each node, which tinygltf does not read.
  struct NodeExtension {
    int light = -1;  ///< index into the lights of KHR_lights_punctual
    bool visible = true;
  };
  std::vector<NodeExtension> nodeExtensions;
  std::vector<std::string> variants;  ///< names of KHR_materials_variants, which may be empty
  struct Pieces {
    /// By mesh and primitive: the material of each variant that gives it one.
    std::map<std::pair<std::size_t, std::size_t>, std::map<int, int>> variantMaterials;
    /// By node: the accessors of EXT_mesh_gpu_instancing by their names.
    std::map<std::size_t, std::map<std::string, int>> instancing;
  };
  Pieces pieces;
  std::vector<FileExtension> extensions;
  std::vector<FileSkin> skins;
  std::vector<FileMorph> morphs;
  std::vector<ByteSource> buffers;
  /// Buffers of which nobody says where they lie: neither a uri nor a binary chunk.
  std::vector<bool> absent;
  std::vector<ViewPlace> views;  ///< all buffer views, as they lie in `buffers`
  /// Of each buffer the stretch that accessors lie in: most of a model's bytes are images, of which
  /// most are never shown. A long one of a model that stands still is not held: it is read once,
  /// from the file to where it is needed.
  struct Stretch {
    std::uint64_t first = 0, end = 0;
    std::vector<unsigned char> bytes;  ///< empty where they are not held
  };
  std::vector<Stretch> stretches;
  std::uint64_t geometryBytes = 0;  ///< of all stretches

  /// The absent buffer that an accessor lies in, or -1.
  int absentBufferOf(int accessor) const;
};

/// The list of lights of KHR_lights_punctual.
Cursor lightsOf(Cursor root);

Document readDocument(const std::filesystem::path& path, Messages& messages);

/// How much a document may ask for. A file of a few hundred bytes can name an accessor of four
/// thousand million zeros, or draw one accessor ten thousand times; a model that somebody made
/// needs a few elements for each byte that it brings.
class Budget {
 public:
  Budget(std::uint64_t geometryBytes, const Messages& messages);

  /// Counts elements about to be read, or fails.
  void read(std::uint64_t elements);
  /// Counts vertices about to be kept, or fails.
  void keep(std::uint64_t vertices);

 private:
  [[noreturn]] void exceeded() const;

  std::uint64_t readable_;
  std::uint64_t keepable_;
  const Messages* messages_;
};

}  // namespace glint::gltf
