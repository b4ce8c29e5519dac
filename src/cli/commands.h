#pragma once

#include <functional>

#include "glint/options/exit_status.h"
#include "glint/options/look_options.h"
#include "glint/options/outputs.h"

namespace CLI {
class App;
}

namespace glint {

/// Each function adds a subcommand to the program. The returned function runs it after parsing and
/// returns the exit status. Errors are exceptions.
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

}  // namespace glint
