#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace glint {

/// A model to draw.
struct ModelEntry {
  std::string model;
  std::string output;         ///< a picture of its own name; empty: by the template
  std::string look = {};      ///< JSON of a look of its own, over that of the run; may be empty
  std::string lookFile = {};  ///< likewise, a file with it
  std::string error = {};     ///< what is wrong with its line; empty if all is well
  std::size_t number = 0;     ///< its place among all, from 0
};

/// A share of the work: every `of`-th, beginning with number part - 1.
struct Shard {
  std::size_t part = 1, of = 1;
  bool has(std::size_t number) const { return number % of == part - 1; }
};

/// "K/N", 1 <= K <= N. Throws InputError.
Shard parseShard(const std::string& text);

/// Which of the models fall to a shard, given what each costs: every `of`-th where the costs are
/// about the same, else so that the shards cost about the same (each model in turn, the dearest
/// first, goes to the shard with the least: at most 4/3 of the best, Graham 1969). It depends on
/// nothing else, so that shards on several machines fit together.
std::vector<bool> membersOf(const Shard& shard, const std::vector<double>& costs);

/// The models of a run, one after the other: those of the command line, or the lines of a list.
///
/// A line is the path of a model, or a path, a TAB and the name of its picture, or an object of
/// JSON with the keys "model" and perhaps "output" (the name of its picture) and "look" (the keys
/// of a look file, or the path of one); empty lines are skipped. A line that is neither is an entry
/// with an error. A list in a file is looked through once beforehand; one from a pipe is read line
/// by line as they come.
class ModelList {
 public:
  explicit ModelList(std::vector<std::string> models);
  /// Opens a list; "-" is standard input. Throws InputError.
  explicit ModelList(const std::string& path);
  ~ModelList();
  ModelList(const ModelList&) = delete;
  ModelList& operator=(const ModelList&) = delete;

  /// Looks through all of them, if they are known beforehand: from then on count() is known too.
  void lookThrough(const std::function<void(const ModelEntry&)>& visit);
  std::optional<std::size_t> count() const { return count_; }

  /// The next one. Waits for its line; empty at the end, and when a signal has come.
  /// Throws InputError if the list cannot be read.
  std::optional<ModelEntry> next();

 private:
  bool readLine(std::string& line);
  void readEntry(const std::string& line, ModelEntry& entry) const;
  bool fill();

  std::vector<std::string> models_;
  std::string path_;
  int file_ = -1;
  bool seekable_ = false;
  long long begin_ = 0;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  bool ended_ = false;
  std::size_t number_ = 0, line_ = 0;
  std::optional<std::size_t> count_;
};

}  // namespace glint
