#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "dialogs.h"
#include "overlay.h"
#include "panel.h"
#include "picture.h"
#include "session.h"
#include "window.h"

namespace glint {

/// Seconds without input after which the picture is drawn in full.
inline constexpr double restAfter = 0.12;

inline double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// What glint-viewer was started with.
struct AppOptions {
  std::filesystem::path model;  ///< empty: none yet
  std::filesystem::path look;   ///< the file the look was read from, watched; may be empty
  std::filesystem::path glsl;   ///< folder of shader files, watched; may be empty
  double scale = 0;             ///< of text and widgets; 0: the screen's
};

/// The window at work: takes input, lets the panel edit the session, draws what has changed.
class App {
 public:
  App(Window&, Look, AppOptions);
  ~App();

  /// Until the window is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;
  struct Drawn {
    DrawnPicture picture;
    bool preview = false;
  };

  // app.cpp: frames
  void applyInput(const std::deque<InputEvent>& events);
  void key(const InputEvent& event);
  void buildInterface();
  void pictureArea();
  void statusBar();
  void helpWindow();
  bool updatePicture();
  void present();
  void layout();
  void setTitle();
  std::unique_ptr<Drawn> drawLook(const Look& look, bool preview);
  bool gestureActive() const;

  // app_actions.cpp: what keys and buttons do
  void execute(Action);
  void saveLookTo(const std::string& path, bool sure);
  void saveModelTo(const std::string& path, bool sure);
  void savePictureTo(const std::string& path, bool sure);
  void open(const std::string& path);
  void openAnyway(const std::filesystem::path& path);
  void load(const std::filesystem::path& path);
  void finishLoading();
  void watch();
  void quit();
  void setCompare(CompareMode);
  void pick(glm::dvec2 pixel);
  void hover(glm::dvec2 pixel);
  /// Runs something; an error goes to the log.
  void attempt(const std::function<void()>& action);
  DrawnPicture fullPicture();

  Window& window_;
  AppOptions options_;
  Session session_;
  Dialogs dialogs_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<GpuScene> gpuScene_;
  Screen screen_;
  std::unique_ptr<OverlayDrawer> overlay_;

  std::future<std::unique_ptr<Model>> loading_;
  std::filesystem::path loadingPath_;

  std::unique_ptr<Drawn> a_, b_;
  std::optional<Look> failed_;  ///< could not be drawn; not tried again until it changes
  bool screenStale_ = true, overlayStale_ = true;
  Document shown_;  ///< what the screen was composed from
  Overlay shownOverlay_ = Overlay::none;
  double fullMilliseconds_ = 0, uiMilliseconds_ = 0;
  Clock::time_point lastChange_{};
  Clock::time_point lastScroll_{};
  bool wantsFull_ = true;  ///< a picture made smaller for speed is on the screen

  glm::ivec2 framebuffer_{1}, resolution_{1};  ///< pixels
  double ratio_ = 1;                           ///< pixels per window coordinate
  float panelWidth_ = 0, statusHeight_ = 0;    ///< window coordinates
  bool panelShown_ = true, helpShown_ = false, quitting_ = false;
  std::optional<glm::dvec2> cursor_;  ///< over the picture, its pixels
  std::optional<Probe> probe_;
  bool probeStale_ = true;
  bool dragged_ = false, draggingDivider_ = false;
  glm::dvec2 pressedAt_{0};

  FileState modelState_, lookState_, glslState_;
  std::string glyphFile_;
};

}  // namespace glint
