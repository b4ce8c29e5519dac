#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

/// The arguments after the program's name, as the parser expects them: "help" becomes --help, "help
/// COMMAND" becomes COMMAND --help. A line without a command becomes "view" if it begins with a
/// model (.glb or .gltf, in any case), or begins with options and contains a model.
std::vector<std::string> expandShorthand(std::vector<std::string> arguments,
                                         std::span<const std::string_view> commands);

}  // namespace glint
