#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "glint/image/stored_image.h"

namespace glint {

/// One of the pictures that a file holds. OpenEXR files can hold many: colours by layer and part,
/// and channels that are not colours (depth, normals, masks), each as a grey picture. Files of
/// other formats hold only one.
struct PictureLayer {
  std::string name;                   ///< empty: the main picture
  std::vector<std::string> channels;  ///< their names in the file; empty for other formats
  bool colour = true;                 ///< visible colour; otherwise arbitrary values
  StoredImage image;
};

struct PictureLayers {
  std::vector<PictureLayer> layers;  ///< at least one; the main picture is first, if there is one
  std::vector<std::string> skipped;  ///< what else the file holds, in words; not read
  bool named = false;                ///< the format names its layers
};

/// Reads the layers of a picture in memory: "all", "main", or those with one name: "diffuse" (its
/// colours), "normal" (normal.X, normal.Y, normal.Z), "Z", a part, a part and a layer
/// ("right.diffuse"). `name` appears in the messages. Throws InputError as readStoredImage() does,
/// and for a name that does not exist. A picture of more than `heldBytes` is read by rows if its
/// format allows (PNG that is not interlaced, PPM, PGM, TIFF in strips); `bytes` must then outlive
/// it.
PictureLayers decodePictureLayers(std::span<const std::byte> bytes, const std::string& name,
                                  const std::string& wanted, std::size_t heldBytes = SIZE_MAX);

}  // namespace glint
