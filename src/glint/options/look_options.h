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
  /// The look that they add up to (options over look file over `defaults`). Writes the --save-look
  /// file, unless the look has an error budget, since its forms then depend on the scene.
  Look operator()(const Look& defaults = {}) const;
  /// The --save-look file; empty if none.
  const std::string& saveFile() const;
  /// Whether --save-look has to wait until the forms are chosen.
  bool savesResolved(const Look&) const;
  /// Writes the file in that case.
  void saveResolved(const Look& resolved) const;

 private:
  std::shared_ptr<LookOptions> options_;
};

/// Adds the options of the look's parameter table, plus --look and --save-look.
LookSource addLookOptions(CLI::App&);

}  // namespace glint
