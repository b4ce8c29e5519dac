#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/parameters.h"
#include "panel.h"
#include "widgets.h"

namespace glint {
namespace {

using widgets::style;

constexpr const char* typeNames[] = {"directional", "point", "spot", "camera"};

glm::dmat3 cameraAxes(const PanelContext& context) {
  return context.picture ? context.picture->list.camera.axes : glm::dmat3(1.0);
}

// A light of another type at about the same place, so that changing the type keeps what it can.
void changeType(Light& light, Light::Type type, const PanelContext& context) {
  const Bounds bounds = context.session.model ? context.session.model->bounds : Bounds{};
  const double reach = bounds.radius > 0 ? 2.5 * bounds.radius : 2.5;
  const glm::dmat3 axes = cameraAxes(context);
  glm::dvec3 toLight(0, 0, 1);  // from the model's centre, world space
  switch (light.type) {
    case Light::Type::directional:
      toLight = light.direction;
      break;
    case Light::Type::camera:
      toLight = axes * light.direction;
      break;
    case Light::Type::point:
    case Light::Type::spot:
      toLight = light.position - bounds.center;
      break;
  }
  const double length = glm::length(toLight);
  toLight = length > 0 ? toLight / length : glm::dvec3(0, 0, 1);
  const auto tidy = [](glm::dvec3 v) { return glm::round(v * 1e4) / 1e4; };
  light.type = type;
  if (type == Light::Type::directional) light.direction = tidy(toLight);
  if (type == Light::Type::camera) light.direction = {0, 0, 1};
  if (type == Light::Type::point || type == Light::Type::spot)
    light.position = tidy(bounds.center + toLight * reach);
  if (type == Light::Type::spot) {
    light.direction = tidy(-toLight);
    light.innerAngle = std::min(light.innerAngle, 20.0);
    light.outerAngle = 30;
    if (light.innerAngle <= 0) light.innerAngle = 15;
  }
}

void editLight(Light& light, const PanelContext& context) {
  widgets::label("type");
  if (ImGui::BeginCombo("##type", typeNames[int(light.type)])) {
    for (int t = 0; t < 4; ++t)
      if (ImGui::Selectable(typeNames[t], t == int(light.type)) && t != int(light.type))
        changeType(light, Light::Type(t), context);
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
  if (widgets::slider("##intensity", strength, {0, 4, false}, 0, 1e6)) set(strength);
  if (widgets::doubleClicked()) set(1);
  widgets::tooltip("factor of the colour, in linear light\nsymbol I_m");

  if (light.type == Light::Type::point || light.type == Light::Type::spot) {
    widgets::label("position");
    widgets::vector("##position", light.position);
  }
  if (light.type == Light::Type::directional || light.type == Light::Type::spot) {
    widgets::label(light.type == Light::Type::spot ? "shines along" : "to the light");
    glm::dvec3 d = light.direction;
    if (widgets::vector("##direction", d) && d != glm::dvec3(0.0)) light.direction = d;
    // Of a spot, too, the sphere shows where its light comes from.
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

// A light of the file as one of the look, which does not fall off: with the intensity that it has
// at the model's centre.
Light ownLight(Light light, const Bounds& bounds) {
  if (!light.fallsOff) return light;
  const glm::dvec3 way = light.position - bounds.center;
  const double square = glm::dot(way, way);
  if (square > 0) light.intensity = glm::clamp(light.intensity / square, 0.0, 1e6);
  light.fallsOff = false;
  light.range = 0;
  return light;
}

}  // namespace

void drawLightsTab(PanelContext& context) {
  Look& look = context.session.document.a;
  const std::string section = "Lights and environment";
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float third = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  static int selected = 0;
  const Model* model = context.session.model.get();
  std::vector<Light> lights = lightsOf(model ? withFileLights(model->scene, look) : look);
  const bool fromFile = !look.light && !look.noLights && model && !model->scene.lights.empty();
  selected = std::clamp(selected, 0, std::max(0, int(lights.size()) - 1));

  if (look.noLights)
    ImGui::TextDisabled("no lights: ambient light alone");
  else if (fromFile)
    ImGui::TextDisabled("%d of the model's file; editing makes them your own", int(lights.size()));
  else if (!look.light)
    ImGui::TextDisabled("the default light; editing makes it your own");
  else
    ImGui::TextDisabled(lights.size() == 1 ? "1 light" : "%d lights", int(lights.size()));
  const std::vector<Light> before = lights;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float lines = float(std::clamp<std::size_t>(lights.size(), 2, 5));
  if (ImGui::BeginListBox("##lights", ImVec2(-1, line * lines + 4 * style().scale))) {
    for (int i = 0; i < int(lights.size()); ++i) {
      ImGui::PushID(i);
      const glm::dvec3& c = lights[std::size_t(i)].intensity;
      const double most = std::max({c.r, c.g, c.b, 1.0});
      ImGui::ColorButton("##c",
                         ImVec4(float(std::sqrt(c.r / most)), float(std::sqrt(c.g / most)),
                                float(std::sqrt(c.b / most)), 1),
                         ImGuiColorEditFlags_NoTooltip,
                         ImVec2(ImGui::GetTextLineHeight(), ImGui::GetTextLineHeight()));
      ImGui::SameLine();
      const std::string text =
          std::to_string(i + 1) + "  " + typeNames[int(lights[std::size_t(i)].type)];
      if (ImGui::Selectable(text.c_str(), i == selected)) selected = i;
      ImGui::PopID();
    }
    ImGui::EndListBox();
  }
  if (ImGui::Button("Add", ImVec2(third, 0)) && lights.size() < maxLights) {
    look.noLights = false;
    Light added;
    added.direction = {1, 1, 1};
    if (!lights.empty()) {
      added = lights[std::size_t(selected)];
      if (added.type == Light::Type::directional || added.type == Light::Type::camera) {
        changeType(added, Light::Type::directional, context);
        added.direction = {-added.direction.x, added.direction.y, added.direction.z};
      }
    }
    lights.push_back(added);
    selected = int(lights.size()) - 1;
  }
  widgets::tooltip("one light more, mirrored from the selected one");
  ImGui::SameLine();
  if (ImGui::Button("Remove", ImVec2(third, 0)) && !lights.empty())
    lights.erase(lights.begin() + selected);
  ImGui::SameLine();
  if (ImGui::Button("Default", ImVec2(third, 0))) {
    look.light.reset();
    look.noLights = false;
    lights = before;
  }
  widgets::tooltip("the lights that stand without any of your own: the file's, or else one");
  if (selected < int(lights.size())) {
    ImGui::PushID("light");
    editLight(lights[std::size_t(selected)], context);
    ImGui::PopID();
  }
  if (lights != before) {
    look.noLights = false;
    if (fromFile)
      for (Light& light : lights) light = ownLight(light, model->bounds);
    look.light = lights;
  }
  ImGui::Separator();
  drawSection(context, section, {"light"});
}

}  // namespace glint
