#pragma once

#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/error.h"

namespace glint {

/// A way to get an OpenGL 3.3 core context without a window.
/// - automatic: egl, then osmesa.
/// - egl: the GPUs that EGL lists, in its order; then Mesa's surfaceless platform; then the
///   software device. Listing takes no measurable time without a GPU. GPUs are skipped if
///   LIBGL_ALWAYS_SOFTWARE is true in the environment.
/// - eglSoftware: Mesa's software renderer even if there is a GPU: the EGL device marked
///   EGL_MESA_device_software, then the surfaceless platform. LIBGL_ALWAYS_SOFTWARE is set for
///   this, and GL_RENDERER is checked.
/// - osmesa: Mesa's off-screen library, always software. Mesa 25.1 and newer no longer have it.
enum class Backend { automatic, egl, eglSoftware, osmesa };

/// "auto", "egl", "egl-software", "osmesa": as on the command line.
const char* backendName(Backend backend);

/// The backend with this name. Throws InputError that lists the names, followed by `more`: others
/// that the caller accepts, such as ", reference".
Backend backendFromName(std::string_view name, std::string_view more = {});

/// There is no OpenGL context. what() is one line or, for Backend::automatic, a heading and one
/// line per backend with the reason why it does not work. The program exits with status 3.
class ContextError : public Error {
 public:
  using Error::Error;
};

/// An OpenGL 3.3 core context without a usable default framebuffer: all drawing goes into
/// framebuffer objects. At most one context is current at a time; objects created in it must be
/// deleted before it is.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes the context current on the calling thread and loads the GL function pointers, which are
  /// global: they belong to the context made current last. Throws ContextError.
  void makeCurrent();

  /// Releases the context from the calling thread, so that another thread can make it current.
  virtual void release() = 0;

  /// What was opened: egl, eglSoftware or osmesa.
  Backend backend() const { return backend_; }

  /// What was opened, for display: "egl: device 0, /dev/dri/renderD128".
  const std::string& description() const { return description_; }

  /// Why something preferable was skipped: a GPU that cannot be opened, or EGL missing with
  /// `automatic`. One line; empty if nothing was skipped.
  const std::string& remark() const { return remark_; }
  void addRemark(const std::string& text);

 protected:
  using Function = void (*)();
  using Loader = Function (*)(const char* name);
  static constexpr int leastVersion = 30003;  ///< encoded as in glad: 3.3
  Context(Backend backend, std::string description, int least = leastVersion)
      : backend_(backend), description_(std::move(description)), least_(least) {}

 private:
  virtual void bind() = 0;
  virtual Loader loader() const = 0;

  Backend backend_;
  std::string description_, remark_;
  int least_;
};

/// Opens a context without making it current, so that this can run on another thread than
/// makeCurrent. No context may be current on the calling thread. Throws ContextError. The first
/// call may set environment variables that keep Mesa from writing to stderr (EGL_LOG_LEVEL) or make
/// it use software (eglSoftware); see openContextAsync.
std::unique_ptr<Context> openContext(Backend backend);

/// Runs openContext on its own thread: loading the driver takes 60 to 90 ms of a cold start, enough
/// to read a model meanwhile. Environment variables are set before the thread starts, because
/// setting them while another thread reads one is a race. get() rethrows errors.
std::future<std::unique_ptr<Context>> openContextAsync(Backend backend);

/// Vendor, renderer and version of the driver, as reported by GL.
struct GlStrings {
  std::string vendor, renderer, version;
};

/// The strings of the current context.
GlStrings glStrings();

/// Whether the current context's driver draws from buffers in the program's own memory
/// (GL_AMD_pinned_memory) as fast as from its own. This is true for a software driver, which then
/// needs no copy.
bool drawsFromOwnMemory();

/// Whether a backend works on this machine.
struct BackendReport {
  Backend backend;
  bool works;
  std::string detail;  ///< what was opened and the GL strings, or one line with the reason why not
};

/// Tries one backend. The calling thread must have no context current, and has none afterwards.
BackendReport probeBackend(Backend backend);

/// Tries egl, egl-software and osmesa one after the other, for `glint backends`.
std::vector<BackendReport> probeBackends();

}  // namespace glint
