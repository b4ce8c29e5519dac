#pragma once

#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "glint/image/file.h"

namespace glint {

/// Files for the report; those that are not needed are empty.
struct PairPictures {
  std::vector<std::byte> a, b, map;         ///< as a browser shows them
  std::vector<std::byte> valuesA, valuesB;  ///< of 16 bits and floats: see trueValues()
  std::vector<std::byte> thumbnail;
};

/// The report of `glint diff`, one page that needs nothing else. The list of pairs stands at its
/// beginning, so that it can be read while the pictures are still coming; those wait in a temporary
/// file until then and need no memory. It appears when finish() has returned.
class DiffHtml {
 public:
  /// With `beside` the pictures go into the folder PATH.pictures.
  DiffHtml(const std::string& path, bool beside);

  /// The pictures of pair `index`, in any order of pairs. Those of pairs without any difference are
  /// left out once the page is long.
  void add(std::size_t index, bool differs, PairPictures pictures);

  /// Ends the page with the JSON of the comparison, whose "pairs" have the indices' order.
  void finish(const nlohmann::ordered_json& json);

 private:
  void keep(const std::string& text);
  void writePictures(std::size_t index, const PairPictures& pictures, bool differs);
  void copyKept(std::size_t begin, std::size_t end);

  struct Waiting {
    bool differs;
    PairPictures pictures;
  };
  OutputFile file_;
  std::string folder_;                                    ///< of pictures; empty: in the page
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> kept_;  ///< the pictures, as elements
  std::size_t written_ = 0;                               ///< bytes
  std::size_t next_ = 0;                                  ///< pair
  std::map<std::size_t, Waiting> later_;                  ///< pairs whose turn has not come
  std::map<std::size_t, std::vector<std::byte>> thumbnails_;
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> places_;  ///< in what waits
  std::map<std::size_t, std::string> kinds_;  ///< of the pictures that a pair has: "abm"
};

}  // namespace glint
