#include "app.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "compose.h"
#include "glint/gl/check.h"
#include "glint/image/error.h"
#include "interface.h"
#include "materials.h"
#include "widgets.h"

namespace glint {
namespace {

constexpr double slowFrame = 1000.0 / 30;  // ms

// A picture that is drawn fast enough to follow a hand: first without anti-aliasing, then smaller.
Look fasterLook(const Look& look, double milliseconds) {
  Look fast = look;
  double expected = milliseconds;
  if (look.antiAliasing.mode != AntiAliasing::Mode::none) {
    const int n = look.antiAliasing.count;
    expected /= look.antiAliasing.mode == AntiAliasing::Mode::ssaa ? n * n : 2.5;
    fast.antiAliasing = {AntiAliasing::Mode::none, 1};
  }
  int divide = 1;
  while (expected / (divide * divide) > slowFrame * 0.8 && divide < 6) ++divide;
  fast.resolution = glm::max((look.resolution + divide - 1) / divide, glm::ivec2(1));
  return fast;
}

}  // namespace

std::unique_ptr<App::Drawn> App::drawLook(const Look& look, bool preview) {
  Scene& scene = session_.model->scene;
  gpuScene_->addImages(
      decodeImages(scene, look, [this](int image) { return gpuScene_->hasImage(image); }));
  auto drawn = std::make_unique<Drawn>();
  drawn->picture = drawPicture(*renderer_, *gpuScene_, session_.model->bounds, look);
  drawn->preview = preview;
  return drawn;
}

bool App::updatePicture() {
  if (!gpuScene_) return false;
  const auto now = Clock::now();
  const Document& document = session_.document;
  Look full = document.a;
  full.resolution = resolution_;
  const bool moving = ImGui::IsAnyMouseDown() || seconds(now - lastScroll_) < restAfter;
  Look look = full;
  bool preview = false;
  const bool isFull = a_ && !a_->preview && a_->picture.look == full;
  if (!isFull && moving && fullMilliseconds_ > slowFrame) {
    const Look fast = fasterLook(full, fullMilliseconds_);
    const bool same = a_ && a_->preview && a_->picture.look == fast;
    if (!same) lastChange_ = now;
    preview = fast != full && (!same || seconds(now - lastChange_) < restAfter);
    if (preview) look = fast;
  }
  const bool compares = document.b && document.compare != CompareMode::off;
  Look other;
  if (compares) {
    other = *document.b;
    other.resolution = look.resolution;
    if (preview) other.antiAliasing = look.antiAliasing;
  }
  bool changed = false;
  const bool stale = !a_ || a_->picture.look != look || a_->preview != preview;
  if (stale && !(failed_ && *failed_ == look)) {
    try {
      a_ = drawLook(look, preview);
      if (!preview) fullMilliseconds_ = a_->picture.milliseconds - a_->picture.times.compile;
      if (failed_ && session_.statusIsError) session_.say("drawn again");
      failed_.reset();
      changed = true;
    } catch (const Error& error) {
      failed_ = look;
      session_.fail(error.what());
    }
  }
  if (compares && (!b_ || b_->picture.look != other)) {
    try {
      b_ = drawLook(other, preview);
      changed = true;
    } catch (const Error& error) {
      session_.fail(error.what());
      session_.document.compare = CompareMode::off;
    }
  }
  if (!a_) return false;
  if (changed) probeStale_ = overlayStale_ = true;
  const bool recompose = changed || screenStale_ || shown_.compare != document.compare ||
                         shown_.divider != document.divider ||
                         shown_.amplification != document.amplification ||
                         shownOverlay_ != session_.overlay;
  if (recompose) {
    const auto codes = [](const Drawn& d) {
      return CodePicture{d.picture.look.resolution.x, d.picture.look.resolution.y,
                         d.picture.codes.data()};
    };
    const CodePicture a = codes(*a_), b = b_ ? codes(*b_) : CodePicture{};
    std::vector<std::uint8_t> pixels =
        compose(a, compares && b_ ? &b : nullptr, document, document.a.noBackground);
    if (session_.overlay == Overlay::clipped) {
      const std::size_t marked = markClipped(pixels, a_->picture.linear, a_->picture.look.exposure);
      session_.say(std::to_string(marked) +
                   " pixels are clipped (red), negative (blue) or not numbers (magenta)");
    }
    screen_.upload(pixels.data(), a.width, a.height);
    screenStale_ = false;
    shown_ = document;
  }
  const bool laid = session_.overlay == Overlay::wireframe ||
                    session_.overlay == Overlay::normals || session_.overlay == Overlay::facing;
  if (laid && (overlayStale_ || shownOverlay_ != session_.overlay)) {
    if (!overlay_) overlay_ = std::make_unique<OverlayDrawer>();
    overlay_->draw(*gpuScene_, a_->picture.list, session_.overlay, resolution_);
    overlayStale_ = false;
  }
  shownOverlay_ = session_.overlay;
  if (probeStale_) {
    probeStale_ = false;
    if (cursor_)
      hover(*cursor_);
    else
      session_.hovered.reset();
  }
  return changed;
}

void App::present() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, framebuffer_.x, framebuffer_.y);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.1f, 0.1f, 0.1f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  if (a_) screen_.show(0, 0, resolution_.x, resolution_.y, framebuffer_.y);
  const bool laid = session_.overlay == Overlay::wireframe ||
                    session_.overlay == Overlay::normals || session_.overlay == Overlay::facing;
  if (laid && overlay_) overlay_->show(0, 0, framebuffer_.y);
  checkGl("window");
}

}  // namespace glint
