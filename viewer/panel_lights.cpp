#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "light_edit.h"
#include "panel.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

using widgets::style;

constexpr const char* typeNames[] = {"directional", "point", "spot", "camera"};

glm::dmat3 cameraAxes(const PanelContext& context) {
  return context.picture ? context.picture->list.camera.axes : glm::dmat3(1.0);
}

// The upper end of the strength slider. The strength of a light with fall-off is given at one world
// unit, so the range grows with the light's distance from the model.
double strongest(const Light& light, const Bounds& bounds) {
  if (!light.fallsOff) return 4;
  const glm::dvec3 way = light.position - bounds.center;
  return std::max(4 * glm::dot(way, way), 1e-3);
}

void editPlace(Light& light, const Bounds& bounds) {
  widgets::label("position");
  widgets::vector("##position", light.position);
  bool fallsOff = light.fallsOff;
  widgets::label("falls off");
  if (ImGui::Checkbox("##falloff", &fallsOff)) setFallOff(light, fallsOff, bounds);
  widgets::tooltip(
      "the light falls off with the square of the distance; the intensity is given at one world "
      "unit. Switching it keeps the light at the model's centre");
  if (!light.fallsOff) return;
  widgets::label("range");
  const double reach = std::max(4 * bounds.radius, 1.0);
  widgets::slider("##range", light.range, {0, reach, false}, 0, 1e30,
                  light.range > 0 ? "%.4g" : "unlimited");
  if (widgets::resetAsked(true)) light.range = 0;
  widgets::tooltip("world units from the light to where its light ends\nDouble-click: unlimited");
}

void editLight(Light& light, const PanelContext& context) {
  const Bounds bounds = context.session.model ? context.session.model->bounds : Bounds{};
  widgets::label("type");
  if (ImGui::BeginCombo("##type", typeNames[int(light.type)])) {
    for (int t = 0; t < 4; ++t)
      if (ImGui::Selectable(typeNames[t], t == int(light.type)) && t != int(light.type))
        changeType(light, Light::Type(t), bounds, cameraAxes(context));
    ImGui::EndCombo();
  }
  // A colour whose largest component is at most 1, and a strength.
  double strength = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
  glm::dvec3 hue = strength > 0 ? light.intensity / strength : glm::dvec3(1.0);
  const auto set = [&](double s) { light.intensity = glm::clamp(hue * s, 0.0, 1e6); };
  widgets::label("color");
  if (widgets::color("##color", hue)) {
    const double most = std::max({hue.r, hue.g, hue.b});
    if (most > 1) hue /= most;
    set(strength);
  }
  widgets::label("intensity");
  if (widgets::slider("##intensity", strength, {0, strongest(light, bounds), false}, 0, 1e6))
    set(strength);
  if (widgets::resetAsked(true)) set(1);
  widgets::tooltip(std::string("factor of the colour, in linear light") +
                   (light.fallsOff ? ", at one world unit from the light" : "") + "\nsymbol I_m");

  if (light.type == Light::Type::point || light.type == Light::Type::spot) {
    editPlace(light, bounds);
  }
  if (light.type == Light::Type::directional || light.type == Light::Type::spot) {
    widgets::label(light.type == Light::Type::spot ? "shines along" : "to the light");
    glm::dvec3 d = light.direction;
    if (widgets::vector("##direction", d) && d != glm::dvec3(0.0)) light.direction = d;
    // For a spot, too, the sphere shows where the light comes from.
    d = light.type == Light::Type::spot ? -light.direction : light.direction;
    ImGui::Dummy(ImVec2(0, 0));
    ImGui::SameLine(style().labelWidth + ImGui::GetStyle().WindowPadding.x);
    if (widgets::direction("##sphere", d, cameraAxes(context), 110 * style().scale))
      light.direction = light.type == Light::Type::spot ? -d : d;
  }
  if (light.type == Light::Type::spot) {
    widgets::label("inner angle");
    widgets::slider("##inner", light.innerAngle, {0, 89, false}, 0, 89.999);
    widgets::tooltip("degrees from the axis: full intensity inside");
    widgets::label("outer angle");
    widgets::slider("##outer", light.outerAngle, {1, 90, false}, 0.001, 90);
    widgets::tooltip("degrees from the axis: no light outside");
    light.outerAngle = std::max(light.outerAngle, std::min(light.innerAngle + 0.001, 90.0));
    light.innerAngle = std::min(light.innerAngle, light.outerAngle - 0.001);
  }
}

