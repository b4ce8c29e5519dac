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
  std::string output;         ///< the picture's own name; empty: from the template
  std::string look = {};      ///< a look of its own as JSON, over the run's; may be empty
  std::string lookFile = {};  ///< likewise, from a file
  std::string error = {};     ///< the fault of its list line; empty if none
  std::size_t number = 0;     ///< its position among all, from 0
};

/// A share of the work: every `of`-th entry, beginning with number part - 1.
struct Shard {
  std::size_t part = 1, of = 1;
  bool has(std::size_t number) const { return number % of == part - 1; }
};

/// Parses "K/N", 1 <= K <= N. Throws InputError.
Shard parseShard(const std::string& text);

/// Which models belong to a shard, given the cost of each. If the costs are about the same, every
/// `of`-th model; otherwise the shards are balanced (each model, the most expensive first, goes to
/// the shard with the least cost: at most 4/3 of the optimum, Graham 1969). The result depends on
/// nothing else, so that shards on several machines fit together.
std::vector<bool> membersOf(const Shard& shard, const std::vector<double>& costs);

/// The models of a run, one after the other: those of the command line, or the lines of a list.
///
/// A line is the path of a model; or a path, a TAB and the name of its picture; or a JSON object
/// with the key "model" and optionally "output" (the name of its picture) and "look" (the keys of a
/// look file, or the path of one). Empty lines are skipped. Any other line is an entry with an
/// error. A list in a file is scanned once beforehand; one from a pipe is read line by line as the
/// lines arrive.
class ModelList {
 public:
  explicit ModelList(std::vector<std::string> models);
  /// Opens a list; "-" is standard input. Throws InputError.
  explicit ModelList(const std::string& path);
  ~ModelList();
  ModelList(const ModelList&) = delete;
  ModelList& operator=(const ModelList&) = delete;

  /// Scans all models, if they are known beforehand; from then on count() is known too.
  void lookThrough(const std::function<void(const ModelEntry&)>& visit);
  std::optional<std::size_t> count() const { return count_; }

  /// The next model. Waits for its line; empty at the end and after a signal. Throws InputError if
  /// the list cannot be read.
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
