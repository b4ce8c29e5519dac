#pragma once

#include <map>
#include <memory>
#include <vector>

#include "glint/gl/framebuffer.h"
#include "glint/gl/handles.h"
#include "glint/gl/layers.h"
#include "glint/gl/program.h"
#include "glint/image/image.h"
#include "glint/render/draw_list.h"
#include "glint/render/environment_texture.h"
#include "glint/render/glsl_sources.h"
#include "glint/render/gpu_scene.h"
#include "glint/render/tiles.h"

namespace glint {

/// Milliseconds that parts of a picture took.
struct RenderTimes {
  double compile = 0, draw = 0, read = 0;
};

/// Draws scenes into pictures of linear light. Keeps its programs from picture to picture; lives
/// and dies in one current context.
class Renderer {
 public:
  /// Throws Error if no context is current.
  explicit Renderer(GlslSources sources = {});

  /// A picture being drawn, band by band from the top.
  class Picture {
   public:
    int bandCount() const { return int(layout_.bands.size()); }
    /// The next band's rows: linear, premultiplied by alpha over the background, before exposure.
    /// The image is reused if it has room.
    void drawBand(Image& rows);
    /// Draws the whole picture once more without reading it back, and does not wait: what is
    /// measured of a frame until glFinish. The bands stay as they are.
    void redraw();
    const DrawList& list() const { return list_; }
    /// Samples a pixel that the driver gave.
    int samples() const;
    const RenderTimes& times() const { return times_; }

   private:
    friend class Renderer;
    Picture(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look);
    /// Without `rows` nothing is read back.
    void drawTile(const Tile& tile, Image* rows);
    void drawItem(std::size_t item);
    /// What is blended, from this item on, layer by layer from the back.
    void drawLayers(std::size_t first);
    void bindDraw(std::size_t item);

    Renderer& renderer_;
    GpuScene& scene_;
    DrawList list_;
    Look look_;
    TileLayout layout_;
    std::size_t nextBand_ = 0;
    Buffer lights_, draws_, materials_;
    GLsizeiptr drawStride_ = 0, materialStride_ = 0;
    std::vector<const Program*> programs_;  ///< of each item
    const Program* used_ = nullptr;         ///< by the item before
    std::vector<float> scratch_;
    RenderTimes times_;
  };

  /// Prepares a picture: compiles what is missing, uploads what is new. Throws InputError for more
  /// samples or pixels than the driver has, Error for shaders that do not compile. The scene must
  /// outlive the picture.
  Picture begin(GpuScene&, DrawList, const Look&);

  /// Forgets all programs if there are more than `most`, so that a long run over models of many
  /// kinds stays within bounds. No picture may be in the making.
  void limitPrograms(std::size_t most);

  /// Pictures begun from now on are drawn by programs of their own, built anew; those of earlier
  /// pictures stay.
  void setProgramsAside();

  /// Whether depth is 1 at the near plane and 0 at the far one; else 0 and 1.
  bool reversedDepth() const { return clipControl_; }

  /// Draws a whole picture at once.
  Image draw(GpuScene&, const Bounds&, const Look&);

 private:
  const Program& programFor(const Variant&);
  const Program& backgroundFor(Environment);
  RenderTarget& targetFor(int width, int height, int samples);
  /// Of the target, or null if this driver cannot tell the layers of its samples apart.
  const DepthLayers* layersFor();
  const Program& layerProgram();
  void needCurve();

  GlslSources sources_;
  bool fileNames_;
  bool clipControl_;
  std::map<Variant, Program> programs_;
  std::vector<std::map<Variant, Program>> former_;
  std::map<Environment, Program> backgrounds_;
  EnvironmentTexture environment_;
  std::unique_ptr<RenderTarget> target_;
  std::unique_ptr<DepthLayers> layers_;    ///< of the target; dies first
  std::map<bool, Program> layerPrograms_;  ///< by whether there are samples
  Query layerQuery_;
  int askedSamples_ = 0;
  VertexArray noVertices_;
  Buffer frame_;
  Buffer curve_;  ///< made when a texture is in sRGB
};

}  // namespace glint
