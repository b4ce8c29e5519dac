#include "widgets.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "glint/scene/look_text.h"

namespace glint::viewer::widgets {

Style& style() {
  static Style value;
  return value;
}

void label(const std::string& text, bool edited) {
  ImGui::AlignTextToFramePadding();
  const float left = ImGui::GetCursorPosX();
  if (edited)
    ImGui::TextColored(ImVec4(1.0f, 0.8f, 0.45f, 1.0f), "%s", text.c_str());
  else
    ImGui::TextUnformatted(text.c_str());
  ImGui::SameLine(left + style().labelWidth);
  ImGui::SetNextItemWidth(-1);
}

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool doubleClicked() {
  if (!ImGui::IsItemHovered() || !ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return false;
  ImGui::ClearActiveID();
  return true;
}

bool slider(const char* id, double& value, const SliderRange& range, double min, double max,
            const char* format) {
  const ImGuiSliderFlags flags = range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  double v = value;
  if (!ImGui::SliderScalar(id, ImGuiDataType_Double, &v, &range.min, &range.max, format, flags))
    return false;
  v = std::isfinite(v) ? std::clamp(v, min, max) : value;
  // A slider that is moved within its range keeps a value beyond it until the mouse does.
  if (v == value) return false;
  value = v;
  return true;
}

namespace {

double toSrgb(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double toLinear(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

}  // namespace

bool color(const char* id, glm::dvec3& linear) {
  float shown[3];
  for (int i = 0; i < 3; ++i) shown[i] = float(toSrgb(linear[i]));
  const float before[3] = {shown[0], shown[1], shown[2]};
  if (!ImGui::ColorEdit3(id, shown, ImGuiColorEditFlags_HDR)) return false;
  bool changed = false;
  for (int i = 0; i < 3; ++i) {
    if (shown[i] == before[i]) continue;
    linear[i] = std::clamp(std::round(toLinear(double(shown[i])) * 1e6) / 1e6, 0.0, 1e6);
    changed = true;
  }
  return changed;
}

bool vector(const char* id, glm::dvec3& v) {
  double values[3] = {v.x + 0.0, v.y + 0.0, v.z + 0.0};  // no -0
  if (!ImGui::InputScalarN(id, ImGuiDataType_Double, values, 3, nullptr, nullptr, "%.4g"))
    return false;
  for (int i = 0; i < 3; ++i)
    if (std::isfinite(values[i])) v[i] = values[i];
  return true;
}

bool direction(const char* id, glm::dvec3& d, const glm::dmat3& axes, float size) {
  // Azimuthal equidistant: the distance from the centre is the angle to the viewer, 180 degrees at
  // the rim.
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
                             const std::string& unit, double min, double max) {
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
  return text + "\nDouble-click: reset - Ctrl+click: type a value";
}

namespace {

// Texts being typed, by parameter; a look changes when Enter is pressed or the field is left.
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

std::string joined(const glm::dvec3& v) {
  return numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
}

// Left of a slider, for a number without which something is off.
bool tick(const Parameter& p, Look& look) {
  bool on = !p.save(look).is_null();
  const bool clicked = ImGui::Checkbox(("##on" + p.name).c_str(), &on);
  if (clicked && on) p.read(look, "0.01");
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
  // Forms by light have no name of one form: choosing one replaces them.
  const bool byLight = !forms.dimmer.empty();
  const std::string now = byLight ? highlightText(forms) : nameOf(form);
  bool changed = false;
  label(name, edited);
  if (ImGui::BeginCombo(("##" + name).c_str(), now.c_str())) {
    std::string last;
    for (const std::string& text : highlightTexts()) {
      HighlightForm each = parseHighlights(text, name).brightest;
      if (nameOf(each) == last) continue;  // the same with another gamma
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
      "the power that the form is raised to by squaring: 1, 2, 4, ... 64; larger ones are "
      "nearer to the exact lobe and cost more");
  return changed;
}

bool parameter(const Parameter& p, Look& look, const std::optional<glm::dvec3>& shown) {
  const nlohmann::ordered_json now = p.save(look);
  const bool edited = now != p.save(Look{});
  std::string name = p.name;
  if (name.starts_with("camera-")) name = name.substr(7);
  std::replace(name.begin(), name.end(), '-', ' ');
  if (p.name == "highlight") return highlightForm(name, edited, look.highlight, p.help);
  label(name, edited);
  const std::string id = "##" + p.name;
  bool changed = false;
  std::string unit;
  switch (p.kind) {
    case ParameterKind::number: {
      const bool off = now.is_null() && p.name == "max-error";
      if (p.name == "max-error") changed = tick(p, look);
      double value = now.is_number() ? now.get<double>() : p.unset;
      if (slider(id.c_str(), value, p.slider, p.min, p.max, off ? "off" : "%.4g")) {
        p.read(look, numberText(value));
        changed = true;
      }
      for (const char c : p.value)
        unit += p.value.size() > 1 ? char(std::tolower(static_cast<unsigned char>(c))) : c;
      if (unit == "factor" || unit == "x" || unit.size() == 1) unit.clear();
      break;
    }
    case ParameterKind::flag: {
      bool value = now.is_boolean() && now.get<bool>();
      if (ImGui::Checkbox(id.c_str(), &value)) {
        p.read(look, value ? "true" : "false");
        changed = true;
      }
      break;
    }
    case ParameterKind::choice: {
      const std::string value = now.get<std::string>();
      if (ImGui::BeginCombo(id.c_str(), value.c_str())) {
        for (const std::string& each : p.choices())
          if (ImGui::Selectable(each.c_str(), each == value) && each != value) {
            p.read(look, each);
            changed = true;
          }
        ImGui::EndCombo();
      }
      break;
    }
    case ParameterKind::vector:
    case ParameterKind::direction: {
      glm::dvec3 value = shown.value_or(glm::dvec3(0.0));
      if (now.is_array())
        value = {now[0].get<double>(), now[1].get<double>(), now[2].get<double>()};
      if (vector(id.c_str(), value)) {
        p.read(look, joined(value));
        changed = true;
      }
      break;
    }
    case ParameterKind::color: {
      glm::dvec3 value{now[0].get<double>(), now[1].get<double>(), now[2].get<double>()};
      if (color(id.c_str(), value)) {
        p.read(look, joined(value));
        changed = true;
      }
      break;
    }
    case ParameterKind::text:
      changed = textField(p, look);
      break;
  }
  const bool widgetResets = p.kind == ParameterKind::number || p.kind == ParameterKind::vector;
  if (widgetResets && p.reset && doubleClicked()) {
    p.reset(look);
    return true;
  }
  tooltip(parameterTooltip(p.help, p.symbol, unit, p.min, p.max));
  return changed;
}

}  // namespace glint::viewer::widgets
