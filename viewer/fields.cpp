// The rows of the panel: labels, tooltips, sliders and number fields.
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/srgb.h"
#include "glint/scene/look_text.h"
#include "imgui_versions.h"
#include "theme.h"
#include "typed_number.h"
#include "widgets.h"

namespace glint::viewer::widgets {
namespace {

constexpr double tooltipAfter = 0.6;  // seconds

// The label drawn last belongs to the next widget.
struct LabelState {
  bool hovered = false, doubleClicked = false;
};
LabelState lastLabel;

// Where the pointer rests.
struct Rest {
  ImVec2 place{-1, -1};
  Clock::time_point since{};
  int frame = -10;
};
Rest rest;

int ringAtNumber = -10;  // the last frame in which it was

bool ringHere() { return ImGui::IsItemFocused() && ImGui::GetIO().NavVisible; }

// For a number field: whether Enter starts typing.
bool entersAtRing() {
  if (!ringHere()) return false;
  ringAtNumber = ImGui::GetFrameCount();
  return imgui::enterPressed();
}

// The one number field being typed in.
struct Typing {
  ImGuiID id = 0;
  std::string first, text, error;
  int begins = 0;  ///< frames left to give the field the caret
};
Typing typing;
std::string problem;

void beginTyping(ImGuiID id, double value) {
  typing = {id, numberText(value), numberText(value), {}, 10};
  ImGui::ClearActiveID();
}

// Shows a text beside the panel; without room there, above the item or below the next row. Keeps
// full brightness in a disabled row.
void showBeside(const std::string& text, const ImVec4& color) {
  const ImVec2 corner = ImGui::GetItemRectMin(), screen = ImGui::GetIO().DisplaySize;
  const float gap = 8 * style().scale, font = ImGui::GetFontSize();
  const float room = style().panelLeft - 2 * gap;
  const bool beside = room > 10 * font && corner.x >= style().panelLeft;
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float width = std::min(24 * font, (beside ? room : screen.x - 2 * gap) - 2 * padding.x);
  const ImVec2 words = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  const ImVec2 size(words.x + 2 * padding.x, words.y + 2 * padding.y);
  ImVec2 at(style().panelLeft - gap - size.x, std::min(corner.y, screen.y - size.y - gap));
  if (!beside) {
    at.x = std::clamp(corner.x, gap, std::max(gap, screen.x - size.x - gap));
    at.y = corner.y - size.y - gap / 2;
    if (at.y < 0) at.y = ImGui::GetItemRectMax().y + ImGui::GetFrameHeightWithSpacing();
  }
  ImGui::SetNextWindowPos(at);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0f);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(padding.x + width);
  ImGui::TextColored(color, "%s", text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

using Reading = std::function<TypedNumber(const std::string&)>;

// The field while it is being typed in. Empty unless a number was entered.
std::optional<double> typed(ImGuiID id, const Reading& read) {
  if (typing.begins > 0) {
    ImGui::SetKeyboardFocusHere();
    --typing.begins;
  }
  const bool wrong = !typing.error.empty();
  if (wrong) ImGui::PushStyleColor(ImGuiCol_FrameBg, colorOf(theme::wrongFrame));
  ImGui::PushID(int(id));
  const bool entered =
      ImGui::InputText("##typed", &typing.text,
                       ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopID();
  if (wrong) ImGui::PopStyleColor();
  if (ImGui::IsItemActive()) typing.begins = 0;
  const TypedNumber now = read(typing.text);
  typing.error = typing.text == typing.first ? "" : now.error;
  if (!typing.error.empty()) showBeside(typing.error, colorOf(theme::error));
  if (!ImGui::IsItemDeactivated()) {
    if (typing.begins == 0 && !ImGui::IsItemActive()) typing = {};
    return {};
  }
  if (typing.text == typing.first) {
    typing = {};
    return {};
  }
  if (!now.value && entered) {
    typing.begins = 10;  // stays open to be corrected
    return {};
  }
  if (!now.value) problem = "'" + typing.text + "': " + now.error + "; the old value is kept";
  typing = {};
  return now.value;
}

Reading within(double min, double max) {
  return [=](const std::string& text) { return readTypedNumber(text, min, max); };
}

bool numberBy(const char* id, double& value, const Reading& read) {
  const ImGuiID key = ImGui::GetID(id);
  if (typing.id == key) {
    const auto taken = typed(key, read);
    if (!taken || *taken == value) return false;
    value = *taken;
    return true;
  }
  // Looks like a field, and becomes one when it is clicked or Enter is pressed.
  char text[40];
  std::snprintf(text, sizeof text, "%.5g###%s", value + 0.0, id);  // avoids -0
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_FrameBgHovered));
  ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, ImVec2(0, 0.5f));
  if (ImGui::Button(text, ImVec2(ImGui::CalcItemWidth(), 0)) || entersAtRing())
    beginTyping(key, value);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(2);
  return false;
}

// Three number fields side by side.
bool three(glm::dvec3& v, float width, const Reading& read) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float each = std::max(1.0f, (width - 2 * gap) / 3);
  static const char* const names[] = {"x", "y", "z"};
  bool changed = false;
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(each);
    changed = numberBy(names[i], v[i], read) || changed;
  }
  return changed;
}

}  // namespace

