#include "window.h"

#include <glad/gl.h>
// After glad, which provides the GL declarations.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <utility>

#include "glint/gl/context.h"

namespace glint::viewer {
namespace {

std::atomic<bool> woken = false;

Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

std::string lastError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

void add(GLFWwindow* window, InputEvent event) {
  of(window).input().add(std::move(event));
  of(window).happened();
}

// GLFW's key codes name positions on an American keyboard; shortcuts mean the letters of the user's
// keyboard.
int layoutKey(int key, int scancode) {
  if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return key;
  const char* name = glfwGetKeyName(key, scancode);
  if (!name || name[0] == 0 || name[1] != 0) return key;
  const char c = name[0];
  return c >= 'a' && c <= 'z' ? c - 'a' + GLFW_KEY_A : key;
}

void installCallbacks(GLFWwindow* window) {
  using Kind = InputEvent::Kind;
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    add(w, {.kind = Kind::motion, .x = x, .y = y, .path = {}});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
    add(w, {.kind = Kind::button,
            .code = button,
            .down = action == GLFW_PRESS,
            .modifiers = modifiers,
            .path = {}});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    add(w, {.kind = Kind::scroll, .x = x, .y = y, .path = {}});
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
    add(w, {.kind = Kind::key,
            .code = layoutKey(key, scancode),
            .down = action != GLFW_RELEASE,
            .repeated = action == GLFW_REPEAT,
            .modifiers = modifiers,
            .path = {}});
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
    add(w, {.kind = Kind::character, .code = int(character), .path = {}});
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) add(w, {.kind = Kind::drop, .path = paths[0]});
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    add(w, {.kind = Kind::focus, .down = focused != 0, .path = {}});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    if (!entered) add(w, {.kind = Kind::motion, .x = -1e6, .y = -1e6, .path = {}});
  });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).happened(); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).happened(); });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { of(w).happened(); });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { of(w).happened(); });
}

// Without a window manager, a window that does not fit on the screen is cut off.
glm::ivec2 withinScreen(glm::ivec2 size) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (!monitor) return size;
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  return width > 0 && height > 0 ? glm::min(size, glm::ivec2(width, height)) : size;
}

void hintContext() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

}  // namespace

Window::Window(const std::string& title, glm::ivec2 size) {
#ifdef GLFW_PLATFORM
  // Wayland's library prints an error of its own if there is no Wayland session.
  if (!std::getenv("XDG_RUNTIME_DIR")) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  if (!glfwInit())
    throw ContextError("no window: " + lastError() +
                       ": start it in a desktop session or under xvfb-run, or draw offscreen with "
                       "glint render");
  hintContext();
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "glint-viewer");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "glint-viewer");
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    float scale = 1;
    glfwGetMonitorContentScale(monitor, &scale, nullptr);
    // GLFW will enlarge it by the screen's scale.
    if (scale > 0)
      size = glm::ivec2(glm::dvec2(withinScreen(glm::ivec2(glm::dvec2(size) * double(scale)))) /
                        double(scale));
  }
  window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string reason = lastError();
    glfwTerminate();
    throw ContextError("no OpenGL 3.3 window: " + reason +
                       ": draw offscreen with glint render; glint backends says what works");
  }
  glfwMakeContextCurrent(window_);
  if (glint_gladLoadGL(glfwGetProcAddress) < GLAD_MAKE_VERSION(3, 3)) {
    glfwDestroyWindow(window_);
    glfwTerminate();
    throw ContextError("the window's driver has no OpenGL 3.3: draw offscreen with glint render");
  }
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetWindowSizeLimits(window_, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
  installCallbacks(window_);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

glm::ivec2 Window::size() const {
  glm::ivec2 v;
  glfwGetWindowSize(window_, &v.x, &v.y);
  return v;
}

glm::ivec2 Window::framebufferSize() const {
  glm::ivec2 v;
  glfwGetFramebufferSize(window_, &v.x, &v.y);
  return v;
}

double Window::contentScale() const {
  float scale = 1;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  // Where window coordinates are not pixels, the window system already scales the window.
  const glm::ivec2 window = size(), pixels = framebufferSize();
  return window.x > 0 && pixels.x > 0 ? double(scale) * window.x / pixels.x : double(scale);
}

void Window::resize(glm::ivec2 size) {
  size = withinScreen(size);
  glfwSetWindowSize(window_, size.x, size.y);
}
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
void Window::present() { glfwSwapBuffers(window_); }

bool Window::wait(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  const bool wasWoken = woken.exchange(false);
  return std::exchange(happened_, false) || wasWoken;
}

void Window::wake() {
  woken = true;
  glfwPostEmptyEvent();
}
bool Window::closeRequested() const { return glfwWindowShouldClose(window_); }
void Window::refuseClose() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}

void Window::setClipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

OffscreenContext::OffscreenContext(const Window&) {
  glfwDefaultWindowHints();
  hintContext();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  window_ = glfwCreateWindow(16, 16, "glint pictures", nullptr, nullptr);
  if (!window_)
    throw ContextError("no second OpenGL context: " + lastError() +
                       ": draw offscreen with glint render");
}

OffscreenContext::~OffscreenContext() { glfwDestroyWindow(window_); }
void OffscreenContext::makeCurrent() { glfwMakeContextCurrent(window_); }
void OffscreenContext::release() { glfwMakeContextCurrent(nullptr); }

}  // namespace glint::viewer
