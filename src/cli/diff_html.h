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

/// Files for the report; empty if not needed.
struct PairPictures {
  std::vector<std::byte> a, b, map;         ///< as a browser can show them
  std::vector<std::byte> valuesA, valuesB;  ///< for 16 bits and floats: see trueValues()
  std::vector<std::byte> thumbnail;
};

/// The report of `glint diff`: one self-contained page. The list of pairs comes first, so that it
/// can be read while the pictures are still loading. Until finish() the pictures are kept in a
/// temporary file, not in memory. The page appears when finish() has returned.
class DiffHtml {
 public:
  /// With `beside` the pictures go into the folder PATH.pictures.
  DiffHtml(const std::string& path, bool beside);

  /// Adds the pictures of pair `index`; pairs may come in any order. Once the page is long, the
  /// pictures of pairs without any difference are left out.
  void add(std::size_t index, bool differs, PairPictures pictures);

  /// Completes the page with the JSON of the comparison, whose "pairs" are in index order.
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
  std::string folder_;                                    ///< for pictures; empty: in the page
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> kept_;  ///< the pictures, as elements
  std::size_t written_ = 0;                               ///< bytes
  std::size_t next_ = 0;                                  ///< the next pair to write
  std::map<std::size_t, Waiting> later_;                  ///< pairs that must wait for their turn
  std::map<std::size_t, std::vector<std::byte>> thumbnails_;
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> places_;  ///< ranges in kept_
  std::map<std::size_t, std::string> kinds_;  ///< the pictures that a pair has: "abm"
};

}  // namespace glint
