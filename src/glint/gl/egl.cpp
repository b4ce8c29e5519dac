// EGL without a window system: devices and Mesa's surfaceless platform. glad's header provides
// types and constants; the functions are kept in a struct, so that a library is a value.

#include <glad/egl.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "glint/gl/backends.h"

namespace glint::backends {

namespace {

constexpr EGLint drmDeviceFile = 0x3233;  // EGL_EXT_device_drm
constexpr unsigned glRenderer = 0x1F01, glVersion = 0x1F02;
constexpr const char* remedy = "install the Debian packages libegl1, libegl-mesa0, libgl1-mesa-dri";

struct EglFunctions {
  PFNEGLGETPROCADDRESSPROC getProcAddress;
  PFNEGLQUERYSTRINGPROC queryString;
  PFNEGLGETERRORPROC getError;
  PFNEGLINITIALIZEPROC initialize;
  PFNEGLBINDAPIPROC bindApi;
  PFNEGLCHOOSECONFIGPROC chooseConfig;
  PFNEGLCREATECONTEXTPROC createContext;
  PFNEGLDESTROYCONTEXTPROC destroyContext;
  PFNEGLCREATEPBUFFERSURFACEPROC createPbufferSurface;
  PFNEGLDESTROYSURFACEPROC destroySurface;
  PFNEGLMAKECURRENTPROC makeCurrent;
  PFNEGLGETCURRENTCONTEXTPROC getCurrentContext;
  // Extension functions: null if the library does not have them.
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay;
  PFNEGLQUERYDEVICESEXTPROC queryDevices;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString;
};

EglFunctions loadFunctions(std::span<const char* const> sonames) {
  EglFunctions egl{};
  const auto to = [](auto& function) { return reinterpret_cast<void**>(&function); };
  const Symbol symbols[] = {
      {"eglGetProcAddress", to(egl.getProcAddress)},
      {"eglQueryString", to(egl.queryString)},
      {"eglGetError", to(egl.getError)},
      {"eglInitialize", to(egl.initialize)},
      {"eglBindAPI", to(egl.bindApi)},
      {"eglChooseConfig", to(egl.chooseConfig)},
      {"eglCreateContext", to(egl.createContext)},
      {"eglDestroyContext", to(egl.destroyContext)},
      {"eglCreatePbufferSurface", to(egl.createPbufferSurface)},
      {"eglDestroySurface", to(egl.destroySurface)},
      {"eglMakeCurrent", to(egl.makeCurrent)},
      {"eglGetCurrentContext", to(egl.getCurrentContext)},
  };
  openLibrary(sonames, symbols, remedy);
  const auto extension = [&](auto& function, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(egl.getProcAddress(name));
  };
  extension(egl.getPlatformDisplay, "eglGetPlatformDisplayEXT");
  extension(egl.queryDevices, "eglQueryDevicesEXT");
  extension(egl.queryDeviceString, "eglQueryDeviceStringEXT");
  return egl;
}

/// Whether a list of names separated by blanks (may be null) contains a name.
bool has(const char* list, std::string_view name) {
  const std::string_view all = list ? list : "";
  for (std::size_t at = all.find(name); at != all.npos; at = all.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

/// The last EGL error as its name and a description from EGL's specification.
std::string errorWords(const EglFunctions& egl) {
  const EGLint code = egl.getError();
  switch (code) {
    case EGL_SUCCESS:
      return "no reason given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED, the driver cannot be started";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS, in use by another thread or not permitted";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC, out of memory or other resources";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE, an attribute is not known";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG, no such configuration";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT, no such context";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY, no such display";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH, this combination or version is not supported";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER, an argument is not supported";
    case EGL_BAD_SURFACE:
      return "EGL_BAD_SURFACE, no such surface";
    case EGL_BAD_DEVICE_EXT:
      return "EGL_BAD_DEVICE_EXT, no such device";
    case EGL_CONTEXT_LOST:
      return "EGL_CONTEXT_LOST, the device was reset";
    default:
      return "EGL error " + std::to_string(code);
  }
}

/// The parts of a context; releases them itself. The display stays initialised until the process
/// ends: EGL does not count its users, so eglTerminate would take it from other contexts.
struct Handles {
  Handles(const EglFunctions& functions, EGLDisplay ofDisplay, Api ofApi)
      : egl(functions), display(ofDisplay), api(ofApi) {}
  Handles(const Handles&) = delete;
  ~Handles() {
    release();
    if (context) egl.destroyContext(display, context);
    if (surface) egl.destroySurface(display, surface);
  }
  bool bind() const {
    // The bound API is per-thread state.
    return bindApi() && egl.makeCurrent(display, surface, surface, context);
  }
  bool bindApi() const { return egl.bindApi(api == Api::es3 ? EGL_OPENGL_ES_API : EGL_OPENGL_API); }
  void release() const {
    if (context && egl.getCurrentContext() == context)
      egl.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  /// A GL string, read by making the context current on this thread briefly; empty if that fails.
  std::string glString(unsigned name) const {
    if (!bind()) return {};
    using GetString = const unsigned char* (*)(unsigned);
    const auto getString = reinterpret_cast<GetString>(egl.getProcAddress("glGetString"));
    const unsigned char* text = getString ? getString(name) : nullptr;
    std::string result = text ? reinterpret_cast<const char*>(text) : "";
    release();
    return result;
  }

  EglFunctions egl;
  EGLDisplay display;
  Api api;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;
};

class EglContext final : public Context {
 public:
  EglContext(Backend backend, std::string description, std::unique_ptr<Handles> handles)
      : Context(backend, std::move(description), handles->api == Api::es3 ? 30000 : leastVersion),
        handles_(std::move(handles)) {}
  void release() override { handles_->release(); }

 private:
  void bind() override {
    if (!handles_->bind())
      throw ContextError(description() + ": eglMakeCurrent: " + errorWords(handles_->egl));
  }
  Loader loader() const override { return handles_->egl.getProcAddress; }

  std::unique_ptr<Handles> handles_;
};

/// Somewhere to create a context: a device, or the surfaceless platform.
struct Place {
  std::string name;
  EGLenum platform;
  void* native;
  bool hardware;
};

/// All places, in EGL's order.
std::vector<Place> findPlaces(const EglFunctions& egl) {
  std::vector<Place> places;
  const char* client = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (egl.getPlatformDisplay && egl.queryDevices && has(client, "EGL_EXT_platform_device")) {
    EGLint count = 0;
    if (!egl.queryDevices(0, nullptr, &count)) count = 0;
    std::vector<EGLDeviceEXT> devices(std::size_t(count), nullptr);
    if (count && !egl.queryDevices(count, devices.data(), &count)) count = 0;
    for (int i = 0; i < count; ++i) {
      const auto string = [&](EGLint name) {
        return egl.queryDeviceString ? egl.queryDeviceString(devices[i], name) : nullptr;
      };
      const char* extensions = string(EGL_EXTENSIONS);
      const bool software = has(extensions, "EGL_MESA_device_software");
      Place place{"device " + std::to_string(i), EGL_PLATFORM_DEVICE_EXT, devices[i], !software};
      const char* file =
          has(extensions, "EGL_EXT_device_drm") && !software ? string(drmDeviceFile) : nullptr;
      place.name += software ? ", Mesa's software device" : file ? ", " + std::string(file) : "";
      places.push_back(std::move(place));
    }
  }
  if (egl.getPlatformDisplay && has(client, "EGL_MESA_platform_surfaceless"))
    places.push_back(
        {"Mesa's surfaceless platform", EGL_PLATFORM_SURFACELESS_MESA, nullptr, false});
  return places;
}

/// Interprets the variable as Mesa does.
bool softwareWanted() {
  const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  if (!value || !*value) return false;
  const std::string_view text = value;
  return text != "0" && text != "n" && text != "no" && text != "f" && text != "false";
}

/// The places worth trying, best first; see Backend.
std::vector<Place> choosePlaces(const std::vector<Place>& all, bool software) {
  std::vector<Place> chosen;
  const auto take = [&](auto condition) {
    for (const Place& place : all)
      if (condition(place)) chosen.push_back(place);
  };
  const auto surfaceless = [](const Place& p) { return p.platform != EGL_PLATFORM_DEVICE_EXT; };
  const auto softwareDevice = [&](const Place& p) { return !p.hardware && !surfaceless(p); };
  if (software) {
    take(softwareDevice);
    take(surfaceless);
  } else {
    if (!softwareWanted()) take([](const Place& p) { return p.hardware; });
    take(surfaceless);
    take(softwareDevice);
  }
  return chosen;
}

/// Creates the context, with a tiny surface if the driver needs one. Throws ContextError.
std::unique_ptr<Handles> createContext(const EglFunctions& egl, EGLDisplay display, Api api) {
  const auto fail = [&](const std::string& what) {
    throw ContextError(what + ": " + errorWords(egl));
  };
  auto handles = std::make_unique<Handles>(egl, display, api);
  if (!handles->bindApi())
    fail(api == Api::es3 ? "eglBindAPI of OpenGL ES" : "eglBindAPI of desktop OpenGL");
  const char* extensions = egl.queryString(display, EGL_EXTENSIONS);
  const bool surfaceless = has(extensions, "EGL_KHR_surfaceless_context");
  EGLConfig config = nullptr;  // EGL_NO_CONFIG_KHR
  if (!surfaceless || !(has(extensions, "EGL_KHR_no_config_context") ||
                        has(extensions, "EGL_MESA_configless_context"))) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE,
                             api == Api::es3 ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT,
                             EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT, EGL_NONE};
    EGLint count = 0;
    if (!egl.chooseConfig(display, wanted, &config, 1, &count)) fail("eglChooseConfig");
    if (count < 1) throw ContextError("no EGL configuration draws with this kind of OpenGL");
  }
  if (!surfaceless) {
    const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    handles->surface = egl.createPbufferSurface(display, config, size);
    if (!handles->surface) fail("eglCreatePbufferSurface");
  }
  if (api == Api::es3) {
    const EGLint es3[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    handles->context = egl.createContext(display, config, EGL_NO_CONTEXT, es3);
    if (!handles->context) fail("eglCreateContext of OpenGL ES 3");
    return handles;
  }
  // A context that reports a device reset (GL_CONTEXT_LOST, see check.h), if the driver supports
  // that: without it a lost context may carry on and draw nothing.
  const EGLint core33[] = {EGL_CONTEXT_MAJOR_VERSION,
                           3,
                           EGL_CONTEXT_MINOR_VERSION,
                           3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                           EGL_LOSE_CONTEXT_ON_RESET,
                           EGL_NONE};
  handles->context = egl.createContext(display, config, EGL_NO_CONTEXT, core33);
  if (handles->context) return handles;
  std::vector<EGLint> plain(std::begin(core33), std::end(core33) - 3);
  plain.push_back(EGL_NONE);
  handles->context = egl.createContext(display, config, EGL_NO_CONTEXT, plain.data());
  if (handles->context) return handles;
  const std::string reason = "eglCreateContext: " + errorWords(egl);
  // The version that the driver gives without any request is more informative than the error.
  handles->context = egl.createContext(display, config, EGL_NO_CONTEXT, nullptr);
  const std::string version = handles->context ? handles->glString(glVersion) : "";
  throw ContextError(
      version.empty() ? reason : "the driver has no OpenGL 3.3 core context, only " + version);
}

std::unique_ptr<Context> openPlace(const EglFunctions& egl, const Place& place, bool software,
                                   Api api) {
  const EGLDisplay display = egl.getPlatformDisplay(place.platform, place.native, nullptr);
  if (!display) throw ContextError("eglGetPlatformDisplay: " + errorWords(egl));
  if (!egl.initialize(display, nullptr, nullptr)) {
    const std::string reason = "eglInitialize: " + errorWords(egl);
    throw ContextError(reason + (place.hardware ? " (is the user in the group render?)"
                                                : " (is libgl1-mesa-dri installed?)"));
  }
  auto handles = createContext(egl, display, api);
  const std::string renderer = handles->glString(glRenderer);
  if (renderer.empty()) throw ContextError("eglMakeCurrent: " + errorWords(egl));
  const auto is = [&](const char* name) { return renderer.find(name) != renderer.npos; };
  if (software && !is("llvmpipe") && !is("softpipe") && !is("Software Rasterizer") && !is("SWR"))
    throw ContextError("draws with \"" + renderer + "\", not with Mesa's software renderer");
  return std::make_unique<EglContext>(software ? Backend::eglSoftware : Backend::egl,
                                      "egl: " + place.name, std::move(handles));
}

}  // namespace

std::unique_ptr<Context> openEgl(std::span<const char* const> sonames, bool software, Api api) {
  const EglFunctions egl = loadFunctions(sonames);
  const std::vector<Place> places = choosePlaces(findPlaces(egl), software);
  std::string reasons;
  for (const Place& place : places) {
    try {
      std::unique_ptr<Context> context = openPlace(egl, place, software, api);
      context->addRemark(reasons);
      return context;
    } catch (const ContextError& error) {
      reasons += (reasons.empty() ? "" : "; ") + place.name + ": " + error.what();
    }
  }
  if (places.empty())
    reasons = std::string("EGL has no ") + (software ? "software " : "") +
              "device and no surfaceless platform: for software rendering " + remedy;
  throw ContextError(reasons);
}

}  // namespace glint::backends
