#include "reference_task.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "glint/image/error.h"
#include "glint/render/reference_renderer.h"

namespace glint {
namespace {

constexpr int rowsAtOnce = 16;

// Threads that it starts inherit this: the window comes first.
void stepBack() { setpriority(PRIO_PROCESS, 0, 10); }

void draw(const Model& model, ReferencePicture& picture, const std::atomic<bool>& stop,
          const std::function<void()>& progressed) {
  using Clock = std::chrono::steady_clock;
  const int threads = std::max(1, int(std::thread::hardware_concurrency()) - 1);
  ReferenceRenderer renderer(model.scene, model.images, model.bounds, picture.look, threads);
  Image band;
  auto told = Clock::now();
  const int height = picture.linear.height;
  for (int y = 0; y < height && !stop; y += rowsAtOnce) {
    const int rows = std::min(rowsAtOnce, height - y);
    renderer.drawRows(y, rows, band);
    std::ranges::copy(band.values, picture.linear.row(y));
    picture.rows = y + rows;
    if (progressed && Clock::now() - told > std::chrono::milliseconds(100)) {
      told = Clock::now();
      progressed();
    }
  }
}

}  // namespace

Look exactLook(const Look& look) {
  Look exact = comparableLook(look);
  exact.highlight = Highlight::exact;
  exact.fresnel = Fresnel::exact;
  return exact;
}

Look comparableLook(const Look& look) {
  Look plain = look;
  if (plain.antiAliasing.mode == AntiAliasing::Mode::msaa)
    plain.antiAliasing = {AntiAliasing::Mode::none, 1};
  return plain;
}

ReferenceTask::ReferenceTask(std::function<void()> progressed)
    : progressed_(std::move(progressed)), worker_(stepBack) {}

void ReferenceTask::want(std::shared_ptr<const Model> model, const Look& look) {
  const Look exact = exactLook(look);
  if (picture_ && picture_->look == exact && model == model_) return;
  model_ = std::move(model);
  picture_ = std::make_shared<ReferencePicture>();
  picture_->look = exact;
  const glm::ivec2 size = exact.resolution;
  picture_->linear = {size.x, size.y, {}};
  picture_->linear.values.resize(std::size_t(4) * std::size_t(size.x) * std::size_t(size.y));
  worker_.latest([model = model_, picture = picture_, this](const std::atomic<bool>& stop) {
    try {
      draw(*model, *picture, stop, progressed_);
    } catch (const std::exception& error) {
      picture->error = error.what();
      picture->failed = true;
    }
    if (progressed_ && !stop) progressed_();
  });
}

void ReferenceTask::stop() {
  worker_.stopLatest();
  picture_.reset();
  model_.reset();
}

}  // namespace glint
