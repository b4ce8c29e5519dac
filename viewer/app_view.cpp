#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app.h"
#include "camera_control.h"
#include "compose.h"
#include "effects.h"
#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "widgets.h"

namespace glint::viewer {

void App::pictureArea() {
  const ImVec2 size(float(resolution_.x / ratio_), float(resolution_.y / ratio_));
  ImGui::SetNextWindowPos(ImVec2(0, menuHeight_));
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin("picture", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("canvas", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const ImGuiIO& io = ImGui::GetIO();
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const glm::dvec2 mouse =
      glm::dvec2(double(io.MousePos.x), double(io.MousePos.y - menuHeight_)) * ratio_;
  handlePicture(mouse, hovered, active);
  const std::optional<glm::dvec2> was = cursor_;
  cursor_ = hovered && !active ? std::optional(mouse) : std::nullopt;
  if (cursor_ != was) probeStale_ = true;
  drawOverPicture();
  ImGui::End();
}

void App::handlePicture(glm::dvec2 mouse, bool hovered, bool active) {
  const ImGuiIO& io = ImGui::GetIO();
  Document& document = session_.document;
  const bool split = document.compare == CompareMode::split &&
                     (comparesLooks(document) || comparesExact(document));
  const double dividerX = document.divider * resolution_.x;
  const bool nearDivider = split && hovered && std::abs(mouse.x - dividerX) < 6 * ratio_;

  if (ImGui::IsItemActivated()) {
    pressedAt_ = mouse;
    dragged_ = false;
    draggingDivider_ = nearDivider && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    draggedLight_ = draggingDivider_ || !ImGui::IsMouseDown(ImGuiMouseButton_Left)
                        ? std::nullopt
                        : handleAt({double(io.MousePos.x), double(io.MousePos.y)});
    if (draggedLight_) session_.light = draggedLight_->light;
    const auto hit = hitAt(mouse);
    pressedPoint_ = hit ? std::optional(hit->position) : std::nullopt;
  }
  if (active) {
    if (glm::length(mouse - pressedAt_) > 3 * ratio_) dragged_ = true;
    if (dragged_) dragPicture(mouse);
  }
  if (ImGui::IsItemDeactivated()) {
    if (!dragged_ && hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
        !draggingDivider_ && !draggedLight_)
      pick(mouse);
    draggedLight_.reset();
    draggingDivider_ = false;
  }
  if (hovered && io.MouseWheel != 0) {
    lastScroll_ = Clock::now();
    dolly(mouse, std::pow(0.88, double(io.MouseWheel)));
  }
  if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !nearDivider)
    setPivot(mouse);
  if (nearDivider || draggingDivider_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void App::moveCamera(const std::function<Pose(const Pose&)>& move) {
  if (!session_.model) return;
  attempt([&] {
    Look look = session_.document.a;
    look.resolution = resolution_;
    const Scene& scene = session_.model->scene;
    setPose(session_.document.a, move(poseOf(scene, session_.model->bounds, look)));
  });
}

void App::dragPicture(glm::dvec2 mouse) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 delta = glm::dvec2(double(io.MouseDelta.x), double(io.MouseDelta.y)) * ratio_;
  if (delta == glm::dvec2(0.0)) return;
  const double height = std::max(1.0, double(resolution_.y));
  const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (draggingDivider_)
    session_.document.divider = std::clamp(mouse.x / resolution_.x, 0.0, 1.0);
  else if (draggedLight_)
    dragLight(mouse);
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (left && io.KeyShift))
    moveCamera([&](const Pose& p) { return panned(p, delta.x / height, delta.y / height); });
  else if (left && io.KeyCtrl)
    moveCamera([&](const Pose& p) { return rolled(p, -delta.x / height * 180); });
  else if (left)
    moveCamera([&](const Pose& p) {
      return orbited(p, -delta.x / height * 200, delta.y / height * 200, pivot_);
    });
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Right) && io.KeyShift)
    turnEnvironment(delta.x / height * 200);
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
    dolly(pressedAt_, std::exp(-2 * delta.y / height));
}

void App::turnEnvironment(double degrees) {
  Look& look = session_.document.a;
  look.environmentRotation = std::remainder(look.environmentRotation + degrees, 360);
  session_.say("environment turned by " + numberText(std::round(look.environmentRotation)) +
               (look.shading == Shading::environment || look.environmentBackground
                    ? " degrees"
                    : " degrees; only the program environment and the background show it"));
}

std::optional<Hit> App::hitAt(glm::dvec2 pixel) const {
  if (!session_.model) return {};
  try {
    Look look = session_.document.a;
    look.resolution = resolution_;
    const Model& model = *session_.model;
    const Camera camera = cameraFor(model.scene, model.bounds, look);
    return model.picker->pick(model.scene, rayThrough(camera, pixel, resolution_), look.twoSided);
  } catch (const InputError&) {
    return {};
  }
}

