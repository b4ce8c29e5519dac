#include "panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "camera_control.h"
#include "edits.h"
#include "effects.h"
#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "imgui_versions.h"
#include "materials.h"
#include "own_presets.h"
#include "presets.h"
#include "widgets.h"

namespace glint::viewer {

using widgets::style;

bool actionButton(PanelContext& context, Action command, const char* text, float width) {
  const bool pressed = ImGui::Button(text, ImVec2(width, 0));
  const ActionInfo& info = infoOf(command);
  widgets::tooltip(std::string(info.help) + " (" + keyText(info) + ")");
  if (pressed) context.run(command);
  return pressed;
}

namespace {

void drawParameter(Session& session, const Parameter& p) {
  try {
    widgets::parameter(p, session.document.a, session.model ? &session.model->scene : nullptr);
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

namespace {

void materialList(PanelContext& context) {
  Session& session = context.session;
  const Scene& scene = session.model->scene;
  const std::vector<int> drawn = drawnMaterials(scene);
  if (drawn.size() > 8)
    actionButton(context, Action::findMaterial, "Find a material by name ...", -1);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float lines = float(std::clamp<std::size_t>(drawn.size() + 1, 2, 6));
  if (!ImGui::BeginListBox("##materials", ImVec2(-1, line * lines + 4 * style().scale))) return;
  static int shown =
      -1;  // the one selected when the list was drawn last: another one is scrolled to
  const auto entry = [&](int index) {
    const std::string name = materialLabel(scene, index);
    const bool edited = session.document.a.material.contains(materialKey(scene, index));
    const std::string text = name + (edited ? "  (edited)" : "") + "##" + std::to_string(index);
    if (session.hovered == index)
      ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 214, 120, 255));
    if (ImGui::Selectable(text.c_str(), session.material == index)) session.material = index;
    if (session.material == index && index != shown) ImGui::SetScrollHereY();
    if (session.hovered == index) ImGui::PopStyleColor();
  };
  entry(-1);
  for (const int index : drawn) entry(index);
  shown = session.material;
  ImGui::EndListBox();
}

void materialSliders(Session& session) {
  const Scene& scene = session.model->scene;
  Look& look = session.document.a;
  const std::string key = materialKey(scene, session.material);
  const ShadingParameters values = effectiveParameters(scene, look, session.material);
  const auto found = look.material.find(key);
  const MaterialEdit edits = found == look.material.end() ? MaterialEdit{} : found->second;

  const bool all = session.material < 0;
  const bool oneColor = !all || haveOneColor(scene, look);
  widgets::label(oneColor ? "color" : "color (mixed)", edits.color.has_value());
  glm::dvec3 color = values.color;
  if (widgets::color("##color", color)) {
    if (all)  // what single materials say would stand above it
      for (auto& each : look.material) each.second.color.reset();
    look.material[key].color = color;
  }
  if (widgets::resetAsked()) resetColor(look, key);
  widgets::tooltip("the material's colour, in linear light (" + numberText(values.color.r) + ", " +
                   numberText(values.color.g) + ", " + numberText(values.color.b) +
                   "); multiplies its texture\nsymbol C\nThe square opens a "
                   "picker; #c04020 may be typed - Double-click on its name: reset");
  for (const MaterialParameter& p : materialParameters()) {
    const std::string name(p.name);
    const std::string reason = withoutEffect(look, &scene, name);
    ImGui::BeginDisabled(!reason.empty());
    widgets::label(name, (edits.*p.edit).has_value());
    double value = values.*p.value;
    char format[64] = "%.4g";
    if (const ValueSpread spread = all ? spreadOf(scene, look, p) : ValueSpread{}; spread.mixed())
      std::snprintf(format, sizeof format, "mixed: %.3g to %.3g", spread.least, spread.most);
    if (widgets::slider(("##" + name).c_str(), value, p.slider, p.min, p.max, format)) {
      if (key.empty())  // what single materials say would stand above it
        for (auto& each : look.material) (each.second.*p.edit).reset();
      look.material[key].*p.edit = value;
    }
    if (widgets::resetAsked(true)) resetParameter(look, key, p);
    ImGui::EndDisabled();
    widgets::tooltip(!reason.empty()
                         ? "without effect: " + reason + "\n" + std::string(p.help)
                         : widgets::parameterTooltip(std::string(p.help), {}, {}, p.min, p.max));
  }
}

// Forms that the material has in place of the look's.
void materialForms(Session& session) {
  Look& look = session.document.a;
  const std::string key = materialKey(session.model->scene, session.material);
  const auto found = look.material.find(key);
  MaterialEdit edit = found == look.material.end() ? MaterialEdit{} : found->second;
  const MaterialEdit before = edit;
  bool own = edit.highlight || edit.fresnel;
  widgets::label("own forms", own);
  if (ImGui::Checkbox("##own", &own)) {
    edit.highlight = own ? std::optional(look.highlight) : std::nullopt;
    edit.fresnel = own ? std::optional(look.fresnel) : std::nullopt;
  }
  widgets::tooltip("this material's lobe and reflectance by other forms than the look's above");
  if (own) {
    HighlightForms form = edit.highlight.value_or(look.highlight);
    if (widgets::highlightForm("its highlight", edit.highlight.has_value(), form,
                               "form of this material's lobe"))
      edit.highlight = form;
    widgets::label("its fresnel", edit.fresnel.has_value());
    const Fresnel now = edit.fresnel.value_or(look.fresnel);
    if (ImGui::BeginCombo("##its fresnel", std::string(fresnelText(now)).c_str())) {
      for (std::size_t i = 0; i < fresnelTexts().size(); ++i)
        if (ImGui::Selectable(std::string(fresnelTexts()[i]).c_str(), Fresnel(i) == now))
          edit.fresnel = Fresnel(i);
      ImGui::EndCombo();
    }
  }
  if (edit == before) return;
  look.material[key] = edit;
  if (edit == MaterialEdit{}) look.material.erase(key);
}

// The user's own, above the table's.
void ownPresetRows(Session& session) {
  const std::vector<OwnPreset> all = ownPresets();
  if (all.empty()) return;
  ImGui::TextDisabled("own");
  for (const OwnPreset& preset : all) {
    ImGui::PushID(preset.name.c_str());
    const bool taken = ImGui::Selectable(preset.name.c_str());
    if (taken || ImGui::IsItemHovered()) try {
        Look look = session.document.a;
        pasteMaterial(look, materialKey(session.model->scene, session.material),
                      ownPresetText(preset));
        (taken ? session.document.a : session.tried.emplace()) = std::move(look);
      } catch (const InputError& error) {
        session.say(preset.path.string() + ": " + error.what());
      }
    ImGui::PopID();
  }
}

void materialButtons(PanelContext& context) {
  Session& session = context.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
  ImGui::SetNextItemWidth(width);
  if (ImGui::BeginCombo("##preset", "Preset", ImGuiComboFlags_HeightLarge)) {
    std::string_view group;
    const FitForm form{usesBlinn(session.document.a.shading), session.document.a.blinnFactor};
    const int now =
        presetOf(effectiveParameters(session.model->scene, session.document.a, session.material));
    ownPresetRows(session);
    for (const Preset& preset : presets()) {
      if (preset.group != group) {
        group = preset.group;
        ImGui::TextDisabled("%s", std::string(group).c_str());
      }
      const int place = int(&preset - presets().data());
      const float side = 1.6f * ImGui::GetTextLineHeight();
      if (context.thumbnails)
        imgui::image(context.thumbnails->ofPreset(place, form).texture, side, side);
      ImGui::SameLine();
      const bool taken =
          ImGui::Selectable(std::string(preset.name).c_str(), place == now, 0, ImVec2(0, side));
      if (!taken && ImGui::IsItemHovered()) session.tried = session.document.a;
      if (Look* const look = taken                    ? &session.document.a
                             : ImGui::IsItemHovered() ? &*session.tried
                                                      : nullptr)
        setParameters(*look, materialKey(session.model->scene, session.material),
                      presetParameters(preset));
    }
    ImGui::EndCombo();
  }
  widgets::tooltip(
      "a material from the classic published tables (teapots.c, Silicon Graphics), in Phong's "
      "parameters (" +
      keyText(infoOf(Action::nextPreset)) + " the next, " +
      keyText(infoOf(Action::previousPreset)) + " the previous); " +
      keyText(infoOf(Action::keepPreset)) + " keeps the selected one among your own");
  ImGui::SameLine();
  actionButton(context, Action::copyMaterial, "Copy", width);
  ImGui::SameLine();
  actionButton(context, Action::pasteMaterial, "Paste", width);
  ImGui::SameLine();
  actionButton(context, Action::resetMaterial, "Reset", width);
}

}  // namespace

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
    ImGui::TextWrapped("auto chooses by the error that is allowed: tick max error (%s)",
                       key.c_str());
  }
  ImGui::Separator();
  if (!session.model) return;
  materialList(context);
  materialSliders(session);
  ImGui::BeginDisabled(look.maxError.has_value());
  materialForms(session);
  ImGui::EndDisabled();
  materialButtons(context);
  drawTextures(context);
  ImGui::Separator();
  drawPlots(context);
}

