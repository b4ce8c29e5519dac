#pragma once

#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/error.h"

namespace glint {

/// A way to an OpenGL 3.3 core context without a window.
/// - automatic: egl, then osmesa.
/// - egl: the GPUs that EGL lists, in its order; then Mesa's surfaceless platform; then the
///   software device. Listing takes no measurable time where there is no GPU. A true
///   LIBGL_ALWAYS_SOFTWARE in the environment leaves the GPUs out.
/// - eglSoftware: Mesa's software renderer, also where there is a GPU: the EGL device marked
///   EGL_MESA_device_software, then the surfaceless platform. LIBGL_ALWAYS_SOFTWARE is set for
///   it, and what GL_RENDERER says is checked.
/// - osmesa: Mesa's off-screen library, always software. Mesa 25.1 and newer no longer have it.
enum class Backend { automatic, egl, eglSoftware, osmesa };

/// "auto", "egl", "egl-software", "osmesa": as on the command line.
const char* backendName(Backend backend);

/// The backend with this name. Throws InputError that lists the names, and `more` behind them: what
/// the caller knows besides, such as ", reference".
Backend backendFromName(std::string_view name, std::string_view more = {});

/// No OpenGL context: what() is one line, or, for Backend::automatic, a heading and one line for
/// each backend with the reason why it does not work. The program ends with status 3.
class ContextError : public Error {
 public:
  using Error::Error;
};

/// An OpenGL 3.3 core context without a default framebuffer worth drawing to: all drawing goes
/// into framebuffer objects. At most one is current at a time; objects made in it are deleted
/// before it.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Binds the context to the calling thread and loads the GL function pointers, which are global:
  /// they belong to the context made current last. Throws ContextError.
  void makeCurrent();

  /// Frees the calling thread from the context, so that another thread can make it current.
  virtual void release() = 0;

  /// What was opened: egl, eglSoftware or osmesa.
  Backend backend() const { return backend_; }

  /// What was opened, for people: "egl: device 0, /dev/dri/renderD128".
  const std::string& description() const { return description_; }

  /// Why something preferable was passed over: a GPU that cannot be opened, EGL missing under
  /// automatic. One line, empty if nothing was.
  const std::string& remark() const { return remark_; }
  void addRemark(const std::string& text);

 protected:
  using Function = void (*)();
  using Loader = Function (*)(const char* name);
  static constexpr int leastVersion = 30003;  ///< as glad has it: 3.3
  Context(Backend backend, std::string description, int least = leastVersion)
      : backend_(backend), description_(std::move(description)), least_(least) {}

 private:
  virtual void bind() = 0;
  virtual Loader loader() const = 0;

  Backend backend_;
  std::string description_, remark_;
  int least_;
};

/// Opens a context, not yet current, so that it may run on another thread than the one that calls
/// makeCurrent. The calling thread must have no context current. Throws ContextError.
/// The first call may set environment variables that keep Mesa from writing to stderr
/// (EGL_LOG_LEVEL) or make it use software (eglSoftware); see openContextAsync.
std::unique_ptr<Context> openContext(Backend backend);

/// openContext on a thread of its own: loading the driver takes 60 to 90 ms of a cold start, time
/// to read a model in. Environment variables are set before the thread starts, because setting
/// them while another thread reads one is a race. The errors come out of get().
std::future<std::unique_ptr<Context>> openContextAsync(Backend backend);

/// Vendor, renderer and version of the driver, as GL gives them.
struct GlStrings {
  std::string vendor, renderer, version;
};

/// Those of the current context.
GlStrings glStrings();

/// Whether the current context's driver draws from buffers that lie in the program's own memory
/// (GL_AMD_pinned_memory) as fast as from its own: a software driver, which then needs no copy.
bool drawsFromOwnMemory();

/// Whether a backend works on this machine.
struct BackendReport {
  Backend backend;
  bool works;
  std::string detail;  ///< what was opened and the GL strings, or one line with the reason why not
};

/// Tries one backend. No context may be current on the calling thread; none is afterwards.
BackendReport probeBackend(Backend backend);

/// Tries egl, egl-software and osmesa one after the other, for `glint backends`.
std::vector<BackendReport> probeBackends();

}  // namespace glint
