#include "glint/image/error.h"
#include "glint/study/format.h"
#include "glint/study/report_words.h"
#include "glint/study/study.h"

namespace glint {

FrameClock clockFor(std::optional<FrameClock> asked, std::string_view renderer, bool hasGpuTimer) {
  const bool gpu = hasGpuTimer && !drawsOnCpu(renderer);
  if (asked == FrameClock::gpu && !gpu)
    throw InputError("--clock gpu: " + std::string(renderer) +
                     (hasGpuTimer ? " draws on the CPU" : " has no timer") + ": give wall or cpu");
  return asked.value_or(gpu ? FrameClock::gpu : FrameClock::wall);
}

std::string whyNoFront(const std::array<ClockNoise, frameClocks>& noise, FrameClock clock,
                       double spreadLimit) {
  const double spread = noise[std::size_t(clock)].spread;
  if (spread <= spreadLimit) return {};
  std::string why = formatted(
      "There is no front: by %s one program, measured twice, differs from itself by up to "
      "%.1f %%, which is more than %g %%. ",
      clockWords(clock), 100 * spread, 100 * spreadLimit);
  for (const FrameClock other : {FrameClock::gpu, FrameClock::cpu}) {
    const double own = noise[std::size_t(other)].spread;
    if (other != clock && own > 0 && own <= spreadLimit)
      return why + formatted(
                       "By %s it is %.1f %%: give --clock %s, or measure when the "
                       "machine is idle.",
                       clockWords(other), 100 * own, std::string(clockName(other)).c_str());
  }
  return why + "Measure when the machine is idle, or with more --repetitions.";
}

}  // namespace glint
