#include <algorithm>
#include <cmath>

#include "glint/image/flip.h"

namespace glint {

void magma(float error, unsigned char rgb[3]) {
  // The Magma map of Smith and van der Walt (2015, CC0) at 16 even steps, 8-bit sRGB, with linear
  // interpolation in between, which is within 3 codes of the map.
  static constexpr unsigned char stops[16][3] = {
      {0, 0, 4},       {11, 9, 36},     {32, 17, 75},    {59, 15, 112},
      {87, 21, 126},   {114, 31, 129},  {140, 41, 129},  {168, 50, 125},
      {196, 60, 117},  {222, 73, 104},  {241, 96, 93},   {250, 127, 94},
      {254, 159, 109}, {254, 191, 132}, {253, 222, 160}, {252, 253, 191}};
  const float at = std::clamp(error, 0.0f, 1.0f) * 15;
  const int index = std::min(14, static_cast<int>(at));
  const float part = at - static_cast<float>(index);
  for (int c = 0; c < 3; ++c) {
    const float low = stops[index][c], high = stops[index + 1][c];
    rgb[c] = static_cast<unsigned char>(std::lround(low + part * (high - low)));
  }
}

}  // namespace glint
