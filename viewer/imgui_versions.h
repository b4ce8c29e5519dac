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
/// Whether the key went down since the last frame; while a widget has it.
bool enterPressed();
bool backspacePressed();
/// The window has gained or lost the focus; with it all keys and buttons are let go.
void setFocus(bool gained);

/// A child window over what is left, into which the keyboard's ring goes as into the window itself.
/// Ends with ImGui::EndChild().
void beginFlattened(const char* name);

/// A picture of GL's name `texture`.
void image(unsigned texture, float width, float height);
/// The same at a place of the screen, of the window that is drawn; takes no room in its layout.
void imageAt(unsigned texture, float x, float y, float width, float height);

/// The fonts have been added.
void buildFonts();
/// Height of the first font, in the window's coordinates.
float fontHeight();

/// Copies and pastes by these; `user` is handed to them.
void setClipboard(const char* (*get)(void* user), void (*set)(void* user, const char* text),
                  void* user);

}  // namespace glint::viewer::imgui
