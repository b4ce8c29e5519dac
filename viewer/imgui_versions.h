#pragma once

/// Hides the differences between versions of Dear ImGui, from 1.86 to 1.92. Keys and buttons are
/// GLFW's.
namespace glint::viewer::imgui {

/// Call after ImGui::CreateContext().
void beginInput();

void moveMouse(float x, float y);
void setButton(int button, bool down);
void scroll(float x, float y);
/// Passes a GLFW key to ImGui; keys that no widget uses are ignored.
void setKey(int key, bool down);
void setModifiers(bool control, bool shift, bool alt);
/// Whether the key was pressed since the last frame, also while a widget owns it.
bool enterPressed();
bool backspacePressed();
/// Reports that the window has gained or lost the focus; all keys and buttons are released.
void setFocus(bool gained);

/// Begins a child window over the remaining space that keyboard navigation enters like its parent.
/// End it with ImGui::EndChild().
void beginFlattened(const char* name);

/// Draws the GL texture named `texture`.
void image(unsigned texture, float width, float height);
/// The same at a screen position in the current window, without taking room in its layout.
void imageAt(unsigned texture, float x, float y, float width, float height);

/// Call when the fonts have been added.
void buildFonts();
/// The height of the first font, in window coordinates.
float fontHeight();

/// Sets the clipboard functions; `user` is passed to them.
void setClipboard(const char* (*get)(void* user), void (*set)(void* user, const char* text),
                  void* user);

}  // namespace glint::viewer::imgui
