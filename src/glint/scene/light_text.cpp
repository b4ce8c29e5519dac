#include <array>

#include "glint/scene/look_text.h"
#include "glint/scene/text_parts.h"

namespace glint {

using namespace parts;

namespace {

constexpr std::array<std::string_view, 4> lightNames{"directional", "point", "spot", "camera"};

constexpr glm::dvec3 alongView(0, 0, 1);  // the direction to a camera light

Light parseSteadyLight(const std::string& text) {
  const std::string what = "--light";
  const auto parts = split(text, ':');
  Light light;
  // A camera light's direction is part of its name, so that a colour after it keeps its meaning.
  const std::size_t at = parts[0].find('@');
  light.type = Light::Type(parseChoice(parts[0].substr(0, at), lightNames, what));
  if (at != std::string::npos && light.type != Light::Type::camera)
    refuse(what, text, "a light: only camera takes a direction after @ (camera@x,y,z)");
  // The number of fields before the colour, including the type's name.
  const std::size_t fields = std::array<std::size_t, 4>{2, 2, 4, 1}[std::size_t(light.type)];
  if (parts.size() != fields && parts.size() != fields + 1)
    refuse(what, text,
           std::array<const char*, 4>{"directional:x,y,z[:r,g,b]",
                                      "point:x,y,z[:r,g,b][:falloff[,RANGE]]",
                                      "spot:x,y,z:dx,dy,dz:inner,outer[:r,g,b][:falloff[,RANGE]]",
                                      "camera[@x,y,z][:r,g,b]"}[std::size_t(light.type)]);
  if (parts.size() == fields + 1) light.intensity = parseColor(parts[fields], what);
  if (light.type == Light::Type::camera)
    light.direction = at == std::string::npos
                          ? alongView
                          : parseVector(parts[0].substr(at + 1), -1e30, 1e30, what);
  if (light.type == Light::Type::directional)
    light.direction = parseVector(parts[1], -1e30, 1e30, what);
  if (light.type == Light::Type::point || light.type == Light::Type::spot)
    light.position = parseVector(parts[1], -1e30, 1e30, what);
  if (light.type == Light::Type::spot) {
    light.direction = parseVector(parts[2], -1e30, 1e30, what);
    const auto angles = split(parts[3], ',');
    if (angles.size() != 2 || !readAll(angles[0], light.innerAngle) ||
        !readAll(angles[1], light.outerAngle) ||
        !(light.innerAngle >= 0 && light.innerAngle < light.outerAngle && light.outerAngle <= 90))
      refuse(what, parts[3], "inner,outer with 0 <= inner < outer <= 90 degrees");
  }
  if (light.type != Light::Type::point && light.direction == glm::dvec3(0.0))
    throw InputError(what + ": '" + text + "' has no direction: give a vector other than 0,0,0");
  return light;
}

}  // namespace

Light parseLight(const std::string& text) {
  constexpr std::string_view word = "falloff";
  const std::size_t colon = text.rfind(':');
  const std::string last = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (!last.starts_with(word)) return parseSteadyLight(text);
  const std::string rest = last.substr(word.size());
  Light light = parseSteadyLight(text.substr(0, colon));
  if (light.type != Light::Type::point && light.type != Light::Type::spot)
    throw InputError("--light: '" + text + "': only point and spot lights have fall-off: leave '" +
                     last + "' out");
  if (!rest.empty() && rest[0] != ',') refuse("--light", last, "falloff or falloff,RANGE");
  light.fallsOff = true;
  if (!rest.empty()) light.range = parseNumber(rest.substr(1), 0, 1e30, "--light");
  return light;
}

std::string lightText(const Light& light) {
  auto vec = [](const glm::dvec3& v) {
    return ":" + numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
  };
  std::string text(lightNames[std::size_t(light.type)]);
  if (light.type == Light::Type::camera && light.direction != alongView)
    text += vec(light.direction).replace(0, 1, "@");
  if (light.type == Light::Type::point || light.type == Light::Type::spot)
    text += vec(light.position);
  if (light.type == Light::Type::directional || light.type == Light::Type::spot)
    text += vec(light.direction);
  if (light.type == Light::Type::spot)
    text += ":" + numberText(light.innerAngle) + "," + numberText(light.outerAngle);
  text += vec(light.intensity);
  if (!light.fallsOff) return text;
  return text + ":falloff" + (light.range > 0 ? "," + numberText(light.range) : "");
}

}  // namespace glint
