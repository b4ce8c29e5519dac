#include "glint/study/report_words.h"

#include <algorithm>

#include "glint/study/format.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

std::string placeText(const FrontPlace& place, const std::string& by) {
  return (place.isSlower ? "by " : "undecided against ") + by;
}

}  // namespace

const char* clockWords(FrameClock clock) {
  return clock == FrameClock::cpu   ? "CPU time"
         : clock == FrameClock::gpu ? "GPU time"
                                    : "wall time";
}

std::string ratioText(const TimeRatio& ratio) {
  return formatted("%.3f (%.3f to %.3f)", ratio.value, ratio.low, ratio.high);
}

double medianOf(const std::vector<double>& times) {
  return times.empty() ? 0 : quantile(times, 0.5);
}

double perPixel(const StudyResult& r, const FrameTimes& times) {
  if (times.wall.empty() || r.floors.empty()) return 0;
  const double above = medianOf(times.by(r.clock)) - medianOf(r.floors[0].times.by(r.clock));
  return above * 1e6 / double(std::max<std::size_t>(1, r.mask.covered));
}

const StudyFront* frontOf(const StudyResult& r, Shading model, const std::string& metric) {
  for (const StudyFront& front : r.fronts)
    if (front.model == model && front.metric == metric) return &front;
  return nullptr;
}

const FrontPlace* placeOf(const StudyFront* front, std::size_t variant) {
  if (!front) return nullptr;
  for (std::size_t i = 0; i < front->variants.size(); ++i)
    if (front->variants[i] == int(variant)) return &front->places[i];
  return nullptr;
}

const StudyFront* wayFrontOf(const StudyResult& r, Shading model) {
  for (const StudyFront& front : r.wayFronts)
    if (front.model == model) return &front;
  return nullptr;
}

std::string dominator(const StudyResult& r, const StudyFront& front, const FrontPlace& place) {
  return r.variants[std::size_t(front.variants[std::size_t(place.dominatedBy)])].variant.name;
}

std::string placeWords(const StudyResult& r, const StudyFront* front, std::size_t variant) {
  const FrontPlace* place = placeOf(front, variant);
  if (!place) return "";
  return place->onFront ? "on the front" : placeText(*place, dominator(r, *front, *place));
}

std::string wayPlaceWords(const StudyResult& r, std::size_t way) {
  const StudyFront* front = wayFrontOf(r, r.ways[way].model);
  const FrontPlace* place = placeOf(front, way);
  if (!place) return "";
  if (place->onFront) return "on the front";
  const int by = front->variants[std::size_t(place->dominatedBy)];
  return placeText(*place, r.ways[std::size_t(by)].name);
}

}  // namespace glint
