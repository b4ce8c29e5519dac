#pragma once

namespace CLI {
class App;
}

namespace glint {

// Limits on reading models. They apply to the whole process.

/// `--confine`: nothing outside a model's folder is read (gltf/file.h).
void addConfineOption(CLI::App& command);

/// `--decode-limit MIB`: how much a model's decoded textures may take (render/decode.h).
void addDecodeLimitOption(CLI::App& command);

}  // namespace glint
