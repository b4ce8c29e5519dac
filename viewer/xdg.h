#pragma once

#include <filesystem>

namespace glint::viewer {

// Where this program keeps its own files (XDG Base Directory Specification 0.8). A variable that is
// not an absolute path counts as not set; without a home folder the path is empty and nothing is
// kept.

/// For settings: $XDG_CONFIG_HOME/glint, by default ~/.config/glint.
std::filesystem::path configFolder();

/// For unsaved edits: $XDG_STATE_HOME/glint, by default ~/.local/state/glint.
std::filesystem::path stateFolder();

}  // namespace glint::viewer
