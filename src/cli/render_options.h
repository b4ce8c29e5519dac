#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glint/image/picture_writer.h"

namespace CLI {
class App;
}

namespace glint {

/// What `glint render` is asked for, beside the look.
struct RenderOptions {
  std::vector<std::string> models;
  std::string list;  ///< of models, instead of them
  std::string output, backend = "auto", json, glsl, shard;
  int bitDepth = 8;
  std::optional<int> quality;  ///< of JPEG and WebP
  std::string formatName;      ///< in place of what the pictures' names say
  int turntable = 0;           ///< pictures of it; 0: none
  int frames = 0;              ///< of the animation; 0: one picture, of the look's moment
  int jobs = 0;                ///< models in the works at once; 0: by the machine
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

/// How a picture of this name is written, but for what its look says: in the format of its ending,
/// PNG where that tells none.
PictureOptions pictureOptions(const RenderOptions& options, const std::string& output);

/// Adds the options to the command, which fill in `options` when it is parsed.
void addRenderOptions(CLI::App& command, RenderOptions& options);

/// Throws InputError for options that exclude each other or lack something.
void checkRenderOptions(const RenderOptions& options);

}  // namespace glint
