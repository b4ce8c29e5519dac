#pragma once

#include <atomic>
#include <vector>

#include "glint/image/image.h"
#include "glint/reference/scene.h"
#include "glint/render/picture_terms.h"

namespace glint::reference {
struct Primitive;
}

namespace glint {

/// Draws a scene and look on the CPU in double precision, without GL: the reference for every error
/// figure. The picture does not depend on the number of threads or on how its rows are requested.
///
/// Rasterises by GL's rules (pixel centres, samples on left and bottom edges belong to a triangle,
/// perspective-correct interpolation, samples between the near and the far plane) but does not snap
/// vertices to a subpixel grid. Points and lines are one pixel of the picture wide. With
/// multisampling, a pixel that a triangle covers in part is shaded at the mean of the samples
/// covered. Where depths agree to 1e-12, the first drawn stays in
/// front. Blended surfaces are composited exactly, back to front at every sample.
class ReferenceRenderer {
 public:
  /// Transforms the scene and sorts it into strips of rows; draws nothing yet. Scene and images
  /// must outlive it. `threads` 0: as many as the processor has. Throws InputError for a number of
  /// samples without a pattern (samples.h), and for a camera or a material that the scene does not
  /// have.
  ReferenceRenderer(const Scene& scene, const DecodedImages& images, const Bounds& bounds,
                    const Look& look, int threads = 0);

  /// Call before drawing: sets where a multisampled picture's samples lie in each pixel, from its
  /// centre, y upwards, so as to match a driver.
  void sampleAt(std::vector<glm::dvec2> samples);

  /// Call before drawing: reduces the picture to one term (picture_terms.h).
  void keep(const PictureTerm& term);

  /// Rows y0 to y0 + rows - 1 from the top: linear, premultiplied by alpha over the background,
  /// before exposure. The image is reused if it has room.
  void drawRows(int y0, int rows, Image& out);
  Image draw();

  /// A number of rows that keeps all threads busy and memory small.
  int bandRows() const;

  /// Rows done so far by drawRows, all calls together; may be called from another thread.
  int rowsDone() const { return rowsDone_; }

  /// What is seen at the pixels of these rows, row by row: the front-most opaque surface. With
  /// ssaa, at the samples of the grid (`rows` are then rows of samples).
  std::vector<reference::Attributes> attributes(int y0, int rows) const;

  /// The parts of the radiance for given attributes.
  reference::Terms shade(const reference::Attributes& attributes) const;

  const DrawList& list() const { return list_; }
  const reference::Stage& stage() const { return stage_; }

 private:
  struct Entry {
    std::uint32_t item, primitive;
  };
  struct Fragment {
    std::size_t at;      ///< in the strip
    std::size_t number;  ///< in the order of drawing
    double depth;
    glm::dvec4 color;
  };
  struct Strip {
    std::vector<glm::dvec4> color;
    std::vector<double> depth;
    std::vector<Fragment> fragments;     ///< of blended items
    glm::dvec2 sample{0.0};              ///< the place in each pixel, from its centre
    std::vector<std::uint32_t> visible;  ///< 1 + index into the strip's primitives; 0 is none
  };
  void sortIntoStrips();
  std::size_t stripOf(int sampleRow) const { return std::size_t(sampleRow / stripRows_); }
  void findVisible(int firstRow, int endRow, Strip& strip) const;
  void drawStrip(int firstRow, int endRow, Strip& strip) const;
  void drawSamples(int firstRow, int endRow, Strip& strip) const;
  void blend(int firstRow, int endRow, Strip& strip) const;
  double depthAt(const reference::Primitive&, int column, int row, const glm::dvec2& sample) const;
  double alphaAt(const reference::Item&, const reference::Primitive&, int column, int row) const;
  glm::dvec4 background(int column, int row) const;

  Look look_;
  int scale_, threads_;
  int stripRows_ = 1;  ///< rows of samples; a multiple of scale_
  DrawList list_;
  reference::Stage stage_;
  std::vector<std::vector<Entry>> strips_;  ///< what may touch each, in drawing order
  std::atomic<int> rowsDone_ = 0;
};

/// What the reference draws with where nothing else is asked for: the default look without
/// anti-aliasing.
Look referenceDefaults();

/// Throws InputError if the reference cannot draw with this anti-aliasing.
void checkReferenceAntiAliasing(const AntiAliasing&);

}  // namespace glint
