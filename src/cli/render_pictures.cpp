#include "render_pictures.h"

#include <cmath>

#include "commands.h"
#include "glint/budget/error_budget.h"
#include "glint/image/clock.h"
#include "glint/image/compare.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/exit_status.h"
#include "glint/options/parameters.h"
#include "glint/options/picture_text.h"
#include "interrupt.h"
#include "report.h"
#include "term_files.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;
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
  } catch (const std::exception& error) {
    const bool missing = isMissing(picture.reference);
    fail(result,
         missing ? printablePath(picture.reference) + ": no such picture to compare with: use " +
                       printablePath(picture.output) + " if it is correct"
                 : failureOf(error, picture.reference),
         missing ? noBaseline : unusable);
    return;
  }
  try {
    CompareOptions how;
    how.metrics = {"flip", "max"};
    if (options.referenceThreshold) how.conditions = {{"flip", *options.referenceThreshold}};
    const StoredImage drawn = readStoredImage(picture.output);
    if (drawn.isEncoded() != reference->isEncoded())
      throw InputError(printablePath(picture.output) + " and " + printablePath(picture.reference) +
                       ": one is sRGB, the other linear light: give --reference a picture of the "
                       "kind that -o names");
    const Comparison found = compare(*reference, drawn, how);
    comparison["same"] = found.same;
    comparison["flip"] = found.values.at("flip");
    comparison["max"] = found.values.at("max");
    if (!found.same)
      fail(result,
           printablePath(picture.output) + ": differs from " + printablePath(picture.reference) +
               ": mean FLIP " + std::to_string(found.values.at("flip")) + ": see glint diff",
           differs);
  } catch (const std::exception& error) {
    fail(result, failureOf(error, picture.output));
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
        run_.encoder.then([&run = run_, planned = model_.pictures[i], result]() mutable {
          compareWithReference(run.options, planned, result);
          run.report.add(std::move(result));
        });
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
        drawInto(planned, start);
        return;
      } catch (const std::exception& failure) {
        error = failureOf(failure, planned.output);
      }
    }
    PictureResult result = resultFor(model_, planned);
    fail(result, error);
    result.errorIsNew = error != lastError_;
    lastError_ = error;
    hand(std::move(result));
  }

  void drawInto(const PlannedPicture& planned, Clock::time_point start) {
    pose(planned);
    const Look asked = lookOf(planned, run_.options, model_.look, model_);
    checkMaterialNames(model_.scene, asked);
    const auto choosing = Clock::now();
    const ResolvedLook& resolved = choiceFor(planned, asked);
    const double chooseTime = since(choosing);
    const Look look = withChoice(asked, resolved);
    if (run_.saveResolved) run_.saveResolved(look);
    const auto source = run_.sweeps.empty()
                            ? stage_->picture(look)
                            : std::make_unique<ContactSheet>(*stage_, run_.sweeps, look);
    PictureOptions file = pictureOptions(run_.options, planned.output);
    file.alpha = look.noBackground && file.format->hasAlpha;
    file.exposureScale = float(std::exp2(look.exposure));
    file.text = pictureText(look, model_.look,
                            {model_.hash, run_.gl, run_.options.bitDepth, planned.variation});
    const auto out = std::make_shared<OutgoingPicture>();
    PictureResult result = resultFor(model_, planned);
    if (run_.options.terms)
      drawTerms(planned, look, *source, file, *out, result);
    else
      drawRows(planned, *source, file, out);
    if (Interrupt::signal() != 0) return;
    for (std::string& warning : stage_->takeWarnings()) {
      result.news.push_back(model_.entry.model + ": " + warning);
      result.warnings.push_back(std::move(warning));
    }
    for (std::string& remark : formatRemarks(planned, look)) {
      if (!told_) result.news.push_back(planned.output + ": " + remark);
      result.warnings.push_back(planned.output + ": " + remark);
    }
    const RenderTimes times = source->times();
    result.entry["triangles"] = triangleCount(model_.scene, source->list());
    result.entry["draws"] = drawCalls(source->list().items).size();
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
                                     {"choose", chooseTime},
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

  // Where a picture's format differs from what its name or its look asks for.
  std::vector<std::string> formatRemarks(const PlannedPicture& planned, const Look& look) const {
    std::vector<std::string> remarks;
    const PictureFormat& format = *pictureOptions(run_.options, planned.output).format;
    if (run_.options.formatName.empty() && planned.output != "-" &&
        !pictureFormatOf(planned.output))
      remarks.push_back("its extension is not that of a picture format: written as " +
                        std::string(format.name));
    // Whoever writes PFM wants three numbers per pixel.
    if (look.noBackground && !format.hasAlpha && !format.isFloat)
      remarks.push_back("a " + std::string(format.name) +
                        " has no transparency: transparent parts become black");
    return remarks;
  }

  // One choice for all pictures of a sequence, so that neither forms nor program change between
  // them. Other shards of it make the same choice.
  const ResolvedLook& choiceFor(const PlannedPicture& planned, const Look& asked) {
    if (choice_) return *choice_;
    const std::size_t count = run_.options.hasFrames() ? run_.options.frameCount() : 1;
    if (count == 1 || !(asked.maxError || asked.shading == Shading::automatic))
      return choice_.emplace(resolveLook(model_.scene, model_.bounds, asked));
    choice_ = resolveSequence(count, [&](std::size_t frame) -> LookAtScene {
      PlannedPicture each = planned;
      each.frame = frame;
      if (model_.file) poseScene(each);
      return {model_.scene, model_.bounds, lookOf(each, run_.options, model_.look, model_)};
    });
    if (model_.file) pose(planned);
    return *choice_;
  }

  void poseScene(const PlannedPicture& planned) {
    PoseRequest request = poseOf(model_.look);
    request.time = model_.duration * double(planned.frame) / run_.options.frames;
    model_.file->pose(model_.scene, request);
    model_.bounds = boundsOf(model_.scene);
  }

  // In a sequence over an animation, the scene is uploaded anew for each picture.
  void pose(const PlannedPicture& planned) {
    if (model_.file) {
      stage_.reset();
      poseScene(planned);
    }
    if (!stage_) stage_.emplace(run_.renderer, model_);
  }

  void drawRows(const PlannedPicture& planned, PictureSource& source, const PictureOptions& file,
                const std::shared_ptr<OutgoingPicture>& out) {
    const glm::ivec2 size = source.size();
    out->writer = openPictureWriter(planned.output, size.x, size.y, file);
    int rowsDone = 0;
    for (;;) {
      Image rows = run_.encoder.takeImage();
      if (!source.draw(rows)) return;
      rowsDone += rows.height;
      if (model_.pictures.size() == 1)
        run_.line.show(planned.output + ": " + std::to_string(100LL * rowsDone / size.y) + " %");
      if (Interrupt::signal() != 0 || !run_.encoder.write(out, std::move(rows))) return;
    }
  }

  // All layers of a file are written at once, so all of them are kept until then.
  void drawTerms(const PlannedPicture& planned, const Look& look, PictureSource& source,
                 const PictureOptions& file, OutgoingPicture& out, PictureResult& result) {
    const auto drawn = std::make_shared<DrawnTerms>();
    drawn->picture = {source.size().x, source.size().y, {}};
    for (Image rows; source.draw(rows);) {
      auto& values = drawn->picture.values;
      values.insert(values.end(), rows.values.begin(), rows.values.end());
    }
    Json& names = result.entry["terms"] = Json::object();
    for (const PictureTerm& term : termsOf(source.list(), look)) {
      if (Interrupt::signal() != 0) return;
      run_.line.show(planned.output + ": " + term.name);
      drawn->terms.emplace_back(term, stage_->term(look, term));
      names[term.name] = termOutput(planned.output, *file.format, term);
    }
    out.whole = [drawn, file, output = planned.output] { return writeTerms(output, *drawn, file); };
  }

  // Runs in the encoder's thread.
  static void finish(RenderRun& run, OutgoingPicture& out, const PlannedPicture& planned,
                     PictureResult result, const std::function<double()>& total) {
    const auto start = Clock::now();
    std::size_t nan = 0;
    try {
      if (out.whole) nan = out.whole();
      if (out.writer && out.error.empty()) out.writer->finish();
    } catch (const std::exception& error) {
      out.error = failureOf(error, planned.output);
    }
    if (out.writer) nan = out.writer->nanPixels();
    out.writer.reset();
    out.whole = nullptr;
    out.encodeTime += since(start);
    if (nan > 0) {
      const std::string warning = planned.output + ": " + std::to_string(nan) +
                                  " pixels are not numbers and are drawn black: please report this "
                                  "model";
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
  std::optional<ResolvedLook> choice_;
  bool told_ = false;  ///< the model's warnings and times, reported with its first picture
};

}  // namespace

void drawModel(RenderRun& run, LoadedModel model) { ModelDrawing(run, std::move(model)).draw(); }

}  // namespace glint
