#pragma once

#include <memory>
#include <string>

#include "glint/scene/look.h"

namespace CLI {
class App;
}

namespace glint {

struct LookOptions;

/// The options of a look, after parsing.
class LookSource {
 public:
  explicit LookSource(std::shared_ptr<LookOptions> options) : options_(std::move(options)) {}
  /// The look they add up to (options over look file over defaults). Writes the file of
  /// --save-look, unless the look has a budget, whose forms a scene decides.
  Look operator()() const;
  /// The file of --save-look, empty if none.
  const std::string& saveFile() const;
  /// Whether --save-look waits for the forms to be chosen.
  bool savesResolved(const Look&) const;
  /// Writes it then.
  void saveResolved(const Look& resolved) const;

 private:
  std::shared_ptr<LookOptions> options_;
};

/// Adds the options of the look, from its table, with --look and --save-look.
LookSource addLookOptions(CLI::App&);

}  // namespace glint
