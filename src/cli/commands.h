#pragma once

#include <functional>
#include <memory>
#include <string>

#include "glint/scene/look.h"

namespace CLI {
class App;
}

namespace glint {

/// Status codes of the program, for scripts.
enum ExitStatus : int { done = 0, differs = 1, unusable = 2, noContext = 3, noBaseline = 4 };

/// Each adds a subcommand to the program; the returned function runs it after parsing and gives the
/// exit status. Errors are exceptions.
using Command = std::function<int()>;
Command addRender(CLI::App&);
Command addView(CLI::App&);
Command addDiff(CLI::App&);
Command addStudy(CLI::App&);
Command addConvert(CLI::App&);
Command addInfo(CLI::App&);
Command addStability(CLI::App&);
Command addBackends(CLI::App&);
Command addEnvironment(CLI::App&);

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

/// Gives the look the options' materials, which beat its own also where the look speaks of one
/// material and the option of all.
void mergeMaterials(Look& look, const Look& options);

/// Writes text to a file, or to stdout for "-".
void writeText(const std::string& path, const std::string& text);

/// "glint: warning: TEXT" on stderr, one line.
void printWarning(const std::string& text);

}  // namespace glint
