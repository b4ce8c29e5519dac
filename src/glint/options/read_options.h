#pragma once

namespace CLI {
class App;
}

namespace glint {

// How much of models is read. What is given counts for the whole process.

/// `--confine`: nothing outside of a model's folder is read (gltf/file.h).
void addConfineOption(CLI::App& command);

/// `--decode-limit MIB`: what a model's textures may take decoded (render/decode.h).
void addDecodeLimitOption(CLI::App& command);

}  // namespace glint
