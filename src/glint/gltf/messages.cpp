#include "glint/gltf/messages.h"

#include <utility>

#include "glint/image/error.h"

namespace glint::gltf {
namespace {

constexpr std::size_t maxWarnings = 100;

/// The length of the UTF-8 sequence at the front of `text`, 0 where there is none or where it is a
/// control character (U+0080 to U+009F included).
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                             : first >= 0xe0 && first <= 0xef ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool tooLong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool surrogate = first == 0xed && byte(1) >= 0xa0;
  const bool beyond = first == 0xf4 && byte(1) >= 0x90;
  const bool control = first == 0xc2 && byte(1) < 0xa0;
  return tooLong || surrogate || beyond || control ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    if (line.size() + length > limit) return line + "...";
    if (length == 0) {
      line += '?';
      text.remove_prefix(1);
    } else {
      line += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return line;
}

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
