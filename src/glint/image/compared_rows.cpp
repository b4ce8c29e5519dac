#include "glint/image/compared_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "glint/image/error.h"
#include "glint/image/row_window.h"

namespace glint::detail {

namespace {

std::string sizeOf(const StoredImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

}  // namespace

std::string sizesText(const StoredImage& a, const StoredImage& b) {
  return "the sizes differ: " + sizeOf(a) + " and " + sizeOf(b) + " pixels";
}

ComparedRows::ComparedRows(const StoredImage& a, const StoredImage& b,
                           const CompareOptions& options)
    : a_(a), b_(b), options_(options), space_(options.values), background_(options.background) {
  if (a.width != b.width || a.height != b.height) throw Error(sizesText(a, b));
  if (options.mask && (options.mask->width != a.width || options.mask->height != a.height)) {
    throw InputError("the mask has " + sizeOf(*options.mask) + " pixels, but the pictures have " +
                     sizeOf(a) + ": give a mask of their size");
  }
  if (space_ == ValueSpace::asStored) {
    if (a.isEncoded() != b.isEncoded()) {
      throw InputError(
          "one is sRGB, the other linear light: choose which values to compare (--values encoded "
          "or --values linear)");
    }
    space_ = a.isEncoded() ? ValueSpace::encoded : ValueSpace::linear;
  }
  if (options.alpha == AlphaUse::straight && (a.hasAlpha() || b.hasAlpha())) channels_ = 4;
  ignoresSome_ = options.mask || !options.ignored.empty();
  bothCodes_ = a.isEncoded() && b.isEncoded();
  comparesCodes_ = space_ == ValueSpace::encoded && options.alpha != AlphaUse::over &&
                   a.values.index() == 0 && b.values.index() == 0 && a.channels == b.channels;
}

void ComparedRows::valuesOf(const std::uint8_t* codes, float* values) const {
  const bool seen = channels_ == 3 || a_.channels == 3 || codes[3] > 0;
  for (int c = 0; c < 3; ++c) values[c] = seen ? codes[c] / 255.0f : 0;
  values[3] = a_.channels == 4 && channels_ == 4 ? codes[3] / 255.0f : 1;
}

bool ComparedRows::codesAreEqual(int y) const {
  if (a_.values.index() != b_.values.index() || a_.channels != b_.channels || !a_.isEncoded())
    return false;
  const std::size_t size = std::size_t(a_.channels) * a_.width;
  return std::visit(
      [&](const auto& a) {
        std::decay_t<decltype(a)> copyA, copyB;
        return std::memcmp(a_.heldRows(y, 1, copyA), b_.heldRows(y, 1, copyB),
                           size * sizeof a[0]) == 0;
      },
      a_.values);
}

std::size_t ComparedRows::pixelsAboveOne() const {
  std::size_t count = 0;
  std::vector<float> row(std::size_t(4) * a_.width);
  std::vector<char> above(std::size_t(a_.width));
  if (bothCodes_) return 0;
  for (int y = 0; y < a_.height; ++y) {
    std::fill(above.begin(), above.end(), 0);
    for (const StoredImage* image : {&a_, &b_}) {
      if (image->isEncoded()) continue;
      image->linearRows(y, 1, row.data());
      for (std::size_t x = 0; x < above.size(); ++x)
        if (row[4 * x] > 1 || row[4 * x + 1] > 1 || row[4 * x + 2] > 1) above[x] = 1;
    }
    count += std::size_t(std::count(above.begin(), above.end(), 1));
  }
  return count;
}

void ComparedRows::rowOf(const StoredImage& image, int y, ValueSpace space, AlphaUse alpha,
                         float* rgba) const {
  const bool encoded = space == ValueSpace::encoded;
  const int width = image.width;
  if (alpha == AlphaUse::ignored) {
    // The values as stored, regardless of alpha: nothing is divided by it.
    image.storedRows(y, 1, rgba);
    for (int x = 0; x < width; ++x) {
      float* p = rgba + 4 * x;
      p[3] = 1;
      if (encoded == image.isEncoded()) continue;
      for (int c = 0; c < 3; ++c) p[c] = encoded ? encodedValue(p[c]) : decodedValue(p[c]);
    }
    return;
  }
  const bool over = alpha == AlphaUse::over && image.hasAlpha();
  if (encoded && image.isEncoded() && (bothCodes_ || over || !image.hasAlpha())) {
    image.encodedRows(y, 1, rgba);
    if (!over) return;
    const auto opaque = [](float a) { return a == 1; };
    bool all = true;
    for (int x = 0; x < width; ++x) all = all && opaque(rgba[4 * x + 3]);
    if (all) return;
    // Compositing is done in linear light; opaque pixels keep their codes.
    std::vector<float> linear(std::size_t(4) * width);
    image.linearRows(y, 1, linear.data());
    for (int x = 0; x < width; ++x) {
      float* p = rgba + 4 * x;
      if (opaque(p[3])) continue;
      for (std::size_t c = 0; c < 3; ++c)
        p[c] = encodedValue(linear[std::size_t(4) * x + c] + (1 - p[3]) * background_[c]);
      p[3] = 1;
    }
    return;
  }
  // Linear light is premultiplied, in floating-point files and here: dividing by a small alpha
  // would exaggerate small differences.
  image.linearRows(y, 1, rgba);
  if (over) {
    for (int x = 0; x < width; ++x) {
      float* p = rgba + 4 * x;
      for (std::size_t c = 0; c < 3; ++c) p[c] += (1 - p[3]) * background_[c];
      p[3] = 1;
    }
  }
  if (!encoded) return;
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < 3; ++c) rgba[4 * x + c] = encodedValue(rgba[4 * x + c]);
}

void ComparedRows::pair(int y, ValueSpace space, AlphaUse alpha, float* a, float* b) const {
  rowOf(a_, y, space, alpha, a);
  rowOf(b_, y, space, alpha, b);
  if (!ignoresSome_) return;
  std::vector<unsigned char> counts(std::size_t(a_.width));
  counted(y, counts.data());
  for (std::size_t x = 0; x < counts.size(); ++x)
    if (!counts[x]) std::memcpy(b + 4 * x, a + 4 * x, 4 * sizeof(float));
}

void ComparedRows::values(int y, float* a, float* b) const {
  pair(y, space_, options_.alpha, a, b);
}

void ComparedRows::encoded(int y, float* a, float* b) const {
  pair(y, ValueSpace::encoded,
       options_.alpha == AlphaUse::ignored ? AlphaUse::ignored : AlphaUse::over, a, b);
}

void ComparedRows::counted(int y, unsigned char* row) const {
  std::fill_n(row, a_.width, static_cast<unsigned char>(1));
  for (const PixelBox& box : options_.ignored) {
    if (y < box.top || y > box.bottom) continue;
    for (int x = std::max(0, box.left); x <= std::min(a_.width - 1, box.right); ++x) row[x] = 0;
  }
  if (!options_.mask) return;
  std::vector<float> mask(std::size_t(4) * a_.width);
  options_.mask->encodedRows(y, 1, mask.data());
  for (int x = 0; x < a_.width; ++x) {
    const float* p = &mask[std::size_t(4) * x];
    if (p[0] + p[1] + p[2] < 1.5f) row[x] = 0;
  }
}

int ComparedRows::reach() const {
  int least = 0;
  for (const StoredImage* image : {&a_, &b_})
    if (image->window)
      least = least == 0 ? image->window->reach() : std::min(least, image->window->reach());
  return least;
}

PixelRows ComparedRows::linearA() const {
  const AlphaUse alpha = options_.alpha == AlphaUse::ignored ? AlphaUse::ignored : AlphaUse::over;
  return {a_.width, a_.height,
          [this, alpha](int first, int count, float* rgba) {
            for (int y = first; y < first + count; ++y, rgba += std::size_t(4) * a_.width)
              rowOf(a_, y, ValueSpace::linear, alpha, rgba);
          },
          reach()};
}

PixelRows ComparedRows::linearB() const {
  const AlphaUse alpha = options_.alpha == AlphaUse::ignored ? AlphaUse::ignored : AlphaUse::over;
  return {a_.width, a_.height,
          [this, alpha](int first, int count, float* rgba) {
            std::vector<float> other(ignoresSome_ ? std::size_t(4) * a_.width : 0);
            for (int y = first; y < first + count; ++y, rgba += std::size_t(4) * a_.width) {
              if (ignoresSome_) {
                pair(y, ValueSpace::linear, alpha, other.data(), rgba);
              } else {
                rowOf(b_, y, ValueSpace::linear, alpha, rgba);
              }
            }
          },
          reach()};
}

namespace {

/// Luma as the authors' program computes it (MATLAB's rgb2gray, except that it rounds to codes and
/// this does not). The weights sum to 1, so grey is unchanged.
void lumaOf(const float* rgba, int width, double* luma) {
  for (int x = 0; x < width; ++x) {
    const float* p = rgba + 4 * x;
    const double value =
        0.298936021293775 * p[0] + 0.587043074451121 * p[1] + 0.114020904255104 * p[2];
    luma[x] = std::isfinite(value) ? value : 0;
  }
}

std::vector<double> window(int side) {
  const int size = std::min(11, side);
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i < size; ++i) {
    const double x = i - (size - 1) / 2.0;
    weights.push_back(std::exp(-x * x / (2 * 1.5 * 1.5)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Weighted means of the two pictures in a window, and their variances and covariance.
struct Moments {
  double a, b, aa, bb, ab;
};

// E[x^2] - m^2 loses about 2^-48 m^2 to rounding: above this mean too much beside K2^2 = 9e-4.
constexpr double largeMean = 16;

// Variances and covariance of a window whose first row is `row` of the ring, from differences to
// its middle value, which are exact where the window is nearly even.
void centre(Moments& m, const std::vector<double>& lumas, int width, int row, int x,
            const std::vector<double>& across, const std::vector<double>& down) {
  const int rows = int(down.size()), columns = int(across.size());
  const auto rowAt = [&](int k) {
    return lumas.data() + std::size_t(2) * width * ((row + k) % rows) + x;
  };
  const double a0 = rowAt(rows / 2)[columns / 2], b0 = rowAt(rows / 2)[width + columns / 2];
  Moments d{};
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < columns; ++i) {
      const double w = down[k] * across[i], a = rowAt(k)[i] - a0, b = rowAt(k)[width + i] - b0;
      d.a += w * a;
      d.b += w * b;
      d.aa += w * a * a;
      d.bb += w * b * b;
      d.ab += w * a * b;
    }
  m.aa = std::max(0.0, d.aa - d.a * d.a);
  m.bb = std::max(0.0, d.bb - d.b * d.b);
  m.ab = d.ab - d.a * d.b;
}

}  // namespace

double structuralSimilarity(const ComparedRows& rows) {
  const int width = rows.width(), height = rows.height();
  const std::vector<double> across = window(width), down = window(height);
  const int outWidth = width - int(across.size()) + 1;
  const int ring = int(down.size());
  const std::size_t plane = std::size_t(outWidth), entry = 5 * plane;
  std::vector<double> filtered(entry * std::size_t(ring)), sums(entry);
  std::vector<double> products(5 * std::size_t(width));
  std::vector<double> lumas(std::size_t(2) * width * ring);
  std::vector<float> a(std::size_t(4) * width), b(a.size());
  std::vector<unsigned char> counts(std::size_t(width), 1);
  double total = 0;
  std::size_t windows = 0;
  for (int y = 0; y < height; ++y) {
    rows.encoded(y, a.data(), b.data());
    double* va = products.data();
    double* vb = va + width;
    lumaOf(a.data(), width, va);
    lumaOf(b.data(), width, vb);
    std::copy_n(va, 2 * width, lumas.data() + std::size_t(2) * width * (y % ring));
    for (int x = 0; x < width; ++x) {
      vb[width + x] = va[x] * va[x];
      vb[2 * width + x] = vb[x] * vb[x];
      vb[3 * width + x] = va[x] * vb[x];
    }
    double* out = filtered.data() + entry * std::size_t(y % ring);
    std::fill_n(out, entry, 0.0);
    for (std::size_t p = 0; p < 5; ++p)
      for (std::size_t k = 0; k < across.size(); ++k)
        for (std::size_t x = 0; x < plane; ++x)
          out[p * plane + x] += across[k] * products[p * std::size_t(width) + x + k];
    if (y + 1 < ring) continue;
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int k = 0; k < ring; ++k) {
      const double* row = filtered.data() + entry * std::size_t((y - ring + 1 + k) % ring);
      for (std::size_t i = 0; i < entry; ++i) sums[i] += down[std::size_t(k)] * row[i];
    }
    if (rows.ignoresSome()) rows.counted(y - ring / 2, counts.data());
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double rowTotal = 0;
    for (std::size_t x = 0; x < plane; ++x) {
      if (!counts[x + across.size() / 2]) continue;
      Moments m{sums[x], sums[plane + x], sums[2 * plane + x], sums[3 * plane + x],
                sums[4 * plane + x]};
      const double squareA = m.a * m.a, squareB = m.b * m.b;
      m.aa -= squareA;
      m.bb -= squareB;
      m.ab -= m.a * m.b;
      if (std::max(squareA, squareB) > largeMean * largeMean)
        centre(m, lumas, width, y + 1, int(x), across, down);
      rowTotal +=
          (2 * m.a * m.b + c1) * (2 * m.ab + c2) / ((squareA + squareB + c1) * (m.aa + m.bb + c2));
      ++windows;
    }
    total += rowTotal;
  }
  return windows > 0 ? total / double(windows) : 1;
}

}  // namespace glint::detail
