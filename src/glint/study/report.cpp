#include "glint/study/report.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "glint/scene/look_text.h"
#include "glint/study/advice.h"
#include "glint/study/format.h"
#include "glint/study/report_words.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

/// The ways to treat aliasing, against the supersampled picture.
std::string waysTable(const StudyResult& r) {
  std::string table;
  for (const WholeTruth& truth : r.wholeTruths) {
    std::string rows;
    for (std::size_t i = 0; i < r.ways.size(); ++i) {
      const StudyWay& way = r.ways[i];
      if (way.model != truth.model) continue;
      rows += formatted("%-34s %8.3f %8.3f %9.2e %9.2e %9.2e  %s\n", way.name.c_str(),
                        medianOf(way.times.wall), medianOf(way.times.cpu), way.error.inside.max,
                        way.error.inside.rmse, way.error.picture.rmse, wayPlaceWords(r, i).c_str());
    }
    if (rows.empty()) continue;
    const std::string head =
        formatted("against %s of %d x %d samples", std::string(shadingName(truth.model)).c_str(),
                  truth.samples, truth.samples);
    table += formatted("\n%-34s %8s %8s %9s %9s %9s  %s\n", head.c_str(), "ms", "CPU ms", "max in",
                       "rmse in", "rmse all", "front (rmse all)") +
             rows + formatted("itself off by less than rmse %.1e\n", truth.own.rmse);
  }
  return table;
}

}  // namespace

std::vector<std::string> studyMethod(const StudyHead& head, const StudyResult& r) {
  const bool software = drawsOnCpu(r.gl.renderer);
  const char* threads = std::getenv("LP_NUM_THREADS");
  std::vector<std::string> all{
      formatted(
          "Variants, floors and controls alternate, in a different order each round: %d rounds "
          "after %d that are not counted. They are shared by %d builds of all programs, since "
          "where a driver puts one may change how fast it is.",
          head.rounds, head.warmUp, head.builds),
      "wall: from the first GL call of a frame until glFinish returns, nothing read back.",
      "cpu: the time used meanwhile by all threads of the process, user and system (getrusage).",
      software ? "query: GL_TIME_ELAPSED. llvmpipe counts in its rasteriser's threads, separately "
                 "for each tile: only a small part of a frame, so nothing here is judged by it."
               : "query: GL_TIME_ELAPSED, the time of the GPU alone.",
      formatted("Times are compared, and fronts made, by %s.", clockWords(r.clock)),
      formatted("empty: the target is only cleared; constant: the same surface in one colour. ns "
                "per pixel: median above the empty frame, for each of the %zu covered pixels.",
                r.mask.covered),
      formatted("Two times differ only if the 95 %% bootstrap interval of the ratio of their lower "
                "quartiles is farther from 1 than the spread, %.1f %%: the most by which a variant "
                "differs from itself, built and measured twice (A/A). With a spread above %g %% "
                "there is no front.",
                100 * r.spread(), 100 * r.spreadLimit),
      formatted(
          "Errors: linear light before exposure, over %zu pixels, against double precision in the "
          "exact form. Excluded from %zu covered: %zu at edges, %zu covered in only one picture, "
          "%zu that show another or a blended surface.",
          r.mask.pixels.size(), r.mask.covered, r.mask.edge, r.mask.onlyOne, r.mask.other),
      // NOLINTNEXTLINE(bugprone-suspicious-missing-comma)
      "flat, gouraud and phong are compared with phong per pixel, blinn-phong and environment with "
      "themselves, blinn-phong with phong too.",
      "whole: against the exact form supersampled in double, where a surface covers all of a pixel "
      "and of the whole picture: form, interpolation, driver and aliasing together.",
      "shading: form and rounding, given the driver's interpolated values; interpolation: how "
      "those differ from the exact ones (for flat and gouraud: light interpolated instead of "
      "normals)."};
  if (head.longFrame > 0)
    all.push_back(formatted(
        "Half the usual width and height, because a frame of exact phong takes more than %g ms "
        "there.",
        head.longFrame));
  if (r.mask.sampledColors)
    all.emplace_back(
        "The driver's own texture samples are taken as given: their filtering is not an error of "
        "shading.");
  all.push_back(
      formatted("Rasteriser's threads: %s; processors: %u; Mesa's cache of shaders is off.",
                threads ? threads : "the driver's choice", std::thread::hardware_concurrency()));
  return all;
}

