#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

namespace glint::detail {

/// The rows of a picture that is too large to be held: decoded in their order when they are asked
/// for, and kept while near. May be asked by several threads at once.
class RowWindow {
 public:
  /// Writes the next row. Throws InputError where the file is damaged.
  using Next = std::function<void(std::byte* row)>;
  /// Begins with the first row (again).
  using Start = std::function<Next()>;

  RowWindow(std::size_t rowBytes, int height, Start start);

  /// How far apart rows may be asked for without the picture being decoded again: of wide ones as
  /// many as FLIP needs at the largest resolution (2 * 135), of others as its threads need.
  int reach() const { return reach_; }

  /// Copies `count` rows from `first` on.
  void read(int first, int count, std::byte* out);

  /// Decodes what has never been decoded: whether the file is whole shows at its end.
  void readToEnd();

 private:
  void decodeTo(int row);

  const std::size_t rowBytes_;
  const int height_, reach_;
  const Start start_;
  std::mutex mutex_;  ///< guards what follows
  Next next_;
  std::vector<std::byte> kept_;
  int decoded_ = 0;     ///< rows of the current pass
  bool ended_ = false;  ///< in a pass before this one
};

}  // namespace glint::detail
