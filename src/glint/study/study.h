#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "glint/gl/context.h"
#include "glint/study/frame_parts.h"
#include "glint/study/frame_times.h"
#include "glint/study/front.h"
#include "glint/study/picture_error.h"
#include "glint/study/variants.h"
#include "glint/study/whole_picture.h"

// Speed against error: how long each way of shading a scene takes with this driver, and how far its
// picture is from the exact one.
namespace glint {

struct StudyOptions {
  Look look;           ///< without anti-aliasing
  StudyFilter filter;  ///< with a filter there are no series
  int warmUp = 10;     ///< rounds that are not counted
  int rounds = 60;     ///< frames of each variant
  int builds = 6;      ///< builds of each program, which share the rounds
  /// The clock that decides; empty: the GPU's if there is one, otherwise the wall clock.
  std::optional<FrameClock> clock;
  double spreadLimit = largestSpread;  ///< with a larger spread there are no fronts
  bool quick = false;                  ///< series with fewer points
  int truthSamples = 8;  ///< N of N x N samples a pixel of the supersampled truth; even, 0 for none
  bool keepPictures = false;
};

/// The difference of a variant from the exact form of a model.
struct VariantError {
  Shading against = Shading::phong;
  PictureError whole;
  double flip = 0;
};

struct VariantResult {
  StudyVariant variant;
  std::vector<std::string> features;  ///< of the scene's variants together
  double compile = 0;                 ///< ms of GL's compiler
  double firstFrame = 0;  ///< ms of the first frame, in which a software driver compiles
  FrameTimes times;
  /// The first is against its own model; blinn-phong's second is its distance from phong.
  std::vector<VariantError> errors;
  /// Parts of the first error: that of form and rounding, given what the driver interpolated, and
  /// that of the interpolation. For flat and gouraud the latter is due to interpolating light
  /// instead of the normal.
  PictureError shading, interpolation;
  std::optional<WholeError> whole;  ///< against its own model, supersampled
};

/// A PNG file of the report's page: "picture-I" of a variant, "error-I-MODEL", "truth-MODEL".
struct PagePicture {
  std::string id;
  std::vector<std::byte> png;
};

/// The time of a frame of the same target without shading.
struct StudyFloor {
  std::string name;  ///< "empty": cleared only; "constant": the same surface in one colour
  FrameTimes times;
};

/// Time against one metric of the error, among the variants that approximate one model.
struct StudyFront {
  Shading model = Shading::phong;
  std::string metric;              ///< a name of errorMetrics()
  std::vector<int> variants;       ///< indices
  std::vector<FrontPlace> places;  ///< of those; dominatedBy is an index into `variants`
};

struct SeriesPoint {
  double x = 0;
  double max = 0, rmse = 0, relativeRmse = 0;
  double milliseconds = 0;  ///< median of a frame; 0 where it was not measured
};

struct SeriesLine {
  std::string name;
  std::vector<SeriesPoint> points;
  double orderMax = 0, orderRmse = 0;  ///< of the last step, where the series has orders
};

struct StudySeries {
  std::string name, title, axis;
  std::string note;  ///< what is compared with what
  bool logarithmic = true, hasErrors = true, hasOrders = false;
  std::vector<SeriesLine> lines = {};
};

/// Model and look drawn by shaders that contain what they need, and by ones that contain
/// everything.
struct Specialisation {
  std::string program;
  double compile = 0, generalCompile = 0, first = 0, generalFirst = 0;  ///< ms
  FrameTimes times, generalTimes;
  double difference = 0;  ///< the largest between the two pictures
};

/// How repeatable a clock's times are, from variants measured twice with programs built separately.
struct ClockNoise {
  std::vector<TimeRatio> ratios;  ///< of the second measurement to the first
  double spread = 0;              ///< noise floor of a ratio of times; 0 if there is no such clock
};

struct StudyResult {
  bool complete = false;
  std::vector<std::string> missing;  ///< what was left out when it ended early
  GlStrings gl;
  std::size_t triangles = 0, draws = 0;
  std::vector<double> exponents;  ///< Phong's, of the materials that have a highlight; ascending
  StudyMask mask;                 ///< of the variants' pictures
  std::vector<VariantResult> variants;
  std::vector<StudyFloor> floors;
  std::vector<std::string> controls;          ///< variants measured twice
  std::array<ClockNoise, frameClocks> noise;  ///< by clock, of the controls
  FrameClock clock = FrameClock::wall;        ///< the one that decides
  double spreadLimit = largestSpread;
  std::string noFront;  ///< why there is no front, and what to do; empty if there may be one
  std::vector<StudyFront> fronts;
  std::vector<StudySeries> series;
  std::vector<Specialisation> specialisations;
  std::vector<WholeTruth> wholeTruths;  ///< by model, without their pictures
  std::vector<StudyWay> ways;
  std::vector<FramePart> parts;       ///< of a frame of the look's model in the exact form
  std::vector<StudyFront> wayFronts;  ///< of `ways`, by the RMSE of the whole picture
  std::vector<PagePicture> pictures;  ///< if they are kept

  /// The spread of the clock that decides.
  double spread() const { return noise[std::size_t(clock)].spread; }
};

/// The clock that decides: the one asked for, otherwise the GPU's if it works, otherwise the wall
/// clock. Throws InputError if the one asked for does not work with this driver.
FrameClock clockFor(std::optional<FrameClock> asked, std::string_view renderer, bool hasGpuTimer);

/// Why there are no fronts with this clock, and what to do; empty if there are.
std::string whyNoFront(const std::array<ClockNoise, frameClocks>& noise, FrameClock clock,
                       double spreadLimit);

/// Receives what is being done and what share of it is done, [0, 1].
using StudyProgress = std::function<void(std::string_view what, double share)>;

/// max, p999, rmse, relative-rmse, flip: the metrics that fronts are made for.
const std::vector<std::string>& errorMetrics();
double metricOf(const VariantError& error, const std::string& metric);

/// The error of a variant against a model, null if it approximates another.
const VariantError* errorAgainst(const VariantResult& variant, Shading model);

/// Milliseconds of a frame in the exact form of phong, in the current context.
double exactFrame(const StudyScene& scene, const Look& look);

/// Studies a scene in the current context. `stop` ends it early with the results so far.
StudyResult study(const StudyScene& scene, const StudyOptions& options, const Stop& stop,
                  const StudyProgress& progress);

}  // namespace glint
