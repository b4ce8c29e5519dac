#pragma once

#include <ImfMultiPartInputFile.h>

#include <array>
#include <string>
#include <vector>

namespace glint::detail {

/// A picture in an EXR: colours with their alpha, or one channel that is no colour.
struct ExrLayer {
  int part = 0;
  std::string name;    ///< "" is the main picture; "diffuse", "normal.X", "Z", "right.diffuse"
  std::string alias;   ///< without the part's name
  std::string prefix;  ///< of the channel names, with the dot
  /// Names of the channels of R, G, B and A; empty is none. Grey has one name three times.
  std::array<std::string, 4> channels;
  bool colour = false;  ///< is seen; else a value of any meaning
  bool chroma = false;  ///< Y, RY, BY
  bool deep = false;

  bool isGrey() const { return !chroma && channels[0] == channels[1]; }
  /// The file's channels that make it.
  std::vector<std::string> channelNames() const;
  /// Whether a name given by the user means it: its own, or that of what it lies in.
  bool isOf(const std::string& wanted) const;
};

/// All that a file holds, in its order: each channel is in one of them.
std::vector<ExrLayer> exrLayersOf(const Imf::MultiPartInputFile& file);

}  // namespace glint::detail
