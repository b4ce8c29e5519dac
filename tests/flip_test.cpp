// FLIP compared with a slow version of the paper's formulas and with closed cases.

#include "glint/image/flip.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

#include "flip_reference.h"
#include "glint/image/error.h"

namespace glint::test::flip_test {

struct Picture {
  int width, height;
  std::vector<float> rgba;

  Picture(int w, int h, const std::function<Rgb(int x, int y)>& colour) : width(w), height(h) {
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        for (const double v : colour(x, y)) rgba.push_back(float(v));
        rgba.push_back(1);
      }
  }
  PixelRows rows() const {
    return {width, height, [this](int first, int count, float* out) {
              std::memcpy(out, rgba.data() + std::size_t(4) * width * first,
                          sizeof(float) * 4 * width * count);
            }};
  }
  std::vector<Rgb> doubles() const {
    std::vector<Rgb> pixels;
    for (std::size_t i = 0; i < rgba.size(); i += 4)
      pixels.push_back({rgba[i], rgba[i + 1], rgba[i + 2]});
    return pixels;
  }
};

Picture plain(int w, int h, const Rgb& colour) {
  return Picture(w, h, [&](int, int) { return colour; });
}

TEST(Flip, AgreesWithThePaper) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 1);
  const auto noise = [&](int, int) { return Rgb{any(random), any(random), any(random)}; };
  const std::array<int, 2> sizes[] = {{1, 1}, {1, 40}, {40, 1}, {3, 2}, {17, 33}, {70, 51}};
  for (const std::array<int, 2>& size : sizes) {
    const int w = size[0],
              h = size[1];  // Clang 14 cannot capture structured bindings in lambdas
    for (const double ppd : {67.0206432765823, 20.0, 5.0, 110.0}) {
      const Picture a(w, h, noise);
      // Small differences, large ones, edges, and no difference.
      const Picture tests[] = {Picture(w, h, noise),
                               Picture(w, h,
                                       [&](int x, int y) {
                                         const float* p = &a.rgba[std::size_t(4) * (y * w + x)];
                                         return Rgb{p[0] * 0.99, p[1], p[2] * 1.3};
                                       }),
                               Picture(w, h,
                                       [&](int x, int y) {
                                         const float* p = &a.rgba[std::size_t(4) * (y * w + x)];
                                         return x > w / 2 ? Rgb{0, 0, 1} : Rgb{p[0], p[1], p[2]};
                                       }),
                               a};
      for (const Picture& b : tests) {
        FlipOptions options;
        options.pixelsPerDegree = ppd;
        options.threads = 1 + int(random() % 3);
        std::vector<float> map;
        const FlipResult result = glint::flip(
            a.rows(), b.rows(), options,
            [&](int, const float* errors) { map.insert(map.end(), errors, errors + w); });
        const auto expected = glint::test::flipByThePaper(w, h, a.doubles(), b.doubles(), ppd);
        double mean = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          mean += expected[i] / double(expected.size());
          // Where the pictures are nearly equal, the power 0.7 and the square root of the features
          // turn a rounding of 1e-7 of a value into about 1e-4 of the error.
          ASSERT_NEAR(map[i], expected[i], 5e-4) << w << " x " << h << ", " << ppd;
        }
        EXPECT_NEAR(result.mean, mean, w * h > 1000 ? 2e-6 : 2e-5)
            << w << " x " << h << ", " << ppd;
      }
    }
  }
}

TEST(Flip, ClosedCases) {
  // Equal pictures: 0. Green and blue have the largest possible colour difference, by definition.
  const Picture green = plain(30, 20, {0, 1, 0}), blue = plain(30, 20, {0, 0, 1});
  EXPECT_EQ(glint::flip(green.rows(), green.rows()).mean, 0);
  EXPECT_NEAR(glint::flip(green.rows(), blue.rows()).mean, 1, 1e-6);
  // Uniform black and white, without features: lightness 100 apart.
  const double largest = std::pow(
      glint::test::hyab(glint::test::huntLab({0, 1, 0}), glint::test::huntLab({0, 0, 1})), 0.7);
  const double power = std::pow(100.0, 0.7), corner = 0.4 * largest;
  const double expected = 0.95 + 0.05 * (power - corner) / (largest - corner);
  const Picture black = plain(9, 9, {0, 0, 0}), white = plain(9, 9, {1, 1, 1});
  EXPECT_NEAR(glint::flip(black.rows(), white.rows()).mean, expected, 1e-6);
  // Values outside [0, 1] are clamped; NaN becomes black.
  EXPECT_EQ(glint::flip(white.rows(), plain(9, 9, {7, 2, 1e30}).rows()).mean, 0);
  EXPECT_EQ(glint::flip(black.rows(), plain(9, 9, {NAN, -1, 0}).rows()).mean, 0);
}

