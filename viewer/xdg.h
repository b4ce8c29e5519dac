#pragma once

#include <filesystem>

namespace glint::viewer {

// Where this program keeps files of its own (XDG Base Directory Specification 0.8). A variable that
// is not an absolute path counts as not set; without a home folder the path is empty and nothing is
// kept.

/// $XDG_CONFIG_HOME/glint, by default ~/.config/glint: settings.
std::filesystem::path configFolder();

/// $XDG_STATE_HOME/glint, by default ~/.local/state/glint: edits that were not saved.
std::filesystem::path stateFolder();

}  // namespace glint::viewer
