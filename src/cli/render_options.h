#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glint/image/picture_writer.h"

namespace CLI {
class App;
}

namespace glint {

/// The options of `glint render` other than the look.
struct RenderOptions {
  std::vector<std::string> models;
  std::string list;  ///< a list of models, used instead of `models`
  std::string output, backend = "auto", json, glsl, shard;
  int bitDepth = 8;
  std::optional<int> quality;  ///< of JPEG and WebP
  std::string formatName;      ///< overrides the format of the pictures' names
  int turntable = 0;           ///< number of pictures; 0: no turntable
  int frames = 0;              ///< number of pictures of the animation; 0: one, at the look's time
  int jobs = 0;                ///< models in progress at once; 0: depends on the machine
  bool resume = false, terms = false;
  std::vector<std::string> sweeps;
  std::string reference;
  std::optional<double> referenceThreshold;

  bool usesReference() const { return backend == "reference"; }
  bool hasList() const { return !list.empty(); }
  bool hasFrames() const { return turntable > 0 || frames > 0; }
  std::size_t frameCount() const {
    return turntable > 0 ? std::size_t(turntable) : frames > 0 ? std::size_t(frames) : 1;
  }
};

/// How a picture of this name is written, except for what its look says: in the format of its
/// extension, or as PNG if that is unknown.
PictureOptions pictureOptions(const RenderOptions& options, const std::string& output);

/// Adds the options to the command; parsing fills in `options`.
void addRenderOptions(CLI::App& command, RenderOptions& options);

/// Throws InputError for options that exclude each other or are incomplete.
void checkRenderOptions(const RenderOptions& options);

}  // namespace glint