TEST(Flip, TheSameForAllThreads) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  const auto noise = [&](int, int) { return Rgb{any(random), any(random), any(random)}; };
  const Picture a(50, 900, noise), b(50, 900, noise);
  FlipOptions options;
  options.threads = 1;
  const FlipResult one = glint::flip(a.rows(), b.rows(), options);
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    EXPECT_EQ(glint::flip(a.rows(), b.rows(), options).mean, one.mean);
  }
}

TEST(Flip, IgnoredPixelsDoNotCount) {
  const Picture a = plain(40, 40, {0, 0, 0});
  const Picture b(40, 40, [](int x, int) { return x < 20 ? Rgb{1, 1, 1} : Rgb{0, 0, 0}; });
  const FlipResult right = glint::flip(a.rows(), b.rows(), {}, {}, [](int, unsigned char* row) {
    for (int x = 0; x < 40; ++x) row[x] = x >= 36;
  });
  EXPECT_EQ(right.pixels, 160u);
  EXPECT_LT(right.mean, 1e-6);
}

TEST(Flip, PixelsPerDegree) {
  EXPECT_NEAR(glint::pixelsPerDegree(0.7, 3840, 0.7), 67.0206, 1e-4);
  EXPECT_EQ(FlipOptions().pixelsPerDegree, glint::pixelsPerDegree(0.7, 3840, 0.7));
  FlipOptions options;
  options.pixelsPerDegree = 0;
  const Picture a = plain(1, 1, {0, 0, 0});
  EXPECT_THROW(glint::flip(a.rows(), a.rows(), options), glint::InputError);
}

/// The largest FLIP over `count` exposures from `start` to `stop`, by the paper's formulas.
std::vector<double> hdrByThePaper(const Picture& a, const Picture& b, double start, double stop,
                                  int count, const std::function<Rgb(Rgb)>& tone) {
  std::vector<double> largest(std::size_t(a.width) * a.height);
  for (int i = 0; i < count; ++i) {
    const double exposure = count > 1 ? start + i * (stop - start) / (count - 1) : start;
    std::vector<Rgb> mapped[2] = {a.doubles(), b.doubles()};
    for (auto& pixels : mapped)
      for (Rgb& p : pixels) {
        for (double& v : p) v *= std::exp2(exposure);
        p = tone(p);
      }
    const auto errors =
        glint::test::flipByThePaper(a.width, a.height, mapped[0], mapped[1], 67.0206432765823);
    for (std::size_t k = 0; k < errors.size(); ++k) largest[k] = std::max(largest[k], errors[k]);
  }
  return largest;
}

/// The value below which errors add up to this share of their sum.
double weightedQuantile(std::vector<double> errors, double share) {
  std::sort(errors.begin(), errors.end());
  double all = 0, below = 0;
  for (const double error : errors) all += error;
  for (const double error : errors)
    if ((below += error) >= share * all) return error;
  return 0;
}

