#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/budget/error_budget.h"
#include "glint/image/image.h"
#include "glint/render/renderer.h"

namespace glint::viewer {

/// A drawn picture with its encoding.
struct DrawnPicture {
  Look asked;  ///< may leave forms and program open
  Look look;   ///< with the forms and resolution actually drawn
  std::shared_ptr<const ResolvedLook> choice;
  Image linear;                     ///< before exposure
  std::vector<std::uint8_t> codes;  ///< RGBA, rows from the top: the bytes of glint render's PNG
  DrawList list;
  bool coarse = false, fewerLights = false;  ///< of a coarse scene; with fewer lights than asked
  int samples = 1;
  RenderTimes times;
  double milliseconds = 0;  ///< in total, including encoding
  std::size_t notNumbers = 0;
};

/// Draws a look as `glint render` does: with the same renderer, bands, read-back and encoding. The
/// look must leave nothing open. Empty if `stop` becomes true meanwhile.
std::optional<DrawnPicture> drawPicture(Renderer&, GpuScene&, const Bounds&, const Look&,
                                        const std::atomic<bool>& stop);

/// Chooses what the look leaves open, draws it and writes it band by band, as `glint render` does;
/// `model` is the model's file, which is recorded in the picture's text. Throws InputError.
void writePicture(Renderer&, GpuScene&, const Bounds&, const Look& asked, const std::string& model,
                  const std::string& path);

/// Copies pixels to the screen unchanged: no filter, no conversion, no blending.
class Screen {
 public:
  Screen();
  /// RGBA rows from the top; shown with the upper left corner at (x, y) from the framebuffer's
  /// upper left, scaled to width x height.
  void upload(const std::uint8_t* rgba, int width, int height);
  void show(int x, int y, int width, int height, int framebufferHeight) const;

 private:
  TextureHandle texture_;
  VertexArray noVertices_;
  Program program_;
  int width_ = 0, height_ = 0;
};

}  // namespace glint::viewer
