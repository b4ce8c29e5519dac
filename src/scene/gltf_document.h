#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>

#include "glint/scene/gltf_json.h"

namespace glint::gltf {

/// A glTF file, checked, with its buffers in memory.
struct Document {
  std::filesystem::path path;
  /// Accessors, buffer views, buffers' bytes, meshes, nodes, skins and scenes.
  tinygltf::Model model;
  /// Materials, textures, samplers, images and cameras, as they stand in the file: tinygltf cuts
  /// large numbers down to 32 bits and would read images that nothing shows.
  Json json;
  std::uint64_t bufferBytes = 0;  ///< of all buffers together
};

Document readDocument(const std::filesystem::path& path, Messages& messages);

/// How much a document may ask for. A file of a few hundred bytes can name an accessor of four
/// thousand million zeros, or draw one accessor ten thousand times; a model that somebody made
/// needs a few elements for each byte that it brings.
class Budget {
 public:
  Budget(std::uint64_t bufferBytes, const Messages& messages);

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
