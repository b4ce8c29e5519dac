#pragma once

#include <deque>
#include <optional>

#include "glint/study/study.h"

namespace glint {

/// What series are measured with. The renderer draws only pictures of the look's size.
struct SeriesTools {
  const StudyScene& scene;
  GpuScene& gpu;
  Renderer& renderer;
  Look look;  ///< the study's, at the size of series
  bool quick = false;
  int warmUp = 3, rounds = 30;
  Stop stop;
  std::function<void(double share)> progress;
  FrameClock clock = FrameClock::wall;  ///< of the points' times

  Timing timing(int count) const { return {warmUp, count, clock == FrameClock::gpu, stop, {}}; }
  bool stopped() const { return stop && stop(); }
  void tell(double share) const {
    if (progress) progress(share);
  }
};

/// Makes the points of a series: the errors first, then the times of all, measured in turn.
class SeriesDrawer {
 public:
  SeriesDrawer(const SeriesTools& tools, StudySeries series);

  /// Draws a point of the line `name`, and compares it with the truth if there is one.
  void add(const std::string& name, double x, const Look& look, const StudyMask* mask,
           const Radiances* truth);
  /// The same for another scene.
  void add(const std::string& name, double x, GpuScene& gpu, const StudyScene& scene,
           const Look& look, const StudyMask* mask, const Radiances* truth);

  /// Times what was added; if it is stopped before, the points stay without times.
  StudySeries finish();

 private:
  struct Trial {
    std::size_t line, point;
    Renderer::Picture picture;
  };
  const SeriesTools& tools_;
  StudySeries series_;
  std::deque<Trial> trials_;
};

/// Error and time over one quantity. None if it changes nothing in the scene. A stopped series
/// keeps the points measured so far.
std::optional<StudySeries> exponentSeries(const SeriesTools&);    ///< forms of the highlight
std::optional<StudySeries> aliasingSeries(const SeriesTools&);    ///< ways to treat aliasing
std::optional<StudySeries> distanceSeries(const SeriesTools&);    ///< the same, over the size
std::optional<StudySeries> motionSeries(const SeriesTools&);      ///< the same, for a moving view
std::optional<StudySeries> iorSeries(const SeriesTools&);         ///< forms of the reflectance
std::optional<StudySeries> lightSeries(const SeriesTools&);       ///< programs
std::optional<StudySeries> resolutionSeries(const SeriesTools&);  ///< programs; only times
/// For built-in spheres, whatever the scene:
std::optional<StudySeries> incidenceSeries(const SeriesTools&);  ///< Blinn-Phong against Phong
std::optional<StudySeries> finenessSeries(const SeriesTools&);   ///< against the true sphere
/// distanceSeries() and motionSeries() for a built-in sphere with a normal map.
std::optional<StudySeries> bumpsSeries(const SeriesTools&);
std::optional<StudySeries> bumpsMotionSeries(const SeriesTools&);

inline bool anyItem(const SeriesTools& tools, const Look& look, bool Variant::*feature) {
  return anyHas(makeDrawList(tools.scene.scene, tools.scene.bounds, look), feature);
}

inline SeriesPoint pointOf(double x, const PictureError& error) {
  return {x, error.max, error.rmse, error.relativeRmse};
}

/// Sets the orders of convergence of a series whose x is a length, from the last two points of each
/// line.
void setOrders(StudySeries& series);

/// Compares the scene drawn by the variants it needs with the scene drawn by variants with every
/// feature of the program.
std::vector<Specialisation> specialisations(const SeriesTools&);

}  // namespace glint
