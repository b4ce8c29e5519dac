#include <algorithm>
#include <array>
#include <cmath>

#include "glint/image/compared_rows.h"
#include "glint/image/srgb.h"

namespace glint::detail {
namespace {

using Row = std::vector<float>;

/// NTSC luma and chroma of sRGB values in [0, 1].
double yOf(const float* p) { return 0.29889531 * p[0] + 0.58662247 * p[1] + 0.11448223 * p[2]; }
double iOf(const float* p) { return 0.59597799 * p[0] - 0.27417610 * p[1] - 0.32180189 * p[2]; }
double qOf(const float* p) { return 0.21147017 * p[0] - 0.52261711 * p[1] + 0.31114694 * p[2]; }

/// The perceived distance of Kotsarenko and Ramos; 35215 is the largest square for codes up to 255.
double yiqDistance(const float* a, const float* b) {
  const double y = yOf(a) - yOf(b), i = iOf(a) - iOf(b), q = qOf(a) - qOf(b);
  return std::sqrt((0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) * (255.0 * 255.0 / 35215.0));
}

struct Oklab {
  double l, a, b;
};

/// OKLab (Ottosson, "A perceptual color space for image processing", 2020) with his later
/// correction of lightness near black ("Okhsv and Okhsl", 2021): 0 for black to 1 for white.
Oklab oklabOf(const float* p) {
  double c[3];
  for (int i = 0; i < 3; ++i)
    c[i] = std::copysign(srgbLinear(std::fabs(double(p[i]))), double(p[i]));
  const double l = std::cbrt(0.4122214708 * c[0] + 0.5363325363 * c[1] + 0.0514459929 * c[2]);
  const double m = std::cbrt(0.2119034982 * c[0] + 0.6806995451 * c[1] + 0.1073969566 * c[2]);
  const double s = std::cbrt(0.0883024619 * c[0] + 0.2817188376 * c[1] + 0.6299787005 * c[2]);
  const double lightness = 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
  constexpr double k1 = 0.206, k2 = 0.03, k3 = (1 + k1) / (1 + k2);
  const double x = k3 * lightness - k1;
  return {0.5 * (x + std::sqrt(x * x + 4 * k2 * k3 * lightness)),
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

/// HyAB: city-block in lightness, Euclidean in chroma.
double oklabDistance(const float* p, const float* q) {
  const Oklab a = oklabOf(p), b = oklabOf(q);
  return std::fabs(a.l - b.l) + std::hypot(a.a - b.a, a.b - b.b);
}

/// One view of both pictures. Rows are computed on first access and kept while they are near.
class View {
 public:
  View(const ComparedRows& compared, const CompareOptions& options)
      : compared_(compared), options_(options), kept_(std::max(5, 2 * options.shift + 1)) {}

  /// Whether the distance is over the tolerance. NaN always is.
  bool differs(int x, int y) { return areFar(at(0, x, y), at(1, x, y)); }

  bool looksAntiAliased(int x, int y) { return antiAliased(0, x, y) || antiAliased(1, x, y); }

  /// Whether each picture's pixel is found near its place in the other.
  bool isShifted(int x, int y) { return isNear(0, x, y) && isNear(1, x, y); }

 private:
  struct Kept {
    int y = -1;
    std::array<Row, 2> rows;
  };

  /// A pixel of picture 0 or 1; null beyond the edges.
  const float* at(int picture, int x, int y) {
    if (x < 0 || y < 0 || x >= compared_.width() || y >= compared_.height()) return nullptr;
    Kept& kept = kept_[std::size_t(y) % kept_.size()];
    if (kept.y != y) {
      kept.y = y;
      for (Row& row : kept.rows) row.resize(std::size_t(4) * compared_.width());
      compared_.encoded(y, kept.rows[0].data(), kept.rows[1].data());
    }
    return &kept.rows[std::size_t(picture)][std::size_t(4) * x];
  }

  bool areFar(const float* a, const float* b) const {
    if (std::equal(a, a + 3, b)) return false;
    const double distance =
        options_.distance == PixelDistance::yiq ? yiqDistance(a, b) : oklabDistance(a, b);
    return !(distance <= options_.tolerance);
  }

  bool isNear(int picture, int x, int y) {
    for (int dy = -options_.shift; dy <= options_.shift; ++dy)
      for (int dx = -options_.shift; dx <= options_.shift; ++dx) {
        const float* const other = at(1 - picture, x + dx, y + dy);
        if (other && !areFar(at(picture, x, y), other)) return true;
      }
    return false;
  }

  bool hasManySiblings(int picture, int x, int y) {
    const float* const centre = at(picture, x, y);
    int equal = 0;
    bool edge = false;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        if (i == 0 && j == 0) continue;
        const float* const other = at(picture, x + i, y + j);
        edge = edge || !other;
        equal += other && std::equal(other, other + 3, centre);
      }
    return equal + edge > 2;
  }

  /// Whether the pixel lies between a darker and a brighter neighbour, one of them in a uniform
  /// area.
  bool antiAliased(int picture, int x, int y) {
    const float* const centre = at(picture, x, y);
    int equal = 0;
    bool edge = false;
    double lowest = 0, highest = 0;
    int lowX = 0, lowY = 0, highX = 0, highY = 0;
    // Column by column: among equally dark or bright ones the first counts, as in pixelmatch.
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        if (i == 0 && j == 0) continue;
        const float* const neighbour = at(picture, x + i, y + j);
        if (!neighbour) {
          edge = true;
          continue;
        }
        const double delta = yOf(neighbour) - yOf(centre);
        if (delta == 0) ++equal;
        if (delta < lowest) {
          lowest = delta;
          lowX = x + i;
          lowY = y + j;
        }
        if (delta > highest) {
          highest = delta;
          highX = x + i;
          highY = y + j;
        }
      }
    if (equal + edge > 2 || lowest == 0 || highest == 0) return false;
    return (hasManySiblings(0, lowX, lowY) && hasManySiblings(1, lowX, lowY)) ||
           (hasManySiblings(0, highX, highY) && hasManySiblings(1, highX, highY));
  }

  const ComparedRows& compared_;
  const CompareOptions& options_;
  std::vector<Kept> kept_;
};

/// The largest number of marks in any square window of a given side; rows are added one by one.
class Windows {
 public:
  Windows(int width, int height, int side)
      : width_(width),
        side_(std::min({side, width, height})),
        rows_(std::size_t(width) * std::size_t(side_), 0),
        columns_(std::size_t(width), 0) {}

