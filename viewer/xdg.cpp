#include "xdg.h"

#include <cstdlib>

namespace glint::viewer {
namespace {

std::filesystem::path absolute(const char* variable) {
  const char* text = std::getenv(variable);
  const std::filesystem::path path = text ? text : "";
  return path.is_absolute() ? path : std::filesystem::path();
}

std::filesystem::path folder(const char* variable, const char* underHome) {
  std::filesystem::path base = absolute(variable);
  if (base.empty()) {
    base = absolute("HOME");
    if (base.empty()) return {};
    base /= underHome;
  }
  return base / "glint";
}

}  // namespace

std::filesystem::path configFolder() { return folder("XDG_CONFIG_HOME", ".config"); }
std::filesystem::path stateFolder() { return folder("XDG_STATE_HOME", ".local/state"); }

}  // namespace glint::viewer
