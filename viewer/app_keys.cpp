#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>

#include "app.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

// Keys that move and operate the ring, a list or a menu.
bool isMove(int code) {
  constexpr int keys[] = {GLFW_KEY_LEFT,      GLFW_KEY_RIGHT,   GLFW_KEY_UP,       GLFW_KEY_DOWN,
                          GLFW_KEY_SPACE,     GLFW_KEY_ENTER,   GLFW_KEY_KP_ENTER, GLFW_KEY_ESCAPE,
                          GLFW_KEY_BACKSPACE, GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN};
  return std::ranges::find(keys, code) != std::end(keys);
}

bool popupOpen() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

// With Ctrl, these edit the text that has the caret.
bool editsText(int code) {
  constexpr int keys[] = {'A',
                          'C',
                          'V',
                          'X',
                          'Y',
                          'Z',
                          GLFW_KEY_LEFT,
                          GLFW_KEY_RIGHT,
                          GLFW_KEY_UP,
                          GLFW_KEY_DOWN,
                          GLFW_KEY_BACKSPACE,
                          GLFW_KEY_DELETE,
                          GLFW_KEY_HOME,
                          GLFW_KEY_END};
  return std::ranges::find(keys, code) != std::end(keys);
}

}  // namespace

// A key does what the table says wherever the focus is. The exceptions are keys that a text with a
// caret needs and, where the ring is visible or a popup is open, keys that work there. ImGui gets
// no other keys, least of all Tab, which would open the next text.
bool App::isForWidgets(const InputEvent& e) const {
  if (e.kind != InputEvent::Kind::key || !e.down) return true;
  if (e.code >= GLFW_KEY_LEFT_SHIFT && e.code <= GLFW_KEY_RIGHT_SUPER) return true;
  if (dialogs_.open()) return true;
  const ImGuiIO& io = ImGui::GetIO();
  const bool control = (e.modifiers & GLFW_MOD_CONTROL) != 0;
  const bool shift = (e.modifiers & GLFW_MOD_SHIFT) != 0;
  if (palette_.open) {
    const bool inText = e.code == GLFW_KEY_LEFT || e.code == GLFW_KEY_RIGHT ||
                        e.code == GLFW_KEY_SPACE || e.code == GLFW_KEY_BACKSPACE;
    return inText || !isMove(e.code);
  }
  if (io.WantTextInput) {
    const bool function = e.code >= GLFW_KEY_F1 && e.code <= GLFW_KEY_F25;
    return !function && !(control && !editsText(e.code));
  }
  if (control || shift || !isMove(e.code)) return false;
  if (popupOpen()) return true;
  if (!io.NavVisible || e.code == GLFW_KEY_PAGE_UP || e.code == GLFW_KEY_PAGE_DOWN) return false;
  return e.code != GLFW_KEY_ESCAPE || ImGui::IsAnyItemActive();
}

// Enter presses a button, a menu entry or a checkbox as Space does; at a number it starts typing.
bool App::pressesLikeSpace(const InputEvent& e) const {
  return e.kind == InputEvent::Kind::key && e.down && e.forWidgets && !dialogs_.open() &&
         (e.code == GLFW_KEY_ENTER || e.code == GLFW_KEY_KP_ENTER) &&
         !ImGui::GetIO().WantTextInput && !widgets::ringTakesEnter();
}

void App::applyInput(const std::deque<InputEvent>& events) {
  for (const InputEvent& e : events) {
    if (e.kind == InputEvent::Kind::drop) open(e.path);
    if (e.kind == InputEvent::Kind::button || e.kind == InputEvent::Kind::scroll ||
        e.kind == InputEvent::Kind::key)
      acted_ = true;
    if (e.kind == InputEvent::Kind::key && e.down && (!e.forWidgets || dialogs_.open())) key(e);
    if (e.kind == InputEvent::Kind::character && e.code == '?' && !ImGui::GetIO().WantTextInput &&
        !dialogs_.open() && !palette_.open)
      execute(Action::help);
  }
}

void App::key(const InputEvent& e) {
  const bool control = (e.modifiers & GLFW_MOD_CONTROL) != 0;
  const bool shift = (e.modifiers & GLFW_MOD_SHIFT) != 0;
  if (dialogs_.open()) {
    if (e.code == GLFW_KEY_ESCAPE) dialogs_.pressEscape();
    if (e.code == GLFW_KEY_ENTER || e.code == GLFW_KEY_KP_ENTER) dialogs_.pressEnter();
    return;
  }
  if (palette_.open && isMove(e.code) && !control && !shift) return paletteKey(e.code);
  if (helpShown_ && !control && !shift) {
    const int lines = e.code == GLFW_KEY_DOWN        ? 3
                      : e.code == GLFW_KEY_UP        ? -3
                      : e.code == GLFW_KEY_PAGE_DOWN ? 20
                      : e.code == GLFW_KEY_PAGE_UP   ? -20
                                                     : 0;
    if (lines != 0) {
      helpScroll_ += float(lines);
      return;
    }
  }
  if (e.code == GLFW_KEY_ESCAPE) {
    if (helpShown_)
      helpShown_ = false;
    else if (ImGui::GetIO().NavVisible)
      ImGui::SetWindowFocus(nullptr);  // from the panel back to the picture
    else
      execute(Action::quit);
    return;
  }
  if (e.code == GLFW_KEY_F1 || (e.code == GLFW_KEY_H && !control && !shift))
    return execute(Action::help);
  if (control && !shift && e.code == GLFW_KEY_Y) return execute(Action::redo);
  for (const ActionInfo& info : actions()) {
    if (info.command == Action::help) continue;  // arrives as a character, on any keyboard
    if (info.key == e.code && info.control == control && info.shift == shift) {
      if (!e.repeated || info.repeats) execute(info.command);
      // As for a drag: one undo step.
      if (e.repeated && info.repeats) lastScroll_ = Clock::now();
      return;
    }
  }
}

void App::paletteKey(int code) {
  const int count = int(palette_.found.size());
  const auto go = [&](int step) {
    if (count > 0) palette_.at = std::clamp(palette_.at + step, 0, count - 1);
  };
  switch (code) {
    case GLFW_KEY_UP:
      return go(-1);
    case GLFW_KEY_DOWN:
      return go(1);
    case GLFW_KEY_PAGE_UP:
      return go(-10);
    case GLFW_KEY_PAGE_DOWN:
      return go(10);
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      palette_.open = false;
      if (palette_.at < count) {
        const Finding chosen = palette_.found[std::size_t(palette_.at)];
        take(chosen);
      }
      return;
    case GLFW_KEY_ESCAPE:
      palette_.open = false;
      return;
    default:
      return;
  }
}

}  // namespace glint::viewer
