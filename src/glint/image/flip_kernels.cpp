#include "glint/image/flip_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

// Distribution builds target SSE2 only, so the loops are also compiled for AVX2 and AVX-512 and
// chosen at load time. FMA contraction is off, so that all give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define GLINT_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GLINT_CLONES
#endif

namespace glint::detail {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int lanes = 16;  ///< two AVX vectors, one of AVX-512
using Vector = float __attribute__((vector_size(4 * lanes), aligned(4), may_alias));

// Linear sRGB to XYZ (D65), and that white point.
constexpr double toXyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double white[3] = {0.950428545, 1.0, 1.088900371};

// Constants from section 4 of the paper.
constexpr double colourExponent = 0.7, colourBreak = 0.4, colourBreakValue = 0.95;
constexpr double featureDegrees = 0.082, featureExponent = 0.5;

struct Matrices {
  float toWhite[9];    ///< linear RGB to XYZ relative to white
  float fromWhite[9];  ///< and back
};

Matrices makeMatrices() {
  double m[9], inverse[9];
  for (int i = 0; i < 9; ++i) m[i] = toXyz[i / 3][i % 3] / white[i / 3];
  for (int i = 0; i < 9; ++i) {
    const int r = i / 3, c = i % 3, r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3,
              c2 = (c + 2) % 3;
    inverse[3 * c + r] = m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
  }
  const double determinant = m[0] * inverse[0] + m[1] * inverse[3] + m[2] * inverse[6];
  Matrices matrices;
  for (int i = 0; i < 9; ++i) {
    matrices.toWhite[i] = static_cast<float>(m[i]);
    matrices.fromWhite[i] = static_cast<float>(inverse[i] / determinant);
  }
  return matrices;
}

const Matrices& matrices() {
  static const Matrices made = makeMatrices();
  return made;
}

/// CIELAB's curve is a line below the cube of 6/29.
constexpr double labBreak = 6.0 / 29;

/// The largest colour difference, between green and blue, raised to colourExponent.
double largestDifference() {
  double lab[2][3];
  for (int i = 0; i < 2; ++i) {
    double f[3];
    for (int row = 0; row < 3; ++row) {
      const double x = toXyz[row][i + 1] / white[row];
      f[row] = x > labBreak * labBreak * labBreak ? std::cbrt(x)
                                                  : x / (3 * labBreak * labBreak) + 4.0 / 29;
    }
    lab[i][0] = 116 * f[1] - 16;
    lab[i][1] = 0.01 * lab[i][0] * 500 * (f[0] - f[1]);
    lab[i][2] = 0.01 * lab[i][0] * 200 * (f[1] - f[2]);
  }
  const double a = lab[0][1] - lab[1][1], b = lab[0][2] - lab[1][2];
  return std::pow(std::fabs(lab[0][0] - lab[1][0]) + std::sqrt(a * a + b * b), colourExponent);
}

HalfFilter halfOf(const std::vector<double>& half) {
  // Drops tail weights whose total effect is too small for a float.
  std::size_t size = half.size();
  for (double tail = 0; size > 1; --size) {
    tail += 2 * std::fabs(half[size - 1]);
    if (tail > 3e-8) break;
  }
  return {half.begin(), half.begin() + std::ptrdiff_t(size)};
}

double sumOf(const std::vector<double>& half) {
  double sum = half[0];
  for (std::size_t i = 1; i < half.size(); ++i) sum += 2 * half[i];
  return sum;
}

std::vector<double> sensitivity(int radius, double pixelsPerDegree, double b, double scale) {
  std::vector<double> half;
  for (int i = 0; i <= radius; ++i) {
    const double x = i / pixelsPerDegree;
    half.push_back(scale * std::exp(-pi * pi * x * x / b));
  }
  return half;
}

HalfFilter scaled(std::vector<double> half, double factor) {
  for (double& weight : half) weight *= factor;
  return halfOf(half);
}

}  // namespace