  void add(int y, const std::vector<unsigned char>& marks) {
    unsigned char* const row = &rows_[std::size_t(y % side_) * std::size_t(width_)];
    for (std::size_t x = 0; x < columns_.size(); ++x) {
      columns_[x] += marks[x] - row[x];
      row[x] = marks[x];
    }
    if (y + 1 < side_) return;
    std::size_t sum = 0;
    for (int x = 0; x < width_; ++x) {
      sum += std::size_t(columns_[std::size_t(x)]);
      if (x + 1 < side_) continue;
      most = std::max(most, sum);
      sum -= std::size_t(columns_[std::size_t(x + 1 - side_)]);
    }
  }

  std::size_t most = 0;

 private:
  int width_, side_;
  std::vector<unsigned char> rows_;
  std::vector<int> columns_;
};

}  // namespace

PixelCount countPixels(const std::vector<const ComparedRows*>& views,
                       const CompareOptions& options) {
  const int width = views[0]->width(), height = views[0]->height();
  std::vector<View> seen;
  for (const ComparedRows* rows : views) seen.emplace_back(*rows, options);
  PixelCount count;
  std::vector<unsigned char> marks(std::size_t(width), 0);
  Windows windows(width, height, options.window > 0 ? options.window : 1);
  for (int y = 0; y < height; ++y) {
    std::fill(marks.begin(), marks.end(), static_cast<unsigned char>(0));
    if (!views[0]->codesAreEqual(y)) {
      for (int x = 0; x < width; ++x) {
        bool over = false, antiAliased = false;
        for (View& view : seen) {
          if (over || !view.differs(x, y)) continue;
          if (options.shift > 0 && view.isShifted(x, y)) continue;
          const bool looks = options.ignoreAntiAliasing && view.looksAntiAliased(x, y);
          (looks ? antiAliased : over) = true;
        }
        count.over += over;
        count.antiAliased += antiAliased && !over;
        marks[std::size_t(x)] = over;
      }
    }
    if (options.window > 0) windows.add(y, marks);
  }
  if (options.window > 0) count.over = windows.most;
  return count;
}

}  // namespace glint::detail
