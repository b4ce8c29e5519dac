#pragma once

#include <functional>
#include <string>
#include <vector>

namespace glint {

/// One modal dialog at a time: asks for a path, or for one of a few answers. Enter takes the first
/// answer, Escape the last.
class Dialogs {
 public:
  using PathAction = std::function<void(const std::string& path)>;
  struct Answer {
    std::string text;
    std::function<void()> action;
  };

  /// Asks for a file name. `existing`: one that is there, offered in a list.
  void askPath(std::string title, std::string path, bool existing, PathAction action);
  void ask(std::string title, std::string question, std::vector<Answer> answers);

  bool open() const { return kind_ != Kind::none; }
  void draw();

  /// Keys of ImGui's frame that a dialog takes.
  void pressEnter() { enter_ = true; }
  void pressEscape() { escape_ = true; }

 private:
  enum class Kind { none, path, question };
  void close();
  void drawPath();
  void drawQuestion();

  Kind kind_ = Kind::none;
  bool appearing_ = false, existing_ = false, enter_ = false, escape_ = false;
  std::string title_, text_;
  PathAction pathAction_;
  std::vector<Answer> answers_;
  std::string listedFolder_;
  std::vector<std::string> listed_;
};

}  // namespace glint
