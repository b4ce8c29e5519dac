#pragma once

#include <functional>
#include <map>
#include <memory>
#include <utility>
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

/// The texture unit of the previous layer's depths, while layers are drawn.
inline constexpr GLuint layerDepthUnit = 4;

/// Milliseconds that parts of a picture took.
struct RenderTimes {
  double compile = 0, draw = 0, read = 0;
};

/// Draws scenes into pictures of linear light. Caches its programs from picture to picture; belongs
/// to one current context for its whole lifetime.
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
    /// All bands.
    Image drawAll();
    /// Draws the whole picture once more without read-back and without waiting: a frame's time is
    /// measured up to glFinish. drawBand() continues where it was.
    void redraw();
    const DrawList& list() const { return list_; }
    /// Samples a pixel that the driver provides.
    int samples() const;
    const RenderTimes& times() const { return times_; }

   private:
    friend class Renderer;
    Picture(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look);
    /// `rows` are those of the tile's band; without them nothing is read back.
    void drawTile(const Tile& tile, float* rows);
    /// With `indices` in place of the mesh's own, if given.
    void drawCall(std::size_t call, const Buffer* indices = nullptr);
    /// Draws the blended items, from this call on, layer by layer from the back.
    glm::ivec4 pixelsOf(std::size_t first) const;
    void drawLayers(std::size_t first);
    bool drawInOrder(const DepthLayers&, int last, std::size_t first);
    void orderTriangles(std::size_t first);
    void drawDepths(std::size_t first, bool inOrder);
    void bindDraw(std::size_t call);
    void uploadDraws();

    Renderer& renderer_;
    GpuScene& scene_;
    DrawList list_;
    Look look_;
    TileLayout layout_;
    std::size_t nextBand_ = 0;
    Buffer lights_, draws_, materials_;
    std::vector<Buffer> ordered_;  ///< indices of blended items, farthest first; empty until used
    std::vector<DrawCall> calls_;
    std::vector<GLintptr> drawOffsets_, materialOffsets_, tableOffsets_;  ///< of each call
    std::vector<const Program*> programs_;                                ///< of each call
    const Program* used_ = nullptr;                                       ///< by the previous call
    glm::mat4 projection_{1};  ///< of the tile being drawn
    glm::ivec2 tilePixels_{0};
    bool wideThins_;            ///< points and lines need a frame of their own (thin.h)
    bool inThinFrame_ = false;  ///< which of the two is bound
    RenderTimes times_;
  };

  /// Prepares a picture: compiles what is missing, uploads what is new. Throws InputError for more
  /// samples or pixels than the driver supports, Error for shaders that do not compile. The scene
  /// must outlive the picture.
  Picture begin(GpuScene&, DrawList, const Look&);

  /// Drops all programs if there are more than `most`, so that a long run over many kinds of models
  /// does not grow without limit. No picture may be in progress.
  void limitPrograms(std::size_t most);

  /// Pictures begun from now on are drawn with newly built programs; those of earlier pictures
  /// stay.
  void setProgramsAside();

  /// Whether depth is 1 at the near plane and 0 at the far one; else 0 and 1.
  bool reversedDepth() const { return clipControl_; }

  /// Draw a whole picture at once.
  Image draw(GpuScene&, const Bounds&, const Look&);
  Image draw(GpuScene&, DrawList, const Look&);

 private:
  const Program& programFor(const Variant&, bool instanced);
  const Program& backgroundFor(Environment);
  RenderTarget& targetFor(int width, int height, int samples);
  /// Those of the target, or null if this driver cannot tell the layers of its samples apart.
  const DepthLayers* layersFor();
  const Program& layerProgram();
  void needCurve();
  static void setBlending(bool blended);
  /// Whether any sample that `draw` draws passes the tests, and how many do.
  bool any(const std::function<void()>& draw);
  GLuint samplesPassed(const std::function<void()>& draw);

  GlslSources sources_;
  bool fileNames_;
  bool clipControl_;
  using Programs = std::map<std::pair<Variant, bool>, Program>;  ///< true: for instanced calls
  Programs programs_;
  std::vector<Programs> former_;
  std::map<Environment, Program> backgrounds_;
  EnvironmentTexture environment_;
  std::unique_ptr<RenderTarget> target_;
  std::unique_ptr<DepthLayers> layers_;    ///< of the target; destroyed first
  std::map<bool, Program> layerPrograms_;  ///< key: multisampled or not
  Query layerQuery_, countQuery_;
  int askedSamples_ = 0;
  std::vector<float> scratch_;  ///< for ssaa; kept, since fresh memory costs more than its use
  VertexArray noVertices_;
  Buffer frame_, thinFrame_;
  Buffer curve_;  ///< made when a texture holds sRGB codes
};

}  // namespace glint
