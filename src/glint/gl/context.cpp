#include "glint/gl/context.h"

#include <glad/gl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <latch>
#include <mutex>
#include <thread>
#include <vector>

#include "glint/gl/backends.h"
#include "glint/image/task.h"

namespace glint {

namespace {

struct Name {
  Backend backend;
  const char* name;
};
constexpr Name names[] = {{Backend::automatic, "auto"},
                          {Backend::egl, "egl"},
                          {Backend::eglSoftware, "egl-software"},
                          {Backend::osmesa, "osmesa"}};

constexpr const char* eglSonames[] = {"libEGL.so.1"};

std::unique_ptr<Context> openSystemEgl(bool software) {
  return backends::openEgl(eglSonames, software);
}

std::unique_ptr<Context> openSystemOsmesa() {
  // Mesa has called it .so.8 since 2011; older builds and Debian's compatibility link use .so.6.
  const char* const sonames[] = {"libOSMesa.so.8", "libOSMesa.so.6"};
  return backends::openOsmesa(sonames);
}

constexpr backends::Opener egl{"egl", [] { return openSystemEgl(false); }};
constexpr backends::Opener eglSoftware{"egl-software", [] { return openSystemEgl(true); }};
constexpr backends::Opener osmesa{"osmesa", openSystemOsmesa};

/// Whether the system allows the threads that Mesa's software renderer starts: two kinds, one of
/// each per processor up to 16, plus a few for this program. An address space limit below 1 GiB
/// counts as no: the driver and its compiler take most of that.
bool hasThreadsForMesa() {
  rlimit addresses{};
  if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur < (rlim_t(1) << 30)) return false;
  const unsigned count = 2 * std::clamp(std::thread::hardware_concurrency(), 1u, 16u) + 4;
  std::latch all(1);
  std::vector<std::thread> threads;
  while (threads.size() < count && addWorker(threads, [&all] { all.wait(); })) continue;
  all.count_down();
  for (std::thread& thread : threads) thread.join();
  return threads.size() == count;
}

/// Whether Mesa can keep its cache of compiled shaders. Where it cannot make the folder it prints a
/// line of its own.
bool hasShaderCache() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  std::filesystem::path folder = variable("MESA_SHADER_CACHE_DIR");
  if (folder.empty()) folder = variable("XDG_CACHE_HOME");
  if (folder.empty() && !variable("HOME").empty()) folder = variable("HOME") / ".cache";
  if (folder.empty()) return true;  // that of the user's entry in the password file
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) folder = folder.parent_path();
  return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

/// Sets the environment variables that Mesa reads when a backend is opened; the user's own values
/// take precedence. Otherwise Mesa's warnings, including one per driver it skips, go to stderr.
void prepareEnvironment(Backend backend) {
  static std::mutex mutex;
  static bool softwareIsOurs = false;
  const std::lock_guard lock(mutex);
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  if (!hasShaderCache()) setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  // Mesa waits forever for a thread that could not be started; with 0 threads it draws in the
  // caller's.
  static const bool hasThreads = hasThreadsForMesa();
  if (!hasThreads) setenv("LP_NUM_THREADS", "0", 0);
  if (backend == Backend::eglSoftware && !std::getenv("LIBGL_ALWAYS_SOFTWARE")) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    softwareIsOurs = true;
  } else if (backend != Backend::eglSoftware && softwareIsOurs) {
    unsetenv("LIBGL_ALWAYS_SOFTWARE");
    softwareIsOurs = false;
  }
}

/// Whether the kernel exposes a GPU: a DRM device, or NVIDIA's own driver.
bool hasGpu() {
  std::error_code error;
  return std::filesystem::exists("/dev/dri", error) ||
         std::filesystem::exists("/dev/nvidiactl", error);
}

std::unique_ptr<Context> openPrepared(Backend backend) {
  const backends::Opener automatic[] = {egl, osmesa};
  switch (backend) {
    case Backend::egl:
      return backends::openFirst({&egl, 1}, hasGpu());
    case Backend::eglSoftware:
      return backends::openFirst({&eglSoftware, 1}, hasGpu());
    case Backend::osmesa:
      return backends::openFirst({&osmesa, 1}, hasGpu());
    case Backend::automatic:
      break;
  }
  return backends::openFirst(automatic, hasGpu());
}

std::string text(GLenum name) {
  const GLubyte* value = glGetString(name);
  return value ? reinterpret_cast<const char*>(value) : "";
}

}  // namespace

std::unique_ptr<Context> backends::openFirst(std::span<const Opener> openers, bool hasGpu) {
  std::string reasons, remark;
  for (const Opener& opener : openers) {
    try {
      std::unique_ptr<Context> context = opener.open();
      context->addRemark(remark);
      return context;
    } catch (const ContextError& error) {
      const std::string reason = std::string(opener.name) + ": " + error.what();
      reasons += (reasons.empty() ? "" : "; ") + reason;
      if (hasGpu || !dynamic_cast<const MissingLibrary*>(&error))
        remark += (remark.empty() ? "" : "; ") + reason;
    }
  }
  throw ContextError(openers.size() == 1 ? reasons : "no OpenGL context: " + reasons);
}

std::unique_ptr<Context> backends::openSystemEs3() {
  prepareEnvironment(Backend::egl);
  return openEgl(eglSonames, false, Api::es3);
}

const char* backendName(Backend backend) {
  for (const Name& entry : names)
    if (entry.backend == backend) return entry.name;
  return "";
}

Backend backendFromName(std::string_view name, std::string_view more) {
  std::string all;
  for (const Name& entry : names) {
    if (entry.name == name) return entry.backend;
    all += (all.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw InputError("there is no rendering backend \"" + std::string(name) + "\": use one of " +
                   all + std::string(more));
}

void Context::makeCurrent() {
  bind();
  const int version = glint_gladLoadGL(loader());
  static_assert(leastVersion == GLAD_MAKE_VERSION(3, 3));
  if (version < least_) {
    const std::string got = version ? text(GL_VERSION) : "no OpenGL";
    release();
    throw ContextError(description_ + ": OpenGL 3.3 is needed, the driver gives " + got);
  }
}

void Context::addRemark(const std::string& line) {
  if (!line.empty()) remark_ += (remark_.empty() ? "" : "; ") + line;
}

std::unique_ptr<Context> openContext(Backend backend) {
  prepareEnvironment(backend);
  return openPrepared(backend);
}

std::future<std::unique_ptr<Context>> openContextAsync(Backend backend) {
  prepareEnvironment(backend);
  return startTask([backend] { return openPrepared(backend); });
}

GlStrings glStrings() { return {text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION)}; }

bool drawsFromOwnMemory() {
  return GLINT_GLAD_GL_AMD_pinned_memory != 0 && text(GL_RENDERER).starts_with("llvmpipe");
}

BackendReport probeBackend(Backend backend) {
  BackendReport report{backend, false, {}};
  try {
    const std::unique_ptr<Context> context = openContext(backend);
    context->makeCurrent();
    const GlStrings gl = glStrings();
    report.works = true;
    report.detail =
        context->description() + "; " + gl.vendor + "; " + gl.renderer + "; OpenGL " + gl.version;
    if (!context->remark().empty()) report.detail += "; skipped: " + context->remark();
  } catch (const ContextError& error) {
    report.detail = error.what();
  }
  return report;
}

std::vector<BackendReport> probeBackends() {
  return {probeBackend(Backend::egl), probeBackend(Backend::eglSoftware),
          probeBackend(Backend::osmesa)};
}

}  // namespace glint
