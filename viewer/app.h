#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "compose.h"
#include "dialogs.h"
#include "error_map.h"
#include "pace.h"
#include "painter.h"
#include "panel.h"
#include "picture.h"
#include "recovery.h"
#include "reference_task.h"
#include "session.h"
#include "settings.h"
#include "window.h"

namespace glint::viewer {

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
  double scale = 0;             ///< of text and widgets; 0: the settings' or the screen's
  Settings settings;
};

/// The window at work: takes input, lets the panel edit the session, shows what has changed.
/// Pictures come from the painter, references from their task; neither holds up a frame.
class App {
 public:
  App(Window&, Look, AppOptions);
  ~App();

  /// Until the window is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // app.cpp: frames
  bool somethingDue();
  void applyInput(const std::deque<InputEvent>& events);
  void key(const InputEvent& event);
  void buildInterface();
  void statusBar();
  void helpWindow();
  void layout();
  void setTitle();
  void tellLog();
  void advance(double passed);
  bool gestureActive() const;

  // app_view.cpp: the picture as a thing to touch
  void pictureArea();
  void handlePicture(glm::dvec2 mouse, bool hovered, bool active);
  void drawOverPicture();
  std::string comparisonText() const;

  // app_picture.cpp: what is drawn
  void updatePicture();
  PaintRequest wanted(bool& moving);
  void receive(PaintResult);
  void updateReference();
  void composeScreen();
  void updateProbe();
  void present();

  // app_actions.cpp: what keys and buttons do
  void execute(Action);
  void executeCamera(Action);
  glm::dmat3 cameraAxes() const;
  void setCompare(CompareMode, bool exact);
  void pick(glm::dvec2 pixel);
  /// Runs something; an error goes to the log.
  void attempt(const std::function<void()>& action);

  // app_files.cpp: models, looks, shaders and pictures
  void saveLookTo(const std::string& path, bool sure, std::function<void()> then = {});
  void saveModelTo(const std::string& path, bool sure);
  void savePictureTo(const std::string& path, glm::ivec2 size, bool transparent, bool sure);
  void open(const std::string& path);
  void load(const std::filesystem::path& path);
  void finishLoading();
  void offerRecovered();
  void restore(const Recovered&);
  bool watch();  ///< true if a look was read, or could not be
  void quit();

  Window& window_;
  AppOptions options_;
  Session session_;
  Dialogs dialogs_;
  Recovery recovery_;
  Screen screen_;

  std::future<std::unique_ptr<Model>> loading_;
  std::filesystem::path loadingPath_, nextPath_;  ///< nextPath_: to be read after that
  std::optional<Recovered> restoring_;            ///< once its model is there
  bool offered_ = false;

  PaintResult shownResult_;     ///< what the screen is composed from
  std::optional<Look> failed_;  ///< could not be drawn; not tried again until it changes
  std::optional<PaintRequest> requested_;
  Pace pace_;
  bool screenStale_ = true;
  Document shown_;
  Look lastFull_;
  Overlay shownOverlay_ = Overlay::none;
  int shownRows_ = -1;  ///< of the reference
  std::vector<std::uint8_t> exactCodes_;
  const ReferencePicture* encoded_ = nullptr;  ///< what exactCodes_ are of
  int encodedRows_ = 0;
  ErrorNumbers errors_;
  CompareNumbers difference_;
  double uiMilliseconds_ = 0;
  Clock::time_point lastChange_{}, lastScroll_{}, lastPlayed_{};

  glm::ivec2 framebuffer_{1}, resolution_{1};  ///< pixels
  double ratio_ = 1;                           ///< pixels per window coordinate
  float panelWidth_ = 0, statusHeight_ = 0;    ///< window coordinates
  bool helpShown_ = false, quitting_ = false;
  std::optional<glm::dvec2> cursor_;  ///< over the picture, its pixels
  std::optional<Probe> probe_;
  bool probeStale_ = true, probeShown_ = false;
  bool dragged_ = false, draggingDivider_ = false;
  glm::dvec2 pressedAt_{0};
  std::size_t told_ = 0;  ///< lines of the log

  FileState modelState_, lookState_, glslState_;

  // Last: their threads end before what they report to.
  std::unique_ptr<Painter> painter_;
  std::unique_ptr<ReferenceTask> reference_;
};

}  // namespace glint::viewer
