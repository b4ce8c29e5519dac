#include "look_merge.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "glint/image/json_text.h"
#include "glint/options/parameters.h"

namespace glint::viewer {
namespace {

using Json = nlohmann::ordered_json;

// Copies members that differ between `mine` and `base` from `mine`; recurses into objects.
void keepEdits(const Json& mine, const Json& base, Json& into) {
  const auto member = [](const Json& from, const std::string& key) {
    const auto found = from.is_object() ? from.find(key) : from.end();
    return from.is_object() && found != from.end() ? *found : Json();
  };
  std::set<std::string> keys;
  for (const Json* each : {&mine, &base})
    if (each->is_object())
      for (auto it = each->begin(); it != each->end(); ++it) keys.insert(it.key());
  for (const std::string& key : keys) {
    const Json edited = member(mine, key), before = member(base, key);
    if (edited == before) continue;
    if (!into.is_object()) into = Json::object();
    if (edited.is_object() || before.is_object()) {
      Json part = member(into, key);
      keepEdits(edited, before, part);
      into[key] = part;
    } else {
      into[key] = edited;
    }
    const Json& now = into[key];
    if (now.is_null() || (now.is_object() && now.empty())) into.erase(key);
  }
}

}  // namespace

Look mergedLook(const Look& mine, const Look& base, const Look& theirs) {
  Json all = parsedJson<Json>(saveLook(theirs));
  keepEdits(parsedJson<Json>(saveLook(mine)), parsedJson<Json>(saveLook(base)), all);
  Look look;
  readLook(look, all.dump(), "the look");
  return look;
}

}  // namespace glint::viewer
