#pragma once

// Looks from the texts of options and of look files.

#include <stdexcept>
#include <string>

#include "glint/options/parameters.h"

namespace glint {
inline void PrintTo(const Look& look, std::ostream* out) { *out << saveLook(look); }
}  // namespace glint

namespace glint::test {

inline const Parameter& parameter(const std::string& name) {
  for (const Parameter& p : lookParameters())
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

inline Look with(const std::string& name, const std::string& text) {
  Look look;
  parameter(name).read(look, text);
  return look;
}

inline Look lookOf(const std::string& json) {
  Look look;
  readLook(look, json, "a.json");
  return look;
}

}  // namespace glint::test
