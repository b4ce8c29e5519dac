#include "dialogs.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <utility>

#include "theme.h"
#include "widgets.h"
namespace glint::viewer {

namespace fs = std::filesystem;

namespace {

bool isOpened(std::string ending) {
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  static const char* const all[] = {".glb", ".gltf", ".json", ".look", ".hdr", ".exr", ".binary"};
  return std::ranges::find(all, ending) != std::end(all);
}

}  // namespace

void Dialogs::askPath(std::string title, std::string path, bool existing, PathAction action) {
  kind_ = Kind::path;
  appearing_ = true;
  existing_ = existing;
  enter_ = escape_ = false;
  title_ = std::move(title);
  text_ = std::move(path);
  pathAction_ = std::move(action);
  listedFolder_.clear();
  listed_.clear();
}

void Dialogs::askPicture(std::string path, glm::ivec2 size, bool transparent,
                         PictureAction action) {
  askPath("Save the picture", std::move(path), false, {});
  kind_ = Kind::picture;
  size_ = windowSize_ = size;
  transparent_ = transparent;
  pictureAction_ = std::move(action);
}

void Dialogs::ask(std::string title, std::string question, std::vector<Answer> answers) {
  kind_ = Kind::question;
  appearing_ = true;
  enter_ = escape_ = false;
  title_ = std::move(title);
  text_ = std::move(question);
  answers_ = std::move(answers);
}

void Dialogs::close() {
  kind_ = Kind::none;
  ImGui::CloseCurrentPopup();
}

void Dialogs::draw() {
  if (kind_ == Kind::none) return;
  const std::string id = title_ + "###dialog";
  // The action of an answer may open the next dialog, so reset the flags first.
  const bool appearing = std::exchange(appearing_, false);
  if (appearing) ImGui::OpenPopup(id.c_str());
  const ImVec2 center = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(center, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  if (!ImGui::BeginPopupModal(id.c_str(), nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  const bool enter = std::exchange(enter_, false) && !appearing;
  const bool escape = std::exchange(escape_, false);
  if (kind_ == Kind::path)
    drawPath(escape);
  else if (kind_ == Kind::picture)
    drawPicture(enter, escape);
  else
    drawQuestion(enter, escape);
  ImGui::EndPopup();
}

void Dialogs::drawPath(bool escape) {
  const float width = std::min(ImGui::GetFontSize() * 34, ImGui::GetIO().DisplaySize.x * 0.8f);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(width);
  const bool entered = ImGui::InputText(
      "##path", &text_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  const bool picked = existing_ && drawFiles(width);
  const int chosen = drawButtons(existing_ ? "Open" : "Save", entered || picked, escape);
  std::error_code error;
  if (chosen > 0 && !text_.empty() && !fs::is_directory(text_, error)) {
    const PathAction action = std::move(pathAction_);
    const std::string path = text_;
    close();
    action(path);
  } else if (chosen < 0) {
    close();
  }
}

bool Dialogs::drawFiles(float width) {
  std::error_code error;
  const fs::path typed(text_);
  const fs::path folder = fs::is_directory(typed, error) ? typed
                          : typed.has_parent_path()      ? typed.parent_path()
                                                         : fs::path(".");
  if (folder.string() != listedFolder_) {
    listedFolder_ = folder.string();
    listed_.clear();
    for (const auto& each : fs::directory_iterator(folder, error)) {
      const std::string ending = each.path().extension().string();
      std::error_code ignored;
      if (each.is_directory(ignored))
        listed_.push_back(each.path().filename().string() + "/");
      else if (isOpened(ending))
        listed_.push_back(each.path().filename().string());
    }
    std::sort(listed_.begin(), listed_.end());
    if (folder.has_parent_path() || folder == ".") listed_.insert(listed_.begin(), "../");
  }
  bool picked = false;
  const float lines = std::clamp(
      ImGui::GetIO().DisplaySize.y / ImGui::GetTextLineHeightWithSpacing() - 12, 4.0f, 12.0f);
  if (ImGui::BeginListBox("##files",
                          ImVec2(width, ImGui::GetTextLineHeightWithSpacing() * lines))) {
    if (listed_.empty()) ImGui::TextDisabled("nothing to open in this folder");
    for (const std::string& name : listed_) {
      const fs::path chosen = fs::path(listedFolder_) / name;
      const bool now = text_ == chosen.lexically_normal().string();
      if (ImGui::Selectable(
              widgets::shownName(name).c_str(), now,
              ImGuiSelectableFlags_DontClosePopups | ImGuiSelectableFlags_AllowDoubleClick)) {
        text_ = name.back() == '/' ? fs::weakly_canonical(chosen, error).string() + "/"
                                   : chosen.lexically_normal().string();
        picked = name.back() != '/' && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
      }
    }
    ImGui::EndListBox();
  }
  return picked;
}

int Dialogs::drawButtons(const char* text, bool entered, bool escape) {
  const float button = ImGui::GetFontSize() * 7;
  const bool okay = ImGui::Button(text, ImVec2(button, 0)) || entered;
  ImGui::SameLine();
  const bool cancel = ImGui::Button("Cancel", ImVec2(button, 0)) || escape;
  return cancel ? -1 : okay ? 1 : 0;
}

void Dialogs::drawPicture(bool enter, bool escape) {
  const float width = std::min(ImGui::GetFontSize() * 30, ImGui::GetIO().DisplaySize.x * 0.8f);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(width);
  ImGui::InputText("##path", &text_, ImGuiInputTextFlags_AutoSelectAll);
  ImGui::TextDisabled(".png, .jpg, .webp (8 bits, sRGB), .exr, .pfm (32-bit float, linear)");
  ImGui::SetNextItemWidth(width * 0.5f);
  ImGui::InputInt2("pixels", &size_.x);
  ImGui::SameLine();
  if (ImGui::SmallButton("x 1")) size_ = windowSize_;
  ImGui::SameLine();
  if (ImGui::SmallButton("x 2")) size_ = windowSize_ * 2;
  ImGui::SameLine();
  if (ImGui::SmallButton("x 4")) size_ = windowSize_ * 4;
  ImGui::Checkbox("transparent background", &transparent_);
  const bool possible = size_.x >= 1 && size_.y >= 1 && size_.x <= 32768 && size_.y <= 32768;
  if (!possible) ImGui::TextColored(widgets::colorOf(theme::error), "from 1 to 32768 pixels");
  const int chosen = drawButtons("Save", enter, escape);
  if (chosen > 0 && possible && !text_.empty()) {
    const PictureAction action = std::move(pictureAction_);
    const std::string path = text_;
    const glm::ivec2 size = size_;
    const bool transparent = transparent_;
    close();
    action(path, size, transparent);
  } else if (chosen < 0) {
    close();
  }
}

// Enter at the keyboard's ring presses the focused button.
bool Dialogs::pressedAtRing(bool enter) {
  return enter && ImGui::IsItemFocused() && ImGui::GetIO().NavVisible;
}

void Dialogs::drawQuestion(bool enter, bool escape) {
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
  ImGui::TextUnformatted(text_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  int chosen = -1;
  if (enter && !ImGui::GetIO().NavVisible) chosen = 0;
  if (escape) chosen = int(answers_.size()) - 1;
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const float least = ImGui::GetFontSize() * 6;
    const float fits = ImGui::CalcTextSize(answers_[i].text.c_str()).x + ImGui::GetFontSize();
    if (ImGui::Button(answers_[i].text.c_str(), ImVec2(std::max(least, fits), 0)) ||
        pressedAtRing(enter))
      chosen = int(i);
  }
  if (chosen < 0) return;
  const auto action = answers_[std::size_t(chosen)].action;
  close();
  if (action) action();
}

}  // namespace glint::viewer