void App::dolly(glm::dvec2 pixel, double factor) {
  if (!session_.model) return;
  // A drag keeps going to what was under the pointer when it began.
  std::optional<glm::dvec3> surface =
      ImGui::IsMouseDown(ImGuiMouseButton_Right) ? pressedPoint_ : std::optional<glm::dvec3>();
  if (!surface)
    if (const auto hit = hitAt(pixel)) surface = hit->position;
  const double height = std::max(1.0, double(resolution_.y));
  const glm::dvec2 cursor = (pixel - glm::dvec2(resolution_) / 2.0) * glm::dvec2(2, -2) / height;
  // The near plane can be as near as 1e-5 of the far one (cameraFor), which is then at most twice
  // the radius away.
  const double nearest = 1e-4 * session_.model->bounds.radius;
  bool tooNear = false;
  moveCamera([&](const Pose& p) {
    const glm::dvec3 point = surface.value_or(focalPlanePoint(p, cursor));
    const double distance =
        p.orthographic ? glm::length(p.position - p.focalPoint) : glm::length(p.position - point);
    tooNear = factor < 1 && distance * factor < nearest;
    return tooNear ? p : dollied(p, factor, point);
  });
  if (tooNear) session_.say("already as near to the surface as possible");
}

void App::setPivot(glm::dvec2 pixel) {
  const auto hit = hitAt(pixel);
  pivot_ = hit ? std::optional(hit->position) : std::nullopt;
  session_.say(hit ? "drags now orbit around this point; double-click the background to end this"
                   : "drags orbit around the middle of the view");
}

std::optional<glm::dvec2> App::placeOf(const glm::dvec3& world) const {
  if (!shownResult_.a) return {};
  const Camera& camera = shownResult_.a->list.camera;
  const glm::dvec3 eye = glm::transpose(camera.axes) * (world - camera.eye);
  const double depth = camera.orthographic ? 1 : -eye.z;
  if (!(depth > 0)) return {};
  const glm::dvec2 reach(camera.halfHeight * camera.aspect, camera.halfHeight);
  const glm::dvec2 at = (glm::dvec2(eye) / depth / reach - camera.shift + 1.0) / 2.0;
  const glm::dvec2 size = glm::dvec2(resolution_) / ratio_;
  return glm::dvec2(at.x * size.x, double(menuHeight_) + (1 - at.y) * size.y);
}

// Draws a ring and a dot at the pivot.
void App::drawPivot() {
  if (!pivot_) return;
  const auto at = placeOf(*pivot_);
  if (!at) return;
  const ImVec2 place(float(at->x), float(at->y));
  const float s = widgets::style().scale;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddCircle(place, 7 * s, IM_COL32(0, 0, 0, 200), 24, 3 * s);
  draw->AddCircle(place, 7 * s, IM_COL32(255, 214, 120, 255), 24, 1.5f * s);
  draw->AddCircleFilled(place, 2 * s, IM_COL32(255, 214, 120, 255));
}

// "exact reference: ..." or the difference of the 8-bit values, if both pictures are there.
std::string App::comparisonText() const {
  const Document& document = session_.document;
  const SharedPicture& a = shownResult_.a;
  char text[240];
  if (comparesExact(document) && a) {
    const auto exact = reference_->picture();
    if (shownResult_.request.preview || !exact || exact->look != exactLook(a->look) ||
        a->look != comparableLook(a->look))
      return "the exact reference is drawn when the view is at rest";
    if (exact->failed) return exact->error;
    const int rows = exact->rows;
    std::snprintf(text, sizeof text,
                  "against the exact reference: max %.3g at %d, %d, RMSE %.3g (linear light), at "
                  "most %d of 255 levels",
                  errors_.largest, errors_.where.x, errors_.where.y, errors_.rmse, errors_.levels);
    std::string all = text;
    if (errors_.edges > 0)
      all += ", " + std::to_string(errors_.edges) + " pixels at edges left out";
    else if (exact->edges.empty())
      all += ", including pixels at edges";
    if (errors_.notFinite > 0)
      all += ", " + std::to_string(errors_.notFinite) + " non-finite pixels";
    if (rows < exact->linear.height)
      all += "; " + std::to_string(100 * rows / exact->linear.height) + " % drawn";
    return all;
  }
  if (comparesLooks(document) && a && shownResult_.b) {
    std::snprintf(text, sizeof text,
                  "|A - B|: at most %d of 255 levels, at %d, %d; mean %.4g; %zu pixels differ",
                  difference_.largest, difference_.where.x, difference_.where.y, difference_.mean,
                  difference_.pixels);
    return text;
  }
  return {};
}