// The tone mappers as published by their authors, with given exposures.
TEST(HdrFlip, ExposuresAndToneMappersAsGiven) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-5, 3);
  const auto noise = [&](int, int) {
    return Rgb{std::exp2(any(random)), std::exp2(any(random)), std::exp2(any(random))};
  };
  const Picture a(27, 19, noise), b(27, 19, noise);
  // Hable, "Filmic tonemapping operators" (2010): exposure bias 2, white at 11.2.
  const auto hable = [](Rgb p) {
    const auto curve = [](double x) {
      return (x * (0.15 * x + 0.10 * 0.50) + 0.20 * 0.02) / (x * (0.15 * x + 0.50) + 0.20 * 0.30) -
             0.02 / 0.30;
    };
    for (double& v : p) v = curve(2 * v) / curve(11.2);
    return p;
  };
  // Reinhard, Stark, Shirley, Ferwerda (2002), applied to the luminance.
  const auto reinhard = [](Rgb p) {
    const double luminance = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    for (double& v : p) v /= 1 + luminance;
    return p;
  };
  // Narkowicz, "ACES filmic tone mapping curve" (2015), and the paper's 0.6.
  const auto aces = [](Rgb p) {
    for (double& v : p) {
      v *= 0.6;
      v = v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
    }
    return p;
  };
  struct Case {
    glint::ToneMapper mapper;
    std::function<Rgb(Rgb)> tone;
    double start, stop;
    int count;
  };
  const Case cases[] = {{glint::ToneMapper::hable, hable, -2, 3, 4},
                        {glint::ToneMapper::reinhard, reinhard, -3.5, 1, 3},
                        {glint::ToneMapper::aces, aces, 0.5, 2.5, 2},
                        {glint::ToneMapper::aces, aces, -1, -1, 1}};
  for (const Case& c : cases) {
    FlipOptions options;
    options.toneMapper = c.mapper;
    options.startExposure = c.start;
    options.stopExposure = c.stop;
    options.exposures = c.count;
    const FlipResult result = glint::hdrFlip(a.rows(), b.rows(), options);
    EXPECT_EQ(result.startExposure, c.start);
    EXPECT_EQ(result.stopExposure, c.stop);
    EXPECT_EQ(result.exposures, c.count);
    const auto errors = hdrByThePaper(a, b, c.start, c.stop, c.count, c.tone);
    double mean = 0;
    for (const double error : errors) mean += error / double(errors.size());
    EXPECT_NEAR(result.mean, mean, 2e-5);
    // The median and the quartiles weighted by the errors themselves, to half a step of 1/65536.
    EXPECT_NEAR(result.median, weightedQuantile(errors, 0.5), 5e-4);
    EXPECT_NEAR(result.firstQuartile, weightedQuantile(errors, 0.25), 5e-4);
    EXPECT_NEAR(result.thirdQuartile, weightedQuantile(errors, 0.75), 5e-4);
  }
  // One per stop within the given range.
  FlipOptions options;
  options.startExposure = -1;
  options.stopExposure = 3.5;
  EXPECT_EQ(glint::hdrFlip(a.rows(), b.rows(), options).exposures, 5);
  options.startExposure = 4;
  EXPECT_THROW(glint::hdrFlip(a.rows(), b.rows(), options), glint::InputError);
}

TEST(HdrFlip, IsTheLargestOverExposures) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-6, 4);
  const auto noise = [&](int, int) {
    return Rgb{std::exp2(any(random)), std::exp2(any(random)), std::exp2(any(random))};
  };
  const Picture a(21, 15, noise), b(21, 15, noise);
  const FlipResult result = glint::hdrFlip(a.rows(), b.rows());
  // The tone curve x (0.9036 x + 0.018) / (x (0.8748 x + 0.354) + 0.14) reaches 0.85 at the
  // brightest pixel and at the median.
  const auto curve = [](double x) {
    return x * (0.9036 * x + 0.018) / (x * (0.8748 * x + 0.354) + 0.14);
  };
  std::vector<double> luminances;
  for (const Rgb& p : a.doubles())
    luminances.push_back(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
  std::sort(luminances.begin(), luminances.end());
  EXPECT_NEAR(curve(luminances.back() * std::exp2(result.startExposure)), 0.85, 1e-6);
  EXPECT_NEAR(curve(luminances[luminances.size() / 2] * std::exp2(result.stopExposure)), 0.85,
              1e-6);
  EXPECT_EQ(result.exposures,
            std::max(2, int(std::ceil(result.stopExposure - result.startExposure))));
  const auto largest =
      hdrByThePaper(a, b, result.startExposure, result.stopExposure, result.exposures, [&](Rgb p) {
        for (double& v : p) v = curve(v);
        return p;
      });
  double mean = 0;
  for (const double error : largest) mean += error / double(largest.size());
  EXPECT_NEAR(result.mean, mean, 2e-6);
  // Black references give no exposure range of their own.
  const Picture black = plain(4, 4, {0, 0, 0}), grey = plain(4, 4, {0.1, 0.1, 0.1});
  EXPECT_GT(glint::hdrFlip(black.rows(), grey.rows()).mean, 0.1);
  EXPECT_EQ(glint::hdrFlip(black.rows(), black.rows()).mean, 0);
}

}  // namespace glint::test::flip_test
