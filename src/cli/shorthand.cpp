#include "shorthand.h"

#include <algorithm>
#include <cctype>

namespace glint {
namespace {

bool isModel(std::string word) {
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
  return !word.starts_with('-') && (word.ends_with(".glb") || word.ends_with(".gltf"));
}

}  // namespace

std::vector<std::string> expandShorthand(std::vector<std::string> arguments,
                                         std::span<const std::string_view> commands) {
  if (arguments.empty()) return arguments;
  const auto isCommand = [&](const std::string& word) {
    return std::ranges::find(commands, word) != commands.end();
  };
  const std::string first = arguments.front();
  if (first == "help") {
    arguments.erase(arguments.begin());
    if (arguments.empty() || isCommand(arguments.front()))  // otherwise it is refused as unknown
      arguments.insert(arguments.begin() + (arguments.empty() ? 0 : 1), "--help");
  } else if (isModel(first) || (first.starts_with('-') && std::ranges::any_of(arguments, isModel) &&
                                std::ranges::none_of(arguments, isCommand))) {
    arguments.insert(arguments.begin(), "view");
  }
  return arguments;
}

}  // namespace glint
