// The list of materials, and the parameters of the selected one.
#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "edits.h"
#include "effects.h"
#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "imgui_versions.h"
#include "materials.h"
#include "own_presets.h"
#include "panel.h"
#include "presets.h"
#include "widgets.h"

namespace glint::viewer {

using widgets::style;

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
      -1;  // the selection when the list was last drawn; a different one is scrolled into view
  const FitForm form{usesBlinn(session.document.a.shading), session.document.a.blinnFactor};
  const auto entry = [&](int index) {
    const std::string name = widgets::shownName(materialLabel(scene, index));
    const bool edited = session.document.a.material.contains(materialKey(scene, index));
    const std::string text = name + (edited ? "  (edited)" : "") + "##" + std::to_string(index);
    // As high as a line with its spacing, so that the list's height is a whole number of lines.
    const float height = ImGui::GetTextLineHeight();
    const float side = height + ImGui::GetStyle().ItemSpacing.y - 1;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(ImVec2(side, height));
    if (index >= 0 && context.thumbnails && ImGui::IsItemVisible()) {
      const auto ball = context.thumbnails->ofMaterial(session.model->images, scene,
                                                       session.document.a, index, form);
      imgui::imageAt(ball.texture, at.x, at.y - (side - height) / 2, side, side);
    }
    ImGui::SameLine();
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
    if (all)  // edits of single materials would take precedence
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
      if (key.empty())  // edits of single materials would take precedence
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

// Forms that the material uses instead of the look's.
void materialForms(Session& session) {
  Look& look = session.document.a;
  const std::string key = materialKey(session.model->scene, session.material);
  const auto found = look.material.find(key);
  MaterialEdit edit = found == look.material.end() ? MaterialEdit{} : found->second;
  const MaterialEdit before = edit;
  bool own = edit.highlight || edit.fresnel;
  widgets::label("forms of this material", own);
  if (ImGui::Checkbox("##own", &own)) {
    edit.highlight = own ? std::optional(look.highlight) : std::nullopt;
    edit.fresnel = own ? std::optional(look.fresnel) : std::nullopt;
  }
  widgets::tooltip("other forms of lobe and reflectance for this material than the look's above");
  if (own) {
    HighlightForms form = edit.highlight.value_or(look.highlight);
    if (widgets::highlightForm("material's highlight", edit.highlight.has_value(), form,
                               "form of this material's lobe"))
      edit.highlight = form;
    widgets::label("material's fresnel", edit.fresnel.has_value());
    const Fresnel now = edit.fresnel.value_or(look.fresnel);
    if (ImGui::BeginCombo("##material's fresnel", std::string(fresnelText(now)).c_str())) {
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

// The user's own presets, above those of the table.
void ownPresetRows(Session& session) {
  const std::vector<OwnPreset> all = ownPresets();
  if (all.empty()) return;
  ImGui::TextDisabled("own");
  for (const OwnPreset& preset : all) {
    ImGui::PushID(preset.name.c_str());
    const bool taken = ImGui::Selectable(widgets::shownName(preset.name).c_str());
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
      keyText(infoOf(Action::nextPreset)) + " next, " + keyText(infoOf(Action::previousPreset)) +
      " previous); " + keyText(infoOf(Action::keepPreset)) +
      " keeps the selected material as a preset");
  ImGui::SameLine();
  actionRow(context, width,
            {{Action::copyMaterial, "Copy"},
             {Action::pasteMaterial, "Paste"},
             {Action::resetMaterial, "Reset"}});
}

}  // namespace

void drawMaterials(PanelContext& context) {
  materialList(context);
  materialSliders(context.session);
  ImGui::BeginDisabled(context.session.document.a.maxError.has_value());
  materialForms(context.session);
  ImGui::EndDisabled();
  materialButtons(context);
}

}  // namespace glint::viewer
