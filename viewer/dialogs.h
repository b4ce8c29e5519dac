#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace glint::viewer {

/// One modal dialog at a time: asks for a path, or offers a few answers. Enter chooses the first
/// answer, Escape the last.
class Dialogs {
 public:
  using PathAction = std::function<void(const std::string& path)>;
  using PictureAction =
      std::function<void(const std::string& path, glm::ivec2 size, bool transparent)>;
  struct Answer {
    std::string text;
    std::function<void()> action;
  };

  /// Asks for a file name. `existing`: offers existing files in a list.
  void askPath(std::string title, std::string path, bool existing, PathAction action);
  /// Asks how to save the picture: name, size and whether its background is transparent.
  void askPicture(std::string path, glm::ivec2 size, bool transparent, PictureAction action);
  void ask(std::string title, std::string question, std::vector<Answer> answers);

  bool open() const { return kind_ != Kind::none; }
  void draw();

  /// Passes a key of the current ImGui frame to the dialog.
  void pressEnter() { enter_ = true; }
  void pressEscape() { escape_ = true; }

 private:
  enum class Kind { none, path, picture, question };
  void close();
  void drawPath(bool escape);
  void drawPicture(bool enter, bool escape);
  /// True if a file was double-clicked.
  bool drawFiles(float width);
  static bool pressedAtRing(bool enter);
  /// The buttons at the end: 1 to proceed, -1 to cancel, otherwise 0.
  int drawButtons(const char* text, bool entered, bool escape);
  void drawQuestion(bool enter, bool escape);

  Kind kind_ = Kind::none;
  bool appearing_ = false, existing_ = false, enter_ = false, escape_ = false;
  std::string title_, text_;
  PathAction pathAction_;
  PictureAction pictureAction_;
  glm::ivec2 size_{1}, windowSize_{1};
  bool transparent_ = false;
  std::vector<Answer> answers_;
  std::string listedFolder_;
  std::vector<std::string> listed_;
};

}  // namespace glint::viewer
