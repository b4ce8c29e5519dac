#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app.h"
#include "materials.h"
#include "theme.h"
#include "widgets.h"

namespace glint::viewer {

void App::menuBar() {
  if (!ImGui::BeginMainMenuBar()) return;
  if (std::exchange(menuWanted_, false)) ImGui::OpenPopup("File");
  std::optional<Action> chosen;
  for (const MenuInfo& menu : menus()) {
    if (!ImGui::BeginMenu(std::string(menu.name).c_str())) continue;
    for (const std::string_view section : menu.sections) {
      if (menu.sections.size() > 1) ImGui::TextDisabled("%s", std::string(section).c_str());
      for (const ActionInfo& info : actions())
        if (info.section == section &&
            ImGui::MenuItem(std::string(info.help).c_str(), keyText(info).c_str()))
          chosen = info.command;
    }
    ImGui::EndMenu();
  }
  const std::string find = "Find (" + keyText(infoOf(Action::palette)) + ")";
  const float width = ImGui::CalcTextSize(find.c_str()).x + 3 * ImGui::GetStyle().ItemSpacing.x;
  if (ImGui::GetContentRegionAvail().x > width) {
    ImGui::SameLine(ImGui::GetWindowWidth() - width);
    if (ImGui::MenuItem(find.c_str())) chosen = Action::palette;
  }
  ImGui::EndMainMenuBar();
  if (!chosen) return;
  ImGui::SetWindowFocus(nullptr);  // otherwise keys would go to what had the focus before
  execute(*chosen);
}

void App::openPalette(bool materialsAlone) { palette_ = {true, true, materialsAlone, {}, 0, {}}; }

void App::take(const Finding& finding) {
  if (finding.action) return execute(*finding.action);
  if (!session_.model) return;
  const std::vector<int> drawn = drawnMaterials(session_.model->scene);
  if (std::size_t(finding.material) >= drawn.size()) return;
  session_.material = drawn[std::size_t(finding.material)];
  session_.say("selected " + materialLabel(session_.model->scene, session_.material));
}

void App::paletteWindow() {
  if (!palette_.open) return;
  const ImGuiIO& io = ImGui::GetIO();
  const float font = ImGui::GetFontSize();
  const float width = std::min(font * 40, io.DisplaySize.x * 0.94f);
  const float height = std::min(font * 26, io.DisplaySize.y - menuHeight_ - 2 * font);
  ImGui::SetNextWindowPos(ImVec2(io.DisplaySize.x / 2, menuHeight_ + font), ImGuiCond_Always,
                          ImVec2(0.5f, 0));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  const bool appearing = std::exchange(palette_.appearing, false);
  if (appearing) ImGui::SetNextWindowFocus();
  ImGui::Begin("palette", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  if (appearing) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool typed = ImGui::InputTextWithHint(
      "##words",
      palette_.materialsAlone ? "words of a material's name; Enter selects it"
                              : "words of an action or a material; Enter runs or selects it",
      &palette_.words);
  if (typed || appearing) {
    std::vector<std::string> names;
    if (session_.model)
      for (const int index : drawnMaterials(session_.model->scene))
        names.push_back(materialLabel(session_.model->scene, index));
    palette_.found = findings(palette_.words, names, palette_.materialsAlone);
    palette_.at = 0;
  }
  std::optional<Finding> chosen;
  static int shown = -1;
  ImGui::BeginChild("found");
  if (palette_.found.empty()) ImGui::TextDisabled("nothing matches");
  for (std::size_t i = 0; i < palette_.found.size(); ++i) {
    const Finding& each = palette_.found[i];
    const bool here = int(i) == palette_.at;
    const float right = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(int(i));
    if (ImGui::Selectable(widgets::shownName(each.text).c_str(), here)) chosen = each;
    ImGui::PopID();
    if (here && palette_.at != shown) ImGui::SetScrollHereY();
    if (each.keys.empty()) continue;
    ImGui::SameLine(right - ImGui::CalcTextSize(each.keys.c_str()).x);
    ImGui::TextDisabled("%s", each.keys.c_str());
  }
  shown = palette_.at;
  ImGui::EndChild();
  // A click elsewhere closes the palette.
  const bool away = !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) &&
                    ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  ImGui::End();
  if (away || chosen) palette_.open = false;
  if (chosen) take(*chosen);
}

void App::helpWindow() {
  if (!helpShown_) return;
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos(ImVec2(io.DisplaySize.x / 2, io.DisplaySize.y / 2), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  const float font = ImGui::GetFontSize();
  const float width = std::min(font * 90, io.DisplaySize.x * 0.96f);
  const bool wide = width > font * 75;
  ImGui::SetNextWindowSize(ImVec2(width, std::min(font * 54, io.DisplaySize.y * 0.96f)));
  ImGui::Begin("Keys and mouse", &helpShown_,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
  const auto line = [&](const std::string& key, std::string_view text) {
    ImGui::TextColored(widgets::colorOf(theme::key), "%s", key.c_str());
    ImGui::SameLine(font * 9);
    ImGui::TextWrapped("%s", std::string(text).c_str());
  };
  if (helpScroll_ != 0)
    ImGui::SetScrollY(ImGui::GetScrollY() +
                      std::exchange(helpScroll_, 0.0f) * ImGui::GetTextLineHeightWithSpacing());
  ImGui::Columns(wide ? 3 : 2, "keys", false);
  ImGui::TextDisabled("Mouse over the picture");
  line("left drag", "orbit around the focal point");
  line("middle drag", "move the camera sideways (also Shift + left)");
  line("right drag", "zoom in, out");
  line("wheel", "zoom in or out at the cursor");
  line("Ctrl+left drag", "roll");
  line("click", "select the material under the cursor");
  line("double-click", "orbit around the point there; on the background, around the middle again");
  ImGui::Spacing();
  ImGui::TextDisabled("Panel");
  line("double-click", "on a slider, or on the name of any other row: reset it");
  line("Ctrl+click",
       "on a slider: type a value, which may be outside its range; 0,5 and 1/3 are accepted");
  line("Down",
       "into the panel: arrows move on, Space changes, Enter starts typing, Backspace resets, "
       "Escape leaves");
  std::string_view section;
  for (const ActionInfo& info : actions()) {
    if (info.section != section) {
      const bool column =
          info.section == (wide ? "Edit" : "Shading") || (wide && info.section == "Camera");
      if (column)
        ImGui::NextColumn();
      else
        ImGui::Spacing();
      section = info.section;
      ImGui::TextDisabled("%s", std::string(section).c_str());
    }
    line(keyText(info), info.help);
  }
  ImGui::Columns(1);
  ImGui::End();
}

}  // namespace glint::viewer
