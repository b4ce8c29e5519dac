#pragma once

#include <ImfMultiPartInputFile.h>

#include <array>
#include <string>
#include <vector>

namespace glint::detail {

/// A picture in an EXR: colours with their alpha, or one channel that is not a colour.
struct ExrLayer {
  int part = 0;
  std::string name;    ///< "" for the main picture; "diffuse", "normal.X", "Z", "right.diffuse"
  std::string alias;   ///< without the part's name
  std::string prefix;  ///< of the channel names, including the dot
  /// The names of the R, G, B and A channels; empty if absent. Grey has the same name three times.
  std::array<std::string, 4> channels;
  bool colour = false;  ///< visible colour; otherwise arbitrary values
  bool chroma = false;  ///< Y, RY, BY
  bool deep = false;

  bool isGrey() const { return !chroma && channels[0] == channels[1]; }
  /// The file's channels that it is made of.
  std::vector<std::string> channelNames() const;
  /// Whether a name given by the user matches: the layer's own, or that of a group it belongs to.
  bool isOf(const std::string& wanted) const;
};

/// All the layers of a file, in file order; each channel belongs to one of them.
std::vector<ExrLayer> exrLayersOf(const Imf::MultiPartInputFile& file);

}  // namespace glint::detail
