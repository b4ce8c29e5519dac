#include "glint/study/frame_times.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "glint/gl/handles.h"
#include "glint/image/clock.h"

namespace glint {
namespace {

/// GL_TIME_ELAPSED of what is drawn between begin and end.
class ElapsedClock {
 public:
  ElapsedClock() {
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    if (bits > 0) query_ = Query::make();
  }
  bool works() const { return bool(query_); }
  void begin() const {
    if (works()) glBeginQuery(GL_TIME_ELAPSED, query_.id());
  }
  void end() const {
    if (works()) glEndQuery(GL_TIME_ELAPSED);
  }
  /// Of the last begin and end; waits for it.
  double milliseconds() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
  }

 private:
  Query query_;
};

}  // namespace

double timeOnce(Renderer::Picture& picture) {
  const auto start = Clock::now();
  picture.redraw();
  glFinish();
  return since(start);
}

std::vector<FrameTimes> timeInTurn(std::span<Renderer::Picture* const> pictures, int warmUp,
                                   int rounds, const Stop& stop,
                                   const std::function<void(int)>& done) {
  const ElapsedClock clock;
  std::vector<FrameTimes> times(pictures.size());
  std::vector<std::size_t> order(pictures.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::mt19937 random(1);
  for (int round = -warmUp; round < rounds; ++round) {
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[std::size_t(std::uint64_t(random()) * i >> 32)]);
    std::vector<double> wall(pictures.size()), elapsed(pictures.size());
    for (const std::size_t i : order) {
      if (stop && stop()) return times;
      const auto start = Clock::now();
      clock.begin();
      pictures[i]->redraw();
      // Before the frame is waited for: a software driver forgets what it counted in a finished
      // part.
      clock.end();
      glFinish();
      wall[i] = since(start);
      if (clock.works()) elapsed[i] = clock.milliseconds();
    }
    if (done) done(round);
    if (round < 0) continue;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      times[i].wall.push_back(wall[i]);
      if (clock.works()) times[i].query.push_back(elapsed[i]);
    }
  }
  return times;
}

}  // namespace glint
