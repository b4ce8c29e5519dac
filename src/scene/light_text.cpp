#include "glint/scene/light_text.h"

#include "glint/image/error.h"
#include "glint/scene/look_text.h"

namespace glint {
namespace {

constexpr std::string_view word = "falloff";

}  // namespace

Light readLight(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string last = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (!last.starts_with(word)) return parseLight(text);
  const std::string rest = last.substr(word.size());
  Light light = parseLight(text.substr(0, colon));
  if (light.type != Light::Type::point && light.type != Light::Type::spot)
    throw InputError("--light: '" + text + "': only points and spots fall off: leave '" + last +
                     "' out");
  if (!rest.empty() && rest[0] != ',')
    throw InputError("--light: '" + last + "' is unknown: use falloff or falloff,RANGE");
  light.fallsOff = true;
  if (!rest.empty()) light.range = parseNumber(rest.substr(1), 0, 1e30, "--light");
  return light;
}

std::string writeLight(const Light& light) {
  std::string text = lightText(light);
  if (!light.fallsOff) return text;
  text += ":" + std::string(word);
  return light.range > 0 ? text + "," + numberText(light.range) : text;
}

}  // namespace glint
