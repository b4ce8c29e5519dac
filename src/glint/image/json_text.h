#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

// The one way by which JSON text comes into the program. The parser itself does not recurse, but
// whoever copies, compares, hashes, prints or destroys what it gives does, so that deep nesting
// must be refused before.

/// Arrays and objects in one another; no file that is read here needs a quarter of it.
inline constexpr int maxJsonNesting = 64;

/// So many arrays and objects any text may hold, and beyond that one for so many bytes: each takes
/// more than a kilobyte in the end, and one that says anything has a dozen, as {"mesh":10} has.
inline constexpr std::size_t jsonBracketsFree = 1 << 16, jsonBytesForBrackets = 12;

/// Why a text is not read as JSON at all, such as "JSON nested more than 64 deep"; empty if it may
/// be parsed.
std::string jsonRefusal(std::string_view text);

/// A parser's message without its class and number.
std::string jsonErrorText(const std::exception& error);

/// Parses a text into nlohmann's json or ordered_json. Where there is none, `error` says why:
/// "not valid JSON, parse error at line 3, column 7: ...". A byte order mark is passed over.
template <class Json>
std::optional<Json> parseJsonText(std::string_view text, std::string& error) {
  error = jsonRefusal(text);
  if (!error.empty()) return {};
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::exception& failure) {
    error = "not valid JSON, " + jsonErrorText(failure);
    return {};
  }
}

/// The same for text that this program has made itself or has looked through already.
template <class Json>
Json parsedJson(std::string_view text) {
  std::string error;
  auto json = parseJsonText<Json>(text, error);
  return json ? std::move(*json) : Json();
}

}  // namespace glint
