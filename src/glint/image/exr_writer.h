#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "glint/image/image.h"

namespace glint {

/// A layer of an OpenEXR file.
struct ExrLayer {
  std::string name;     ///< ASCII without dots; empty for the main picture
  const Image* pixels;  ///< all layers must have the same size
  /// The channel names for the values of a pixel, up to four: "RGB", "RGBA", "XYZ", "Z".
  std::string channels = "RGB";
  std::vector<std::string> words = {};  ///< replaces those letters with longer names, up to four
};

/// Writes a whole OpenEXR file: 32-bit float, one part, layers as channel prefixes ("diffuse.R"),
/// `text` as string attributes (names of 1 to 79 ASCII characters, not the format's own). Throws
/// InputError if the file cannot be written, Error for layers that do not fit in one file.
void writeExr(const std::string& path, std::span<const ExrLayer> layers,
              const std::map<std::string, std::string>& text = {});

}  // namespace glint
