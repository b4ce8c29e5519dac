// The time of FLIP compared with a direct implementation of the paper's formulas, in one run.
//
//     flip_benchmark [WIDTH HEIGHT ROUNDS]
//
// The direct version (two-dimensional filters, double, one thread) runs on a part of the picture,
// and its time, which is proportional to the area, is scaled to the whole. Wall time is followed by
// CPU time, which a busy machine lengthens less.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>

#include "../flip_reference.h"
#include "glint/image/flip.h"

namespace {

using Clock = std::chrono::steady_clock;

struct Seconds {
  double passed, used;
};

template <class Work>
Seconds secondsOf(Work work) {
  const std::clock_t used = std::clock();
  const auto start = Clock::now();
  work();
  return {std::chrono::duration<double>(Clock::now() - start).count(),
          double(std::clock() - used) / CLOCKS_PER_SEC};
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc > 1 ? std::atoi(argv[1]) : 1920;
  const int height = argc > 2 ? std::atoi(argv[2]) : 1080;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 5;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(0, 1);
  std::vector<float> a(std::size_t(4) * width * height), b(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = any(random);
    b[i] = i % 3 == 0 ? any(random) : a[i];
  }
  const auto rows = [&](const std::vector<float>& of) {
    return glint::PixelRows{width, height, [&, width](int first, int count, float* out) {
                              std::memcpy(out, of.data() + std::size_t(4) * width * first,
                                          sizeof(float) * 4 * width * count);
                            }};
  };
  constexpr int partWidth = 96, partHeight = 64;
  std::vector<glint::test::Rgb> partA, partB;
  for (std::size_t i = 0; i < partWidth * partHeight; ++i) {
    partA.push_back({a[4 * i], a[4 * i + 1], a[4 * i + 2]});
    partB.push_back({b[4 * i], b[4 * i + 1], b[4 * i + 2]});
  }
  std::printf("%d x %d, seconds passed (used)\n%20s%20s%20s\n", width, height, "all threads",
              "one thread", "straight, scaled");
  for (int round = 0; round < rounds; ++round) {
    double mean = 0;
    glint::FlipOptions one;
    one.threads = 1;
    const Seconds all = secondsOf([&] { mean += glint::flip(rows(a), rows(b)).mean; });
    const Seconds single = secondsOf([&] { mean += glint::flip(rows(a), rows(b), one).mean; });
    const Seconds straight = secondsOf([&] {
      [[maybe_unused]] const auto errors =
          glint::test::flipByThePaper(partWidth, partHeight, partA, partB, 67.0206);
    });
    const double whole = double(width) * height / (partWidth * partHeight);
    std::printf("%12.3f (%.3f)%12.3f (%.3f)%12.1f (%.1f)   mean %.4f\n", all.passed, all.used,
                single.passed, single.used, straight.passed * whole, straight.used * whole,
                mean / 2);
  }
}
