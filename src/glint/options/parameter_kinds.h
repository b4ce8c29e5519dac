#pragma once

// The kinds of rows in the parameter table (parameters.cpp). Each takes the member of Look that it
// reads and saves.

#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"

namespace glint::kinds {

using Json = nlohmann::ordered_json;

inline Json toJson(double v) { return Json(v); }
inline Json toJson(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

template <typename Value>
void finish(Parameter& p, ParameterKind kind, Value Look::*member) {
  p.kind = kind;
  p.reset = [=](Look& look) { look.*member = Look{}.*member; };
}

inline Parameter parameter(std::string name, std::string value, std::string help,
                           std::function<void(Look&, const std::string&)> read,
                           std::function<Json(const Look&)> save, double min = 0, double max = 0) {
  return {std::move(name), {}, std::move(value), std::move(help), false, min, max, std::move(read),
          std::move(save)};
}

template <typename Type>
const Type* given(const Type& value) {
  return &value;
}
template <typename Type>
const Type* given(const std::optional<Type>& value) {
  return value ? &*value : nullptr;
}

inline std::string textOf(double value) { return numberText(value); }
inline std::string textOf(const glm::dvec3& v) {
  return numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
}

inline bool within(double value, double min, double max) { return value >= min && value <= max; }
inline bool within(const glm::dvec3& v, double min, double max) {
  return within(v.x, min, max) && within(v.y, min, max) && within(v.z, min, max);
}

// A row for one number or three, each from `min` to `max`; Member is Value or std::optional<Value>.
// `parse` throws if a text is not such a value; setting a value out of range gives the same error
// as its text.
template <typename Value, typename Member>
Parameter numbers(ParameterKind kind, const std::string& name, const std::string& value,
                  const std::string& help, double min, double max, Member Look::*member,
                  std::function<Value(const std::string&)> parse) {
  Parameter p = parameter(
      name, value, help, [=](Look& look, const std::string& text) { look.*member = parse(text); },
      [=](const Look& look) {
        const Value* now = given(look.*member);
        return now ? toJson(*now) : Json();
      },
      min, max);
  p.get = [=](const Look& look) {
    const Value* now = given(look.*member);
    return now ? ParameterValue(*now) : ParameterValue();
  };
  p.set = [=](Look& look, const ParameterValue& value) {
    const Value& now = std::get<Value>(value);
    const bool fits =
        within(now, min, max) && (kind != ParameterKind::direction || now != Value(0.0));
    look.*member = fits ? now : parse(textOf(now));
  };
  finish(p, kind, member);
  return p;
}

template <typename Member>
Parameter number(const std::string& name, const std::string& unit, double min, double max,
                 Member Look::*member, const std::string& help) {
  Parameter p = numbers<double>(
      ParameterKind::number, name, unit, help, min, max, member,
      [=](const std::string& text) { return parseNumber(text, min, max, "--" + name); });
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
  p.get = [=](const Look& look) { return ParameterValue(look.*member); };
  p.set = [=](Look& look, const ParameterValue& value) { look.*member = std::get<bool>(value); };
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
  p.get = [=](const Look& look) { return ParameterValue(std::size_t(look.*member)); };
  p.set = [=](Look& look, const ParameterValue& value) {
    look.*member = Enum(std::get<std::size_t>(value));
  };
  finish(p, ParameterKind::choice, member);
  return p;
}

inline Parameter vector(const std::string& name, double limit,
                        std::optional<glm::dvec3> Look::*member, const std::string& help) {
  return numbers<glm::dvec3>(
      ParameterKind::vector, name, "x,y,z", help, -limit, limit, member,
      [=](const std::string& text) { return parseVector(text, -limit, limit, "--" + name); });
}

inline Parameter direction(const std::string& name, std::optional<glm::dvec3> Look::*member,
                           const std::string& help) {
  return numbers<glm::dvec3>(
      ParameterKind::direction, name, "x,y,z", help, -1e6, 1e6, member,
      [=](const std::string& text) {
        const glm::dvec3 v = parseVector(text, -1e6, 1e6, "--" + name);
        if (v == glm::dvec3(0.0))
          throw InputError("--" + name + ": '" + text +
                           "' has no direction: give a vector other than 0,0,0");
        return v;
      });
}

inline Parameter color(const std::string& name, glm::dvec3 Look::*member, const std::string& help) {
  return numbers<glm::dvec3>(
      ParameterKind::color, name, "r,g,b|#rrggbb", help, 0, 1e6, member,
      [=](const std::string& text) { return parseColor(text, "--" + name); });
}

inline Parameter slider(Parameter p, double min, double max, bool logarithmic, double unset = 0,
                        std::string_view symbol = {}) {
  p.slider = {min, max, logarithmic};
  p.unset = unset;
  p.symbol = symbol;
  return p;
}

// A choice that is also a switch: its name alone, or true, means `on`, and false means `off`.
inline Parameter switchable(Parameter p, const std::string& off, const std::string& on) {
  p.words = p.choices();
  p.value.clear();
  p.read = [=, read = std::move(p.read)](Look& look, const std::string& text) {
    read(look, text == "true" ? on : text == "false" ? off : text);
  };
  return p;
}

// A row with a side effect when it is set.
inline Parameter then(Parameter p, void (*follow)(Look&)) {
  p.read = [=, read = std::move(p.read)](Look& look, const std::string& text) {
    read(look, text);
    follow(look);
  };
  p.set = [=, set = std::move(p.set)](Look& look, const ParameterValue& value) {
    set(look, value);
    follow(look);
  };
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

// A row of text, of which an empty one is none.
inline Parameter text(const std::string& name, const std::string& value, std::string Look::*member,
                      const std::string& help) {
  const auto read = [=](Look& look, const std::string& given) {
    if (given.empty())
      throw InputError("--" + name + ": '' is empty: give a value or leave the option out");
    look.*member = given;
  };
  const auto save = [=](const Look& look) {
    return (look.*member).empty() ? Json() : Json(look.*member);
  };
  return resetting(custom(name, value, help, read, save), member);
}

}  // namespace glint::kinds
