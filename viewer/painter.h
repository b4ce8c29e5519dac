#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "overlay.h"
#include "picture.h"
#include "session.h"
#include "window.h"
#include "worker.h"

namespace glint::viewer {

/// Pictures that the window wants at one time.
struct PaintRequest {
  Look a;
  /// Something moves: a may be smaller than the window, and heavy models are drawn coarsely.
  bool preview = false;
  glm::ivec2 size{1};         ///< of the whole picture: forms are chosen for that one
  std::optional<Look> b;      ///< what A is compared with
  std::optional<Look> plain;  ///< A without anti-aliasing, for the probe
  Overlay overlay = Overlay::none;
  int outlined = -1;  ///< the material whose outline the overlay shows; -1: all
  bool operator==(const PaintRequest&) const = default;
};

using SharedPicture = std::shared_ptr<const DrawnPicture>;

/// RGBA with straight alpha, rows from the top, as large as the picture it lies over.
using Layer = std::shared_ptr<const std::vector<std::uint8_t>>;

/// What came of a request. Pictures that were drawn before are given again.
struct PaintResult {
  PaintRequest request;
  std::shared_ptr<const Model> model;  ///< in the pose that A asks for; null if it has none
  SharedPicture a, b, plain;
  Layer overlay;
  std::string error;  ///< empty if all is there
};

/// Draws pictures with a GL context and a thread of its own, by the same renderer as `glint
/// render`, each look with the model in the pose that it asks for, so that neither compiling nor a
/// large picture holds up the window. What is drawn is read back in any case: pictures are values,
/// and the window's own context only shows them.
class Painter {
 public:
  /// On the main thread, as the window. `wake` is called when something is ready.
  Painter(const Window&, const std::filesystem::path& glsl, std::function<void()> wake);
  ~Painter();

  /// Draws this model, in whatever pose, from now on; results of other models are not given any
  /// more.
  void setModel(std::shared_ptr<const Model>);

  /// Asks for pictures in place of those asked for before.
  void request(PaintRequest);
  /// A result that has not been taken yet; waits for one, if something is asked for, at most
  /// `seconds`.
  std::optional<PaintResult> take(double seconds = 0);
  /// Whether a request has no result yet.
  bool pending() const;

  /// Called on the main thread, from poll(), with an error's text or "" when it is done.
  using Done = std::function<void(const std::string& error)>;
  /// Draws the model with the look and writes it as `glint render` does; may be larger than memory
  /// has room for. Not cut short by requests.
  void save(const Look&, const std::string& path, Done);
  /// Compiles the folder's shaders for `trial` and takes them if that works.
  void reload(const std::filesystem::path& glsl, const Look& trial, Done);
  /// Runs what save and reload have to report. True if there was something.
  bool poll();
  /// Whether pictures are being saved.
  bool saving() const;

 private:
  struct Objects;  ///< all that lives in the context; touched by the worker's thread alone

  void paint(const PaintRequest&, const std::atomic<bool>& stop, int model);
  void takeCoarse(std::shared_ptr<const Model>, Scene coarse, int number);
  void report(Done, std::string error);

  std::unique_ptr<OffscreenContext> context_;
  std::function<void()> wake_;
  std::unique_ptr<Objects> objects_;
  mutable std::mutex mutex_;
  std::condition_variable ready_;
  std::optional<PaintResult> result_;
  std::optional<PaintRequest> asked_;  ///< without a result
  std::vector<std::pair<Done, std::string>> reports_;
  int model_ = 0;  ///< counts models
  int saves_ = 0;
  std::unique_ptr<Worker> worker_;
  std::unique_ptr<Worker> coarsener_;  ///< gives way; ends before worker_, to which it hands over
};

}  // namespace glint::viewer
