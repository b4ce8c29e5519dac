#include "glint/options/help_json.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "glint/options/parameters.h"

namespace glint {
namespace {

using HelpJson = nlohmann::ordered_json;

HelpJson describe(const CLI::Option& option) {
  const bool positional = option.get_positional();
  HelpJson names = HelpJson::array();
  if (positional) {
    names.push_back(option.get_name(true));
  } else {
    for (const std::string& each : option.get_snames()) names.push_back("-" + each);
    for (const std::string& each : option.get_lnames()) names.push_back("--" + each);
  }
  const bool flag = !positional && option.get_items_expected_max() == 0;
  const std::string value = positional ? option.get_name(true) : option.get_type_name();
  HelpJson result = {{"names", names},
                     {"value", flag ? std::string() : value},
                     {"help", option.get_description()},
                     {"section", option.get_group()},
                     {"required", option.get_required()},
                     {"many", positional && option.get_items_expected_max() > 1},
                     {"look", option.get_group() == "Looks"}};
  const auto all = lookParameters();
  const auto known = std::ranges::find_if(all, [&](const Parameter& each) {
    return names[0] == "--" + each.name && option.get_group() == each.section;
  });
  if (known == all.end()) return result;
  result["look"] = true;
  if (known->kind == ParameterKind::choice) result["choices"] = known->choices();
  return result;
}

HelpJson describe(const CLI::App& app) {
  HelpJson result = {{"name", app.get_name()},
                     {"description", app.get_description()},
                     {"footer", app.get_footer()},
                     {"arguments", HelpJson::array()},
                     {"options", HelpJson::array()}};
  // By section, as in the help.
  for (const std::string& group : app.get_groups())
    for (const CLI::Option* option : app.get_options())
      if (option->get_group() == group)
        result[option->get_positional() ? "arguments" : "options"].push_back(describe(*option));
  HelpJson commands = HelpJson::array();
  for (const CLI::App* each : app.get_subcommands({})) commands.push_back(describe(*each));
  if (!commands.empty()) result["commands"] = commands;
  return result;
}

}  // namespace

std::string helpJson(const CLI::App& app) { return describe(app).dump(2) + "\n"; }

}  // namespace glint
