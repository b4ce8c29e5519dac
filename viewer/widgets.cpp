#include "widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "effects.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/scene/scene.h"

namespace glint::viewer::widgets {

Style& style() {
  static Style value;
  return value;
}

bool direction(const char* id, glm::dvec3& d, const glm::dmat3& axes, float size) {
  // Azimuthal equidistant projection: the distance from the centre is the angle to the viewer, 180
  // degrees at the rim.
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float radius = size / 2;
  const ImVec2 center(corner.x + radius, corner.y + radius);
  ImGui::InvisibleButton(id, ImVec2(size, size));
  bool changed = false;
  if (ImGui::IsItemActive()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    double x = double(mouse.x - center.x) / double(radius);
    double y = -double(mouse.y - center.y) / double(radius);
    const double r = std::hypot(x, y);
    const double angle = std::min(r, 1.0) * std::numbers::pi;
    if (r > 0) x /= r, y /= r;
    glm::dvec3 eye(x * std::sin(angle), y * std::sin(angle), std::cos(angle));
    eye = glm::round(eye * 1e4) / 1e4;
    const glm::dvec3 turned = axes * eye;
    if (turned != d && (ImGui::IsItemClicked() || ImGui::IsMouseDragging(0, 0))) {
      d = glm::round(turned * 1e6) / 1e6;
      changed = true;
    }
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const float thin = std::max(1.0f, style().scale);
  draw->AddCircleFilled(center, radius, ImGui::GetColorU32(ImGuiCol_FrameBg), 48);
  draw->AddCircle(center, radius, line, 48, thin);
  draw->AddCircle(center, radius / 2, line, 48, thin);
  draw->AddLine(ImVec2(center.x - 3, center.y), ImVec2(center.x + 3, center.y), line, thin);
  draw->AddLine(ImVec2(center.x, center.y - 3), ImVec2(center.x, center.y + 3), line, thin);
  const double length = glm::length(d);
  if (length > 0 && std::isfinite(length)) {
    const glm::dvec3 eye = glm::transpose(axes) * (d / length);
    const double angle = std::acos(std::clamp(eye.z, -1.0, 1.0)) / std::numbers::pi;
    const double flat = std::hypot(eye.x, eye.y);
    const double x = flat > 0 ? eye.x / flat * angle : 0, y = flat > 0 ? eye.y / flat * angle : 0;
    const ImVec2 at(center.x + float(x) * radius, center.y - float(y) * radius);
    const ImU32 dot = ImGui::IsItemActive() || ImGui::IsItemHovered() ? IM_COL32(255, 214, 120, 255)
                                                                      : IM_COL32(240, 190, 80, 255);
    draw->AddLine(center, at, dot, thin);
    draw->AddCircleFilled(at, 5 * style().scale, dot);
  }
  tooltip("Drag: the centre points to you, the inner circle to the sides, the rim away from you.");
  return changed;
}

std::string parameterTooltip(const std::string& help, std::string_view symbol,
                             const std::string& unit, double min, double max, bool slides) {
  std::string text = help;
  std::string facts;
  if (!symbol.empty()) facts += "symbol " + std::string(symbol);
  const auto add = [&](const std::string& fact) { facts += (facts.empty() ? "" : " - ") + fact; };
  if (!unit.empty()) add("unit " + unit);
  if (min < max) {
    char range[80];
    std::snprintf(range, sizeof range, "from %.6g to %.6g", min, max);
    add(range);
  }
  if (!facts.empty()) text += "\n" + facts;
  return text + (slides ? "\nDouble-click: reset - Ctrl+click: type a value"
                        : "\nDouble-click on its name: reset");
}

namespace {

// Texts being typed, by parameter; the look changes when Enter is pressed or the field loses focus.
bool textField(const Parameter& p, Look& look) {
  static std::map<std::string, std::string> typed;
  const auto saved = p.save(look);
  std::string now;
  if (saved.is_string())
    now = saved.get<std::string>();
  else if (!saved.is_null())
    now = saved.dump();
  std::erase_if(now, [](char c) { return c == '[' || c == ']'; });
  const std::string id = "##" + p.name;
  const auto found = typed.find(p.name);
  std::string text = found == typed.end() ? now : found->second;
  ImGui::InputTextWithHint(id.c_str(), p.value.c_str(), &text);
  if (ImGui::IsItemActive()) typed[p.name] = text;
  if (!ImGui::IsItemDeactivated()) return false;
  typed.erase(p.name);
  if (text == now) return false;
  if (text.empty() && p.reset)
    p.reset(look);
  else
    p.read(look, text);
  return true;
}

// A checkbox left of a slider, for an optional number.
bool tick(const Parameter& p, Look& look) {
  bool on = p.get(look) != ParameterValue();
  const bool clicked = ImGui::Checkbox(("##on" + p.name).c_str(), &on);
  if (clicked && on) p.set(look, 0.01);
  if (clicked && !on) p.reset(look);
  tooltip(on ? "off" : "on, within 0.01");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  return clicked;
}

}  // namespace

bool highlightForm(const std::string& name, bool edited, HighlightForms& forms,
                   const std::string& help) {
  HighlightForm form = forms.brightest;
  const auto nameOf = [](const HighlightForm& f) {
    const std::string text = highlightText(f);
    return text.substr(0, text.find(':'));
  };
  // Forms chosen per light have no single name; choosing one form replaces them.
  const bool byLight = !forms.dimmer.empty();
  const std::string now = byLight ? highlightText(forms) : nameOf(form);
  bool changed = false;
  label(name, edited);
  if (ImGui::BeginCombo(("##" + name).c_str(), now.c_str())) {
    std::string last;
    for (const std::string& text : highlightTexts()) {
      HighlightForm each = parseHighlights(text, name).brightest;
      if (nameOf(each) == last) continue;  // the same form with another gamma
      last = nameOf(each);
      if (!ImGui::Selectable(last.c_str(), last == now) || last == now) continue;
      if (each.gamma > 0) each.gamma = form.gamma > 0 ? form.gamma : 8;
      forms = form = each;
      changed = true;
    }
    ImGui::EndCombo();
  }
  tooltip(help);
  if (form.gamma <= 0 || !forms.dimmer.empty()) return changed;
  label(style().greek ? "  \u03b3" : "  gamma", edited);
  int power = std::countr_zero(unsigned(form.gamma));
  char text[16];
  std::snprintf(text, sizeof text, "%d", form.gamma);
  if (ImGui::SliderInt(("##gamma" + name).c_str(), &power, 0, 6, text, ImGuiSliderFlags_NoInput)) {
    power = std::clamp(power, 0, 6);
    if (1 << power != form.gamma) {
      form.gamma = 1 << power;
      forms = form;
      changed = true;
    }
  }
  tooltip(
      "the power to which the form is raised by squaring: 1, 2, 4, ... 64; larger ones are nearer "
      "to the exact lobe and cost more");
  return changed;
}

namespace {

// The possible values of a text parameter, if the scene or the picture determines them; else empty.
std::vector<std::string> textChoices(const Parameter& p, const Look& look, const Scene* scene) {
  std::vector<std::string> texts;
  const auto numbered = [&](const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) texts.push_back(std::to_string(i));
  };
  if (p.name == "anti-aliasing") {
    texts = {"none", "msaa:4", "msaa:8", "ssaa:2", "ssaa:3", "ssaa:4", "ssaa:8"};
    const std::string now = antiAliasingText(look.antiAliasing);
    if (std::ranges::find(texts, now) == texts.end()) texts.push_back(now);
  }
  if (!scene) return texts;
  if (p.name == "scene" && scene->scenes.size() > 1) numbered(scene->scenes);
  if (p.name == "variant") texts = scene->variants;
  if (p.name == "camera-index")
    for (const int i : usableCameras(*scene)) texts.push_back(std::to_string(i));
  return texts;
}

bool textCombo(const Parameter& p, Look& look, const Scene* scene,
               const std::vector<std::string>& texts) {
  const nlohmann::ordered_json saved = p.save(look);
  const std::string now = saved.is_null()     ? ""
                          : saved.is_string() ? saved.get<std::string>()
                                              : saved.dump();
  const auto shownText = [&](const std::string& text) {
    if (scene && p.name == "scene" && text.size() < 6) {
      const std::size_t i = std::size_t(std::atoi(text.c_str()));
      if (i < scene->scenes.size() && !scene->scenes[i].empty())
        return text + "  " + shownName(scene->scenes[i]);
    }
    return text;
  };
  bool changed = false;
  if (!ImGui::BeginCombo(("##" + p.name).c_str(), now.empty() ? "default" : shownText(now).c_str()))
    return false;
  if (saved.is_null() || p.name != "anti-aliasing") {
    if (ImGui::Selectable("default", saved.is_null()) && !saved.is_null()) {
      p.reset(look);
      changed = true;
    }
  }
  for (const std::string& text : texts)
    if (ImGui::Selectable(shownText(text).c_str(), text == now) && text != now) {
      p.read(look, text);
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

bool widgetOf(const Parameter& p, Look& look, const Scene* scene,
              const std::optional<glm::dvec3>& shown, const std::string& reason);

}  // namespace

bool parameter(const Parameter& p, Look& look, const Scene* scene,
               const std::optional<glm::dvec3>& shown) {
  const std::string reason = withoutEffect(look, scene, p.name);
  ImGui::BeginDisabled(!reason.empty());
  bool changed = false;
  try {
    changed = widgetOf(p, look, scene, shown, reason);
  } catch (...) {
    ImGui::EndDisabled();
    throw;
  }
  ImGui::EndDisabled();
  return changed;
}

namespace {

bool widgetOf(const Parameter& p, Look& look, const Scene* scene,
              const std::optional<glm::dvec3>& shown, const std::string& reason) {
  const bool edited = p.save(look) != p.save(Look{});
  std::string name = p.name;
  if (name.starts_with("camera-")) name = name.substr(7);
  std::replace(name.begin(), name.end(), '-', ' ');
  if (p.name == "highlight")
    return highlightForm(name, edited, look.highlight,
                         reason.empty() ? p.help : "without effect: " + reason);
  label(name, edited);
  const std::string id = "##" + p.name;
  const ParameterValue now = p.get ? p.get(look) : ParameterValue();
  ParameterValue next;  // empty until something changes
  bool changed = false;
  std::string unit;
  switch (p.kind) {
    case ParameterKind::number: {
      const bool open = now == ParameterValue(), ticked = p.name == "max-error";
      if (ticked) changed = tick(p, look);
      const char* format = ticked && open                   ? "off"
                           : ticked && look.maxErrorInCodes ? "codes: %.4g"
                                                            : "%.4g";
      double value = open ? p.unset : std::get<double>(now);
      if (slider(id.c_str(), value, p.slider, p.min, p.max, format)) next = value;
      if (p.value.size() > 1 && p.value != "FACTOR" && !ticked)
        for (const char c : p.value) unit += char(std::tolower(static_cast<unsigned char>(c)));
      break;
    }
    case ParameterKind::flag: {
      bool value = std::get<bool>(now);
      if (ImGui::Checkbox(id.c_str(), &value)) next = value;
      break;
    }
    case ParameterKind::choice: {
      const std::vector<std::string> words = p.choices();
      const std::size_t at = std::get<std::size_t>(now);
      if (ImGui::BeginCombo(id.c_str(), words[at].c_str())) {
        for (std::size_t i = 0; i < words.size(); ++i)
          if (ImGui::Selectable(words[i].c_str(), i == at) && i != at) next = i;
        ImGui::EndCombo();
      }
      break;
    }
    case ParameterKind::vector:
    case ParameterKind::direction:
    case ParameterKind::color: {
      const glm::dvec3* given = std::get_if<glm::dvec3>(&now);
      glm::dvec3 value = given ? *given : shown.value_or(glm::dvec3(0.0));
      if (p.kind == ParameterKind::color ? color(id.c_str(), value) : vector(id.c_str(), value))
        next = value;
      break;
    }
    case ParameterKind::text: {
      const std::vector<std::string> texts = textChoices(p, look, scene);
      changed = texts.empty() ? textField(p, look) : textCombo(p, look, scene, texts);
      break;
    }
  }
  if (next != ParameterValue()) {
    p.set(look, next);
    changed = true;
  }
  const bool slides = p.kind == ParameterKind::number;
  if (p.reset && resetAsked(slides)) {
    p.reset(look);
    return true;
  }
  tooltip(!reason.empty() ? "without effect: " + reason + "\n" + p.help
                          : parameterTooltip(p.help, p.symbol, unit, p.min, p.max, slides));
  return changed;
}

}  // namespace

}  // namespace glint::viewer::widgets
