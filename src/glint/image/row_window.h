#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

namespace glint::detail {

/// The rows of a picture that is too large to be held: decoded in order on request, and kept while
/// they are near the current one. Several threads may call it at once.
class RowWindow {
 public:
  /// Writes the next row. Throws InputError if the file is damaged.
  using Next = std::function<void(std::byte* row)>;
  /// Starts (again) at the first row.
  using Start = std::function<Next()>;

  RowWindow(std::size_t rowBytes, int height, Start start);

  /// How far apart requested rows may be without the picture being decoded again: for wide pictures
  /// as many as FLIP needs at the largest resolution (2 * 135), for others as its threads need.
  int reach() const { return reach_; }

  /// Copies `count` rows starting at `first`.
  void read(int first, int count, std::byte* out);

  /// Decodes all rows not decoded yet: only the end shows whether the file is complete.
  void readToEnd();

 private:
  void decodeTo(int row);

  const std::size_t rowBytes_;
  const int height_, reach_;
  const Start start_;
  std::mutex mutex_;  ///< guards what follows
  Next next_;
  std::vector<std::byte> kept_;
  int decoded_ = 0;     ///< rows decoded in the current pass
  bool ended_ = false;  ///< an earlier pass reached the end
};

}  // namespace glint::detail
