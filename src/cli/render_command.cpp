#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "glint/image/picture_writer.h"
#include "glint/render/reference_renderer.h"
#include "glint/render/renderer.h"
#include "glint/scene/gltf.h"
#include "glint/scene/parameters.h"
#include "output_names.h"
#include "report.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct RenderOptions {
  std::vector<std::string> models;
  std::string output, backend = "auto", json, glsl;
  int bitDepth = 8;
  bool antiAliasingGiven = false;
  bool usesReference() const { return backend == "reference"; }
};

/// A model read and decoded, or why it could not be.
struct Loaded {
  Scene scene;
  Bounds bounds;
  DecodedImages images;
  std::string error;
  double loadTime = 0, decodeTime = 0;
};

Loaded load(const std::string& path, const Look& look) {
  Loaded loaded;
  try {
    const auto start = Clock::now();
    loaded.scene = loadGltf(path, poseOf(look));
    loaded.bounds = boundsOf(loaded.scene);
    loaded.loadTime = since(start);
    checkMaterialNames(loaded.scene, look);
    const auto decode = Clock::now();
    loaded.images = decodeImages(loaded.scene, look);
    loaded.decodeTime = since(decode);
  } catch (const InputError& error) {
    loaded.error = error.what();
  } catch (const std::bad_alloc&) {
    loaded.error = path + ": out of memory: the model is too large for this machine";
  }
  return loaded;
}

/// A line on a terminal that says how far a picture is, if it takes more than a second.
class Progress {
 public:
  Progress(const std::string& output, int rows)
      : output_(output), rows_(rows), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~Progress() {
    if (shown_) std::cerr << "\r\033[K";
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(int rows) {
    done_ += rows;
    if (!terminal_ || since(start_) < 1000) return;
    shown_ = true;
    std::cerr << "\r" << output_ << ": " << 100LL * done_ / rows_ << " %\033[K" << std::flush;
  }

 private:
  const std::string& output_;
  int rows_, done_ = 0;
  bool terminal_, shown_ = false;
  Clock::time_point start_ = Clock::now();
};

/// A picture in the making, by GL or, where there is no renderer, by the reference.
class Bands {
 public:
  Bands(Renderer* renderer, Loaded& loaded, const Look& look) : look_(look) {
    if (!renderer) {
      const auto start = Clock::now();
      reference_.emplace(loaded.scene, loaded.images, loaded.bounds, look);
      times_.draw = since(start);
    } else {
      scene_.emplace(loaded.scene, std::move(loaded.images));
      picture_.emplace(
          renderer->begin(*scene_, makeDrawList(loaded.scene, loaded.bounds, look), look));
    }
  }

  /// Draws the next rows from the top; false if there are none left.
  bool draw(Image& rows) {
    if (picture_) {
      if (band_ == picture_->bandCount()) return false;
      picture_->drawBand(rows);
      ++band_;
      return true;
    }
    const int first = reference_->rowsDone();
    if (first == look_.resolution.y) return false;
    const auto start = Clock::now();
    reference_->drawRows(first, std::min(reference_->bandRows(), look_.resolution.y - first), rows);
    times_.draw += since(start);
    return true;
  }

  const DrawList& list() const { return picture_ ? picture_->list() : reference_->list(); }
  const RenderTimes& times() const { return picture_ ? picture_->times() : times_; }
  int samples() const {
    if (look_.antiAliasing.mode == AntiAliasing::Mode::ssaa)
      return look_.antiAliasing.count * look_.antiAliasing.count;
    return picture_ ? picture_->samples() : 1;
  }

