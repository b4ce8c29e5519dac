#include "imgui_versions.h"

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace glint::viewer::imgui {
namespace {

// 1.87 introduced an event queue, and renamed this key.
#if IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey keypadEnter = ImGuiKey_KeypadEnter;
#else
constexpr ImGuiKey keypadEnter = ImGuiKey_KeyPadEnter;
#endif

struct Key {
  ImGuiKey key;
  int code;
};
constexpr Key keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                        {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                        {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                        {ImGuiKey_UpArrow, GLFW_KEY_UP},
                        {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                        {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                        {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                        {ImGuiKey_Home, GLFW_KEY_HOME},
                        {ImGuiKey_End, GLFW_KEY_END},
                        {ImGuiKey_Insert, GLFW_KEY_INSERT},
                        {ImGuiKey_Delete, GLFW_KEY_DELETE},
                        {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                        {ImGuiKey_Space, GLFW_KEY_SPACE},
                        {ImGuiKey_Enter, GLFW_KEY_ENTER},
                        {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                        {keypadEnter, GLFW_KEY_KP_ENTER},
                        {ImGuiKey_A, GLFW_KEY_A},
                        {ImGuiKey_C, GLFW_KEY_C},
                        {ImGuiKey_V, GLFW_KEY_V},
                        {ImGuiKey_X, GLFW_KEY_X},
                        {ImGuiKey_Y, GLFW_KEY_Y},
                        {ImGuiKey_Z, GLFW_KEY_Z}};

constexpr int buttons = 5;

}  // namespace

#if IMGUI_VERSION_NUM >= 18700

void beginInput() {
  // Every frame gets events only up to one that would hide another (InputQueue), so ImGui need not
  // spread them over further frames.
  ImGui::GetIO().ConfigInputTrickleEventQueue = false;
}

void moveMouse(float x, float y) { ImGui::GetIO().AddMousePosEvent(x, y); }

void setButton(int button, bool down) {
  if (button >= 0 && button < buttons) ImGui::GetIO().AddMouseButtonEvent(button, down);
}

void scroll(float x, float y) { ImGui::GetIO().AddMouseWheelEvent(x, y); }

void setKey(int code, bool down) {
  const auto found = std::ranges::find(keys, code, &Key::code);
  if (found != std::end(keys)) ImGui::GetIO().AddKeyEvent(found->key, down);
}

void setModifiers(bool control, bool shift, bool alt) {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
  io.AddKeyEvent(ImGuiMod_Ctrl, control);
  io.AddKeyEvent(ImGuiMod_Shift, shift);
  io.AddKeyEvent(ImGuiMod_Alt, alt);
#else
  io.AddKeyEvent(ImGuiKey_ModCtrl, control);
  io.AddKeyEvent(ImGuiKey_ModShift, shift);
  io.AddKeyEvent(ImGuiKey_ModAlt, alt);
#endif
}

void setFocus(bool gained) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddFocusEvent(gained);
  if (gained) return;
  for (const Key& each : keys) io.AddKeyEvent(each.key, false);
  setModifiers(false, false, false);
  for (int i = 0; i < buttons; ++i) io.AddMouseButtonEvent(i, false);
}

#else

void beginInput() {
  for (const Key& each : keys) ImGui::GetIO().KeyMap[each.key] = each.code;
}

void moveMouse(float x, float y) { ImGui::GetIO().MousePos = ImVec2(x, y); }

void setButton(int button, bool down) {
  if (button >= 0 && button < buttons) ImGui::GetIO().MouseDown[button] = down;
}

void scroll(float x, float y) {
  ImGui::GetIO().MouseWheelH += x;
  ImGui::GetIO().MouseWheel += y;
}

void setKey(int code, bool down) {
  ImGuiIO& io = ImGui::GetIO();
  if (code >= 0 && code < int(std::size(io.KeysDown))) io.KeysDown[code] = down;
}

void setModifiers(bool control, bool shift, bool alt) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = control;
  io.KeyShift = shift;
  io.KeyAlt = alt;
}

void setFocus(bool gained) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddFocusEvent(gained);
  if (gained) return;
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  setModifiers(false, false, false);
}

#endif

namespace {

bool pressed(ImGuiKey key) {
#if IMGUI_VERSION_NUM >= 18700
  return ImGui::IsKeyPressed(key, false);
#else
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
#endif
}

}  // namespace

bool enterPressed() { return pressed(ImGuiKey_Enter) || pressed(keypadEnter); }
bool backspacePressed() { return pressed(ImGuiKey_Backspace); }

void beginFlattened(const char* name) {
#if IMGUI_VERSION_NUM >= 19090
  ImGui::BeginChild(name, ImVec2(0, 0), ImGuiChildFlags_NavFlattened);
#else
  ImGui::BeginChild(name, ImVec2(0, 0), false, ImGuiWindowFlags_NavFlattened);
#endif
}

namespace {

ImTextureID idOf(unsigned texture) {
#if IMGUI_VERSION_NUM >= 19140
  return ImTextureID(texture);
#else
  // NOLINTNEXTLINE(performance-no-int-to-ptr): GL names, as ImGui's own GL backend takes them
  return reinterpret_cast<ImTextureID>(std::intptr_t(texture));
#endif
}

}  // namespace

void image(unsigned texture, float width, float height) {
  ImGui::Image(idOf(texture), ImVec2(width, height));
}

void imageAt(unsigned texture, float x, float y, float width, float height) {
  ImGui::GetWindowDrawList()->AddImage(idOf(texture), ImVec2(x, y), ImVec2(x + width, y + height));
}

// From 1.92 on, glyphs are rasterised when they are needed, at any size.
#if IMGUI_VERSION_NUM >= 19200
void buildFonts() {}
float fontHeight() { return ImGui::GetIO().Fonts->Fonts[0]->LegacySize; }
#else
void buildFonts() { ImGui::GetIO().Fonts->Build(); }
float fontHeight() { return ImGui::GetIO().Fonts->Fonts[0]->FontSize; }
#endif

void setClipboard(const char* (*get)(void*), void (*set)(void*, const char*), void* user) {
#if IMGUI_VERSION_NUM >= 19110
  static const char* (*getText)(void*);
  static void (*setText)(void*, const char*);
  getText = get;
  setText = set;
  ImGuiPlatformIO& io = ImGui::GetPlatformIO();
  io.Platform_ClipboardUserData = user;
  io.Platform_GetClipboardTextFn = [](ImGuiContext*) {
    return getText(ImGui::GetPlatformIO().Platform_ClipboardUserData);
  };
  io.Platform_SetClipboardTextFn = [](ImGuiContext*, const char* text) {
    setText(ImGui::GetPlatformIO().Platform_ClipboardUserData, text);
  };
#else
  ImGuiIO& io = ImGui::GetIO();
  io.GetClipboardTextFn = get;
  io.SetClipboardTextFn = set;
  io.ClipboardUserData = user;
#endif
}

}  // namespace glint::viewer::imgui
