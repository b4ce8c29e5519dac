#include <nlohmann/json.hpp>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/json_text.h"
#include "glint/image/read_image.h"
#include "glint/options/look_options.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

// A JSON value as the text that its option would take: numbers, true and false, words, and lists of
// numbers joined by commas. One parser then serves look files and the command line.
std::string optionText(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_unsigned()) return std::to_string(value.get<std::uint64_t>());
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) return numberText(value.get<double>());
  if (value.is_array()) {
    std::string text;
    for (const Json& each : value) {
      if (!each.is_number()) throw InputError("a list with a value that is not a number");
      text += (text.empty() ? "" : ",") + optionText(each);
    }
    return text;
  }
  throw InputError("a value of the wrong type");
}

void readMaterials(Look& look, const Json& value) {
  if (!value.is_object()) throw InputError("must be an object of materials by name");
  for (const auto& [name, edits] : value.items()) {
    if (!edits.is_object()) throw InputError("material '" + name + "' must be an object");
    for (const auto& [key, each] : edits.items())
      setMaterialEdit(look, name, key, optionText(each));
  }
}

Json parsedLook(const std::string& text, const std::string& source) {
  std::string fault;
  std::optional<Json> json = parseJsonText<Json>(text, fault);
  if (!json) throw InputError(source + ": not a look file: " + fault);
  if (!json->is_object()) throw InputError(source + ": not a look file: it must be a JSON object");
  return std::move(*json);
}

void checkVersion(const Json& json, const std::string& source) {
  if (json.value("glint-look", Json()) != Json(1))
    throw InputError(source + ": not a look file of this version: it must hold \"glint-look\": 1");
}

void setKeys(Look& look, const Json& json, const std::string& source) {
  const bool orthographic = json.value("camera-orthographic", Json()) == Json(true);
  if (json.contains("camera-intrinsics") && (orthographic || json.contains("camera-view-angle")))
    throw InputError(source + ": \"camera-intrinsics\" and \"" +
                     (orthographic ? "camera-orthographic" : "camera-view-angle") +
                     "\": give one of them");
  for (const auto& [key, value] : json.items()) {
    if (key == "glint-look") continue;
    const auto parameters = lookParameters();
    const auto p =
        std::find_if(parameters.begin(), parameters.end(),
                     [&, &name = key](const Parameter& each) { return each.name == name; });
    if (p == parameters.end())
      throw InputError(source + ": unknown key \"" + key + "\": see glint render --help for names");
    try {
      if (key == "material") {
        readMaterials(look, value);
      } else if (p->repeatable) {
        if (!value.is_array()) throw InputError("must be a list");
        if (key == "light") look.light.emplace();
        for (const Json& each : value) p->read(look, optionText(each));
      } else {
        p->read(look, optionText(value));
      }
    } catch (const InputError& error) {
      throw InputError(source + ": \"" + key + "\": " + error.what());
    }
  }
}

}  // namespace

void readLook(Look& look, const std::string& text, const std::string& source) {
  const Json json = parsedLook(text, source);
  checkVersion(json, source);
  setKeys(look, json, source);
}

void readLookOver(Look& look, const std::string& text, const std::string& source) {
  const Json json = parsedLook(text, source);
  if (json.contains("glint-look")) checkVersion(json, source);
  Look over = look;
  over.material.clear();
  setKeys(over, json, source);
  if (json.contains("light") && !json.contains("no-lights")) over.noLights = false;
  if (json.contains("environment") && !json.contains("hdri-file")) over.hdriFile.clear();
  const Look materials = over;
  over.material = look.material;
  mergeMaterials(over, materials);
  look = std::move(over);
}

std::string lookTextIn(const std::string& path) {
  const auto bytes = readFile(path);
  if (!mayHoldText(bytes))
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto texts = pictureTextIn(bytes, path);
  const auto found = texts.find("glint-look");
  if (found == texts.end())
    throw InputError(path +
                     ": a picture without a stored look: give a look file, or a PNG or EXR that "
                     "glint has written");
  return found->second;
}

void readLookFile(Look& look, const std::string& path) { readLook(look, lookTextIn(path), path); }

std::string saveLook(const Look& look) {
  Json json{{"glint-look", 1}};
  for (const Parameter& p : lookParameters()) {
    const Json value = p.save(look);
    if (!value.is_null()) json[p.name] = value;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace glint
