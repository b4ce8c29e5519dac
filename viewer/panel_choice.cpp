#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "choice.h"
#include "glint/budget/error_budget.h"
#include "glint/scene/look_text.h"
#include "panel.h"
#include "theme.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

using widgets::style;

const ImVec4 formColor = widgets::colorOf(theme::key), overColor = widgets::colorOf(theme::error);

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string formsOf(const FormChoice& c) {
  std::string text = c.specular ? "highlight " + highlightText(c.highlight) : "";
  if (c.dielectric)
    text += (text.empty() ? "" : ", ") + ("fresnel " + std::string(fresnelText(c.fresnel)));
  return text.empty() ? "nothing to choose" : text;
}

void dimmed(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void materialChoice(const FormChoice& c) {
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::BeginGroup();
  ImGui::TextUnformatted(c.material.empty() ? "(no name)" : c.material.c_str());
  const std::string bound = "bound " + number(c.bound);
  ImGui::SameLine(room - ImGui::CalcTextSize(bound.c_str()).x);
  ImGui::TextUnformatted(bound.c_str());
  ImGui::TextColored(formColor, "%s", formsOf(c).c_str());
  if (c.specular || c.dielectric) dimmed(c.reason);
  ImGui::EndGroup();
  std::string parts = "the bound is the sum of";
  if (c.specular) parts += "\nthe lobe's formula: " + number(c.lobe);
  if (c.dielectric) parts += "\nthe reflectance's formula: " + number(c.reflectance);
  if (c.interpolation > 0)
    parts += "\nshading per face or vertex instead of per pixel: " + number(c.interpolation);
  parts += "\nrounding: " + number(c.rounding);
  if (c.exactCost > 0)
    parts += "\nThe forms cost " + number(c.cost) + ", the exact ones " + number(c.exactCost) + ".";
  widgets::tooltip(parts);
}

// The program that --shading auto chose, with the reason after a colon.
void programChoice(const ResolvedLook& resolved) {
  const std::string& reason = resolved.programReason;
  const std::size_t colon = reason.find(": ");
  widgets::label("  program");
  ImGui::TextColored(formColor, "%s", reason.substr(0, colon).c_str());
  if (colon != std::string::npos) dimmed(reason.substr(colon + 2));
}

}  // namespace

void drawChoice(PanelContext& context) {
  if (!context.session.model || !leavesOpen(context.session.document.a)) return;
  const DrawnPicture* picture = context.picture;
  if (!picture || !leavesOpen(picture->asked)) {
    ImGui::TextDisabled("choosing ...");
    return;
  }
  const ResolvedLook& resolved = *picture->choice;
  if (picture->asked.maxError) {
    widgets::label("  bound");
    const std::string text = number(resolved.bound);
    if (resolved.bound > *errorBudget(picture->asked))
      ImGui::TextColored(overColor, "%s", text.c_str());
    else
      ImGui::TextUnformatted(text.c_str());
    widgets::tooltip(
        "no pixel's shading differs from the exact one by more than this, in linear light before "
        "exposure: the largest bound of the materials");
    ImGui::SameLine();
  } else {
    widgets::label("  frame");
  }
  // Without one-time shader compilation.
  const double frame = std::max(0.0, picture->milliseconds - picture->times.compile);
  char text[64];
  std::snprintf(text, sizeof text, "%s%.3g ms%s", picture->asked.maxError ? "   frame " : "", frame,
                context.preview ? " (while moving)" : "");
  ImGui::TextUnformatted(text);
  widgets::tooltip("choosing, drawing and encoding the last picture, without compiling");
  if (!resolved.programReason.empty()) programChoice(resolved);
  if (resolved.choices.empty()) return;
  // A long list scrolls.
  const bool many = resolved.choices.size() > 2;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  if (many) ImGui::BeginChild("choices", ImVec2(0, 7 * line), true);
  for (std::size_t i = 0; i < resolved.choices.size(); ++i) {
    ImGui::PushID(int(i));
    materialChoice(resolved.choices[i]);
    ImGui::PopID();
  }
  if (many) ImGui::EndChild();
}

}  // namespace glint::viewer
