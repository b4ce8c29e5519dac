#pragma once

// FLIP as defined in the paper: two-dimensional filters, in double. Slow, and written independently
// of src/image.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace glint::test {

using Rgb = std::array<double, 3>;

inline Rgb xyzOf(const Rgb& c) {
  return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
          (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
          (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
}

inline Rgb rgbOf(const Rgb& xyz) {
  // Cramer's rule on the columns of the primaries.
  const Rgb r = xyzOf({1, 0, 0}), g = xyzOf({0, 1, 0}), b = xyzOf({0, 0, 1});
  const auto det = [](const Rgb& x, const Rgb& y, const Rgb& z) {
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - y[0] * (x[1] * z[2] - x[2] * z[1]) +
           z[0] * (x[1] * y[2] - x[2] * y[1]);
  };
  const double d = det(r, g, b);
  return {det(xyz, g, b) / d, det(r, xyz, b) / d, det(r, g, xyz) / d};
}

inline constexpr Rgb whitePoint{0.950428545, 1, 1.088900371};

inline Rgb huntLab(const Rgb& rgb) {
  const Rgb xyz = xyzOf(rgb);
  Rgb f;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / whitePoint[i], d = 6.0 / 29;
    f[i] = t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  }
  const double l = 116 * f[1] - 16;
  return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

inline double hyab(const Rgb& a, const Rgb& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// From pixels of linear RGB, rows from the top, the error of every pixel.
inline std::vector<double> flipByThePaper(int width, int height, const std::vector<Rgb>& reference,
                                          const std::vector<Rgb>& test, double ppd) {
  constexpr double pi = 3.14159265358979323846;
  const auto clampX = [&](int x) { return std::clamp(x, 0, width - 1); };
  const auto clampY = [&](int y) { return std::clamp(y, 0, height - 1); };
  const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
  const double sigma = 0.5 * 0.082 * ppd;
  const int featureRadius = int(std::ceil(3 * sigma));

  const auto filtered = [&](const std::vector<Rgb>& picture) {
    std::vector<Rgb> opponent(picture.size());  // Y, Cx, Cz
    for (std::size_t i = 0; i < picture.size(); ++i) {
      Rgb c = picture[i];
      for (double& v : c) v = std::clamp(v, 0.0, 1.0);
      const Rgb xyz = xyzOf(c);
      const double x = xyz[0] / whitePoint[0], y = xyz[1], z = xyz[2] / whitePoint[2];
      opponent[i] = {116 * y - 16, 500 * (x - y), 200 * (y - z)};
    }
    const double a1[3] = {1, 1, 34.1}, b1[3] = {0.0047, 0.0053, 0.04};
    const double a2[3] = {0, 0, 13.5}, b2[3] = {1e-5, 1e-5, 0.025};
    const int side = 2 * radius + 1;
    std::vector<Rgb> weights(std::size_t(side) * side);
    Rgb sums{};
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          const double d2 = (i * i + j * j) / (ppd * ppd);
          const double w = a1[c] * std::sqrt(pi / b1[c]) * std::exp(-pi * pi * d2 / b1[c]) +
                           a2[c] * std::sqrt(pi / b2[c]) * std::exp(-pi * pi * d2 / b2[c]);
          weights[std::size_t((j + radius) * side + i + radius)][c] = w;
          sums[c] += w;
        }
    std::vector<Rgb> lab(picture.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        Rgb sum{};
        for (int j = -radius; j <= radius; ++j)
          for (int i = -radius; i <= radius; ++i)
            for (std::size_t c = 0; c < 3; ++c)
              sum[c] += weights[std::size_t((j + radius) * side + i + radius)][c] / sums[c] *
                        opponent[std::size_t(clampY(y + j) * width + clampX(x + i))][c];
        const double l = (sum[0] + 16) / 116;
        Rgb rgb =
            rgbOf({(l + sum[1] / 500) * whitePoint[0], l, (l - sum[2] / 200) * whitePoint[2]});
        for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
        lab[std::size_t(y * width + x)] = huntLab(rgb);
      }
    return lab;
  };

  /// Norms of the responses to edges and to points.
  const auto features = [&](const std::vector<Rgb>& picture) {
    const int side = 2 * featureRadius + 1;
    std::vector<double> edge(std::size_t(side) * side), point(edge.size());
    double edgeSum[2] = {}, pointSum[2] = {};
    for (int j = -featureRadius; j <= featureRadius; ++j)
      for (int i = -featureRadius; i <= featureRadius; ++i) {
        const double g = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
        const std::size_t at = std::size_t((j + featureRadius) * side + i + featureRadius);
        edge[at] = -i * g;
        point[at] = (i * i / (sigma * sigma) - 1) * g;
        edgeSum[edge[at] > 0] += std::abs(edge[at]);
        pointSum[point[at] > 0] += std::abs(point[at]);
      }
    for (double& w : edge) w /= edgeSum[w > 0];
    for (double& w : point) w /= pointSum[w > 0];
    std::vector<std::array<double, 2>> norms(picture.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double e[2] = {}, p[2] = {};
        for (int j = -featureRadius; j <= featureRadius; ++j)
          for (int i = -featureRadius; i <= featureRadius; ++i) {
            Rgb c = picture[std::size_t(clampY(y + j) * width + clampX(x + i))];
            for (double& v : c) v = std::clamp(v, 0.0, 1.0);
            const double l = xyzOf(c)[1];
            const auto at = [&](int down, int across) {
              return std::size_t((down + featureRadius) * side + across + featureRadius);
            };
            e[0] += edge[at(j, i)] * l;
            e[1] += edge[at(i, j)] * l;
            p[0] += point[at(j, i)] * l;
            p[1] += point[at(i, j)] * l;
          }
        norms[std::size_t(y * width + x)] = {std::hypot(e[0], e[1]), std::hypot(p[0], p[1])};
      }
    return norms;
  };

  const double largest = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), 0.7);
  const auto labA = filtered(reference), labB = filtered(test);
  const auto featureA = features(reference), featureB = features(test);
  std::vector<double> errors(reference.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double power = std::pow(hyab(labA[i], labB[i]), 0.7), corner = 0.4 * largest;
    const double colour = power < corner ? 0.95 * power / corner
                                         : 0.95 + (power - corner) / (largest - corner) * 0.05;
    const double feature = std::sqrt(std::max(std::abs(featureA[i][0] - featureB[i][0]),
                                              std::abs(featureA[i][1] - featureB[i][1])) /
                                     std::sqrt(2.0));
    errors[i] = std::pow(colour, 1 - feature);
  }
  return errors;
}

}  // namespace glint::test
