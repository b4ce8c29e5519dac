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

/// The pictures that the window wants at one time.
struct PaintRequest {
  Look a;
  /// Something moves: A may be smaller than the window, and heavy models are drawn coarsely.
  bool preview = false;
  glm::ivec2 size{1};         ///< of the whole picture: forms are chosen for this size
  std::optional<Look> b;      ///< the look that A is compared with
  std::optional<Look> plain;  ///< A without anti-aliasing, for the probe
  Overlay overlay = Overlay::none;
  int outlined = -1;  ///< the material whose outline the overlay shows; -1: all
  bool operator==(const PaintRequest&) const = default;
};

using SharedPicture = std::shared_ptr<const DrawnPicture>;

/// RGBA with straight alpha, rows from the top, in the size of the picture below it.
using Layer = std::shared_ptr<const std::vector<std::uint8_t>>;

/// The result of a request. Pictures already drawn are reused.
struct PaintResult {
  PaintRequest request;
  std::shared_ptr<const Model> model;  ///< in A's pose; null if it does not have that pose
  SharedPicture a, b, plain;
  Layer overlay;
  std::string error;  ///< empty if everything was drawn
};

/// Draws pictures with a GL context in a thread of its own, using the same renderer as `glint
/// render`, each look with the model in its pose, so that neither compiling nor a large picture
/// blocks the window. Pictures are always read back: they are values, and the window's own context
/// only shows them.
class Painter {
 public:
  /// Call on the main thread, like the window. `wake` is called when a result is ready.
  Painter(const Window&, const std::filesystem::path& glsl, std::function<void()> wake);
  ~Painter();

  /// Draws this model, in any pose, from now on; results for other models are dropped.
  void setModel(std::shared_ptr<const Model>);

  /// Requests pictures; replaces the previous request.
  void request(PaintRequest);
  /// A result not taken yet; waits for one up to `seconds`, if one is pending.
  std::optional<PaintResult> take(double seconds = 0);
  /// Whether a request is pending.
  bool pending() const;

  /// Called on the main thread, from poll(), with an error's text or "" on success.
  using Done = std::function<void(const std::string& error)>;
  /// Draws the model with the look and writes it as `glint render` does; the picture may be larger
  /// than memory. Not interrupted by requests.
  void save(const Look&, const std::string& path, Done);
  /// Compiles the folder's shaders for `trial` and uses them if that succeeds.
  void reload(const std::filesystem::path& glsl, const Look& trial, Done);
  /// Calls the Done functions of completed save and reload jobs. True if there were any.
  bool poll();
  /// Whether pictures are being saved.
  bool saving() const;

 private:
  struct Objects;  ///< everything in the context; used only by the worker's thread

  void paint(const PaintRequest&, const std::atomic<bool>& stop, int model);
  void takeCoarse(std::shared_ptr<const Model>, Scene coarse, int number);
  void report(Done, std::string error);

  std::unique_ptr<OffscreenContext> context_;
  std::function<void()> wake_;
  std::unique_ptr<Objects> objects_;
  mutable std::mutex mutex_;
  std::condition_variable ready_;
  std::optional<PaintResult> result_;
  std::optional<PaintRequest> asked_;  ///< not yet answered
  std::vector<std::pair<Done, std::string>> reports_;
  int model_ = 0;  ///< counts models
  int saves_ = 0;
  std::unique_ptr<Worker> worker_;
  std::unique_ptr<Worker> coarsener_;  ///< low priority; ends before worker_, which gets its result
};

}  // namespace glint::viewer
