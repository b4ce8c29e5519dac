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

/// What a picture's texels are read as; of each use it is an image of its own.
enum class TextureUse { colors, numbers, normals };

/// Collects the images that textures refer to, each once, as they stand in the file.
class TextureReader {
 public:
  TextureReader(Document& document, Messages& messages);

  /// Reads a textureInfo object (`baseColorTexture` and the like). Nothing where there is none, or,
  /// with a warning, where the image is missing or of no format that is read.
  std::optional<Texture> read(Cursor info, TextureUse use = TextureUse::colors);

  /// The texture whose picture is made of that of `from` and of another one, or of none (-1).
  Texture glossTexture(const Texture& from, const GlossPicture& made);

  std::vector<EncodedImage> takeImages() { return std::move(images_); }

 private:
  int imageSlot(std::size_t image, TextureUse use);
  /// The slot of an image of the same bytes and use, or -1, and the next one will be this image's.
  int equalImage(const std::vector<std::byte>& bytes, TextureUse use);
  std::vector<std::byte> load(Cursor image, std::string& name, std::string& error);
  Sampler sampler(Cursor texture);

  Document& document_;
  Messages& messages_;
  Cursor root_;
  std::vector<EncodedImage> images_;
  std::map<std::pair<std::size_t, TextureUse>, int> slots_;  ///< -1 is not usable
  std::map<std::string, int> slotsBySource_;  ///< several images may name one file or view
  std::unordered_multimap<std::size_t, int> slotsByHash_;              ///< of the bytes
  std::vector<std::pair<std::pair<int, GlossPicture>, int>> glosses_;  ///< made of what, and where
};

}  // namespace glint::gltf
