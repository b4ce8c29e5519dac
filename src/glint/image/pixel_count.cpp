#include <algorithm>
#include <array>
#include <cmath>

#include "glint/image/compared_rows.h"

namespace glint::detail {
namespace {

using Row = std::vector<float>;

/// Luma and chroma of the NTSC, of sRGB values in [0, 1].
double yOf(const float* p) { return 0.29889531 * p[0] + 0.58662247 * p[1] + 0.11448223 * p[2]; }
double iOf(const float* p) { return 0.59597799 * p[0] - 0.27417610 * p[1] - 0.32180189 * p[2]; }
double qOf(const float* p) { return 0.21147017 * p[0] - 0.52261711 * p[1] + 0.31114694 * p[2]; }

/// The square of the perceived distance; 35215 is its largest value for codes up to 255.
double distanceSquared(const float* a, const float* b) {
  const double y = yOf(a) - yOf(b), i = iOf(a) - iOf(b), q = qOf(a) - qOf(b);
  return (0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) * (255.0 * 255.0 / 35215.0);
}

/// Five rows of one picture around the current one; rows beyond the edges are empty.
struct Rows {
  std::array<Row, 5> rows;
  int width = 0;

  const float* at(int x, int dy) const {
    const Row& row = rows[std::size_t(dy + 2)];
    return x < 0 || x >= width || row.empty() ? nullptr : &row[std::size_t(4) * x];
  }

  bool hasManySiblings(int x, int dy) const {
    const float* centre = at(x, dy);
    int equal = 0;
    bool edge = false;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        if (i == 0 && j == 0) continue;
        const float* other = at(x + i, dy + j);
        edge = edge || !other;
        equal += other && std::equal(other, other + 3, centre);
      }
    return equal + edge > 2;
  }

  /// A pixel between a darker and a brighter neighbour, of which one lies in even colour.
  bool looksAntiAliased(int x, const Rows& other) const {
    const float* centre = at(x, 0);
    int equal = 0;
    bool edge = false;
    double lowest = 0, highest = 0;
    int lowX = 0, lowY = 0, highX = 0, highY = 0;
    // Column by column: of equally dark or bright ones the first counts, as in pixelmatch.
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        if (i == 0 && j == 0) continue;
        const float* neighbour = at(x + i, j);
        if (!neighbour) {
          edge = true;
          continue;
        }
        const double delta = yOf(neighbour) - yOf(centre);
        if (delta == 0) ++equal;
        if (delta < lowest) {
          lowest = delta;
          lowX = x + i;
          lowY = j;
        }
        if (delta > highest) {
          highest = delta;
          highX = x + i;
          highY = j;
        }
      }
    if (equal + edge > 2 || lowest == 0 || highest == 0) return false;
    return (hasManySiblings(lowX, lowY) && other.hasManySiblings(lowX, lowY)) ||
           (hasManySiblings(highX, highY) && other.hasManySiblings(highX, highY));
  }
};

}  // namespace

namespace {

/// One way to see both pictures.
class View {
 public:
  explicit View(const ComparedRows& compared) : compared_(compared) {
    a_.width = b_.width = compared.width();
    for (int y = 0; y < 2; ++y) load(y, std::size_t(3 + y));
  }

  void next(int y) {
    for (Rows* rows : {&a_, &b_})
      std::rotate(rows->rows.begin(), rows->rows.begin() + 1, rows->rows.end());
    load(y + 2, 4);
  }

  bool differs(int x, double tolerance) const {
    const float *a = a_.at(x, 0), *b = b_.at(x, 0);
    // A distance that is not a number is over every tolerance.
    return !(distanceSquared(a, b) <= tolerance * tolerance) && !std::equal(a, a + 3, b);
  }

  bool looksAntiAliased(int x) const {
    return a_.looksAntiAliased(x, b_) || b_.looksAntiAliased(x, a_);
  }

 private:
  void load(int y, std::size_t slot) {
    Row &rowA = a_.rows[slot], &rowB = b_.rows[slot];
    rowA.clear();
    rowB.clear();
    if (y >= compared_.height()) return;
    rowA.resize(std::size_t(4) * compared_.width());
    rowB.resize(rowA.size());
    compared_.encoded(y, rowA.data(), rowB.data());
  }

  const ComparedRows& compared_;
  Rows a_, b_;
};

}  // namespace

PixelCount countPixels(const std::vector<const ComparedRows*>& views, double tolerance,
                       bool ignoreAntiAliasing) {
  const int width = views[0]->width(), height = views[0]->height();
  std::vector<View> seen;
  for (const ComparedRows* rows : views) seen.emplace_back(*rows);
  PixelCount count;
  for (int y = 0; y < height; ++y) {
    for (View& view : seen) view.next(y);
    for (int x = 0; x < width; ++x) {
      bool over = false, antiAliased = false;
      for (const View& view : seen) {
        if (over || !view.differs(x, tolerance)) continue;
        const bool looks = ignoreAntiAliasing && view.looksAntiAliased(x);
        (looks ? antiAliased : over) = true;
      }
      count.over += over;
      count.antiAliased += antiAliased && !over;
    }
  }
  return count;
}

}  // namespace glint::detail
