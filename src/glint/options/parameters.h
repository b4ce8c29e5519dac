#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/material_parameters.h"

namespace glint {

/// How a panel edits a parameter.
enum class ParameterKind {
  number,     ///< a slider
  flag,       ///< a tick
  choice,     ///< one of Parameter::choices()
  vector,     ///< three numbers
  direction,  ///< three numbers, not all zero
  color,      ///< linear
  text,       ///< the option's text
};

/// What a parameter is set to, in the type of its kind: a number, a tick, the place of a choice's
/// word among Parameter::choices(), or three numbers. Empty where a look leaves it open.
using ParameterValue = std::variant<std::monostate, double, bool, std::size_t, glm::dvec3>;

/// One parameter of a look. This table is the only place that knows a parameter's name, unit,
/// range, default and help: command line, look files, help and panel are made from it.
struct Parameter {
  std::string name;     ///< of the option and of the key in a look file
  std::string section;  ///< heading in help and panel
  /// What stands for the value in help, such as "x,y,z"; empty for a flag and for a choice whose
  /// name alone says one (--name, or --name=WORD).
  std::string value;
  std::string help;
  bool repeatable = false;
  double min = 0.0, max = 0.0;  ///< of numbers and of each component; both 0 if it has none
  /// Reads the option's text into a look; throws InputError saying what is expected. Of a
  /// repeatable parameter each call adds one.
  std::function<void(Look&, const std::string& text)> read;
  /// The value for a look file; null where the look leaves it open.
  std::function<nlohmann::ordered_json(const Look&)> save;
  ParameterKind kind = ParameterKind::text;
  /// The value itself, without its text; not of the kind text, nor of highlight, whose forms may
  /// be several words. `set` throws what `read` would of the value's text; it takes no empty value.
  std::function<ParameterValue(const Look&)> get = {};
  std::function<void(Look&, const ParameterValue&)> set = {};
  SliderRange slider = {};       ///< of a number
  double unset = 0.0;            ///< of a number that a look may leave open: what stands then
  std::string_view symbol = {};  ///< in docs/science.md; empty if none
  /// Sets the default in a look.
  std::function<void(Look&)> reset = {};
  std::vector<std::string> words = {};  ///< of a choice, where `value` does not list them all

  /// The words of a choice: `words`, or those of `value`.
  std::vector<std::string> choices() const;
};

/// All parameters of a look, in the order of help.
std::span<const Parameter> lookParameters();

/// Sets one parameter by its option's name and text; throws InputError as the option does.
void setParameter(Look&, std::string_view name, const std::string& text);

/// Sets in `look` what a look file's text holds. Unknown keys and wrong types are InputErrors that
/// name `source`.
void readLook(Look& look, const std::string& json, const std::string& source);

/// What a look file's text holds beats all that `look` says, as options on the command line do: its
/// lights those of the file, a material of all those by name. The key "glint-look" may be missing.
void readLookOver(Look& look, const std::string& json, const std::string& source);

/// The look that options add up to, by their names without "--" and their texts: each beats those
/// of its name before it, but that lights and materials add up; "look" is a look file, which stands
/// below all others, in whatever place. Throws InputError, also where two of them contradict each
/// other.
Look lookFrom(const std::vector<std::pair<std::string, std::string>>& options);

/// Gives the look the options' materials, which beat its own also where the look speaks of one
/// material and the option of all.
void mergeMaterials(Look& look, const Look& options);

/// The text of a look in a look file, or in a picture (PNG or EXR) that glint has written.
/// Throws InputError if the file cannot be read or holds no look.
std::string lookTextIn(const std::string& path);

/// readLook() of a look file, or from a picture (PNG or EXR) that glint has written.
/// Throws InputError if the file cannot be read or holds no look.
void readLookFile(Look& look, const std::string& path);

/// The text of a look file that gives the same look again.
std::string saveLook(const Look&);

}  // namespace glint