void drawCameraTab(PanelContext& context) {
  Session& session = context.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
  const auto row = [&](std::initializer_list<std::pair<Action, const char*>> buttons) {
    bool first = true;
    for (const auto& [command, text] : buttons) {
      if (!first) ImGui::SameLine();
      first = false;
      actionButton(context, command, text, width);
    }
  };
  row({{Action::front, "Front"},
       {Action::right, "Right"},
       {Action::top, "Top"},
       {Action::isometric, "Isometric"}});
  row({{Action::back, "Back"},
       {Action::left, "Left"},
       {Action::bottom, "Bottom"},
       {Action::fit, "Fit"}});
  row({{Action::resetCamera, "Reset"},
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
    if (pose) {
      if (p.name == "camera-position") shown = pose->position;
      if (p.name == "camera-focal-point") shown = pose->focalPoint;
      if (p.name == "camera-view-up") shown = pose->up;
      if (p.name == "camera-direction") {
        const glm::dvec3 ahead = pose->focalPoint - pose->position;
        const double length = glm::length(ahead);
        if (length > 0) shown = ahead / length;
      }
    }
    try {
      widgets::parameter(p, session.document.a, session.model ? &session.model->scene : nullptr,
                         shown);
    } catch (const InputError& error) {
      session.fail(error.what());
    }
  }
  if (session.model && !session.model->scene.cameras.empty()) {
    ImGui::Separator();
    ImGui::TextDisabled("Cameras of the file");
    for (std::size_t i = 0; i < session.model->scene.cameras.size(); ++i) {
      const std::string& name = session.model->scene.cameras[i].name;
      const std::string text = std::to_string(i) + "  " + (name.empty() ? "camera" : name);
      if (ImGui::Selectable(text.c_str(), session.document.a.cameraIndex == int(i))) {
        resetCamera(session.document.a);
        session.document.a.cameraIndex = int(i);
      }
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
      Parameter time = p;  // as long as this animation is
      time.slider.max = std::max(animationDuration(scene, look), 0.001);
      drawParameter(session, time);
      continue;
    }
    widgets::label(p.name, !look.animation.empty());
    const auto label = [&](std::size_t i) {
      const std::string& name = scene.animations[i].name;
      return std::to_string(i) + (name.empty() ? "" : "  " + name);
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
  actionButton(context, Action::screenshot, "Save picture", width);
  ImGui::SameLine();
  actionButton(context, Action::screenshotAs, "Save picture as...", width);
  ImGui::TextDisabled("Overlays (never in saved pictures)");
  const auto overlay = [&](Overlay which, Action command, const char* text) {
    bool on = session.overlay == which;
    if (ImGui::Checkbox(text, &on)) context.run(command);
    widgets::tooltip(std::string(infoOf(command).help) + " (" + keyText(infoOf(command)) + ")");
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
