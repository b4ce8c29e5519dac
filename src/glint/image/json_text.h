#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

/// A number, or null for what JSON has no number for: NaN and the infinities.
inline nlohmann::ordered_json jsonNumber(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
}

// All JSON text enters the program through these functions. The parser itself does not recurse, but
// copying, comparing, hashing, printing or destroying its result does, so deep nesting must be
// refused before parsing.

/// Maximum nesting of arrays and objects; no file read here needs a quarter of it.
inline constexpr int maxJsonNesting = 64;

/// Any text may hold up to jsonBracketsFree arrays and objects. A text with more needs at least
/// jsonBytesForBrackets bytes for each: every one takes more than a kilobyte in memory, and one
/// with any content has a dozen bytes, as {"mesh":10} does.
inline constexpr std::size_t jsonBracketsFree = 1 << 16, jsonBytesForBrackets = 12;

/// Why a text is not parsed as JSON at all, such as "JSON nested more than 64 deep"; empty if it
/// may be parsed.
std::string jsonRefusal(std::string_view text);

/// A parser's message without its class and number.
std::string jsonErrorText(const std::exception& error);

/// Parses a text into nlohmann's json or ordered_json. If that fails, `error` gives the reason:
/// "not valid JSON, parse error at line 3, column 7: ...". A byte order mark is skipped.
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

/// The same for text that this program has written itself or has already checked.
template <class Json>
Json parsedJson(std::string_view text) {
  std::string error;
  auto json = parseJsonText<Json>(text, error);
  return json ? std::move(*json) : Json();
}

}  // namespace glint
