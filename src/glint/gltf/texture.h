#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "glint/gltf/document.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// How a picture's texels are interpreted; each use gets its own image.
enum class TextureUse { colors, numbers, normals };

/// Collects the images that textures refer to, each once, as stored in the file.
class TextureReader {
 public:
  TextureReader(Document& document, Messages& messages);

  /// Reads a textureInfo object (`baseColorTexture` and the like). Empty if it is absent or, with a
  /// warning, if the image is missing or its format is not supported.
  std::optional<Texture> read(Cursor info, TextureUse use = TextureUse::colors);

  /// The texture whose picture is made from that of `from` and another one, or none (-1).
  Texture glossTexture(const Texture& from, const GlossPicture& made);

  std::vector<EncodedImage> takeImages() { return std::move(images_); }

 private:
  int imageSlot(std::size_t image, TextureUse use);
  /// The slot of an image with the same bytes and use; or -1, and the next slot is reserved for it.
  int equalImage(const std::vector<std::byte>& bytes, TextureUse use);
  std::vector<std::byte> load(Cursor image, std::string& name, std::string& error);
  Sampler sampler(Cursor texture);

  Document& document_;
  Messages& messages_;
  Cursor root_;
  std::vector<EncodedImage> images_;
  std::map<std::pair<std::size_t, TextureUse>, int> slots_;  ///< -1: not usable
  std::map<std::string, int> slotsBySource_;  ///< several images may name the same file or view
  std::unordered_multimap<std::size_t, int> slotsByHash_;              ///< of the bytes
  std::vector<std::pair<std::pair<int, GlossPicture>, int>> glosses_;  ///< sources, and their slot
};

}  // namespace glint::gltf
