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
#include "theme.h"
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
  hintUntil_ = Clock::now() + std::chrono::seconds(10);
  if (!options_.model.empty()) load(options_.model);
}

App::~App() {
  if (loading_.valid()) loading_.wait();
}

// Advances the animation; it loops.
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
  lastPlayed_ = Clock::now();  // so that it counts as motion
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
  panelWidth_ = options_.settings.panel
                    ? std::min(std::round(float(options_.settings.panelWidth) * scale),
                               std::round(float(size.x) * 0.75f))
                    : 0;
  statusHeight_ = std::round(imgui::fontHeight() + 10 * scale);
  menuHeight_ = imgui::fontHeight() + 2 * ImGui::GetStyle().FramePadding.y;
  widgets::style().panelLeft = float(size.x) - panelWidth_;
  const auto pixels = [&](float coordinates) { return int(std::lround(coordinates * ratio_)); };
  resolution_ =
      glm::max(framebuffer_ - glm::ivec2(pixels(panelWidth_), pixels(statusHeight_ + menuHeight_)),
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

// The log also goes to the terminal that the window was started from.
void App::tellLog() {
  for (; told_ < session_.log.size(); ++told_) {
    std::string line = session_.log[told_];
    while (!line.empty() && line.back() == '\n') line.pop_back();
    for (std::size_t at; (at = line.find('\n')) != std::string::npos;) line.replace(at, 1, " | ");
    std::cerr << "glint: " << line << "\n";
  }
}

// Whether anything other than input calls for a frame.
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
  if (tooltipDue_ && now >= *tooltipDue_) due = true;
  if (shownResult_.request.preview && seconds(now - lastChange_) >= pace_.rest()) due = true;
  if (recovery_.waiting())
    recovery_.keep(session_.lookForFile(session_.document.a), session_.unsaved(),
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
    // The first arrow key in a focused window puts the ring on its first widget.
    if (ringWanted_ > 0) {
      if (!panelFocused_) ImGui::SetWindowFocus("panel");
      imgui::setKey(GLFW_KEY_DOWN, --ringWanted_ % 2 == 1);
    }
    interface.begin(seconds(now - lastFrame));
    lastFrame = now;
    buildInterface();
    if (draw) present();
    interface.end(draw);
    session_.history.settle(session_.document, gestureActive(), session_.playing);
  };
  while (!quitting_) {
    double patience = session_.playing               ? 0.01
                      : shownResult_.request.preview ? pace_.rest()
                      : recovery_.waiting()          ? 0.2
                                                     : 0.5;
    const double tip = widgets::tooltipDue();
    tooltipDue_.reset();
    if (std::isfinite(tip)) {
      patience = std::min(patience, tip);
      tooltipDue_ = Clock::now() +
                    std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(tip));
    }
    const bool happened = window_.wait(patience);
    if (!(somethingDue() || happened)) continue;

    const auto start = Clock::now();
    layout();
    // Each group of events gets its own frame. One more follows, because only then does ImGui place
    // what has just appeared. The last frame is drawn.
    do {
      auto events = window_.input().take();
      for (InputEvent& event : events) {
        event.forWidgets = isForWidgets(event);
        event.presses = pressesLikeSpace(event);
      }
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
    recovery_.keep(session_.lookForFile(session_.document.a), session_.unsaved(),
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
  if (painter_->saving())
    left = "saving the picture ...";
  else if (painter_->pending() && seconds(Clock::now() - lastChange_) > 0.25)
    left = "drawing ...";
  if (!acted_ || Clock::now() < hintUntil_)
    left += (left.empty() ? "" : "   ") +
            std::string(
                "Ctrl+P finds every action, F1 shows keys and mouse; drag the picture to "
                "turn it, click it to select");
  left = left.substr(0, left.find('\n'));
  ImGui::PushClipRect(at, ImVec2(at.x + std::max(0.0f, room - width - 16), at.y + statusHeight_),
                      true);
  if (session_.statusIsError)
    ImGui::TextColored(widgets::colorOf(theme::error), "%s", left.c_str());
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

// The panel's left edge, which can be dragged to resize it.
void App::panelEdge() {
  const ImGuiIO& io = ImGui::GetIO();
  const float s = widgets::style().scale, width = 6 * s;
  ImGui::SetNextWindowPos(ImVec2(io.DisplaySize.x - panelWidth_ - width / 2, menuHeight_));
  ImGui::SetNextWindowSize(ImVec2(width, io.DisplaySize.y - menuHeight_));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin("panel edge", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("edge", ImVec2(width, io.DisplaySize.y - menuHeight_));
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    options_.settings.panelWidth = Settings{}.panelWidth;
  else if (ImGui::IsItemActive() && io.MouseDelta.x != 0)
    options_.settings.panelWidth =
        std::clamp(double(io.DisplaySize.x - io.MousePos.x) / double(s), 240.0,
                   std::max(240.0, double(io.DisplaySize.x) * 0.75 / double(s)));
  ImGui::End();
}

void App::buildInterface() {
  const ImGuiIO& io = ImGui::GetIO();
  menuBar();
  pictureArea();
  statusBar();
  probeShown_ = panelFocused_ = false;
  session_.tried.reset();
  if (options_.settings.panel) {
    ImGui::SetNextWindowPos(ImVec2(io.DisplaySize.x - panelWidth_, menuHeight_));
    ImGui::SetNextWindowSize(ImVec2(panelWidth_, io.DisplaySize.y - menuHeight_));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    PanelContext context{session_, options_.settings};
    context.picture = shownResult_.a.get();
    context.resolution = resolution_;
    context.preview = shownResult_.request.preview;
    context.comparison = comparisonText();
    context.probeShown = &probeShown_;
    context.thumbnails = &thumbnails_;
    session_.plotShown = false;
    context.probe = probe_ ? &*probe_ : nullptr;
    context.uiMilliseconds = uiMilliseconds_;
    context.run = [this](Action c) { execute(c); };
    context.resizePicture = [this](glm::ivec2 size) {
      window_.resize(glm::ivec2(glm::dvec2(size + framebuffer_ - resolution_) / ratio_));
    };
    drawPanel(context);
    panelFocused_ = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
    ImGui::End();
    panelEdge();
    if (const std::string problem = widgets::takeProblem(); !problem.empty())
      session_.fail(problem);
  }
  helpWindow();
  paletteWindow();
  dialogs_.draw();
}

}  // namespace glint::viewer
