#include "interface.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "glint/gl/context.h"
#include "imgui_versions.h"
#include "theme.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

constexpr const char* fonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                 "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                 "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void loadFont(float scale) {
  // Latin, Greek, and the signs for perpendicular and parallel.
  static const ImWchar ranges[] = {0x20, 0xff, 0x370, 0x3ff, 0x2010, 0x2030, 0x2220, 0x22af, 0};
  ImGuiIO& io = ImGui::GetIO();
  for (const char* path : fonts) {
    std::FILE* file = std::fopen(path, "rb");
    if (!file) continue;
    std::fclose(file);
    if (io.Fonts->AddFontFromFileTTF(path, std::round(14 * scale), nullptr, ranges)) return;
  }
  widgets::style().greek = false;
  ImFontConfig config;
  config.SizePixels = 13 * std::max(1.0f, std::round(scale));
  io.Fonts->AddFontDefault(&config);
}

void chooseColors() {
  ImGui::StyleColorsDark();
  ImGuiStyle& s = ImGui::GetStyle();
  s.WindowRounding = 0;
  s.FrameRounding = 3;
  s.GrabRounding = 3;
  s.TabRounding = 3;
  s.PopupRounding = 4;
  s.WindowBorderSize = 0;
  s.FrameBorderSize = 1;
  s.FramePadding = ImVec2(6, 3);
  s.ItemSpacing = ImVec2(6, 5);
  s.WindowPadding = ImVec2(10, 8);
  s.ScrollbarSize = 12;
  const auto set = [&](ImGuiCol which, const glm::dvec3& c, float alpha = 1) {
    s.Colors[which] = ImVec4(float(c.r), float(c.g), float(c.b), alpha);
  };
  set(ImGuiCol_Text, theme::text);
  set(ImGuiCol_TextDisabled, theme::dim);
  set(ImGuiCol_WindowBg, theme::window);
  set(ImGuiCol_PopupBg, theme::popup);
  set(ImGuiCol_MenuBarBg, theme::menu);
  set(ImGuiCol_Border, theme::edge);
  set(ImGuiCol_FrameBg, theme::frame);
  set(ImGuiCol_FrameBgHovered, theme::frameHovered);
  set(ImGuiCol_FrameBgActive, theme::frameActive);
  set(ImGuiCol_Button, theme::button);
  set(ImGuiCol_ButtonHovered, theme::buttonHovered);
  set(ImGuiCol_ButtonActive, theme::accent);
  set(ImGuiCol_SliderGrab, theme::accent);
  set(ImGuiCol_SliderGrabActive, theme::mark);
  set(ImGuiCol_CheckMark, theme::mark);
  set(ImGuiCol_Header, theme::header);
  set(ImGuiCol_HeaderHovered, theme::headerHovered);
  set(ImGuiCol_HeaderActive, theme::accent);
  set(ImGuiCol_Tab, theme::frame);
  set(ImGuiCol_TabHovered, theme::bright);
  set(ImGuiCol_TabActive, theme::accent);
  set(ImGuiCol_TitleBgActive, theme::frame);
  set(ImGuiCol_NavHighlight, theme::hovered);
  set(ImGuiCol_ModalWindowDimBg, glm::dvec3(0.0), 0.45f);
}

const char* getClipboard(void* window) {
  static std::string text;
  text = static_cast<Window*>(window)->clipboard();
  return text.c_str();
}

void setClipboard(void* window, const char* text) {
  static_cast<Window*>(window)->setClipboard(text);
}

}  // namespace

Interface::Interface(Window& window, double scale) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.BackendPlatformName = "glint";
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  imgui::setClipboard(getClipboard, setClipboard, &window);
  imgui::beginInput();
  chooseColors();
  loadFont(float(scale));
  ImGui::GetStyle().ScaleAllSizes(float(scale));
  widgets::style().scale = float(scale);
  imgui::buildFonts();
  widgets::style().labelWidth = imgui::fontHeight() * 11;
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    ImGui::DestroyContext();
    throw ContextError(
        "the window's driver cannot draw the panel: draw offscreen with glint render");
  }
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Interface::feed(const std::deque<InputEvent>& events) {
  using Kind = InputEvent::Kind;
  for (const InputEvent& e : events) {
    switch (e.kind) {
      case Kind::motion:
        imgui::moveMouse(float(e.x), float(e.y));
        break;
      case Kind::button:
        imgui::setButton(e.code, e.down);
        break;
      case Kind::scroll:
        imgui::scroll(float(e.x), float(e.y));
        break;
      case Kind::key:
        if (e.code >= 0 && std::size_t(e.code) < held_.size()) held_[std::size_t(e.code)] = e.down;
        if (e.forWidgets || !e.down) imgui::setKey(e.presses ? GLFW_KEY_SPACE : e.code, e.down);
        if (!e.down && (e.code == GLFW_KEY_ENTER || e.code == GLFW_KEY_KP_ENTER))
          imgui::setKey(GLFW_KEY_SPACE, false);
        break;
      case Kind::character:
        ImGui::GetIO().AddInputCharacter(unsigned(e.code));
        break;
      case Kind::drop:
        break;
      case Kind::focus:
        imgui::setFocus(e.down);
        if (!e.down) held_.fill(false);
        break;
    }
    if (e.kind == Kind::key || e.kind == Kind::button) {
      // The modifiers after the event; events of modifier keys carry the state before them.
      const auto held = [&](int bit, int left, int right) {
        const bool own = e.kind == Kind::key && (e.code == left || e.code == right);
        return (!(own && !e.down) && (e.modifiers & bit) != 0) || held_[std::size_t(left)] ||
               held_[std::size_t(right)];
      };
      imgui::setModifiers(held(GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                          held(GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
                          held(GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT));
    }
  }
}

void Interface::begin(double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  const glm::ivec2 size = window_.size(), pixels = window_.framebufferSize();
  io.DisplaySize = ImVec2(float(size.x), float(size.y));
  if (size.x > 0 && size.y > 0)
    io.DisplayFramebufferScale =
        ImVec2(float(pixels.x) / float(size.x), float(pixels.y) / float(size.y));
  io.DeltaTime = float(std::clamp(seconds, 1e-4, 1.0));
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Interface::end(bool draw) {
  if (!draw) {
    ImGui::EndFrame();
    return;
  }
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace glint::viewer
