#pragma once

/// What differs between the versions of Dear ImGui, from 1.86 to 1.92: this file alone knows them.
/// Keys and buttons are GLFW's.
namespace glint::viewer::imgui {

/// After ImGui::CreateContext().
void beginInput();

void moveMouse(float x, float y);
void setButton(int button, bool down);
void scroll(float x, float y);
/// A key of GLFW's; those that no widget asks for are passed over.
void setKey(int key, bool down);
void setModifiers(bool control, bool shift, bool alt);
/// The window has gained or lost the focus; with it all keys and buttons are let go.
void setFocus(bool gained);

/// The fonts have been added.
void buildFonts();
/// Height of the first font, in the window's coordinates.
float fontHeight();

/// Copies and pastes by these; `user` is handed to them.
void setClipboard(const char* (*get)(void* user), void (*set)(void* user, const char* text),
                  void* user);

}  // namespace glint::viewer::imgui
