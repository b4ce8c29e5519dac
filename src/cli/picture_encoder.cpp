#include "picture_encoder.h"

#include "glint/image/clock.h"
#include "glint/image/task.h"
#include "glint/options/exit_status.h"

namespace glint {
namespace {

constexpr std::size_t waitingLimit = 3;

}  // namespace

PictureEncoder::PictureEncoder() : thread_(startThread([this] { work(); })) {}

PictureEncoder::~PictureEncoder() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

Image PictureEncoder::takeImage() {
  const std::lock_guard lock(mutex_);
  if (images_.empty()) return {};
  Image image = std::move(images_.back());
  images_.pop_back();
  return image;
}

bool PictureEncoder::write(const std::shared_ptr<OutgoingPicture>& picture, Image rows) {
  {
    const std::lock_guard lock(mutex_);
    if (!picture->error.empty()) return false;
  }
  auto image = std::make_shared<Image>(std::move(rows));
  add([this, picture, image] {
    const auto start = Clock::now();
    std::string error;
    try {
      if (picture->error.empty()) picture->writer->write(*image);
    } catch (const std::exception& failure) {
      error = failureOf(failure, "the picture");
    }
    const std::lock_guard lock(mutex_);
    if (!error.empty()) picture->error = error;
    picture->encodeTime += since(start);
    if (images_.size() < waitingLimit) images_.push_back(std::move(*image));
  });
  return true;
}

void PictureEncoder::then(std::function<void()> task) { add(std::move(task)); }

void PictureEncoder::add(std::function<void()> task) {
  if (!thread_.joinable()) return task();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return tasks_.size() < waitingLimit || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  tasks_.push_back(std::move(task));
  changed_.notify_all();
}

void PictureEncoder::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return (tasks_.empty() && !busy_) || failure_; });
  if (failure_) std::rethrow_exception(failure_);
}

void PictureEncoder::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ended_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    auto task = std::move(tasks_.front());
    tasks_.pop_front();
    busy_ = true;
    changed_.notify_all();
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (!failure_) task();
    } catch (...) {
      failure = std::current_exception();
    }
    task = nullptr;  // releases its pictures before finish() returns
    lock.lock();
    if (failure) failure_ = failure;
    busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace glint
