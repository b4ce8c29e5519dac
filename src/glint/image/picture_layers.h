#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "glint/image/stored_image.h"

namespace glint {

/// One of the pictures that a file holds. OpenEXR has many: colours by layer and part, and
/// channels that are no colours (depth, normals, masks), each of which is a grey one. Of other
/// formats the file's picture is the only one.
struct PictureLayer {
  std::string name;                   ///< empty: the main picture
  std::vector<std::string> channels;  ///< the file's names of them; of other formats empty
  bool colour = true;                 ///< is seen; else values of any meaning
  StoredImage image;
};

struct PictureLayers {
  std::vector<PictureLayer> layers;  ///< at least one; the main picture first, if there is one
  std::vector<std::string> skipped;  ///< what the file holds beside them and is not read, in words
  bool named = false;                ///< the format has names for layers
};

/// Reads the layers of a picture: "all", "main", or those of one name: "diffuse" (its colours),
/// "normal" (normal.X, normal.Y, normal.Z), "Z", a part, a part and a layer ("right.diffuse").
/// Throws InputError as readStoredImage(), and for a name that is not there.
PictureLayers readPictureLayers(const std::string& path, const std::string& wanted);
/// The same from memory; `name` stands in the messages. A picture of more than `heldBytes` is read
/// by rows where its format allows (PNG that is not interlaced, PPM, PGM, TIFF in strips): then
/// `bytes` must live as long as it does.
PictureLayers decodePictureLayers(std::span<const std::byte> bytes, const std::string& name,
                                  const std::string& wanted, std::size_t heldBytes = SIZE_MAX);

}  // namespace glint
