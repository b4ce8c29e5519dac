#include "app.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "edits.h"
#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "imgui_versions.h"
#include "interface.h"
#include "materials.h"
#include "widgets.h"
#include "xdg.h"

namespace glint::viewer {
namespace {

std::filesystem::path recoveryFolder() {
  const std::filesystem::path state = stateFolder();
  return state.empty() ? state : state / "recovery";
}

}  // namespace

App::App(Window& window, Look look, AppOptions options)
    : window_(window), options_(std::move(options)), recovery_(recoveryFolder()) {
  painter_ = std::make_unique<Painter>(window_, options_.glsl, Window::wake);
  reference_ = std::make_unique<ReferenceTask>(Window::wake);
  session_.document.a = std::move(look);
  session_.document.amplification = options_.settings.amplification;
  session_.saved = session_.document.a;
  session_.history = History(session_.document);
  session_.lookPath = options_.look;
  if (!options_.look.empty())
    attempt([&] { readLookFile(session_.lookOnDisk, options_.look.string()); });
  lookState_ = stateOf(options_.look);
  if (!options_.model.empty()) load(options_.model);
}

App::~App() {
  if (loading_.valid()) loading_.wait();
}

// The animation goes on; at its end it begins again.
void App::advance(double passed) {
  if (!session_.playing) return;
  const double duration =
      session_.model ? animationDuration(session_.model->scene, session_.document.a) : 0;
  if (!(duration > 0)) {
    session_.playing = false;
    return;
  }
  double& time = session_.document.a.animationTime.emplace(
      session_.document.a.animationTime.value_or(0) + std::min(passed, 0.25));
  time = std::round(std::fmod(time, duration) * 1000) / 1000;
  lastPlayed_ = Clock::now();  // moves, as under a hand
}

bool App::gestureActive() const {
  return ImGui::IsAnyMouseDown() || ImGui::IsAnyItemActive() ||
         seconds(Clock::now() - lastScroll_) < 0.3;
}

void App::layout() {
  framebuffer_ = window_.framebufferSize();
  const glm::ivec2 size = window_.size();
  ratio_ = size.x > 0 ? double(framebuffer_.x) / size.x : 1;
  const float scale = widgets::style().scale;
  panelWidth_ =
      options_.settings.panel ? std::min(std::round(372 * scale), float(size.x) * 0.6f) : 0;
  statusHeight_ = std::round(imgui::fontHeight() + 10 * scale);
  const auto pixels = [&](float coordinates) { return int(std::lround(coordinates * ratio_)); };
  resolution_ = glm::max(framebuffer_ - glm::ivec2(pixels(panelWidth_), pixels(statusHeight_)),
                         glm::ivec2(1));
}

void App::setTitle() {
  std::string title = session_.model ? session_.model->path.filename().string() : "glint";
  if (session_.unsaved()) title = "* " + title;
  static std::string last;
  if (title == last) return;
  last = title;
  window_.setTitle(title + " - glint");
}

// The log is also for who started the window from a terminal.
void App::tellLog() {
  for (; told_ < session_.log.size(); ++told_) {
    std::string line = session_.log[told_];
    while (!line.empty() && line.back() == '\n') line.pop_back();
    for (std::size_t at; (at = line.find('\n')) != std::string::npos;) line.replace(at, 1, " | ");
    std::cerr << "glint: " << line << "\n";
  }
}

// Whether a frame is called for by anything else than input.
bool App::somethingDue() {
  bool due = false;
  const auto now = Clock::now();
  if (loading_.valid() && loading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    finishLoading();
    due = true;
  }
  due = painter_->poll() || due;
  static Clock::time_point lastWatch;
  if (seconds(now - lastWatch) > 0.4) {
    lastWatch = now;
    due = watch() || due || loading_.valid();
  }
  if (window_.closeRequested()) {
    window_.refuseClose();
    quit();
    due = true;
  }
  if (session_.playing) due = true;
  if (shownResult_.request.preview && seconds(now - lastChange_) >= restAfter) due = true;
  if (recovery_.waiting())
    recovery_.keep(session_.document.a, session_.unsaved(),
                   session_.model ? session_.model->path : std::filesystem::path());
  return due;
}

void App::run() {
  const double screenScale = window_.contentScale();
  const double own = options_.scale > 0 ? options_.scale : options_.settings.scale;
  const double scale = own > 0 ? own : screenScale;
  Interface interface(window_, scale);
  layout();
  if (session_.document.a.resolution != Look{}.resolution) {
    const glm::ivec2 chrome = framebuffer_ - resolution_;
    window_.resize(glm::ivec2(glm::dvec2(session_.document.a.resolution + chrome) / ratio_));
  }
  if (options_.model.empty()) offerRecovered();
  auto lastFrame = Clock::now(), lastAdvance = lastFrame;
  const auto frame = [&](bool draw) {
    const auto now = Clock::now();
    interface.begin(seconds(now - lastFrame));
    lastFrame = now;
    buildInterface();
    if (draw) present();
    interface.end(draw);
    session_.history.settle(session_.document, gestureActive(), session_.playing);
  };
  while (!quitting_) {
    const double patience = session_.playing               ? 0.01
                            : shownResult_.request.preview ? restAfter
                            : recovery_.waiting()          ? 0.2
                                                           : 0.5;
    const bool happened = window_.wait(patience);
    if (!(somethingDue() || happened)) continue;

    const auto start = Clock::now();
    layout();
    // Each group of events in a frame of its own, then one more, as ImGui places what has just
    // appeared only then; the last one is drawn.
    do {
      const auto events = window_.input().take();
      interface.feed(events);
      applyInput(events);
      frame(false);
    } while (!window_.input().empty());
    frame(false);
    layout();
    const auto before = Clock::now();
    advance(seconds(before - lastAdvance));
    lastAdvance = before;
    updatePicture();
    const double waited = seconds(Clock::now() - before);
    frame(true);
    window_.present();
    setTitle();
    tellLog();
    recovery_.keep(session_.document.a, session_.unsaved(),
                   session_.model ? session_.model->path : std::filesystem::path());
    uiMilliseconds_ = (seconds(Clock::now() - start) - waited) * 1000;
  }
  recovery_.clear();
  while (painter_->saving()) {
    window_.wait(0.1);
    painter_->poll();
  }
  painter_->poll();
  options_.settings.window = glm::ivec2(glm::dvec2(window_.size()) / scale * screenScale);
  options_.settings.amplification = session_.document.amplification;
  attempt([&] { saveSettings(options_.settings); });
  tellLog();
}

void App::applyInput(const std::deque<InputEvent>& events) {
  for (const InputEvent& e : events) {
    if (e.kind == InputEvent::Kind::drop) open(e.path);
    if (e.kind == InputEvent::Kind::key && e.down) key(e);
    if (e.kind == InputEvent::Kind::character && e.code == '?' && !ImGui::GetIO().WantTextInput &&
        !dialogs_.open())
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
  if (ImGui::GetIO().WantTextInput) return;
  if (e.code == GLFW_KEY_ESCAPE) {
    if (helpShown_)
      helpShown_ = false;
    else if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
      execute(Action::quit);
    return;
  }
  if (e.code == GLFW_KEY_F1 || (e.code == GLFW_KEY_H && !control && !shift))
    return execute(Action::help);
  if (control && !shift && e.code == GLFW_KEY_Y) return execute(Action::redo);
  for (const ActionInfo& info : actions()) {
    if (info.command == Action::help) continue;  // comes as a character, on any keyboard
    if (info.key == e.code && info.control == control && info.shift == shift) {
      if (!e.repeated || info.repeats) execute(info.command);
      // As under a hand: one step of undo.
      if (e.repeated && info.repeats) lastScroll_ = Clock::now();
      return;
    }
  }
}

void App::statusBar() {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos(ImVec2(0, io.DisplaySize.y - statusHeight_));
  ImGui::SetNextWindowSize(ImVec2(io.DisplaySize.x - panelWidth_, statusHeight_));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(8 * widgets::style().scale, 4 * widgets::style().scale));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin("status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar(2);
  std::string right;
  if (session_.hovered && session_.model)
    right = materialLabel(session_.model->scene, *session_.hovered) + "   ";
  if (shownResult_.a) {
    char text[80];
    std::snprintf(text, sizeof text, "%d x %d   %.0f ms", resolution_.x, resolution_.y,
                  shownResult_.a->milliseconds);
    right += text;
  }
  const float width = ImGui::CalcTextSize(right.c_str()).x;
  const float room = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  std::string left = session_.status;
  if (loading_.valid())
    left = "reading " + loadingPath_.filename().string() + " ...";
  else if (painter_->saving())
    left = "saving the picture ...";
  else if (painter_->pending() && seconds(Clock::now() - lastChange_) > 0.25)
    left = "drawing ...";
  if (left.empty()) left = "? shows the keys";
  left = left.substr(0, left.find('\n'));
  ImGui::PushClipRect(at, ImVec2(at.x + std::max(0.0f, room - width - 16), at.y + statusHeight_),
                      true);
  if (session_.statusIsError)
    ImGui::TextColored(ImVec4(1, 0.45f, 0.4f, 1), "%s", left.c_str());
  else
    ImGui::TextDisabled("%s", left.c_str());
  ImGui::PopClipRect();
  if (ImGui::IsItemHovered() && !session_.status.empty())
    ImGui::SetTooltip("%s", session_.status.c_str());
  ImGui::SameLine();
  ImGui::SetCursorScreenPos(ImVec2(at.x + room - width, at.y));
  ImGui::TextUnformatted(right.c_str());
  ImGui::End();
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
    ImGui::TextColored(ImVec4(0.95f, 0.78f, 0.4f, 1), "%s", key.c_str());
    ImGui::SameLine(font * 9);
    ImGui::TextWrapped("%s", std::string(text).c_str());
  };
  ImGui::Columns(wide ? 3 : 2, "keys", false);
  ImGui::TextDisabled("Mouse over the picture");
  line("left drag", "turn the camera about what it looks at");
  line("middle drag", "move the camera sideways (also Shift + left)");
  line("right drag", "nearer, farther");
  line("wheel", "nearer to, farther from what is under the cursor");
  line("Ctrl+left drag", "roll");
  line("click", "select the material under the cursor");
  ImGui::Spacing();
  ImGui::TextDisabled("Panel");
  line("double-click", "reset a value");
  line("Ctrl+click", "type a value, beyond the slider too");
  std::string_view section;
  for (const ActionInfo& info : actions()) {
    if (info.section != section) {
      if (info.section == (wide ? "Edit" : "Shading") || (wide && info.section == "Camera"))
        ImGui::NextColumn();
      ImGui::Spacing();
      section = info.section;
      ImGui::TextDisabled("%s", std::string(section).c_str());
    }
    line(keyText(info), info.help);
  }
  ImGui::Columns(1);
  ImGui::End();
}

void App::buildInterface() {
  const ImGuiIO& io = ImGui::GetIO();
  pictureArea();
  statusBar();
  probeShown_ = false;
  if (options_.settings.panel) {
    ImGui::SetNextWindowPos(ImVec2(io.DisplaySize.x - panelWidth_, 0));
    ImGui::SetNextWindowSize(ImVec2(panelWidth_, io.DisplaySize.y));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
    PanelContext context{session_, options_.settings};
    context.picture = shownResult_.a.get();
    context.resolution = resolution_;
    context.preview = shownResult_.request.preview;
    context.comparison = comparisonText();
    context.probeShown = &probeShown_;
    session_.plotShown = false;
    context.probe = probe_ ? &*probe_ : nullptr;
    context.uiMilliseconds = uiMilliseconds_;
    context.run = [this](Action c) { execute(c); };
    context.resizePicture = [this](glm::ivec2 size) {
      window_.resize(glm::ivec2(glm::dvec2(size + framebuffer_ - resolution_) / ratio_));
    };
    drawPanel(context);
    ImGui::End();
  }
  helpWindow();
  dialogs_.draw();
}

}  // namespace glint::viewer
