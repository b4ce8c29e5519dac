#pragma once

// The kinds of rows that the table of parameters is made of (parameters.cpp). Each takes the member
// of Look that it reads and saves.

#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"

namespace glint::kinds {

using Json = nlohmann::ordered_json;

inline Json toJson(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

template <typename Value>
void finish(Parameter& p, ParameterKind kind, Value Look::*member) {
  p.kind = kind;
  p.reset = [=](Look& look) { look.*member = Look{}.*member; };
}

template <typename Value>
Json toJson(const std::optional<Value>& v) {
  if (!v) return Json();
  if constexpr (std::is_same_v<Value, glm::dvec3>)
    return toJson(*v);
  else
    return Json(*v);
}

inline Parameter parameter(std::string name, std::string value, std::string help,
                           std::function<void(Look&, const std::string&)> read,
                           std::function<Json(const Look&)> save, double min = 0, double max = 0) {
  return {std::move(name), {}, std::move(value), std::move(help), false, min, max, std::move(read),
          std::move(save)};
}

// Value is double or std::optional<double>.
template <typename Value>
Parameter number(std::string name, std::string unit, double min, double max, Value Look::*member,
                 std::string help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseNumber(text, min, max, "--" + name);
  };
  auto save = [=](const Look& look) { return Json(toJson(std::optional(look.*member))); };
  Parameter p = parameter(name, unit, help, read, save, min, max);
  finish(p, ParameterKind::number, member);
  p.slider = {min, max, false};
  return p;
}

inline Parameter flag(const std::string& name, bool Look::*member, const std::string& help) {
  auto read = [=](Look& look, const std::string& text) {
    if (text != "true" && text != "false")
      throw InputError("--" + name + ": '" + text + "' is not true or false");
    look.*member = text == "true";
  };
  Parameter p =
      parameter(name, {}, help, read, [=](const Look& look) { return Json(look.*member); });
  finish(p, ParameterKind::flag, member);
  return p;
}

template <typename Enum>
Parameter choice(const std::string& name, std::span<const std::string_view> names,
                 Enum Look::*member, const std::string& help) {
  std::string value;
  for (const auto& each : names) value += (value.empty() ? "" : "|") + std::string(each);
  auto read = [=](Look& look, const std::string& text) {
    look.*member = Enum(parseChoice(text, names, "--" + name));
  };
  Parameter p = parameter(name, value, help, read,
                          [=](const Look& look) { return Json(names[std::size_t(look.*member)]); });
  finish(p, ParameterKind::choice, member);
  return p;
}

inline Parameter vector(const std::string& name, double limit,
                        std::optional<glm::dvec3> Look::*member, const std::string& help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseVector(text, -limit, limit, "--" + name);
  };
  Parameter p = parameter(
      name, "x,y,z", help, read, [=](const Look& look) { return toJson(look.*member); }, -limit,
      limit);
  finish(p, ParameterKind::vector, member);
  return p;
}

inline Parameter direction(const std::string& name, std::optional<glm::dvec3> Look::*member,
                           const std::string& help) {
  Parameter p = vector(name, 1e6, member, help);
  p.kind = ParameterKind::direction;
  p.read = [read = p.read, name = p.name, member](Look& look, const std::string& text) {
    read(look, text);
    if (*(look.*member) == glm::dvec3(0.0))
      throw InputError("--" + name + ": '" + text + "' has no direction: give another than 0,0,0");
  };
  return p;
}

inline Parameter color(const std::string& name, glm::dvec3 Look::*member, const std::string& help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseColor(text, "--" + name);
  };
  Parameter p = parameter(
      name, "r,g,b|#rrggbb", help, read, [=](const Look& look) { return toJson(look.*member); }, 0,
      1e6);
  finish(p, ParameterKind::color, member);
  return p;
}

inline Parameter slider(Parameter p, double min, double max, bool logarithmic, double unset = 0,
                        std::string_view symbol = {}) {
  p.slider = {min, max, logarithmic};
  p.unset = unset;
  p.symbol = symbol;
  return p;
}

inline Parameter custom(std::string name, std::string value, std::string help,
                        std::function<void(Look&, const std::string&)> read,
                        std::function<Json(const Look&)> save) {
  return parameter(std::move(name), std::move(value), std::move(help), std::move(read),
                   std::move(save));
}

template <typename Value>
Parameter resetting(Parameter p, Value Look::*member) {
  finish(p, ParameterKind::text, member);
  return p;
}

}  // namespace glint::kinds