 private:
  const Look& look_;
  std::optional<ReferenceRenderer> reference_;
  std::optional<GpuScene> scene_;
  std::optional<Renderer::Picture> picture_;
  int band_ = 0;
  RenderTimes times_;
};

/// Draws one loaded model into its file; fills its entry of the report.
void drawPicture(Renderer* renderer, Loaded& loaded, const Look& look, const RenderOptions& options,
                 const std::string& output, Json& entry) {
  const auto opened = Clock::now();
  Bands bands(renderer, loaded, look);
  PictureOptions file;
  file.bitDepth = options.bitDepth;
  file.alpha = look.noBackground;
  file.exposureScale = float(std::exp2(look.exposure));
  const auto writer = openPictureWriter(output, look.resolution.x, look.resolution.y, file);
  double encode = 0;
  Image rows;
  Progress progress(output, look.resolution.y);
  while (bands.draw(rows)) {
    const auto start = Clock::now();
    writer->write(rows);
    encode += since(start);
    progress.add(rows.height);
  }
  const auto start = Clock::now();
  writer->finish();
  encode += since(start);
  if (writer->nanPixels() > 0)
    loaded.scene.warnings.push_back(output + ": " + std::to_string(writer->nanPixels()) +
                                    " pixels are not numbers and are shown black: please report "
                                    "this model");
  const RenderTimes& times = bands.times();
  entry["triangles"] = triangleCount(loaded.scene, bands.list());
  entry["draws"] = bands.list().items.size();
  entry["samples"] = bands.samples();
  entry["variants"] = variantsJson(loaded.scene, bands.list(), look);
  entry["ms"] = {
      {"load", loaded.loadTime}, {"decode", loaded.decodeTime},
      {"context", 0.0},          {"compile", times.compile},
      {"draw", times.draw},      {"read", times.read},
      {"encode", encode},        {"total", since(opened) + loaded.loadTime + loaded.decodeTime}};
}

int render(const RenderOptions& options, const std::function<Look()>& makeLook) {
  const auto started = Clock::now();
  if (options.output == "-" && options.json == "-")
    throw InputError("-o - and --json -: both would go to stdout: give one of them a file");
  const bool reference = options.usesReference();
  const Backend backend = reference ? Backend::automatic : backendFromName(options.backend);
  PictureOptions file;
  file.bitDepth = options.bitDepth;
  const std::vector<std::string> outputs = outputNames(options.output, options.models);
  for (const std::string& output : outputs) checkPictureName(output, file);
  Look look = makeLook();
  if (reference) {
    if (!options.antiAliasingGiven && look.antiAliasing == AntiAliasing{})
      look.antiAliasing.mode = AntiAliasing::Mode::none;
    checkReferenceAntiAliasing(look.antiAliasing);
  }
  GlslSources sources = options.glsl.empty() ? GlslSources() : GlslSources(options.glsl);

  // Loading the driver and reading the first model take about as long: side by side.
  std::future<std::unique_ptr<Context>> opening;
  if (!reference) opening = openContextAsync(backend);
  auto next = std::async(std::launch::async, load, options.models[0], std::cref(look));
  next.wait();
  const auto waited = Clock::now();
  const auto context = reference ? nullptr : opening.get();
  std::optional<Renderer> renderer;
  Json report{{"glint", GLINT_VERSION}, {"backend", "reference"}};
  if (context) {
    context->makeCurrent();
    if (!context->remark().empty()) printWarning(context->remark());
    const GlStrings gl = glStrings();
    report["backend"] = backendName(context->backend());
    report["gl"] = {{"vendor", gl.vendor}, {"renderer", gl.renderer}, {"version", gl.version}};
    renderer.emplace(std::move(sources));
  }
  const double contextTime = since(waited);
  report["pictures"] = Json::array();
  int status = done;
  for (std::size_t i = 0; i < options.models.size(); ++i) {
    Loaded loaded = next.get();
    if (i + 1 < options.models.size())
      next = std::async(std::launch::async, load, options.models[i + 1], std::cref(look));
    Json entry{{"model", options.models[i]}, {"output", outputs[i]}, {"status", int(done)}};
    if (loaded.error.empty()) {
      try {
        drawPicture(renderer ? &*renderer : nullptr, loaded, look, options, outputs[i], entry);
      } catch (const InputError& error) {
        loaded.error = error.what();
      }
    }
    if (i == 0 && entry.contains("ms")) {
      entry["ms"]["context"] = contextTime;
      entry["ms"]["total"] = since(started);
    }
    for (const std::string& warning : loaded.scene.warnings)
      printWarning(options.models[i] + ": " + warning);
    entry["warnings"] = loaded.scene.warnings;
    if (!loaded.error.empty()) {
      std::cerr << "glint: " << loaded.error << "\n";
      entry["status"] = int(unusable);
      entry["error"] = loaded.error;
      status = unusable;
    }
    report["pictures"].push_back(entry);
  }
  if (!options.json.empty()) writeText(options.json, report.dump(2) + "\n");
  return status;
}

}  // namespace

Command addRender(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "draw pictures of models, offscreen");
  auto options = std::make_shared<RenderOptions>();
  command->add_option("MODEL", options->models, "glTF 2.0 models, .gltf or .glb")->required();
  command
      ->add_option("-o,--output", options->output,
                   "the picture: .png (8 bit sRGB, or 16), .pfm (linear float), - (PNG to stdout); "
                   "{model} and {n} stand for the model's name and number")
      ->type_name("OUT")
      ->required()
      ->take_last();
  command->add_option("--bit-depth", options->bitDepth, "of PNG: 8 or 16 [default: 8]")
      ->type_name("BITS");
  command
      ->add_option("--rendering-backend", options->backend,
                   "what to draw with; auto tries egl, then osmesa; reference is double precision "
                   "on the CPU, without GL [default: auto]")
      ->type_name("auto|egl|egl-software|osmesa|reference")
      ->take_last();
  command->add_option("--json", options->json, "write a report of the run; - is stdout")
      ->type_name("FILE");
  command
      ->add_option("--glsl", options->glsl, "take shader files from this folder where it has them")
      ->type_name("DIR");
  auto look = addLookOptions(*command);
  const CLI::Option* antiAliasing = command->get_option("--anti-aliasing");
  return [options, look, antiAliasing] {
    options->antiAliasingGiven = antiAliasing->count() > 0;
    return render(*options, look);
  };
}

}  // namespace glint