// A checkbox as high as a line of the list.
bool smallCheckbox(bool& on) {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
  const bool clicked = ImGui::Checkbox("##on", &on);
  ImGui::PopStyleVar();
  return clicked;
}

}  // namespace

void drawLightsTab(PanelContext& context) {
  Session& session = context.session;
  Look& look = session.document.a;
  const std::string section = "Lights and environment";
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float third = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  const Model* model = session.model.get();
  const Scene* scene = model ? &model->scene : nullptr;
  std::vector<Light> lights = shownLights(scene, look);
  session.light = std::min(session.light, lights.empty() ? 0 : lights.size() - 1);

  if (look.noLights)
    ImGui::TextDisabled("no lights: only ambient light");
  else if (lightsAreTheFiles(scene, look))
    ImGui::TextDisabled("%d of the model's file; editing makes them your own", int(lights.size()));
  else if (!look.light)
    ImGui::TextDisabled("the default light; editing makes it your own");
  else
    ImGui::TextDisabled(lights.size() == 1 ? "1 light" : "%d lights", int(lights.size()));
  std::optional<std::size_t> switched;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float lines = float(std::clamp<std::size_t>(lights.size(), 2, 5));
  if (ImGui::BeginListBox("##lights", ImVec2(-1, line * lines + 4 * style().scale))) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
      ImGui::PushID(int(i));
      const glm::dvec3& c = lights[i].intensity;
      const double most = std::max({c.r, c.g, c.b, 1.0});
      ImGui::ColorButton("##c",
                         ImVec4(float(std::sqrt(c.r / most)), float(std::sqrt(c.g / most)),
                                float(std::sqrt(c.b / most)), 1),
                         ImGuiColorEditFlags_NoTooltip,
                         ImVec2(ImGui::GetTextLineHeight(), ImGui::GetTextLineHeight()));
      ImGui::SameLine();
      bool on = c != glm::dvec3(0.0);
      if (smallCheckbox(on)) switched = i;
      widgets::tooltip("on or off (" + keyText(infoOf(Action::switchLight)) +
                       " for the selected light, " + keyText(infoOf(Action::soloLight)) +
                       " for only that light)");
      ImGui::SameLine();
      const std::string text = std::to_string(i + 1) + "  " + typeNames[int(lights[i].type)] +
                               (lights[i].fallsOff ? ", falls off" : "");
      if (ImGui::Selectable(text.c_str(), i == session.light)) session.light = i;
      ImGui::PopID();
    }
    ImGui::EndListBox();
  }
  if (switched) {
    session.light = *switched;
    context.run(Action::switchLight);
  }
  actionRow(context, third,
            {{Action::addLight, "Add"},
             {Action::removeLight, "Remove"},
             {Action::defaultLights, "Default"}});
  ImGui::Checkbox("handles in the picture", &session.lightHandles);
  actionTooltip(Action::lightHandles);
  ImGui::SameLine(0, 2 * gap);
  actionButton(context, Action::soloLight, "Solo");
  // The buttons may have changed the lights.
  lights = shownLights(scene, look);
  if (session.light < lights.size()) {
    const Light before = lights[session.light];
    ImGui::PushID("light");
    editLight(lights[session.light], context);
    ImGui::PopID();
    if (lights[session.light] != before) {
      const std::string became =
          setLights(look, scene, model ? model->bounds : Bounds{}, std::move(lights));
      if (!became.empty()) session.say(became);
    }
  }
  ImGui::Separator();
  drawSection(context, section, {"light"});
}

}  // namespace glint::viewer
