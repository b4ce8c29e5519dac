#include "app.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "compose.h"
#include "glint/gl/check.h"
#include "glint/image/error.h"
#include "interface.h"
#include "materials.h"
#include "widgets.h"

namespace glint {

App::App(Window& window, Look look, AppOptions options)
    : window_(window), options_(std::move(options)) {
  GlslSources sources = options_.glsl.empty() ? GlslSources() : GlslSources(options_.glsl);
  renderer_ = std::make_unique<Renderer>(std::move(sources));
  session_.document.a = std::move(look);
  session_.saved = session_.document.a;
  session_.history = History(session_.document);
  session_.lookPath = options_.look;
  lookState_ = stateOf(options_.look);
  if (!options_.model.empty()) load(options_.model);
}

App::~App() {
  if (loading_.valid()) loading_.wait();
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
  panelWidth_ = panelShown_ ? std::min(std::round(372 * scale), float(size.x) * 0.6f) : 0;
  statusHeight_ = std::round(ImGui::GetIO().Fonts->Fonts[0]->FontSize + 10 * scale);
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

void App::run() {
  const double scale = options_.scale > 0 ? options_.scale : window_.contentScale();
  Interface interface(window_, scale);
  layout();
  if (session_.document.a.resolution != Look{}.resolution) {
    const glm::ivec2 chrome = framebuffer_ - resolution_;
    window_.resize(glm::ivec2(glm::dvec2(session_.document.a.resolution + chrome) / ratio_));
  }
  auto lastFrame = Clock::now();
  auto lastWatch = lastFrame;
  const auto frame = [&](bool draw) {
    const auto now = Clock::now();
    interface.begin(seconds(now - lastFrame));
    lastFrame = now;
    buildInterface();
    if (draw) present();
    interface.end(draw);
    session_.history.settle(session_.document, gestureActive());
  };
  while (!quitting_) {
    const bool moving = a_ && a_->preview;
    bool due = window_.wait(moving ? restAfter : 0.5);
    const auto now = Clock::now();
    if (loading_.valid() &&
        loading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
      finishLoading();
      due = true;
    }
    if (seconds(now - lastWatch) > 0.4) {
      lastWatch = now;
      const std::string before = session_.status;
      watch();
      due = due || session_.status != before || loading_.valid();
    }
    if (window_.closeRequested()) {
      window_.refuseClose();
      quit();
      due = true;
    }
    due = due || (moving && seconds(now - lastChange_) >= restAfter);
    if (!due) continue;

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
    if (gpuScene_ && !a_) {  // the first picture of a model may take its shaders' compiling
      frame(true);
      window_.present();
    }
    double drawing = 0;
    {
      const auto before = Clock::now();
      updatePicture();
      drawing = seconds(Clock::now() - before);
    }
    frame(true);
    window_.present();
    setTitle();
    uiMilliseconds_ = (seconds(Clock::now() - start) - drawing) * 1000;
  }
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
  if (e.code == GLFW_KEY_F1) return execute(Action::help);
  if (control && !shift && e.code == GLFW_KEY_Y) return execute(Action::redo);
  for (const ActionInfo& info : actions()) {
    if (info.command == Action::help) continue;  // comes as a character, on any keyboard
    if (info.key == e.code && info.control == control && info.shift == shift) {
      const bool repeats = info.command == Action::undo || info.command == Action::redo;
      if (!e.repeated || repeats) execute(info.command);
      return;
    }
  }
}

void App::pictureArea() {
  const ImVec2 size(float(resolution_.x / ratio_), float(resolution_.y / ratio_));
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin("picture", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("canvas", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const ImGuiIO& io = ImGui::GetIO();
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const glm::dvec2 mouse = glm::dvec2(double(io.MousePos.x), double(io.MousePos.y)) * ratio_;
  Document& document = session_.document;
  const bool split = document.compare == CompareMode::split && document.b;
  const double dividerX = document.divider * resolution_.x;
  const bool nearDivider = split && std::abs(mouse.x - dividerX) < 6 * ratio_;

  const auto moveCamera = [&](auto&& move) {
    if (!session_.model) return;
    attempt([&] {
      Look look = document.a;
      look.resolution = resolution_;
      const Scene& scene = session_.model->scene;
      setPose(document.a, move(poseOf(scene, session_.model->bounds, look)));
    });
  };
  const double height = std::max(1.0, double(resolution_.y));
  const glm::dvec2 centered = (mouse - glm::dvec2(resolution_) / 2.0) * glm::dvec2(2, -2) / height;

  if (ImGui::IsItemActivated()) {
    pressedAt_ = mouse;
    dragged_ = false;
    draggingDivider_ = nearDivider && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  }
  if (active) {
    if (glm::length(mouse - pressedAt_) > 3 * ratio_) dragged_ = true;
    const glm::dvec2 delta = glm::dvec2(double(io.MouseDelta.x), double(io.MouseDelta.y)) * ratio_;
    if (dragged_ && delta != glm::dvec2(0.0)) {
      const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
      if (draggingDivider_)
        document.divider = std::clamp(mouse.x / resolution_.x, 0.0, 1.0);
      else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (left && io.KeyShift))
        moveCamera([&](const Pose& p) { return panned(p, delta.x / height, delta.y / height); });
      else if (left && io.KeyCtrl)
        moveCamera([&](const Pose& p) { return rolled(p, -delta.x / height * 180); });
      else if (left)
        moveCamera([&](const Pose& p) {
          return orbited(p, -delta.x / height * 200, delta.y / height * 200);
        });
      else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
        moveCamera([&](const Pose& p) {
          return dollied(p, std::exp(-2 * delta.y / height), {0, 0});
        });
    }
  }
  if (ImGui::IsItemDeactivated()) {
    if (!dragged_ && hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !draggingDivider_)
      pick(mouse);
    draggingDivider_ = false;
  }
  if (hovered && io.MouseWheel != 0) {
    lastScroll_ = Clock::now();
    const double factor = std::pow(0.88, double(io.MouseWheel));
    moveCamera([&](const Pose& p) { return dollied(p, factor, centered); });
  }
  if (nearDivider || draggingDivider_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const std::optional<glm::dvec2> was = cursor_;
  cursor_ = hovered && !active ? std::optional(mouse) : std::nullopt;
  if (cursor_ != was) probeStale_ = true;

  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (split) {
    const float x = float(dividerX / ratio_), s = widgets::style().scale;
    draw->AddLine(ImVec2(x, 0), ImVec2(x, size.y),
                  nearDivider || draggingDivider_ ? IM_COL32(255, 214, 120, 255)
                                                  : IM_COL32(255, 255, 255, 150),
                  s);
    draw->AddText(ImVec2(x - 16 * s, 6 * s), IM_COL32(255, 255, 255, 220), "A");
    draw->AddText(ImVec2(x + 8 * s, 6 * s), IM_COL32(255, 255, 255, 220), "B");
  } else if (document.b && document.compare == CompareMode::blink) {
    draw->AddText(ImVec2(10, 6), IM_COL32(255, 255, 255, 220), "B");
  } else if (document.b && document.compare == CompareMode::difference && a_ && b_) {
    const CodePicture a{a_->picture.look.resolution.x, a_->picture.look.resolution.y,
                        a_->picture.codes.data()};
    const CodePicture b{b_->picture.look.resolution.x, b_->picture.look.resolution.y,
                        b_->picture.codes.data()};
    const CompareNumbers n = compareNumbers(a, b);
    char text[160];
    std::snprintf(text, sizeof text,
                  "|A - B| x %.3g: at most %d of 255, mean %.4g, %zu pixels differ",
                  document.amplification, n.largest, n.mean, n.pixels);
    draw->AddText(ImVec2(10, 6), IM_COL32(255, 255, 255, 220), text);
  }
  if (!session_.model) {
    const std::string text = loading_.valid()
                                 ? "Reading " + loadingPath_.filename().string() + " ..."
                                 : "Drop a model here (.glb or .gltf), or press Ctrl+O";
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    draw->AddText(ImVec2((size.x - extent.x) / 2, (size.y - extent.y) / 2),
                  IM_COL32(255, 255, 255, 200), text.c_str());
  }
  ImGui::End();
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
  if (a_) {
    char text[80];
    std::snprintf(text, sizeof text, "%d x %d   %.0f ms", resolution_.x, resolution_.y,
                  a_->picture.milliseconds);
    right += text;
  }
  const float width = ImGui::CalcTextSize(right.c_str()).x;
  const float room = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  std::string left = session_.status;
  if (loading_.valid()) left = "reading " + loadingPath_.filename().string() + " ...";
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
  ImGui::SetNextWindowSize(ImVec2(std::min(font * 62, io.DisplaySize.x * 0.96f),
                                  std::min(font * 52, io.DisplaySize.y * 0.96f)));
  ImGui::Begin("Keys and mouse", &helpShown_,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
  const auto line = [&](const std::string& key, std::string_view text) {
    ImGui::TextColored(ImVec4(0.95f, 0.78f, 0.4f, 1), "%s", key.c_str());
    ImGui::SameLine(font * 9);
    ImGui::TextWrapped("%s", std::string(text).c_str());
  };
  ImGui::Columns(2, "keys", false);
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
      if (info.section == "Edit") ImGui::NextColumn();
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
  if (panelShown_) {
    ImGui::SetNextWindowPos(ImVec2(io.DisplaySize.x - panelWidth_, 0));
    ImGui::SetNextWindowSize(ImVec2(panelWidth_, io.DisplaySize.y));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
    PanelContext context{session_};
    context.picture = a_ ? &a_->picture : nullptr;
    context.resolution = resolution_;
    context.preview = a_ && a_->preview;
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

}  // namespace glint
