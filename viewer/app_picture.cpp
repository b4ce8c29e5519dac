#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app.h"
#include "camera_control.h"
#include "compose.h"
#include "glint/gl/check.h"
#include "glint/image/error.h"
#include "glint/image/srgb.h"

namespace glint::viewer {
namespace {

// A frame waits this long, in seconds, for its picture; slower ones are shown in a later frame.
constexpr double patience = 0.05;
// Looking up programs takes less than this, compiling one more; ms.
constexpr double compiling = 5;

CodePicture codesOf(const DrawnPicture& picture) {
  return {picture.look.resolution.x, picture.look.resolution.y, picture.codes.data()};
}

}  // namespace

// Whether the pixel under the cursor shows B. Without a common pose, the probe has no surfaces for
// B.
bool App::probesB(const Document& document) const {
  if (!cursor_ || !comparesLooks(document) ||
      !samePose(glint::poseOf(document.a), glint::poseOf(*document.b)))
    return false;
  return document.compare == CompareMode::blink ||
         (document.compare == CompareMode::split &&
          cursor_->x >= std::lround(document.divider * resolution_.x));
}

// The pictures that the window needs now.
PaintRequest App::wanted(bool& moving) {
  const auto now = Clock::now();
  const Document& document = session_.document;
  PaintRequest want;
  want.a = session_.tried.value_or(document.a);
  want.a.resolution = want.size = resolution_;
  if (comparesExact(document)) want.a = comparableLook(want.a);
  if (want.a != lastFull_) {
    lastFull_ = want.a;
    lastChange_ = now;
  }
  moving = (ImGui::IsAnyMouseDown() ||
            seconds(now - std::max(lastScroll_, lastPlayed_)) < pace_.rest()) &&
           seconds(now - lastChange_) < pace_.rest();
  const bool isWhole =
      shownResult_.a && !shownResult_.request.preview && shownResult_.request.a == want.a;
  if (moving && !isWhole && pace_.tooSlow()) {
    want.preview = true;
    want.a = pace_.faster(want.a);
  }
  if (comparesLooks(document)) {
    want.b = *document.b;
    want.b->resolution = want.a.resolution;
    if (want.preview) want.b->antiAliasing = want.a.antiAliasing;
  }
  want.overlay = session_.overlay;
  want.outlined = want.overlay == Overlay::outline ? session_.material : -1;
  // Only after the picture itself.
  if (probeShown_ && isWhole) {
    const Look& probed = probesB(document) && want.b ? *want.b : want.a;
    if (probed.antiAliasing.mode != AntiAliasing::Mode::none) {
      want.plain = probed;
      want.plain->antiAliasing = {AntiAliasing::Mode::none, 1};
    }
  }
  return want;
}

void App::updatePicture() {
  if (!session_.model) return;
  bool moving = false;
  const PaintRequest want = wanted(moving);
  bool asked = false;
  // A picture that follows a drag is not cancelled for the next one, or none would ever be
  // completed.
  const bool waits = painter_->pending() && requested_ && requested_->preview && want.preview;
  if (requested_ != want && !waits && !(failed_ && *failed_ == want.a)) {
    painter_->request(want);
    requested_ = want;
    asked = true;
  }
  if (auto result = painter_->take(asked || waits ? patience : 0)) receive(std::move(*result));
  if (!shownResult_.a) return;
  updateReference();
  composeScreen();
  updateProbe();
}

void App::receive(PaintResult result) {
  const PaintRequest& request = result.request;
  if (!result.error.empty()) {
    session_.fail(result.error);
    if (result.a) {  // B cannot be drawn
      session_.document.compare = CompareMode::off;
    } else {
      failed_ = request.a;
    }
    return;
  }
  if (failed_ && session_.statusIsError) session_.say("drawn again");
  failed_.reset();
  if (result.a != shownResult_.a) {
    if (request.preview && shownResult_.request.preview &&
        result.a->coarse != shownResult_.a->coarse)
      pace_.learnAnew();
    if (request.preview)
      pace_.drewFaster(result.a->milliseconds, result.a->times.compile > compiling);
    else
      pace_.drewWhole(result.a->milliseconds, result.a->times.compile > compiling);
  }
  if (result.model && result.model != session_.model) session_.takePose(result.model);
  shownResult_ = std::move(result);
  screenStale_ = probeStale_ = true;
}

void App::updateReference() {
  const bool exact = comparesExact(session_.document);
  if (exact && !shownResult_.request.preview)
    reference_->want(session_.model, shownResult_.a->look);
  else if (reference_->picture())
    reference_->stop();
}

void App::composeScreen() {
  const Document& document = session_.document;
  const bool exact = comparesExact(document);
  const DrawnPicture& a = *shownResult_.a;
  const auto reference = exact ? reference_->picture() : nullptr;
  const bool comparable =
      reference && reference->look == exactLook(a.look) && a.look == comparableLook(a.look);
  const int rows = comparable ? int(reference->rows) : 0;
  const bool same = !screenStale_ && shown_.compare == document.compare &&
                    shown_.exact == document.exact && shown_.divider == document.divider &&
                    shown_.amplification == document.amplification &&
                    shownOverlay_ == session_.overlay && shownRows_ == rows;
  if (same) return;
  if (exact && (encoded_ != reference.get() || rows < encodedRows_ || screenStale_)) {
    exactCodes_ = a.codes;  // rows still to come show A
    encoded_ = reference.get();
    encodedRows_ = 0;
  }
  if (rows > encodedRows_) {
    const std::size_t across = std::size_t(a.linear.width);
    encodeSrgb8(reference->linear.row(encodedRows_), across * std::size_t(rows - encodedRows_),
                float(std::exp2(a.look.exposure)),
                exactCodes_.data() + 4 * across * std::size_t(encodedRows_));
    encodedRows_ = rows;
    errors_ = errorNumbers(a.linear, reference->linear, reference->edges, rows, a.look.exposure);
  }
  const CodePicture pictureA = codesOf(a);
  CodePicture pictureB;
  if (exact && !exactCodes_.empty())
    pictureB = {pictureA.width, pictureA.height, exactCodes_.data()};
  else if (shownResult_.b)
    pictureB = codesOf(*shownResult_.b);
  std::vector<std::uint8_t> pixels;
  if (exact && document.compare == CompareMode::difference && reference && rows > 0)
    pixels = errorMap(a.linear, reference->linear, rows);
  else
    pixels = compose(pictureA, pictureB.codes ? &pictureB : nullptr, document,
                     a.look.noBackground || (shownResult_.b && shownResult_.b->look.noBackground));
  if (pictureB.codes && !exact) difference_ = compareNumbers(pictureA, pictureB);
  if (session_.overlay == Overlay::clipped) {
    const std::size_t marked = markClipped(pixels, a.linear, a.look.exposure);
    session_.say(std::to_string(marked) +
                 " pixels are clipped (red), negative (blue) or not a number (magenta)");
  }
  if (shownResult_.overlay) layOver(pixels, *shownResult_.overlay);
  screen_.upload(pixels.data(), pictureA.width, pictureA.height);
  screenStale_ = false;
  shown_ = document;
  shownOverlay_ = session_.overlay;
  shownRows_ = rows;
}

void App::updateProbe() {
  if (!probeStale_) return;
  probeStale_ = false;
  session_.hovered.reset();
  probe_.reset();
  if (!cursor_ || shownResult_.request.preview) return;
  attempt([&] {
    const bool isB = shownResult_.b && probesB(session_.document);
    const DrawnPicture& a = isB ? *shownResult_.b : *shownResult_.a;
    const Model& model = *session_.model;
    const glm::ivec2 at =
        glm::clamp(glm::ivec2(glm::floor(*cursor_)), glm::ivec2(0), a.look.resolution - 1);
    if (!probeShown_) {
      const Camera camera = cameraFor(model.scene, model.bounds, a.look);
      const auto hit = model.picker->pick(
          model.scene, rayThrough(camera, glm::dvec2(at) + 0.5, a.look.resolution),
          a.look.twoSided);
      if (hit) session_.hovered = hit->material;
      return;
    }
    const Image* plain = shownResult_.plain ? &shownResult_.plain->linear : nullptr;
    Look withoutSamples = a.asked;
    withoutSamples.antiAliasing = {AntiAliasing::Mode::none, 1};
    if (plain && shownResult_.plain->asked != withoutSamples) plain = nullptr;  // of the other look
    if (a.look.antiAliasing.mode == AntiAliasing::Mode::none) plain = &a.linear;
    probe_ = probePixel({model.scene, *model.images, model.bounds, *model.picker, a.list}, a.look,
                        a.linear, plain, at);
    probe_->side = isB ? 'B' : 'A';
    if (const DrawnPicture* other = isB ? shownResult_.a.get() : shownResult_.b.get();
        other && comparesLooks(session_.document) && other->look.resolution == a.look.resolution) {
      const float* rgba = other->linear.row(at.y) + std::size_t(4) * std::size_t(at.x);
      probe_->other = glm::vec3(rgba[0], rgba[1], rgba[2]);
    }
    if (probe_->hit) session_.hovered = probe_->hit->material;
  });
}

void App::present() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, framebuffer_.x, framebuffer_.y);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.1f, 0.1f, 0.1f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  if (shownResult_.a)
    screen_.show(0, int(std::lround(double(menuHeight_) * ratio_)), resolution_.x, resolution_.y,
                 framebuffer_.y);
  checkGl("window");
}

}  // namespace glint::viewer