std::string studyCsv(const StudyResult& r) {
  std::string csv =
      "variant,against,frames,wall_min_ms,wall_lower_quartile_ms,wall_median_ms,"
      "wall_upper_quartile_ms,cpu_lower_quartile_ms,cpu_median_ms,query_median_ms,ns_per_pixel,"
      "compile_ms,first_frame_ms,max,p999,rmse,"
      "relative_rmse,flip,off_by_more_than_one_level,shading_max,shading_rmse,interpolation_max,"
      "interpolation_rmse,rmse_front,dominated_by\n";
  for (std::size_t i = 0; i < r.variants.size(); ++i) {
    const VariantResult& v = r.variants[i];
    const Spread wall = spreadOf(v.times.wall), cpu = spreadOf(v.times.cpu),
                 query = spreadOf(v.times.query);
    for (const VariantError& e : v.errors) {
      const StudyFront* front = frontOf(r, e.against, "rmse");
      const FrontPlace* place = placeOf(front, i);
      csv += "\"" + v.variant.name + "\"," + std::string(shadingName(e.against)) + "," +
             formatted("%zu,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,", wall.count,
                       wall.minimum, wall.lowerQuartile, wall.median, wall.upperQuartile,
                       cpu.lowerQuartile, cpu.median, query.median, perPixel(r, v.times), v.compile,
                       v.firstFrame) +
             formatted("%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,", e.whole.max, e.whole.percentile999,
                       e.whole.rmse, e.whole.relativeRmse, e.flip, e.whole.offByMore) +
             formatted("%.6g,%.6g,%.6g,%.6g,", v.shading.max, v.shading.rmse, v.interpolation.max,
                       v.interpolation.rmse) +
             (!place ? ","
              : place->onFront
                  ? "yes,"
                  : (place->isSlower ? "no,\"" : "open,\"") + dominator(r, *front, *place) + "\"") +
             "\n";
    }
  }
  return csv;
}

std::string studyTable(const StudyHead& head, const StudyResult& r) {
  std::string table =
      head.model + formatted(": %zu triangles, %zu draws, %d x %d pixels, %zu compared; %s\n",
                             r.triangles, r.draws, head.look.resolution.x, head.look.resolution.y,
                             r.mask.pixels.size(), r.gl.renderer.c_str());
  for (const StudyFloor& floor : r.floors)
    if (!floor.times.wall.empty())
      table += formatted("floor, %-9s %8.3f ms, CPU %8.3f ms\n", floor.name.c_str(),
                         medianOf(floor.times.wall), medianOf(floor.times.cpu));
  if (r.spread() > 0) {
    table += "spread (A/A)   ";
    for (std::size_t c = 0; c < frameClocks; ++c)
      if (r.noise[c].spread > 0)
        table += formatted(" %s %.1f %%", std::string(clockName(FrameClock(c))).c_str(),
                           100 * r.noise[c].spread);
    table += formatted("; compared by %s\n", clockWords(r.clock));
  }
  if (!r.noFront.empty()) table += r.noFront + "\n";
  for (const Shading model : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
    const StudyFront* front = frontOf(r, model, "rmse");
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < r.variants.size(); ++i)
      if (const VariantError* e = errorAgainst(r.variants[i], model))
        order.emplace_back(e->whole.rmse, i);
    if (order.empty()) continue;
    std::sort(order.begin(), order.end());
    int width = 32;
    for (const auto& [rmse, i] : order)
      width = std::max(width, int(r.variants[i].variant.name.size()));
    table +=
        formatted("\n%-*s %8s %17s %8s %7s %9s %9s %9s %9s %7s  %s\n", width,
                  ("against exact " + std::string(shadingName(model))).c_str(), "ms", "quartiles",
                  "CPU ms", "ns/px", "max", "p99.9", "rmse", "flip", ">1 lev", "front (rmse)");
    for (const auto& [rmse, i] : order) {
      const VariantResult& v = r.variants[i];
      const VariantError& e = *errorAgainst(v, model);
      const Spread wall = spreadOf(v.times.wall);
      table += formatted("%-*s ", width, v.variant.name.c_str());
      table += wall.count == 0
                   ? formatted("%8s %17s %8s %7s ", "-", "-", "-", "-")
                   : formatted("%8.3f %8.3f-%8.3f %8.3f %7.2f ", wall.median, wall.lowerQuartile,
                               wall.upperQuartile, medianOf(v.times.cpu), perPixel(r, v.times));
      table +=
          formatted("%9.2e %9.2e %9.2e %9.2e %6.2f%%  %s\n", e.whole.max, e.whole.percentile999,
                    e.whole.rmse, e.flip, 100 * e.whole.offByMore, placeWords(r, front, i).c_str());
    }
  }
  table += waysTable(r);
  if (const std::string advice = adviceText(head, r); !advice.empty())
    table += "\n" + wrapped(advice, 100) + "\n";
  if (!r.complete) {
    table += "\nincomplete: ended before";
    for (const std::string& what : r.missing) table += " " + what + ";";
    table += "\n";
  }
  return table;
}

}  // namespace glint
