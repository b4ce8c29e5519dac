#include "panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "camera_control.h"
#include "edits.h"
#include "glint/image/error.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "imgui_versions.h"
#include "materials.h"
#include "widgets.h"

namespace glint::viewer {

void actionButton(PanelContext& context, Action command, const char* text, float width) {
  const bool pressed = ImGui::Button(text, ImVec2(width, 0));
  actionTooltip(command);
  if (pressed) context.run(command);
}

void actionRow(PanelContext& context, float width,
               std::initializer_list<std::pair<Action, const char*>> buttons) {
  for (const auto& button : buttons) {
    if (&button != buttons.begin()) ImGui::SameLine();
    actionButton(context, button.first, button.second, width);
  }
}

void actionTooltip(Action command) {
  const ActionInfo& info = infoOf(command);
  widgets::tooltip(std::string(info.help) + " (" + keyText(info) + ")");
}

namespace {

void drawParameter(Session& session, const Parameter& p,
                   const std::optional<glm::dvec3>& shown = {}) {
  try {
    widgets::parameter(p, session.document.a, session.model ? &session.model->scene : nullptr,
                       shown);
  } catch (const InputError& error) {
    session.fail(error.what());
  }
}

}  // namespace

void drawSection(PanelContext& context, const std::string& section,
                 std::initializer_list<std::string_view> without) {
  Session& session = context.session;
  for (const Parameter& p : lookParameters()) {
    if (p.section != section) continue;
    if (std::find(without.begin(), without.end(), p.name) != without.end()) continue;
    drawParameter(session, p);
  }
}

void drawShadingTab(PanelContext& context) {
  Session& session = context.session;
  Look& look = session.document.a;
  for (const Parameter& p : lookParameters()) {
    if (p.section != "Shading" || p.name == "material") continue;
    if (p.name == "cost-table" && !look.maxError && look.costTable.empty()) continue;
    if (look.maxError && (p.name == "highlight" || p.name == "fresnel")) {
      widgets::label(p.name);
      ImGui::TextDisabled("chosen by max error");
      continue;
    }
    drawParameter(session, p);
    if (p.name != "max-error") continue;
    drawChoice(context);
    if (look.shading != Shading::automatic || look.maxError) continue;
    const std::string key = keyText(infoOf(Action::maxError));
    ImGui::TextWrapped("auto needs an allowed error: tick max error (%s)", key.c_str());
  }
  ImGui::Separator();
  if (!session.model) return;
  drawMaterials(context);
  drawTextures(context);
  ImGui::Separator();
  drawPlots(context);
}

void drawCameraTab(PanelContext& context) {
  Session& session = context.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
  actionRow(context, width,
            {{Action::front, "Front"},
             {Action::right, "Right"},
             {Action::top, "Top"},
             {Action::isometric, "Isometric"}});
  actionRow(context, width,
            {{Action::back, "Back"},
             {Action::left, "Left"},
             {Action::bottom, "Bottom"},
             {Action::fit, "Fit"}});
  actionRow(context, width,
            {{Action::resetCamera, "Reset"},
             {Action::orthographic, "Parallel"},
             {Action::nextCamera, "File's"}});
  ImGui::Separator();
  std::optional<Pose> pose;
  if (session.model) {
    try {
      Look look = session.document.a;
      look.resolution = context.resolution;
      pose = poseOf(session.model->scene, session.model->bounds, look);
    } catch (const InputError&) {
    }
  }
  for (const Parameter& p : lookParameters()) {
    if (p.section != "Camera") continue;
    std::optional<glm::dvec3> shown;
    // Sets values that are 0 except for rounding to 0.
    const auto tidy = [](glm::dvec3 v) {
      const double most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      for (int c = 0; c < 3; ++c)
        if (std::abs(v[c]) < 1e-12 * most) v[c] = 0;
      return v;
    };
    if (pose) {
      if (p.name == "camera-position") shown = tidy(pose->position);
      if (p.name == "camera-focal-point") shown = tidy(pose->focalPoint);
      if (p.name == "camera-view-up") shown = tidy(pose->up);
      if (p.name == "camera-direction") {
        const glm::dvec3 ahead = pose->focalPoint - pose->position;
        const double length = glm::length(ahead);
        if (length > 0) shown = tidy(ahead / length);
      }
    }
    drawParameter(session, p, shown);
  }
  if (!session.model) return;
  const Scene& scene = session.model->scene;
  const std::vector<int> cameras = usableCameras(scene);
  if (cameras.empty()) return;
  ImGui::Separator();
  ImGui::TextDisabled("Cameras of the file");
  for (const int i : cameras) {
    const std::string& name = scene.cameras[std::size_t(i)].name;
    const std::string text =
        std::to_string(i) + "  " + (name.empty() ? "camera" : widgets::shownName(name));
    if (ImGui::Selectable(text.c_str(), session.document.a.cameraIndex == i)) {
      resetCamera(session.document.a);
      session.document.a.cameraIndex = i;
    }
  }
}

namespace {

void drawAnimation(PanelContext& context) {
  Session& session = context.session;
  Look& look = session.document.a;
  const Scene& scene = session.model->scene;
  ImGui::TextDisabled("Animation");
  for (const Parameter& p : lookParameters()) {
    if (p.section != "Animation") continue;
    if (p.name == "animation-time") {
      Parameter time = p;  // the slider ends at the animation's duration
      time.slider.max = std::max(animationDuration(scene, look), 0.001);
      drawParameter(session, time);
      continue;
    }
    widgets::label(p.name, !look.animation.empty());
    const auto label = [&](std::size_t i) {
      const std::string& name = scene.animations[i].name;
      return std::to_string(i) + (name.empty() ? "" : "  " + widgets::shownName(name));
    };
    std::size_t now = 0;
    for (std::size_t i = 0; i < scene.animations.size(); ++i)
      if (look.animation == std::to_string(i) || look.animation == scene.animations[i].name)
        now = i;
    if (ImGui::BeginCombo("##animation", label(now).c_str())) {
      for (std::size_t i = 0; i < scene.animations.size(); ++i)
        if (ImGui::Selectable(label(i).c_str(), i == now) && i != now)
          look.animation = std::to_string(i);
      ImGui::EndCombo();
    }
    widgets::tooltip(p.help + " (" + keyText(infoOf(Action::nextAnimation)) + ")");
  }
  actionButton(context, Action::play, session.playing ? "Stop" : "Play", -1);
}

}  // namespace

void drawPictureTab(PanelContext& context) {
  Session& session = context.session;
  static glm::ivec2 typed{0};
  static bool typing = false;
  if (!typing) typed = context.resolution;
  widgets::label("resolution");
  ImGui::InputInt2("##resolution", &typed.x);
  typing = ImGui::IsItemActive();
  if (ImGui::IsItemDeactivatedAfterEdit())
    context.resizePicture(glm::clamp(typed, glm::ivec2(16), glm::ivec2(16384)));
  widgets::tooltip("width and height of the picture in pixels; typed values resize the window");
  drawSection(context, "Picture", {"resolution"});
  if (session.model && !session.model->scene.animations.empty()) {
    ImGui::Separator();
    drawAnimation(context);
  }
  ImGui::Separator();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  actionRow(context, width,
            {{Action::screenshot, "Save picture"}, {Action::screenshotAs, "Save picture as..."}});
  ImGui::TextDisabled("Overlays (never in saved pictures)");
  const auto overlay = [&](Overlay which, Action command, const char* text) {
    bool on = session.overlay == which;
    if (ImGui::Checkbox(text, &on)) context.run(command);
    actionTooltip(command);
  };
  overlay(Overlay::wireframe, Action::wireframe, "edges");
  ImGui::SameLine(width + 2 * gap);
  overlay(Overlay::normals, Action::normals, "normals");
  overlay(Overlay::facing, Action::facing, "facing");
  ImGui::SameLine(width + 2 * gap);
  overlay(Overlay::clipped, Action::clipped, "clipped pixels");
}

void drawPanel(PanelContext& context) {
  if (!ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) return;
  int number = 0;
  std::optional<int>& wanted = context.session.wantedTab;
  const auto tab = [&](const char* name, void (*draw)(PanelContext&)) {
    const bool select = wanted == number++;
    if (select) wanted.reset();
    if (!ImGui::BeginTabItem(name, nullptr, select ? ImGuiTabItemFlags_SetSelected : 0)) return;
    imgui::beginFlattened("tab");
    draw(context);
    ImGui::EndChild();
    ImGui::EndTabItem();
  };
  tab("Shading", drawShadingTab);
  tab("Lights", drawLightsTab);
  tab("Camera", drawCameraTab);
  tab("Picture", drawPictureTab);
  tab("Compare", drawCompareTab);
  tab("Info", drawInfoTab);
  ImGui::EndTabBar();
}

}  // namespace glint::viewer
