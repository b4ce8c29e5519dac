#include "render_pictures.h"

#include <chrono>
#include <cmath>

#include "commands.h"
#include "glint/image/compare.h"
#include "glint/image/error.h"
#include "glint/render/error_budget.h"
#include "glint/render/picture_text.h"
#include "glint/scene/parameters.h"
#include "interrupt.h"
#include "report.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

PictureResult resultFor(const LoadedModel& model, const PlannedPicture& picture) {
  PictureResult result;
  result.entry = {{"model", model.entry.model}, {"output", picture.output}, {"status", int(done)}};
  result.warnings = model.scene.warnings;
  return result;
}

void fail(PictureResult& result, const std::string& error, int status = unusable) {
  result.entry["status"] = status;
  result.error = error;
}

void compareWithReference(const RenderOptions& options, const PlannedPicture& picture,
                          PictureResult& result) {
  if (picture.reference.empty()) return;
  Json& comparison = result.entry["comparison"] = {{"reference", picture.reference}};
  std::optional<StoredImage> reference;
  try {
    reference = readStoredImage(picture.reference);
  } catch (const InputError& error) {
    const bool missing = !std::filesystem::exists(picture.reference);
    fail(result,
         missing ? picture.reference + ": no such picture to compare with: take " + picture.output +
                       " if it is as it should be"
                 : error.what(),
         missing ? noBaseline : unusable);
    return;
  }
  try {
    CompareOptions how;
    how.metrics = {"flip", "max"};
    if (options.referenceThreshold) how.conditions = {{"flip", *options.referenceThreshold}};
    const Comparison found = compare(*reference, readStoredImage(picture.output), how);
    comparison["same"] = found.same;
    comparison["flip"] = found.values.at("flip");
    comparison["max"] = found.values.at("max");
    if (!found.same)
      fail(result,
           picture.output + ": differs from " + picture.reference + ": mean FLIP " +
               std::to_string(found.values.at("flip")) + ": see glint diff",
           differs);
  } catch (const InputError& error) {
    fail(result, error.what());
  }
}

class ModelDrawing {
 public:
  ModelDrawing(RenderRun& run, LoadedModel model) : run_(run), model_(std::move(model)) {}

  void draw() {
    for (std::size_t i = 0; i < model_.pictures.size(); ++i) {
      if (Interrupt::signal() != 0) return;
      if (model_.present[i]) {
        PictureResult result = resultFor(model_, model_.pictures[i]);
        result.entry["skipped"] = true;
        hand(std::move(result));
        continue;
      }
      draw(model_.pictures[i]);
    }
  }

 private:
  void draw(const PlannedPicture& planned) {
    const auto start = Clock::now();
    std::string error = model_.error;
    if (error.empty()) {
      try {
        if (!stage_) stage_.emplace(run_.renderer, model_);
        drawInto(planned, start);
        return;
      } catch (const Error& failure) {
        error = failure.what();
      } catch (const std::bad_alloc&) {
        error = planned.output + ": out of memory: give a smaller --resolution or model";
      }
    }
    PictureResult result = resultFor(model_, planned);
    fail(result, error);
    result.errorIsNew = error != lastError_;
    lastError_ = error;
    hand(std::move(result));
  }

  void drawInto(const PlannedPicture& planned, Clock::time_point start) {
    const Look asked = lookOf(planned, run_.options, run_.look, model_.scene, model_.bounds);
    checkMaterialNames(model_.scene, asked);
    const ResolvedLook resolved = resolveLook(model_.scene, model_.bounds, asked);
    const Look& look = resolved.look;
    if (run_.saveResolved) run_.saveResolved(look);
    const auto source = stage_->picture(look);
    PictureOptions file;
    file.bitDepth = run_.options.bitDepth;
    file.alpha = look.noBackground;
    file.exposureScale = float(std::exp2(look.exposure));
    file.text = pictureText(look, run_.look,
                            {model_.hash, run_.gl, run_.options.bitDepth, planned.variation});
    const auto out = std::make_shared<OutgoingPicture>();
    const glm::ivec2 size = source->size();
    out->writer = openPictureWriter(planned.output, size.x, size.y, file);
    int rowsDone = 0;
    for (;;) {
      Image rows = run_.encoder.takeImage();
      if (!source->draw(rows)) break;
      rowsDone += rows.height;
      if (model_.pictures.size() == 1)
        run_.line.show(planned.output + ": " + std::to_string(100LL * rowsDone / size.y) + " %");
      if (Interrupt::signal() != 0) return;
      if (!run_.encoder.write(out, std::move(rows))) break;
    }
    PictureResult result = resultFor(model_, planned);
    const RenderTimes times = source->times();
    result.entry["triangles"] = triangleCount(model_.scene, source->list());
    result.entry["draws"] = source->list().items.size();
    result.entry["samples"] = source->samples();
    result.entry["variants"] = variantsJson(model_.scene, source->list(), look);
    if (asked.maxError || !resolved.programReason.empty())
      result.entry["choice"] = choiceJson(resolved, asked);
    const bool first = run_.first, fresh = !told_;
    run_.first = false;
    told_ = true;
    Json& ms = result.entry["ms"] = {{"load", fresh ? model_.loadTime : 0.0},
                                     {"decode", fresh ? model_.decodeTime : 0.0},
                                     {"context", first ? run_.contextTime : 0.0},
                                     {"compile", times.compile},
                                     {"draw", times.draw},
                                     {"read", times.read},
                                     {"encode", 0.0},
                                     {"total", 0.0}};
    const double before =
        first ? run_.startTime : ms["load"].get<double>() + ms["decode"].get<double>();
    for (const std::string& warning : model_.scene.warnings)
      if (fresh) result.news.push_back(model_.entry.model + ": " + warning);
    run_.encoder.then([&run = run_, out, planned, before, start, result = std::move(result)] {
      finish(run, *out, planned, result, [&] { return before + since(start); });
    });
  }

  // In the encoder's thread.
  static void finish(RenderRun& run, OutgoingPicture& out, const PlannedPicture& planned,
                     PictureResult result, const std::function<double()>& total) {
    const auto start = Clock::now();
    try {
      if (out.error.empty()) out.writer->finish();
    } catch (const Error& error) {
      out.error = error.what();
    }
    const std::size_t nan = out.writer->nanPixels();
    out.writer.reset();
    out.encodeTime += since(start);
    if (nan > 0) {
      const std::string warning = planned.output + ": " + std::to_string(nan) +
                                  " pixels are not numbers and are shown black: please report "
                                  "this model";
      result.warnings.push_back(warning);
      result.news.push_back(result.entry["model"].get<std::string>() + ": " + warning);
    }
    if (out.error.empty())
      compareWithReference(run.options, planned, result);
    else
      fail(result, out.error);
    result.entry["ms"]["encode"] = out.encodeTime;
    result.entry["ms"]["total"] = total();
    run.report.add(std::move(result));
  }

  void hand(PictureResult result) {
    if (!told_)
      for (const std::string& warning : model_.scene.warnings)
        result.news.push_back(model_.entry.model + ": " + warning);
    told_ = true;
    run_.encoder.then([&run = run_, result = std::move(result)] { run.report.add(result); });
  }

  RenderRun& run_;
  LoadedModel model_;
  std::optional<Stage> stage_;
  std::string lastError_;
  bool told_ = false;  ///< the model's warnings and times, with its first picture
};

}  // namespace

void drawModel(RenderRun& run, LoadedModel model) { ModelDrawing(run, std::move(model)).draw(); }

}  // namespace glint
