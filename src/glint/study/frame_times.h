#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "glint/render/renderer.h"

namespace glint {

/// The clocks that a frame is measured with.
enum class FrameClock {
  wall,  ///< from the first GL call until glFinish returns
  cpu,   ///< user and system time of all threads of the process meanwhile
  gpu,   ///< GL_TIME_ELAPSED
};
inline constexpr std::size_t frameClocks = 3;

/// "wall", "cpu", "gpu".
std::string_view clockName(FrameClock);

/// Milliseconds of the frames of one picture, one a round.
struct FrameTimes {
  std::vector<double> wall, cpu;
  std::vector<double> query;  ///< GL_TIME_ELAPSED of the same frames; empty if GL has no such clock
  int batch = 1;              ///< frames drawn for each of these times, which are their means

  const std::vector<double>& by(FrameClock clock) const {
    return clock == FrameClock::cpu ? cpu : clock == FrameClock::gpu ? query : wall;
  }
};

/// Called between frames: true ends the work early.
using Stop = std::function<bool()>;

/// Measures how long the GPU takes for what is drawn between begin() and end().
class GpuTimer {
 public:
  virtual ~GpuTimer() = default;
  virtual bool works() const = 0;  ///< if false, nothing else is called
  virtual void begin() = 0;
  virtual void end() = 0;
  /// The time between the last begin() and end(), in multiples of the timer's resolution; waits for
  /// it.
  virtual double milliseconds() = 0;
};

/// GL_TIME_ELAPSED in the current context.
std::unique_ptr<GpuTimer> elapsedTimer();

/// Whether a driver draws on the CPU, by its GL_RENDERER: there the wall and CPU clocks are the
/// ones to use, while GL_TIME_ELAPSED may count only in the rasteriser's threads.
bool drawsOnCpu(std::string_view renderer);

/// How to measure.
struct Timing {
  int warmUp = 0;  ///< rounds whose times are not kept
  int rounds = 1;
  /// The GPU's timer decides: frames are drawn in batches large enough for its resolution to be at
  /// most `timerShare` of a batch.
  bool byGpu = false;
  Stop stop = {};
  std::function<void(int round)> done = {};  ///< called after each round, from -warmUp on
};

/// The largest share of a measurement that the resolution of the GPU's timer may be: a tenth of the
/// spread of a quiet machine.
inline constexpr double timerShare = 0.002;

/// Draws pictures in turn, A B C A B C, each round in another (repeatable) order, so that what
/// slows the machine down for a while affects all alike. In the warm-up rounds drivers compile for
/// the state they meet, some of them only after a few frames, and memory is touched for the first
/// time. Ends early, after a whole round, if `stop` says so. All pictures are of one renderer and
/// of one size.
std::vector<FrameTimes> timeInTurn(std::span<Renderer::Picture* const> pictures,
                                   const Timing& timing);

/// The same for anything that can be drawn; `finish` waits until it is done.
std::vector<FrameTimes> timeInTurn(std::span<const std::function<void()>> draws,
                                   const std::function<void()>& finish, GpuTimer& timer,
                                   const Timing& timing);

/// Draws once and returns the wall time in ms.
double timeOnce(Renderer::Picture& picture);

}  // namespace glint
