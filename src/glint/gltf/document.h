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

/// The location of a buffer view.
struct ViewPlace {
  std::size_t buffer = 0;
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// A checked glTF file, with its accessors' data or where to find them.
struct Document {
  std::filesystem::path path;
  /// Accessors, buffer views, meshes, nodes, skins and scenes, without the buffers' bytes.
  tinygltf::Model model;
  /// Materials, textures, samplers, images and cameras, as in the file: tinygltf truncates large
  /// numbers to 32 bits and would read images that nothing shows.
  Json json;
  /// Extension data of each node, which tinygltf does not read.
  struct NodeExtension {
    int light = -1;  ///< index into the lights of KHR_lights_punctual
    bool visible = true;
  };
  std::vector<NodeExtension> nodeExtensions;
  std::vector<std::string> variants;  ///< names of KHR_materials_variants, which may be empty
  struct Pieces {
    /// By mesh and primitive: the material for each variant that sets one.
    std::map<std::pair<std::size_t, std::size_t>, std::map<int, int>> variantMaterials;
    /// By node: the accessors of EXT_mesh_gpu_instancing, by name.
    std::map<std::size_t, std::map<std::string, int>> instancing;
  };
  Pieces pieces;
  std::vector<FileExtension> extensions;
  std::vector<FileSkin> skins;
  std::vector<FileMorph> morphs;
  std::vector<ByteSource> buffers;
  /// Buffers without a location: neither a uri nor a binary chunk.
  std::vector<bool> absent;
  std::vector<ViewPlace> views;  ///< all buffer views, by their places in `buffers`
  /// The range of each buffer that contains its accessors: most of a model's bytes are images, and
  /// most of those are never shown. A long range of a static model is not held but read once, from
  /// the file to where it is needed.
  struct Stretch {
    std::uint64_t first = 0, end = 0;
    std::vector<unsigned char> bytes;  ///< empty if not held
  };
  std::vector<Stretch> stretches;
  std::uint64_t geometryBytes = 0;  ///< of all stretches

  /// The absent buffer that an accessor refers to, or -1.
  int absentBufferOf(int accessor) const;
};

/// The list of lights of KHR_lights_punctual.
Cursor lightsOf(Cursor root);

Document readDocument(const std::filesystem::path& path, Messages& messages);

/// Limits how much a document may request. A file of a few hundred bytes can declare an accessor of
/// four thousand million zeros, or draw one accessor ten thousand times; a genuine model needs a
/// few elements per byte of its data.
class Budget {
 public:
  Budget(std::uint64_t geometryBytes, const Messages& messages);

  /// Counts elements about to be read; fails if there are too many.
  void read(std::uint64_t elements);
  /// Counts vertices about to be kept; fails if there are too many.
  void keep(std::uint64_t vertices);

 private:
  [[noreturn]] void exceeded() const;

  std::uint64_t readable_;
  std::uint64_t keepable_;
  const Messages* messages_;
};

}  // namespace glint::gltf
