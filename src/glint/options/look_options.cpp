#include "glint/options/look_options.h"

#include <deque>
#include <memory>
#include <nlohmann/json.hpp>

#include "glint/options/add_option.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"

namespace glint {
namespace {

std::string defaultText(const Parameter& p) {
  const auto value = p.save(Look{});
  if (value.is_null() || value == false) return {};
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
  if (p.name == "background-color") text = "#333333";
  return " [default: " + text + "]";
}

bool hasBudget(const Look& look) {
  return look.maxError.has_value() || look.shading == Shading::automatic;
}

}  // namespace

struct LookOptions {
  std::vector<std::pair<const Parameter*, CLI::Option*>> options;
  std::deque<std::vector<std::string>> texts;  // CLI11's storage; values are read through results()
  std::string lookFile, saveFile;
};

LookSource addLookOptions(CLI::App& app) {
  auto state = std::make_shared<LookOptions>();
  for (const Parameter& p : lookParameters()) {
    CLI::Option* option = nullptr;
    if (p.value.empty()) {
      option = app.add_flag("--" + p.name, p.help);
    } else {
      option = app.add_option("--" + p.name, state->texts.emplace_back(), p.help + defaultText(p));
      option->type_name(p.value);
      option->expected(1)->allow_extra_args(false);
      if (p.repeatable)
        option->take_all();
      else
        option->take_last();
    }
    option->group(p.section);
    state->options.emplace_back(&p, option);
  }
  addOption(app, "--look", state->lookFile, "FILE",
            "start from the look in this file (JSON), or from the look stored in a picture that "
            "glint has drawn (PNG or EXR); options on the command line override it")
      ->group("Looks");
  addOption(app, "--save-look", state->saveFile, "FILE", "write the look to this file; - is stdout")
      ->group("Looks");
  return LookSource(state);
}

Look LookSource::operator()(const Look& defaults) const {
  std::vector<std::pair<std::string, std::string>> given;
  if (!options_->lookFile.empty()) given.emplace_back("look", options_->lookFile);
  for (const auto& [p, option] : options_->options) {
    if (option->count() == 0) continue;
    for (const std::string& text : option->results()) given.emplace_back(p->name, text);
  }
  const Look look = lookFrom(given, defaults);
  if (!options_->saveFile.empty() && !hasBudget(look))
    writeText(options_->saveFile, saveLook(look));
  return look;
}

const std::string& LookSource::saveFile() const { return options_->saveFile; }

bool LookSource::savesResolved(const Look& look) const {
  return !options_->saveFile.empty() && hasBudget(look);
}

void LookSource::saveResolved(const Look& resolved) const {
  writeText(options_->saveFile, saveLook(resolved));
}

}  // namespace glint
