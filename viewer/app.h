#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "actions.h"
#include "camera_control.h"
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
#include "thumbnails.h"
#include "window.h"

namespace glint::viewer {

inline double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// How glint-viewer was started.
struct AppOptions {
  std::filesystem::path model;  ///< empty: none yet
  std::filesystem::path look;   ///< the file that the look came from, watched; may be empty
  std::filesystem::path glsl;   ///< folder of shader files, watched; may be empty
  double scale = 0;             ///< of text and widgets; 0: from the settings or the screen
  Settings settings;
};

/// The running window: takes input, lets the panel edit the session and shows the result. Pictures
/// come from the painter, references from their task; neither blocks a frame.
class App {
 public:
  App(Window&, Look, AppOptions);
  ~App();

  /// Runs until the window is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // app.cpp: frames
  bool somethingDue();
  void buildInterface();
  void statusBar();
  void panelEdge();
  void layout();
  void setTitle();
  void tellLog();
  void advance(double passed);
  bool gestureActive() const;

  // app_keys.cpp: who gets a key, and what the keys of the table do
  bool isForWidgets(const InputEvent&) const;
  bool pressesLikeSpace(const InputEvent&) const;
  void applyInput(const std::deque<InputEvent>& events);
  void key(const InputEvent& event);
  void paletteKey(int code);

  // app_menu.cpp: the menu, the palette and the help, all made from the table of actions
  void menuBar();
  void openPalette(bool materialsAlone);
  void paletteWindow();
  void take(const Finding&);
  void helpWindow();

  // app_view.cpp: interaction with the picture
  void pictureArea();
  void handlePicture(glm::dvec2 mouse, bool hovered, bool active);
  void turnEnvironment(double degrees);
  void dragPicture(glm::dvec2 mouse);
  void moveCamera(const std::function<Pose(const Pose&)>& move);
  /// Scales the distance to the surface at a pixel, or to the focal plane there, by a factor.
  void dolly(glm::dvec2 pixel, double factor);
  std::optional<Hit> hitAt(glm::dvec2 pixel) const;
  void setPivot(glm::dvec2 pixel);
  void drawPivot();
  void drawProgress();
  /// Where a world-space point is seen, in window coordinates; empty if behind the camera.
  std::optional<glm::dvec2> placeOf(const glm::dvec3& world) const;

  // app_lights.cpp: light handles that can be dragged in the picture
  struct LightHandle {
    std::size_t light = 0;
    bool aim = false;       ///< of a spot: the point it shines at
    glm::dvec2 place{0.0};  ///< window coordinates
    bool behind = false;    ///< it points to a light behind the model
  };
  std::vector<LightHandle> lightHandles() const;
  std::optional<LightHandle> handleAt(glm::dvec2 mouse) const;
  void drawLightHandles();
  void dragLight(glm::dvec2 mouse);
  void drawOverPicture();
  std::string comparisonText() const;

  // app_picture.cpp: what is drawn
  void updatePicture();
  PaintRequest wanted(bool& moving);
  bool probesB(const Document&) const;
  void receive(PaintResult);
  void updateReference();
  void composeScreen();
  void updateProbe();
  void present();

  // app_actions.cpp: what keys and buttons do
  void execute(Action);
  std::string stem() const;  ///< of the names of files that are saved
  void askLook(const std::function<void()>& then = {});
  void showPlot(int step);
  void turnCamera(double right, double up);  ///< degrees
  glm::dmat3 cameraAxes() const;
  void setCompare(CompareMode, bool alsoExact = false);
  void pick(glm::dvec2 pixel);
  /// Runs an action; an error goes to the log.
  void attempt(const std::function<void()>& action);

