#include "glint/options/look_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>

#include "glint/budget/cost_file.h"
#include "glint/image/error.h"
#include "glint/image/read_files.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"
#include "glint/scene/material_key.h"

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

/// Takes back what `by` sets.
void clearEdit(MaterialEdit& edit, const MaterialEdit& by) {
  forEachEdit([&](auto part) {
    if (by.*part) (edit.*part).reset();
  });
}

bool hasBudget(const Look& look) {
  return look.maxError.has_value() || look.shading == Shading::automatic;
}

}  // namespace

struct LookOptions {
  std::vector<std::pair<const Parameter*, CLI::Option*>> options;
  std::deque<std::vector<std::string>> texts;  // what CLI11 stores; results() is what is read
  std::string lookFile, saveFile;
};

void mergeMaterials(Look& look, const Look& options) {
  const auto all = options.material.find("");
  if (all != options.material.end())
    for (auto& [key, edit] : look.material) clearEdit(edit, all->second);
  for (const auto& [key, from] : options.material) {
    // What is said of all of a name stands above what the look says of one of them.
    for (auto& [other, edit] : look.material)
      if (!key.empty() && other.starts_with(key + "#")) clearEdit(edit, from);
    mergeEdit(look.material[key], from);
  }
  std::erase_if(look.material, [](const auto& each) { return each.second == MaterialEdit{}; });
}

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
  app.add_option(
         "--look", state->lookFile,
         "start from the look in this file (JSON), or from that stored in a picture drawn by glint "
         "(PNG or EXR); options on the command line change it")
      ->type_name("FILE")
      ->group("Looks");
  app.add_option("--save-look", state->saveFile, "write the look to this file; - is stdout")
      ->type_name("FILE")
      ->group("Looks");
  return LookSource(state);
}

Look LookSource::operator()() const {
  Look look;
  if (!options_->lookFile.empty()) readLookFile(look, options_->lookFile);
  Look materials;
  const auto given = [&](const char* name) {
    return std::ranges::any_of(options_->options, [&](const auto& each) {
      return each.first->name == name && each.second->count() > 0;
    });
  };
  for (const auto& [one, other] :
       {std::pair("light", "no-lights"), std::pair("camera-intrinsics", "camera-view-angle"),
        std::pair("camera-intrinsics", "camera-orthographic")})
    if (given(one) && given(other))
      throw InputError("--" + std::string(one) + " and --" + other + ": give one of them");
  for (const auto& [p, option] : options_->options) {
    if (option->count() == 0) continue;
    if (p->name == "light") {  // in place of the file's, and of its having none
      look.light.reset();
      look.noLights = false;
    }
    if (p->name == "environment") look.hdriFile.clear();
    Look& target = p->name == "material" ? materials : look;
    for (const std::string& text : option->results()) p->read(target, text);
  }
  mergeMaterials(look, materials);
  if (!look.hdriFile.empty()) noteReadFile(look.hdriFile);
  costTableFor(look);  // so that a broken one is told at once, and where nothing is chosen, too
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
