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
  flag,       ///< a checkbox
  choice,     ///< one of Parameter::choices()
  vector,     ///< three numbers
  direction,  ///< three numbers, not all zero
  color,      ///< linear
  text,       ///< the option's text, edited as it is
};

/// A parameter's value, in the type of its kind: a number, a checkbox's state, an index into
/// Parameter::choices(), or three numbers. Empty if the look leaves it open.
using ParameterValue = std::variant<std::monostate, double, bool, std::size_t, glm::dvec3>;

/// One parameter of a look. A parameter's name, unit, range, default and help are defined only in
/// this table: command line, look files, help and panel are generated from it.
struct Parameter {
  std::string name;     ///< of the option and of the key in a look file
  std::string section;  ///< heading in help and panel
  /// The placeholder for the value in help, such as "x,y,z"; empty for a flag and for a choice that
  /// can be given without a value (--name, or --name=WORD).
  std::string value;
  std::string help;
  bool repeatable = false;
  double min = 0.0, max = 0.0;  ///< for numbers and each component; both 0 if there is no range
  /// Reads the option's text into a look; throws InputError with what is expected. For a repeatable
  /// parameter each call adds one.
  std::function<void(Look&, const std::string& text)> read;
  /// The value for a look file; null if the look leaves it open.
  std::function<nlohmann::ordered_json(const Look&)> save;
  ParameterKind kind = ParameterKind::text;
  /// The value itself rather than its text; not for the kind `text`, nor for highlight, whose forms
  /// may be several words. `set` throws what `read` would throw for the value's text; the value
  /// must not be empty.
  std::function<ParameterValue(const Look&)> get = {};
  std::function<void(Look&, const ParameterValue&)> set = {};
  SliderRange slider = {};       ///< for numbers
  double unset = 0.0;            ///< for numbers that a look may leave open: the value in effect
  std::string_view symbol = {};  ///< in docs/science.md; empty if none
  /// Resets the parameter to its default in a look.
  std::function<void(Look&)> reset = {};
  std::vector<std::string> words = {};  ///< for a choice whose `value` does not list all words

  /// The words of a choice: `words`, or else those in `value`.
  std::vector<std::string> choices() const;
};

/// All parameters of a look, in the order of help.
std::span<const Parameter> lookParameters();

/// Sets one parameter by its option's name and text; throws the same InputError as the option.
void setParameter(Look&, std::string_view name, const std::string& text);

/// Sets in `look` what a look file's text contains. Unknown keys and wrong types are InputErrors
/// that name `source`.
void readLook(Look& look, const std::string& json, const std::string& source);

/// The look file's text overrides everything in `look`, as options on the command line would: its
/// lights replace those of `look`, and an edit of all materials overrides edits by name. The key
/// "glint-look" may be missing.
void readLookOver(Look& look, const std::string& json, const std::string& source);

/// The look that results from options, given by their names without "--" and their texts: later
/// values override earlier ones of the same name, except that lights and materials accumulate.
/// "look" is a look file, which all others override, wherever it comes. What neither sets is that
/// of `defaults`. Throws InputError, also for contradictory options.
Look lookFrom(const std::vector<std::pair<std::string, std::string>>& options,
              const Look& defaults = {});

/// Merges the options' materials into the look. They override its own, even if an option is for all
/// materials and the look's edit for a single one.
void mergeMaterials(Look& look, const Look& options);

/// The text of a look, from a look file or from a picture (PNG or EXR) written by glint.
/// Throws InputError if the file cannot be read or holds no look.
std::string lookTextIn(const std::string& path);

/// readLook() on a look file or a picture (PNG or EXR) written by glint.
/// Throws InputError if the file cannot be read or holds no look.
void readLookFile(Look& look, const std::string& path);

/// The text of a look file that reproduces this look.
std::string saveLook(const Look&);

}  // namespace glint