FlipFilters::FlipFilters(double pixelsPerDegree) {
  // The radius is three standard deviations of the widest Gaussian.
  const int spatial = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixelsPerDegree));
  const auto make = [&](double b, double scale) {
    return sensitivity(spatial, pixelsPerDegree, b, scale);
  };
  const auto y = make(0.0047, 1), x = make(0.0053, 1);
  luminance = scaled(y, 1 / sumOf(y));
  redGreen = scaled(x, 1 / sumOf(x));
  // 34.1 and 13.5 weight the two Gaussians; separated, each direction gets the square root.
  const auto z0 = make(0.04, std::sqrt(34.1 * std::sqrt(pi / 0.04)));
  const auto z1 = make(0.025, std::sqrt(13.5 * std::sqrt(pi / 0.025)));
  const double norm = 1 / std::hypot(sumOf(z0), sumOf(z1));
  blueYellow[0] = scaled(z0, norm);
  blueYellow[1] = scaled(z1, norm);

  const double deviation = 0.5 * featureDegrees * pixelsPerDegree;
  const int feature = int(std::ceil(3 * deviation));
  std::vector<double> g, d, dd;
  double positive = 0, negative = 0, slope = 0;
  for (int i = 0; i <= feature; ++i) {
    const double square = i * i / (deviation * deviation);
    g.push_back(std::exp(-square / 2));
    d.push_back(-i * g.back());
    dd.push_back((square - 1) * g.back());
    slope -= d.back();
    (dd.back() > 0 ? positive : negative) += (i == 0 ? 1 : 2) * std::fabs(dd.back());
  }
  // Positive weights sum to 1 and negative ones to -1.
  for (double& weight : dd) weight /= weight > 0 ? positive : negative;
  gaussian = scaled(g, 1 / sumOf(g));
  edge = slope > 0 ? scaled(d, 1 / slope) : HalfFilter{0};
  point = halfOf(dd);
  for (const HalfFilter* f :
       {&luminance, &redGreen, &blueYellow[0], &blueYellow[1], &gaussian, &edge, &point})
    radius = std::max(radius, int(f->size()) - 1);
}

FlipRow::FlipRow(int width, int radius)
    : stride(std::size_t(width) + 2 * std::size_t(radius) + lanes), values(3 * stride) {}

GLINT_CLONES
void flipConvertRow(const float* rgba, int width, int radius, FlipRow& row) {
  const float* m = matrices().toWhite;
  float* luminance = row.values.data() + radius;
  float* redGreen = luminance + row.stride;
  float* blueYellow = redGreen + row.stride;
  for (int x = 0; x < width; ++x) {
    float c[3];
    for (int i = 0; i < 3; ++i) {
      const float v = rgba[4 * x + i];
      const float low = v > 0 ? v : 0;  // and for NaN
      c[i] = low < 1 ? low : 1;
    }
    const float y = m[3] * c[0] + m[4] * c[1] + m[5] * c[2];
    luminance[x] = y;
    redGreen[x] = m[0] * c[0] + m[1] * c[1] + m[2] * c[2] - y;
    blueYellow[x] = y - (m[6] * c[0] + m[7] * c[1] + m[8] * c[2]);
  }
  for (float* channel : {luminance, redGreen, blueYellow}) {
    std::fill(channel - radius, channel, channel[0]);
    std::fill(channel + width, channel + width + radius + lanes, channel[width - 1]);
  }
}

namespace {

inline __attribute__((always_inline)) const Vector& at(const float* p) {
  return *reinterpret_cast<const Vector*>(p);
}

/// Applies a symmetric filter along x for one vector.
inline __attribute__((always_inline)) void filterAt(const float* in, const HalfFilter& filter,
                                                    float* out) {
  Vector sum = at(in) * filter[0];
  const int size = int(filter.size());
  for (int k = 1; k < size; ++k) sum += (at(in - k) + at(in + k)) * filter[std::size_t(k)];
  *reinterpret_cast<Vector*>(out) = sum;
}

/// Second differences: since the weights sum to 0, the centre can be subtracted from each value,
/// and uniform colour gives exactly 0 instead of a rounding error whose square root would be
/// visible.
inline __attribute__((always_inline)) void addSecondDifference(const float* left,
                                                               const float* centre,
                                                               const float* right, float weight,
                                                               Vector& sum) {
  sum += ((at(left) - at(centre)) + (at(right) - at(centre))) * weight;
}

}  // namespace

GLINT_CLONES
void flipFilterRow(const FlipFilters& filters, const FlipRow& row, int begin, int end,
                   float* planes, std::size_t stride) {
  const float* luminance = row.values.data() + filters.radius;
  const float* redGreen = luminance + row.stride;
  const float* blueYellow = redGreen + row.stride;
  for (int x = begin; x < end; x += lanes) {
    float* out = planes + x;
    filterAt(luminance + x, filters.luminance, out + luminancePlane * stride);
    filterAt(redGreen + x, filters.redGreen, out + redGreenPlane * stride);
    filterAt(blueYellow + x, filters.blueYellow[0], out + blueYellowPlane0 * stride);
    filterAt(blueYellow + x, filters.blueYellow[1], out + blueYellowPlane1 * stride);
    filterAt(luminance + x, filters.gaussian, out + gaussianPlane * stride);
    // Antisymmetric: convolution mirrors the filter.
    const float* in = luminance + x;
    Vector sum = at(in) * 0.0f;
    const int size = int(filters.edge.size());
    for (int k = 1; k < size; ++k) sum += (at(in + k) - at(in - k)) * filters.edge[std::size_t(k)];
    *reinterpret_cast<Vector*>(out + edgePlane * stride) = sum;
    sum = at(in) * 0.0f;
    for (int k = 1; k < int(filters.point.size()); ++k)
      addSecondDifference(in - k, in, in + k, filters.point[std::size_t(k)], sum);
    *reinterpret_cast<Vector*>(out + pointPlane * stride) = sum;
  }
}

