#include "glint/gltf/json.h"

#include <cassert>
#include <cmath>

#include "glint/image/json_text.h"

namespace glint::gltf {

Json parseJson(std::string_view text, const Messages& messages) {
  std::string error;
  std::optional<Json> json = parseJsonText<Json>(text, error);
  if (!json) messages.fail(error);
  if (!json->is_object()) messages.fail("its JSON is not an object", "give a glTF 2.0 file");
  return std::move(*json);
}

Cursor Cursor::step(Json* json, Step step) const {
  assert(depth_ < steps_.size());
  Cursor next = *this;
  next.json_ = json;
  next.steps_[next.depth_++] = step;
  return next;
}

Cursor Cursor::member(const char* key) const {
  if (!exists()) return step(nullptr, {key, 0});
  checkObject();
  const auto found = json_->find(key);
  return step(found == json_->end() ? nullptr : &*found, {key, 0});
}

Cursor Cursor::required(const char* key) const {
  Cursor found = member(key);
  if (!found.exists()) found.fail("is missing");
  return found;
}

Cursor Cursor::item(std::size_t i) const { return step(&(*json_)[i], {nullptr, i}); }

std::size_t Cursor::size() const {
  if (!exists()) return 0;
  if (!json_->is_array()) expected("an array");
  return json_->size();
}

std::int64_t Cursor::integer(std::int64_t fallback, std::int64_t low, std::int64_t high) const {
  if (!exists()) return fallback;
  if (json_->is_number_float()) {
    const double value = json_->get<double>();
    if (std::abs(value) < 0x1p53 && value == std::floor(value)) {
      if (value >= 0) {
        *json_ = static_cast<std::uint64_t>(value);
      } else {
        *json_ = static_cast<std::int64_t>(value);
      }
    }
  }
  const bool known = json_->is_number_unsigned()
                         ? json_->get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX)
                         : json_->is_number_integer();
  const std::int64_t value = known ? json_->get<std::int64_t>() : 0;
  if (!known || value < low || value > high) {
    expected("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return value;
}

int Cursor::index(std::size_t count) const {
  if (!exists()) return -1;
  if (count == 0) fail("refers to something that the file does not have");
  return static_cast<int>(integer(-1, 0, static_cast<std::int64_t>(count) - 1));
}

double Cursor::number(double fallback) const {
  if (!exists()) return fallback;
  if (!json_->is_number()) expected("a number");
  return json_->get<double>();
}

bool Cursor::boolean(bool fallback) const {
  if (!exists()) return fallback;
  if (!json_->is_boolean()) expected("true or false");
  return json_->get<bool>();
}

std::string Cursor::text(const std::string& fallback) const {
  if (!exists()) return fallback;
  if (!json_->is_string()) expected("text");
  return json_->get<std::string>();
}

void Cursor::checkNumbers(std::size_t count) const {
  if (!exists()) return;
  bool good = json_->is_array() && (count == 0 || json_->size() == count);
  if (good) {
    for (const Json& value : *json_) good = good && value.is_number();
  }
  if (!good) {
    expected(count == 0 ? "an array of numbers"
                        : "an array of " + std::to_string(count) + " numbers");
  }
}

void Cursor::checkObject() const {
  if (exists() && !json_->is_object()) expected("an object");
}

std::string Cursor::name() const {
  if (!exists() || !json_->is_object()) return {};
  const auto found = json_->find("name");
  return found != json_->end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string Cursor::path() const {
  std::string path;
  for (std::size_t i = 0; i < depth_; ++i) {
    if (steps_[i].key) {
      if (i > 0) path += '.';
      path += printable(steps_[i].key, 60);
    } else {
      path += '[' + std::to_string(steps_[i].index) + ']';
    }
  }
  return path.empty() ? "the root" : path;
}

void Cursor::fail(const std::string& what) const { messages_->fail(path() + " " + what); }

void Cursor::expected(const std::string& what) const {
  std::string found = json_->type_name();
  if (json_->is_primitive()) found = printable(json_->dump(), 40);
  fail("must be " + what + ", not " + found);
}

}  // namespace glint::gltf