ImVec4 colorOf(const glm::dvec3& c) { return ImVec4(float(c.r), float(c.g), float(c.b), 1); }

void label(const std::string& text, bool edited) {
  ImGui::AlignTextToFramePadding();
  const float left = ImGui::GetCursorPosX();
  if (edited)
    ImGui::TextColored(colorOf(theme::edited), "%s", text.c_str());
  else
    ImGui::TextUnformatted(text.c_str());
  lastLabel.hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled);
  lastLabel.doubleClicked = lastLabel.hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  ImGui::SameLine(left + style().labelWidth);
  ImGui::SetNextItemWidth(-1);
}

void tooltip(const std::string& text) {
  const bool overLabel = std::exchange(lastLabel.hovered, false);
  const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || overLabel;
  if (ImGui::IsItemActive() || !hovered) return;
  const ImVec2 place = ImGui::GetItemRectMin();
  const int frame = ImGui::GetFrameCount();
  if (place.x != rest.place.x || place.y != rest.place.y || frame > rest.frame + 1)
    rest = {place, Clock::now(), frame};
  rest.frame = frame;
  if (secondsSince(rest.since) < tooltipAfter) return;
  showBeside(text, colorOf(theme::text));
}

double tooltipDue() {
  const double passed = secondsSince(rest.since);
  const bool waits = rest.frame >= ImGui::GetFrameCount() - 1 && passed < tooltipAfter + 0.05;
  return waits ? std::max(0.005, tooltipAfter - passed) : std::numeric_limits<double>::infinity();
}

bool resetAsked(bool widgetToo) {
  bool asked = std::exchange(lastLabel.doubleClicked, false);
  asked = asked || (ringHere() && imgui::backspacePressed());
  if (widgetToo && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    ImGui::ClearActiveID();
    asked = true;
  }
  return asked;
}

bool slider(const char* id, double& value, const SliderRange& range, double min, double max,
            const char* format) {
  const ImGuiID key = ImGui::GetID(id);
  if (typing.id == key) {
    const auto taken = typed(key, within(min, max));
    if (!taken || *taken == value) return false;
    value = *taken;
    return true;
  }
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_NoInput | (range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  double v = value;
  const bool moved =
      ImGui::SliderScalar(id, ImGuiDataType_Double, &v, &range.min, &range.max, format, flags);
  const ImGuiIO& io = ImGui::GetIO();
  const bool clicked = ImGui::IsItemHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  const bool entered = entersAtRing();
  if ((clicked && io.KeyCtrl) || entered) {
    beginTyping(key, value);
    return false;
  }
  if (!moved) return false;
  v = std::isfinite(v) ? std::clamp(v, min, max) : value;
  // A value beyond the slider's range is kept until the slider is moved.
  if (v == value) return false;
  value = v;
  return true;
}

bool number(const char* id, double& value, double min, double max) {
  return numberBy(id, value, within(min, max));
}

bool ringTakesEnter() { return ringAtNumber >= ImGui::GetFrameCount() - 1; }

std::string takeProblem() { return std::exchange(problem, {}); }

bool color(const char* id, glm::dvec3& linear) {
  float shown[3];
  for (int i = 0; i < 3; ++i) shown[i] = float(srgbEncoded(linear[i]));
  const float before[3] = {shown[0], shown[1], shown[2]};
  const ImGuiColorEditFlags flags = ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoTooltip;
  ImGui::PushID(id);
  const float width = ImGui::CalcItemWidth(), side = ImGui::GetFrameHeight();
  bool changed = false;
  ImGui::BeginGroup();
  if (ImGui::ColorButton("##square", ImVec4(shown[0], shown[1], shown[2], 1), flags,
                         ImVec2(side, side)))
    ImGui::OpenPopup("picker");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  std::optional<glm::dvec3> whole;
  const auto read = [&](const std::string& text) -> TypedNumber {
    if (!text.starts_with('#')) return readTypedNumber(text, 0, 1e6);
    try {
      whole = parseColor(text, "color");
      return {0.0, {}};
    } catch (const InputError&) {
      return {{}, "not a colour: type one such as #c04020"};
    }
  };
  glm::dvec3 numbers = linear;
  if (three(numbers, width - side - ImGui::GetStyle().ItemInnerSpacing.x, read)) {
    linear = whole.value_or(numbers);
    changed = true;
  } else if (whole && typing.id == 0) {
    changed = linear != *whole;
    linear = *whole;
  }
  ImGui::EndGroup();
  if (ImGui::BeginPopup("picker")) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 16);
    if (ImGui::ColorPicker3("##picker", shown,
                            flags | ImGuiColorEditFlags_NoInputs |
                                ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoLabel))
      for (int i = 0; i < 3; ++i) {
        if (shown[i] == before[i]) continue;
        linear[i] = std::clamp(std::round(srgbLinear(double(shown[i])) * 1e6) / 1e6, 0.0, 1e6);
        changed = true;
      }
    ImGui::EndPopup();
  }
  ImGui::PopID();
  return changed;
}

bool vector(const char* id, glm::dvec3& v) {
  ImGui::PushID(id);
  const float width = ImGui::CalcItemWidth();
  ImGui::BeginGroup();
  const bool changed = three(v, width, within(0, 0));
  ImGui::EndGroup();
  ImGui::PopID();
  return changed;
}

}  // namespace glint::viewer::widgets
