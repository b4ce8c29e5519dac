#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace glint {

/// A template for picture names: {model} stands for the model's file name without folder and
/// extension, {folder} for the name of its folder (both are "stdin" for standard input), {n} for
/// the model's number from 0, {frame} for the picture's number from 0.
class OutputPattern {
 public:
  /// Throws InputError for an unknown or unterminated {key}, and for {frame} without frames.
  OutputPattern(const std::string& pattern, bool frames);

  /// `models` and `frames` are the totals, which determine the number of digits; 0 models: not
  /// known, six digits.
  std::string name(const std::string& model, std::size_t number, std::size_t models,
                   std::size_t frame = 0, std::size_t frames = 1) const;

 private:
  struct Piece {
    enum class Kind { text, model, folder, number, frame } kind;
    std::string text;
  };
  std::vector<Piece> pieces_;
};

/// Detects two pictures with the same name, in about 40 bytes for each.
class NamesTaken {
 public:
  /// Takes a name for a model's picture. If it is already taken, returns the number of that model.
  const std::size_t* take(const std::string& name, std::size_t model);

 private:
  std::unordered_map<std::uint64_t, std::size_t> taken_;  ///< by hash
};

/// "DIR/NAME.EXT" with a dot and a word before the extension: "DIR/NAME.WORD.EXT".
std::string withWord(const std::string& path, const std::string& word);

}  // namespace glint
