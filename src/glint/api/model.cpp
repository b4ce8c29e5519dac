#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "glint/api/model_state.h"

namespace glint {
namespace {

[[noreturn]] void failMemory() {
  throw Error("model in memory: " + std::generic_category().message(errno) +
              ": give the model as a file");
}

}  // namespace

MemoryFile::MemoryFile(std::span<const std::byte> bytes)
    : descriptor_(::memfd_create("glint", MFD_CLOEXEC)) {
  if (descriptor_ < 0) failMemory();
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int error = errno;
      ::close(descriptor_);
      errno = error;
      failMemory();
    }
    bytes = bytes.subspan(std::size_t(written));
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

Model::State::State(const std::filesystem::path& path) : name(path.string()) {
  file.emplace(path);
  request.emplace();
  scene = file->take(*request);
  bounds = restBounds = boundsOf(scene);
}

Model::State::State(std::span<const std::byte> bytes, std::string called)
    : name(std::move(called)), memory(std::in_place, bytes) {
  named([&] {
    file.emplace(memory->path());
    request.emplace();
    scene = file->take(*request);
  });
  scene.name = name;
  bounds = restBounds = boundsOf(scene);
}

void Model::State::pose(const Look& look) {
  const PoseRequest wanted = poseOf(look);
  if (request == wanted) return;
  request.reset();
  named([&] { changed = file->pose(scene, wanted); });
  request = wanted;
  bounds = boundsOf(scene);
  ++posed;
}

Model::Model(std::shared_ptr<State> state) : state_(std::move(state)) {}

Model Model::load(const std::filesystem::path& path) {
  return Model(std::make_shared<State>(path));
}

Model Model::fromMemory(std::span<const std::byte> file) {
  return Model(std::make_shared<State>(file, "the model in memory"));
}

Model Model::fromArrays(std::span<const Arrays> parts) {
  return Model(std::make_shared<State>(glbOf(parts), "the arrays"));
}

std::vector<std::string> Model::warnings() const {
  const std::lock_guard lock(state_->mutex);
  return state_->scene.warnings;
}

std::array<double, 4> Model::bounds() const {
  const std::lock_guard lock(state_->mutex);
  const Bounds& all = state_->restBounds;
  return {all.center.x, all.center.y, all.center.z, all.radius};
}

}  // namespace glint
