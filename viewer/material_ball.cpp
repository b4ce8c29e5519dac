#include "material_ball.h"

#include <algorithm>
#include <cmath>

#include "glint/image/srgb.h"

namespace glint::viewer {

Thumbnail ballOf(const ShadingParameters& s, const FitForm& form, int side) {
  Thumbnail ball{side, side, {}};
  ball.rgba.assign(std::size_t(4) * std::size_t(side) * std::size_t(side), 0);
  const glm::dvec3 L = glm::normalize(glm::dvec3(-0.5, 0.7, 1)), V(0, 0, 1);
  const glm::dvec3 ambient = s.ambient * s.color * 0.1;
  constexpr int samples = 3;  // per side of a pixel
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      glm::dvec3 sum(0.0);
      int inside = 0;
      for (int k = 0; k < samples * samples; ++k) {
        const int column = k % samples, row = k / samples;
        const double u = (x + (column + 0.5) / samples) / side * 2 - 1;
        const double v = 1 - (y + (row + 0.5) / samples) / side * 2;
        const double square = u * u + v * v;
        if (square >= 1) continue;
        const glm::dvec3 N(u, v, std::sqrt(1 - square));
        // The lobe functions expect the normal along z.
        const glm::dvec3 across = glm::normalize(
            glm::cross(N, std::abs(N.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dmat3 frame(across, glm::cross(N, across), N);
        const glm::dmat3 local = glm::transpose(frame);
        sum += ambient + modelLight(s, form, local * L, local * V);
        ++inside;
      }
      if (inside == 0) continue;
      std::uint8_t* out =
          ball.rgba.data() + std::size_t(4) * (std::size_t(side) * std::size_t(y) + std::size_t(x));
      for (int c = 0; c < 3; ++c) out[c] = encodeSrgb8(float(sum[c] / inside));
      out[3] = std::uint8_t(255 * inside / (samples * samples));
    }
  return ball;
}

}  // namespace glint::viewer
