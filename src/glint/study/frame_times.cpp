#include "glint/study/frame_times.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "glint/gl/handles.h"
#include "glint/image/clock.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

class ElapsedTimer : public GpuTimer {
 public:
  ElapsedTimer() {
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    if (bits > 0) query_ = Query::make();
  }
  bool works() const override { return bool(query_); }
  void begin() override { glBeginQuery(GL_TIME_ELAPSED, query_.id()); }
  void end() override { glEndQuery(GL_TIME_ELAPSED); }
  double milliseconds() override {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
  }

 private:
  Query query_;
};

/// Milliseconds that all threads of the process have run so far, in user and system mode.
double processorTime() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto of = [](const timeval& t) {
    return 1e3 * double(t.tv_sec) + 1e-3 * double(t.tv_usec);
  };
  return of(used.ru_utime) + of(used.ru_stime);
}

/// The smallest step between different times, which is a multiple of the timer's resolution; 0 if
/// all are the same.
double smallestStep(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  double step = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double each = times[i] - times[i - 1];
    if (each > 1e-9 * times[i] && (step == 0 || each < step)) step = each;
  }
  return step;
}

/// One measurement of one picture.
struct Measured {
  double wall = 0, cpu = 0, query = 0;
};

Measured measure(const std::function<void()>& draw, const std::function<void()>& finish,
                 GpuTimer& timer, int batch) {
  Measured m;
  const double before = processorTime();
  const auto start = Clock::now();
  if (timer.works()) timer.begin();
  for (int i = 0; i < batch; ++i) draw();
  // Ends before the frame is waited for: a software driver drops its count of a finished part.
  if (timer.works()) timer.end();
  finish();
  m.wall = since(start) / batch;
  m.cpu = (processorTime() - before) / batch;
  if (timer.works()) m.query = timer.milliseconds() / batch;
  return m;
}

/// The number of frames for which the timer's resolution, as estimated from `times` of single
/// frames, is a small enough share. If all times are the same, the resolution is coarser than they
/// are.
int batchFor(const std::vector<double>& times) {
  constexpr int most = 1000;
  if (times.empty()) return 1;
  const double typical = quantile(times, 0.5), step = smallestStep(times);
  const double resolution = step > 0 ? step : typical;
  if (!(typical > 0)) return most;
  return int(std::clamp(std::ceil(resolution / (timerShare * typical)), 1.0, double(most)));
}

}  // namespace

std::string_view clockName(FrameClock clock) {
  constexpr std::array<std::string_view, frameClocks> names{"wall", "cpu", "gpu"};
  return names[std::size_t(clock)];
}

std::unique_ptr<GpuTimer> elapsedTimer() { return std::make_unique<ElapsedTimer>(); }

bool drawsOnCpu(std::string_view renderer) {
  for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "SWR", "SwiftShader",
                                      "Software Rasterizer", "Software Renderer", "Basic Render"})
    if (renderer.find(name) != renderer.npos) return true;
  return false;
}

double timeOnce(Renderer::Picture& picture) {
  const auto start = Clock::now();
  picture.redraw();
  glFinish();
  return since(start);
}

std::vector<FrameTimes> timeInTurn(std::span<const std::function<void()>> draws,
                                   const std::function<void()>& finish, GpuTimer& timer,
                                   const Timing& timing) {
  const std::size_t count = draws.size();
  std::vector<FrameTimes> times(count);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::vector<std::vector<double>> single(count);  // by the GPU's timer, before batches
  std::mt19937 random(1);
  for (int round = -timing.warmUp; round < timing.rounds; ++round) {
    if (round == 0 && timing.byGpu && timer.works())
      for (std::size_t i = 0; i < count; ++i) times[i].batch = batchFor(single[i]);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[std::size_t(std::uint64_t(random()) * i >> 32)]);
    std::vector<Measured> measured(count);
    for (const std::size_t i : order) {
      if (timing.stop && timing.stop()) return times;
      measured[i] = measure(draws[i], finish, timer, times[i].batch);
    }
    if (timing.done) timing.done(round);
    for (std::size_t i = 0; i < count; ++i) {
      if (round < 0) {
        single[i].push_back(measured[i].query);
        continue;
      }
      times[i].wall.push_back(measured[i].wall);
      times[i].cpu.push_back(measured[i].cpu);
      if (timer.works()) times[i].query.push_back(measured[i].query);
    }
  }
  return times;
}

std::vector<FrameTimes> timeInTurn(std::span<Renderer::Picture* const> pictures,
                                   const Timing& timing) {
  std::vector<std::function<void()>> draws;
  for (Renderer::Picture* picture : pictures) draws.push_back([picture] { picture->redraw(); });
  const auto timer = elapsedTimer();
  return timeInTurn(
      draws, [] { glFinish(); }, *timer, timing);
}

}  // namespace glint
