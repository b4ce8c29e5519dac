#include "output_names.h"

#include <filesystem>

#include "glint/image/error.h"
#include "stdin_model.h"

namespace glint {
namespace {

std::string padded(std::size_t number, std::size_t count) {
  std::string text = std::to_string(number);
  const std::size_t width = std::to_string(count > 0 ? count - 1 : 999999).size();
  if (text.size() < width) text.insert(0, width - text.size(), '0');
  return text;
}

// The name of the folder that contains a model; empty at the root.
std::string folderOf(const std::string& model) {
  if (isStdin(model)) return "stdin";
  return std::filesystem::absolute(model).lexically_normal().parent_path().filename().string();
}

}  // namespace

OutputPattern::OutputPattern(const std::string& pattern, bool frames) {
  const std::string keys =
      frames ? "use {model}, {folder}, {n} or {frame}" : "use {model}, {folder} or {n}";
  std::string text;
  const auto endText = [&] {
    if (!text.empty()) pieces_.push_back({Piece::Kind::text, text});
    text.clear();
  };
  for (std::size_t i = 0; i < pattern.size();) {
    if (pattern[i] != '{') {
      text += pattern[i++];
      continue;
    }
    const std::size_t end = pattern.find('}', i);
    if (end == std::string::npos) throw InputError("-o " + pattern + ": '{' without '}': " + keys);
    const std::string key = pattern.substr(i + 1, end - i - 1);
    endText();
    if (key == "model")
      pieces_.push_back({Piece::Kind::model, {}});
    else if (key == "folder")
      pieces_.push_back({Piece::Kind::folder, {}});
    else if (key == "n")
      pieces_.push_back({Piece::Kind::number, {}});
    else if (key == "frame" && frames)
      pieces_.push_back({Piece::Kind::frame, {}});
    else if (key == "frame")
      throw InputError("-o " + pattern + ": {frame} needs --turntable or --frames");
    else
      throw InputError("-o " + pattern + ": unknown {" + key + "}: " + keys);
    i = end + 1;
  }
  endText();
}

std::string OutputPattern::name(const std::string& model, std::size_t number, std::size_t models,
                                std::size_t frame, std::size_t frames) const {
  std::string name;
  for (const Piece& piece : pieces_) switch (piece.kind) {
      case Piece::Kind::text:
        name += piece.text;
        break;
      case Piece::Kind::model:
        name += isStdin(model) ? "stdin" : std::filesystem::path(model).stem().string();
        break;
      case Piece::Kind::folder:
        name += folderOf(model);
        break;
      case Piece::Kind::number:
        name += padded(number, models);
        break;
      case Piece::Kind::frame:
        name += padded(frame, frames);
        break;
    }
  return name;
}

const std::size_t* NamesTaken::take(const std::string& name, std::size_t model) {
  const std::string plain = std::filesystem::path(name).lexically_normal().string();
  const auto [place, isNew] = taken_.emplace(std::hash<std::string>()(plain), model);
  return isNew ? nullptr : &place->second;
}

std::string withWord(const std::string& path, const std::string& word) {
  const auto dot = path.find_last_of("./");
  const auto at = dot == std::string::npos || path[dot] != '.' ? path.size() : dot;
  return path.substr(0, at) + "." + word + path.substr(at);
}

}  // namespace glint
