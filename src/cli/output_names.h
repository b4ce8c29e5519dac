#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace glint {

/// A template for the names of pictures: {model} stands for the model file's name without folder
/// and ending, {folder} for the name of the folder it stands in ("stdin" both, of standard input),
/// {n} for its number from 0, {frame} for the picture's number from 0.
class OutputPattern {
 public:
  /// Throws InputError for an unknown {key} and for an unfinished one, and for {frame} without
  /// frames.
  OutputPattern(const std::string& pattern, bool frames);

  /// `models` and `frames` are how many there are, which says to how many digits numbers are
  /// padded; 0 models: not known, six digits.
  std::string name(const std::string& model, std::size_t number, std::size_t models,
                   std::size_t frame = 0, std::size_t frames = 1) const;

 private:
  struct Piece {
    enum class Kind { text, model, folder, number, frame } kind;
    std::string text;
  };
  std::vector<Piece> pieces_;
};

/// Tells when two pictures have one name, in 40 bytes or so for each.
class NamesTaken {
 public:
  /// Takes a name for a model's picture. If it is taken: the number of the model that has it.
  const std::size_t* take(const std::string& name, std::size_t model);

 private:
  std::unordered_map<std::uint64_t, std::size_t> taken_;  ///< by hash
};

/// "DIR/NAME.ENDING" with a dot and a word before the ending: "DIR/NAME.WORD.ENDING".
std::string withWord(const std::string& path, const std::string& word);

}  // namespace glint
