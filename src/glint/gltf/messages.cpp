#include "glint/gltf/messages.h"

#include <utility>

#include "glint/image/error.h"

namespace glint::gltf {
namespace {

constexpr std::size_t maxWarnings = 100;

}  // namespace

std::string named(std::string_view kind, std::size_t index, std::string_view name) {
  std::string text = std::string(kind) + "[" + std::to_string(index) + "]";
  if (!name.empty()) text += " \"" + printable(name, 60) + "\"";
  return text;
}

Messages::Messages(const std::filesystem::path& file)
    : file_(file.empty() ? "''" : printable(file.string(), 4096)) {}

void Messages::fail(const std::string& what, const std::string& advice) const {
  throw InputError(file_ + ": " + what + ": " + advice);
}

void Messages::warn(const std::string& what) {
  if (warnings_.size() < maxWarnings) {
    warnings_.push_back(what);
  } else {
    ++leftOut_;
  }
}

std::vector<std::string> Messages::take() {
  if (leftOut_ > 0) {
    warnings_.push_back("and " + std::to_string(leftOut_) + " more warnings");
    leftOut_ = 0;
  }
  return std::exchange(warnings_, {});
}

}  // namespace glint::gltf
