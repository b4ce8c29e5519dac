#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app.h"
#include "camera_control.h"
#include "compose.h"
#include "widgets.h"

namespace glint::viewer {

void App::pictureArea() {
  const ImVec2 size(float(resolution_.x / ratio_), float(resolution_.y / ratio_));
  ImGui::SetNextWindowPos(ImVec2(0, 0));
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
  const glm::dvec2 mouse = glm::dvec2(double(io.MousePos.x), double(io.MousePos.y)) * ratio_;
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

  const auto moveCamera = [&](auto&& move) {
    if (!session_.model) return;
    attempt([&] {
      Look look = document.a;
      look.resolution = resolution_;
      const Scene& scene = session_.model->scene;
      setPose(document.a, move(poseOf(scene, session_.model->bounds, look)));
    });
  };
  const double height = std::max(1.0, double(resolution_.y));
  const glm::dvec2 centered = (mouse - glm::dvec2(resolution_) / 2.0) * glm::dvec2(2, -2) / height;

  if (ImGui::IsItemActivated()) {
    pressedAt_ = mouse;
    dragged_ = false;
    draggingDivider_ = nearDivider && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  }
  if (active) {
    if (glm::length(mouse - pressedAt_) > 3 * ratio_) dragged_ = true;
    const glm::dvec2 delta = glm::dvec2(double(io.MouseDelta.x), double(io.MouseDelta.y)) * ratio_;
    if (dragged_ && delta != glm::dvec2(0.0)) {
      const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
      if (draggingDivider_)
        document.divider = std::clamp(mouse.x / resolution_.x, 0.0, 1.0);
      else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (left && io.KeyShift))
        moveCamera([&](const Pose& p) { return panned(p, delta.x / height, delta.y / height); });
      else if (left && io.KeyCtrl)
        moveCamera([&](const Pose& p) { return rolled(p, -delta.x / height * 180); });
      else if (left)
        moveCamera([&](const Pose& p) {
          return orbited(p, -delta.x / height * 200, delta.y / height * 200);
        });
      else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
        moveCamera([&](const Pose& p) {
          return dollied(p, std::exp(-2 * delta.y / height), {0, 0});
        });
    }
  }
  if (ImGui::IsItemDeactivated()) {
    if (!dragged_ && hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !draggingDivider_)
      pick(mouse);
    draggingDivider_ = false;
  }
  if (hovered && io.MouseWheel != 0) {
    lastScroll_ = Clock::now();
    const double factor = std::pow(0.88, double(io.MouseWheel));
    moveCamera([&](const Pose& p) { return dollied(p, factor, centered); });
  }
  if (nearDivider || draggingDivider_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

// "exact reference: ..." or the difference of the 8-bit values, where both pictures are there.
std::string App::comparisonText() const {
  const Document& document = session_.document;
  const SharedPicture& a = shownResult_.a;
  char text[240];
  if (comparesExact(document) && a) {
    const auto exact = reference_->picture();
    if (shownResult_.request.preview || !exact || exact->look != exactLook(a->look) ||
        a->look != comparableLook(a->look))
      return "the exact reference follows at rest";
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
      all += ", pixels at edges among them";
    if (errors_.notFinite > 0)
      all += ", " + std::to_string(errors_.notFinite) + " pixels not finite";
    if (rows < exact->linear.height)
      all += "; " + std::to_string(100 * rows / exact->linear.height) + " % drawn";
    return all;
  }
  if (comparesLooks(document) && a && shownResult_.b) {
    std::snprintf(text, sizeof text, "|A - B|: at most %d of 255 levels, mean %.4g, %zu pixels",
                  difference_.largest, difference_.mean, difference_.pixels);
    return text;
  }
  return {};
}

void App::drawOverPicture() {
  const Document& document = session_.document;
  const float s = widgets::style().scale;
  const ImVec2 size(float(resolution_.x / ratio_), float(resolution_.y / ratio_));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 white = IM_COL32(255, 255, 255, 220);
  const auto write = [&](float x, float y, const std::string& text) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    draw->AddRectFilled(ImVec2(x - 4 * s, y - 2 * s),
                        ImVec2(x + extent.x + 4 * s, y + extent.y + 2 * s), IM_COL32(0, 0, 0, 130),
                        3 * s);
    draw->AddText(ImVec2(x, y), white, text.c_str());
  };
  const bool exact = comparesExact(document), compares = exact || comparesLooks(document);
  if (compares && document.compare == CompareMode::split) {
    const float x = float(document.divider * resolution_.x / ratio_);
    const bool held =
        draggingDivider_ || (cursor_ && std::abs(cursor_->x / ratio_ - double(x)) < 6);
    draw->AddLine(ImVec2(x, 0), ImVec2(x, size.y),
                  held ? IM_COL32(255, 214, 120, 255) : IM_COL32(255, 255, 255, 150), s);
    write(x - 22 * s, 6 * s, "A");
    write(x + 10 * s, 6 * s, exact ? "exact" : "B");
  } else if (compares && document.compare == CompareMode::blink) {
    write(10 * s, 6 * s, exact ? "exact" : "B");
  }
  if (compares && (exact || document.compare == CompareMode::difference)) {
    std::string text = comparisonText();
    if (!exact) {
      char times[40];
      std::snprintf(times, sizeof times, ", shown x %.3g", document.amplification);
      text += times;
    }
    write(10 * s, size.y - ImGui::GetTextLineHeight() - 8 * s, text);
  }
  if (exact && document.compare == CompareMode::difference && shownResult_.a) {
    const float left = 10 * s, width = 180 * s, top = 8 * s, height = 10 * s;
    draw->AddRectFilled(
        ImVec2(left - 6 * s, top - 4 * s),
        ImVec2(left + width + 34 * s, top + height + ImGui::GetTextLineHeight() + 4 * s),
        IM_COL32(0, 0, 0, 130), 3 * s);
    const std::vector<std::uint8_t> colors = errorScale(64);
    for (int i = 0; i < 64; ++i) {
      const std::uint8_t* c = colors.data() + 4 * i;
      draw->AddRectFilled(ImVec2(left + width * float(i) / 64, top),
                          ImVec2(left + width * float(i + 1) / 64, top + height),
                          IM_COL32(c[0], c[1], c[2], 255));
    }
    for (const auto& [value, text] : {std::pair{1e-8, "1e-8"}, {1e-4, "1e-4"}, {1.0, "1"}})
      draw->AddText(ImVec2(left + width * float(errorShade(value)) - 4 * s, top + height + 1),
                    white, text);
  }
  if (!session_.model) {
    const std::string text = loading_.valid()
                                 ? "Reading " + loadingPath_.filename().string() + " ..."
                                 : "Drop a model here (.glb or .gltf), or press Ctrl+O";
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    draw->AddText(ImVec2((size.x - extent.x) / 2, (size.y - extent.y) / 2),
                  IM_COL32(255, 255, 255, 200), text.c_str());
  }
}

}  // namespace glint::viewer
