#include "error_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "glint/image/flip.h"
#include "glint/image/srgb.h"

namespace glint::viewer {

ErrorNumbers errorNumbers(const Image& picture, const Image& exact,
                          const std::vector<std::uint8_t>& edges, int rows, double exposure) {
  ErrorNumbers n;
  const float scale = float(std::exp2(exposure));
  double squares = 0;
  std::size_t values = 0;
  for (int y = 0; y < rows; ++y) {
    const float *a = picture.row(y), *b = exact.row(y);
    for (int x = 0; x < picture.width; ++x, a += 4, b += 4) {
      if (!edges.empty() && edges[std::size_t(picture.width) * std::size_t(y) + std::size_t(x)]) {
        ++n.edges;
        continue;
      }
      double largest = 0, square = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = std::abs(double(a[c]) - double(b[c]));
        largest = d <= largest ? largest : d;  // keeps NaN
        square += d * d;
      }
      if (!std::isfinite(square)) {
        ++n.notFinite;
        continue;
      }
      squares += square;
      values += 3;
      if (largest > n.largest) {
        n.largest = largest;
        n.where = {x, y};
      }
      if (largest == 0) continue;
      for (int c = 0; c < 3; ++c)
        n.levels = std::max(
            n.levels, std::abs(int(encodeSrgb8(a[c] * scale)) - int(encodeSrgb8(b[c] * scale))));
    }
  }
  if (values > 0) n.rmse = std::sqrt(squares / double(values));
  return n;
}

double errorShade(double error) {
  if (!(error > leastError)) return 0;
  return std::min(1.0, 1 - std::log10(error) / std::log10(leastError));
}

std::vector<std::uint8_t> errorScale(int steps) {
  std::vector<std::uint8_t> out(std::size_t(4) * std::size_t(steps), 255);
  for (int i = 0; i < steps; ++i)
    magma((float(i) + 0.5f) / float(steps), out.data() + std::size_t(4) * std::size_t(i));
  return out;
}

std::vector<std::uint8_t> errorMap(const Image& picture, const Image& exact, int rows) {
  std::vector<std::uint8_t> out(picture.values.size(), 255);
  for (int y = 0; y < picture.height; ++y) {
    std::uint8_t* to = out.data() + std::size_t(4) * std::size_t(picture.width) * std::size_t(y);
    for (int x = 0; x < picture.width; ++x, to += 4) {
      to[0] = to[1] = to[2] = 40;
      if (y >= rows) continue;
      const float* a = picture.row(y) + std::size_t(4) * std::size_t(x);
      const float* b = exact.row(y) + std::size_t(4) * std::size_t(x);
      float largest = 0;
      bool finite = true;
      for (int c = 0; c < 3; ++c) {
        const float d = std::abs(a[c] - b[c]);
        finite = finite && std::isfinite(d);
        largest = std::max(largest, d);
      }
      if (finite) {
        magma(float(errorShade(double(largest))), to);
      } else {
        to[0] = to[2] = 0;
        to[1] = 255;
      }
    }
  }
  return out;
}

}  // namespace glint::viewer
