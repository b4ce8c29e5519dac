#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "glint/gl/context.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"

namespace glint {

Command addBackends(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "backends", "list the GL backends: which work here, and why the others do not");
  command->footer(examples({"backends", "backends --json -"}));
  auto json = std::make_shared<std::string>();
  addOption(*command, "--json", *json, "FILE", "write the list as JSON; - is stdout");
  return [json] {
    bool any = false;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const BackendReport& report : probeBackends()) {
      any = any || report.works;
      const std::string name = backendName(report.backend);
      list.push_back({{"name", name}, {"works", report.works}, {"detail", report.detail}});
      if (*json != "-")
        std::cout << name << std::string(14 - name.size(), ' ')
                  << (report.works ? "works  " : "no     ") << report.detail << "\n";
    }
    if (!json->empty()) writeText(*json, list.dump(2) + "\n");
    return any ? done : noContext;
  };
}

}  // namespace glint