  // app_files.cpp: models, looks, shaders and pictures
  /// Where there is a file and it is not sure that it goes: asks, and `replace` is run on a yes.
  bool asksFirst(const std::string& path, bool sure, const std::function<void()>& replace,
                 const char* word = "Replace", const std::string& question = "Replace it?");
  void keepPresetAt(const std::string& path, bool sure);
  void saveLookTo(const std::string& path, bool sure, std::function<void()> then = {});
  void saveModelTo(const std::string& path, bool sure);
  void savePictureTo(const std::string& path, glm::ivec2 size, bool transparent, bool sure);
  void open(const std::string& path);
  void openEnvironment(const std::string& path);
  void openMeasured(const std::string& path);
  void openLook(const std::filesystem::path& file);
  static std::string endingOf(const std::filesystem::path&);
  std::string freeName(const std::string& stem, const std::string& ending) const;
  void load(const std::filesystem::path& path);
  void finishLoading();
  void offerRecovered();
  void restore(const Recovered&);
  bool watch();  ///< true if a look was read, or failed to be read
  void quit();

  Window& window_;
  AppOptions options_;
  Session session_;
  Dialogs dialogs_;
  Recovery recovery_;
  Screen screen_;
  Thumbnails thumbnails_;

  std::future<std::unique_ptr<Model>> loading_;
  std::filesystem::path loadingPath_, nextPath_;  ///< nextPath_: to be read after that
  std::optional<Recovered> restoring_;            ///< to be restored once its model is loaded
  bool offered_ = false;

  PaintResult shownResult_;     ///< what the screen is composed from
  std::optional<Look> failed_;  ///< could not be drawn; not retried until it changes
  std::optional<PaintRequest> requested_;
  Pace pace_;
  bool screenStale_ = true;
  Document shown_;
  Look lastFull_;
  Overlay shownOverlay_ = Overlay::none;
  int shownRows_ = -1;  ///< of the reference
  std::vector<std::uint8_t> exactCodes_;
  const ReferencePicture* encoded_ = nullptr;  ///< what exactCodes_ was encoded from
  int encodedRows_ = 0;
  ErrorNumbers errors_;
  CompareNumbers difference_;
  double uiMilliseconds_ = 0;
  Clock::time_point lastChange_{}, lastScroll_{}, lastPlayed_{};

  glm::ivec2 framebuffer_{1}, resolution_{1};                 ///< pixels
  double ratio_ = 1;                                          ///< pixels per window coordinate
  float panelWidth_ = 0, statusHeight_ = 0, menuHeight_ = 0;  ///< window coordinates
  bool helpShown_ = false, menuWanted_ = false, quitting_ = false;
  float helpScroll_ = 0;  ///< lines still to scroll
  std::optional<Clock::time_point> tooltipDue_;
  bool panelFocused_ = false;  ///< the panel has ImGui's focus, whether or not the ring is visible
  int ringWanted_ = 0;         ///< frames left for putting the keyboard's ring on the panel
  Clock::time_point
      hintUntil_{};  ///< the first hint is shown until then or, if sooner, until the first action
  bool acted_ = false;
  struct Palette {
    bool open = false, appearing = false, materialsAlone = false;
    std::string words;
    int at = 0;  ///< an index into `found`
    std::vector<Finding> found;
  } palette_;
  std::optional<glm::dvec3> pivot_;   ///< drags turn about it; empty: the focal point
  std::optional<glm::dvec2> cursor_;  ///< where it is over the picture, pixels
  std::optional<Probe> probe_;
  bool probeStale_ = true, probeShown_ = false;
  bool dragged_ = false, draggingDivider_ = false;
  std::optional<LightHandle> draggedLight_;
  bool wasBeyond_ = false;  ///< beyond the ball's rim, while dragging a direction
  glm::dvec2 pressedAt_{0};
  std::optional<glm::dvec3> pressedPoint_;  ///< target of a drag with the right button
  std::size_t told_ = 0;                    ///< log lines already reported

  FileState modelState_, lookState_, glslState_;
  std::optional<Clock::time_point> missingSince_;  ///< when the model's file was first missing
  bool toldMissing_ = false;
  std::set<std::filesystem::path> mayReplace_;  ///< files that may be replaced without asking again

  // Last, so that their threads end before the members that they report to.
  std::unique_ptr<Painter> painter_;
  std::unique_ptr<ReferenceTask> reference_;
};

}  // namespace glint::viewer
