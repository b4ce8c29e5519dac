#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "glint/image/error.h"

namespace glint {
namespace {

// The window is a separate program, so that this one needs neither X11 nor GLFW. It is next to this
// binary or on the PATH.
[[noreturn]] void view(const std::vector<std::string>& arguments) {
  std::vector<std::string> texts{"glint-viewer"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv((self.parent_path() / "glint-viewer").c_str(), pointers.data());
  execvp("glint-viewer", pointers.data());
  if (errno == ENOENT)
    throw InputError(
        "view: glint-viewer is not installed: build glint with libglfw3-dev and libimgui-dev "
        "installed, or draw offscreen with glint render");
  throw InputError(std::string("view: cannot start glint-viewer: ") + std::strerror(errno));
}

}  // namespace

Command addView(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("view", "show a model in a window, to edit materials, lights and camera");
  // All arguments go to the viewer, including --help.
  command->set_help_flag();
  command->prefix_command();
  return [command]() -> int { view(command->remaining()); };
}

}  // namespace glint
