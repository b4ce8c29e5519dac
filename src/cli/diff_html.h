#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/image/file.h"

namespace glint {

/// PNG files for the report; those that are not needed are empty.
struct PairPictures {
  std::vector<std::byte> a, b, map;
};

/// The report of `glint diff`, one page that needs nothing else, written piece by piece so that the
/// pictures of a large folder need no memory. It appears when finish() has returned.
class DiffHtml {
 public:
  explicit DiffHtml(const std::string& path) : file_(path) {}

  /// The pictures of pair `index`, in any order of pairs. Those of pairs without any difference are
  /// left out once the page is long.
  void add(std::size_t index, bool differs, PairPictures pictures);

  /// Ends the page with the JSON of the comparison, whose "pairs" have the indices' order.
  void finish(const nlohmann::ordered_json& json);

 private:
  void write(const std::string& text);
  void writePictures(std::size_t index, const PairPictures& pictures, bool differs);

  struct Waiting {
    bool differs;
    PairPictures pictures;
  };
  OutputFile file_;
  bool begun_ = false;
  std::size_t written_ = 0;               ///< bytes
  std::size_t next_ = 0;                  ///< pair
  std::map<std::size_t, Waiting> later_;  ///< pairs whose turn has not come
};

}  // namespace glint
