#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

/// The arguments behind the program's name, as the parser takes them: "help" becomes --help, "help
/// COMMAND" COMMAND --help, and a line without a command that begins with a model (.glb or .gltf,
/// in any case), or with options and has a model among what follows, is one of "view".
std::vector<std::string> expandShorthand(std::vector<std::string> arguments,
                                         std::span<const std::string_view> commands);

}  // namespace glint
