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

/// A picture as drawn and as shown.
struct DrawnPicture {
  Look asked;  ///< may leave forms and program open
  Look look;   ///< with the forms and resolution drawn
  std::shared_ptr<const ResolvedLook> choice;
  Image linear;                     ///< before exposure
  std::vector<std::uint8_t> codes;  ///< RGBA, rows from the top: the bytes of glint render's PNG
  DrawList list;
  bool coarse = false, fewerLights = false;  ///< of a coarse scene; with fewer lights than asked
  int samples = 1;
  RenderTimes times;
  double milliseconds = 0;  ///< all together, with encoding
  std::size_t notNumbers = 0;
};

/// Draws a look the way `glint render` does: the same renderer, bands, read back and encode. The
/// look leaves nothing open. Nothing if `stop` becomes true meanwhile.
std::optional<DrawnPicture> drawPicture(Renderer&, GpuScene&, const Bounds&, const Look&,
                                        const std::atomic<bool>& stop);

/// Chooses what the look leaves open, draws it and writes it band by band, as `glint render` does;
/// `model` is the model's file, which the picture names in its text. Throws InputError.
void writePicture(Renderer&, GpuScene&, const Bounds&, const Look& asked, const std::string& model,
                  const std::string& path);

/// Puts bytes on the screen, pixel for pixel: no filter, no conversion, no blending.
class Screen {
 public:
  Screen();
  /// RGBA rows from the top; one pixel of the picture covers `scale` x `scale` of the window's
  /// framebuffer, from its upper left corner at (x, y) from the upper left.
  void upload(const std::uint8_t* rgba, int width, int height);
  void show(int x, int y, int width, int height, int framebufferHeight) const;

 private:
  TextureHandle texture_;
  VertexArray noVertices_;
  Program program_;
  int width_ = 0, height_ = 0;
};

}  // namespace glint::viewer