void App::drawOverPicture() {
  const Document& document = session_.document;
  const float s = widgets::style().scale;
  const ImVec2 size(float(resolution_.x / ratio_), float(resolution_.y / ratio_));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 white = IM_COL32(255, 255, 255, 255);
  const float top = menuHeight_;
  // Wraps lines at the picture's width; with `upwards` the last line is at y.
  const auto write = [&](float x, float y, const std::string& text, bool upwards = false) {
    const float room = std::max(size.x - x - 10 * s, 1.0f);
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
    y += top - (upwards ? extent.y - ImGui::GetTextLineHeight() : 0);
    draw->AddRectFilled(ImVec2(x - 4 * s, y - 2 * s),
                        ImVec2(x + extent.x + 4 * s, y + extent.y + 2 * s), IM_COL32(0, 0, 0, 190),
                        3 * s);
    draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImVec2(x, y), white, text.c_str(),
                  nullptr, room);
  };
  const bool exact = comparesExact(document), compares = exact || comparesLooks(document);
  if (compares && document.compare == CompareMode::split) {
    const float x = float(document.divider * resolution_.x / ratio_);
    const bool held =
        draggingDivider_ || (cursor_ && std::abs(cursor_->x / ratio_ - double(x)) < 6);
    draw->AddLine(ImVec2(x, top), ImVec2(x, top + size.y),
                  held ? IM_COL32(255, 214, 120, 255) : IM_COL32(255, 255, 255, 150), s);
    const std::vector<Difference> all =
        exact ? std::vector<Difference>{} : differences(document.a, *document.b);
    // As much as fits.
    const auto side = [&](bool isA, float room) {
      std::string text = isA ? "A: " : "B: ";
      for (std::size_t most = 3; most-- > 0;) {
        text.resize(3);
        text += sideText(all, isA, most);
        if (ImGui::CalcTextSize(text.c_str()).x < room) return text;
      }
      return text.substr(0, 1);
    };
    const std::string a = exact ? "A" : side(true, x - 24 * s);
    write(x - ImGui::CalcTextSize(a.c_str()).x - 10 * s, 6 * s, a);
    write(x + 10 * s, 6 * s, exact ? "exact reference" : side(false, size.x - x - 24 * s));
  } else if (compares && document.compare == CompareMode::blink) {
    write(
        10 * s, 6 * s,
        exact ? "exact reference" : "B: " + sideText(differences(document.a, *document.b), false));
  }
  if (compares && (exact || document.compare == CompareMode::difference)) {
    std::string text = comparisonText();
    if (!exact) {
      char times[40];
      std::snprintf(times, sizeof times, ", multiplied by %.3g", document.amplification);
      text += times;
    }
    write(10 * s, size.y - ImGui::GetTextLineHeight() - 8 * s, text, true);
  }
  if (exact && document.compare == CompareMode::difference && shownResult_.a) {
    const float left = 10 * s, width = 180 * s, above = top + 8 * s, height = 10 * s;
    draw->AddRectFilled(
        ImVec2(left - 6 * s, above - 4 * s),
        ImVec2(left + width + 34 * s, above + height + ImGui::GetTextLineHeight() + 4 * s),
        IM_COL32(0, 0, 0, 190), 3 * s);
    const std::vector<std::uint8_t> colors = errorScale(64);
    for (int i = 0; i < 64; ++i) {
      const std::uint8_t* c = colors.data() + 4 * i;
      draw->AddRectFilled(ImVec2(left + width * float(i) / 64, above),
                          ImVec2(left + width * float(i + 1) / 64, above + height),
                          IM_COL32(c[0], c[1], c[2], 255));
    }
    for (const auto& [value, text] : {std::pair{1e-8, "1e-8"}, {1e-4, "1e-4"}, {1.0, "1"}})
      draw->AddText(ImVec2(left + width * float(errorShade(value)) - 4 * s, above + height + 1),
                    white, text);
  }
  drawPivot();
  drawLightHandles();
  drawProgress();
}

// In the middle of the picture: what is being loaded, or drawn for the first time.
void App::drawProgress() {
  std::string text;
  if (loading_.valid())
    text = "Reading " + loadingPath_.filename().string() + " ...";
  else if (!session_.model)
    text = "Drop a model here (.glb or .gltf), or open one: menu File, or Ctrl+O";
  else if (!shownResult_.a && painter_->pending())
    text = "Drawing the first picture ...";
  if (text.empty()) return;
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  const float pad = 12 * widgets::style().scale;
  const ImVec2 at((float(resolution_.x / ratio_) - extent.x) / 2,
                  menuHeight_ + (float(resolution_.y / ratio_) - extent.y) / 2);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(ImVec2(at.x - pad, at.y - pad),
                      ImVec2(at.x + extent.x + pad, at.y + extent.y + pad), IM_COL32(0, 0, 0, 190),
                      pad / 2);
  draw->AddText(at, IM_COL32(255, 255, 255, 255), text.c_str());
}

}  // namespace glint::viewer