namespace {

/// A block of one picture after filtering along y.
struct Block {
  float luminance[flipBlock], redGreen[flipBlock], blueYellow[flipBlock];
  float edgeX[flipBlock], edgeY[flipBlock], pointX[flipBlock], pointY[flipBlock];
};

inline __attribute__((always_inline)) void filterColumn(const float* const* rows, int radius,
                                                        std::size_t offset,
                                                        const HalfFilter& filter, Vector& sum) {
  sum = at(rows[radius] + offset) * filter[0];
  const int size = int(filter.size());
  for (int k = 1; k < size; ++k)
    sum += (at(rows[radius - k] + offset) + at(rows[radius + k] + offset)) * filter[std::size_t(k)];
}

inline __attribute__((always_inline)) void filterBlock(const FlipFilters& filters,
                                                       const float* const* rows, std::size_t stride,
                                                       int begin, int count, Block& block) {
  const int radius = filters.radius;
  for (int i = 0; i < count; i += lanes) {
    const std::size_t x = std::size_t(begin + i);
    const auto out = [&](float* values) -> Vector& {
      return *reinterpret_cast<Vector*>(values + i);
    };
    const std::size_t gaussian = gaussianPlane * stride + x;
    filterColumn(rows, radius, luminancePlane * stride + x, filters.luminance,
                 out(block.luminance));
    filterColumn(rows, radius, redGreenPlane * stride + x, filters.redGreen, out(block.redGreen));
    Vector first, second;
    filterColumn(rows, radius, blueYellowPlane0 * stride + x, filters.blueYellow[0], first);
    filterColumn(rows, radius, blueYellowPlane1 * stride + x, filters.blueYellow[1], second);
    out(block.blueYellow) = first + second;
    filterColumn(rows, radius, edgePlane * stride + x, filters.gaussian, out(block.edgeX));
    filterColumn(rows, radius, pointPlane * stride + x, filters.gaussian, out(block.pointX));
    Vector sum = at(rows[radius] + gaussian) * 0.0f;
    const int size = int(filters.edge.size());
    for (int k = 1; k < size; ++k)
      sum += (at(rows[radius + k] + gaussian) - at(rows[radius - k] + gaussian)) *
             filters.edge[std::size_t(k)];
    out(block.edgeY) = sum;
    sum = at(rows[radius] + gaussian) * 0.0f;
    for (int k = 1; k < int(filters.point.size()); ++k)
      addSecondDifference(rows[radius - k] + gaussian, rows[radius] + gaussian,
                          rows[radius + k] + gaussian, filters.point[std::size_t(k)], sum);
    out(block.pointY) = sum;
  }
}

/// Cube root in [0.008, 2]: a guess from the exponent and two Halley steps. The relative errors are
/// 5e-2, then 4e-5 (the method is cubic: 2/3 e^3 at most), then below a float's rounding.
inline __attribute__((always_inline)) float cubeRoot(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const auto guess = static_cast<std::int32_t>(static_cast<float>(bits) * (1.0f / 3)) + 709921077;
  float t = std::bit_cast<float>(guess);
  for (int step = 0; step < 2; ++step) {
    const float cube = t * t * t;
    t *= (cube + 2 * x) / (2 * cube + x);
  }
  return t;
}

/// Binary logarithm of a positive normal float, within 3e-7 (absolute, or relative to the result).
inline __attribute__((always_inline)) float log2Of(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  // Mantissas from the square root of one half to the square root of two.
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
  const float mantissa = std::bit_cast<float>(bits - (exponent << 23));
  const float t = (mantissa - 1) / (mantissa + 1), s = t * t;
  // 2 artanh(t) / ln 2; the next term is below 4e-9.
  constexpr float c = 2.8853900817779268f;
  return static_cast<float>(exponent) +
         t * (c + s * (c / 3 + s * (c / 5 + s * (c / 7 + s * (c / 9)))));
}

/// 2^y for -120 <= y <= 120, with a relative error below 2e-7.
inline __attribute__((always_inline)) float exp2Of(float y) {
  const float shifted = y + 12582912.0f;  // adding 1.5 * 2^23 rounds to the nearest integer
  const float whole = shifted - 12582912.0f;
  const float r = (y - whole) * 0.69314718056f;
  const float p =
      1 + r * (1 + r * (1.0f / 2 +
                        r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
  const auto exponent = static_cast<std::int32_t>(whole);
  return p * std::bit_cast<float>((exponent + 127) << 23);
}

struct Lab {
  float l, a, b;
};

/// CIELAB of filtered opponent colours, clamped to linear sRGB, chroma weighted by lightness
/// (Hunt).
inline __attribute__((always_inline)) Lab labOf(float luminance, float redGreen, float blueYellow,
                                                const float* from, const float* to) {
  const float x = luminance + redGreen, z = luminance - blueYellow;
  float f[3], c[3];
  for (int i = 0; i < 3; ++i) {
    const float v = from[3 * i] * x + from[3 * i + 1] * luminance + from[3 * i + 2] * z;
    const float low = v > 0 ? v : 0;
    c[i] = low < 1 ? low : 1;
  }
  for (int i = 0; i < 3; ++i) {
    const float v = to[3 * i] * c[0] + to[3 * i + 1] * c[1] + to[3 * i + 2] * c[2];
    constexpr float corner = static_cast<float>(labBreak * labBreak * labBreak);
    constexpr float slope = static_cast<float>(1 / (3 * labBreak * labBreak));
    const float root = cubeRoot(v > corner ? v : corner);
    const float line = slope * v + static_cast<float>(4.0 / 29);
    f[i] = v > corner ? root : line;
  }
  const float l = 116 * f[1] - 16, hunt = 0.01f * l;
  return {l, hunt * (500 * (f[0] - f[1])), hunt * (200 * (f[1] - f[2]))};
}

inline __attribute__((always_inline)) void compareBlock(const Block& r, const Block& t, int count,
                                                        const Matrices& m, float largest,
                                                        float* __restrict out) {
  const float breakpoint = largest * static_cast<float>(colourBreak);
  const float below = static_cast<float>(colourBreakValue) / breakpoint;
  const float above = static_cast<float>(1 - colourBreakValue) / (largest - breakpoint);
  for (int i = 0; i < count; ++i) {
    const Lab a = labOf(r.luminance[i], r.redGreen[i], r.blueYellow[i], m.fromWhite, m.toWhite);
    const Lab b = labOf(t.luminance[i], t.redGreen[i], t.blueYellow[i], m.fromWhite, m.toWhite);
    const float da = a.a - b.a, db = a.b - b.b;
    // HyAB distance: city-block in lightness, Euclidean in chroma.
    const float distance = std::fabs(a.l - b.l) + std::sqrt(da * da + db * db);
    const float safe = distance > 1e-20f ? distance : 1e-20f;
    const float power = exp2Of(static_cast<float>(colourExponent) * log2Of(safe));
    const float near = power * below;
    const float far = static_cast<float>(colourBreakValue) + (power - breakpoint) * above;
    const float colour = power < breakpoint ? near : far;

    const float edgeR = std::sqrt(r.edgeX[i] * r.edgeX[i] + r.edgeY[i] * r.edgeY[i]);
    const float edgeT = std::sqrt(t.edgeX[i] * t.edgeX[i] + t.edgeY[i] * t.edgeY[i]);
    const float pointR = std::sqrt(r.pointX[i] * r.pointX[i] + r.pointY[i] * r.pointY[i]);
    const float pointT = std::sqrt(t.pointX[i] * t.pointX[i] + t.pointY[i] * t.pointY[i]);
    const float edge = std::fabs(edgeR - edgeT), point = std::fabs(pointR - pointT);
    const float larger = edge > point ? edge : point;
    static_assert(featureExponent == 0.5);
    const float feature = std::sqrt(larger * static_cast<float>(1 / std::numbers::sqrt2));
    const float error = exp2Of((1 - feature) * log2Of(colour));
    out[i] = distance > 1e-20f ? (error < 1 ? error : 1) : 0;
  }
}

}  // namespace

GLINT_CLONES
void flipCompareRow(const FlipFilters& filters, const float* const* reference,
                    const float* const* test, int begin, int end, std::size_t stride,
                    float* errors) {
  static const auto largest = static_cast<float>(largestDifference());
  const Matrices& m = matrices();
  Block a, b;
  for (int x = begin; x < end; x += flipBlock) {
    const int count = std::min(flipBlock, end - x);
    filterBlock(filters, reference, stride, x, count, a);
    filterBlock(filters, test, stride, x, count, b);
    compareBlock(a, b, count, m, largest, errors + x);
  }
}

}  // namespace glint::detail
