#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>
#include <future>
#include <memory>

#include "commands.h"
#include "glint/gl/context.h"
#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/options/help.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"
#include "interrupt.h"
#include "render_pictures.h"

namespace glint {
namespace {

std::unique_ptr<ModelList> listOf(const RenderOptions& options) {
  return options.hasList() ? std::make_unique<ModelList>(options.list)
                           : std::make_unique<ModelList>(options.models);
}

std::string signalText(int number, const RenderReport& report, std::optional<std::size_t> all) {
  std::string text = number == SIGINT ? "stopped by an interrupt: " : "stopped by a signal: ";
  text += std::to_string(report.done());
  if (all) text += " of " + std::to_string(*all);
  return text + " pictures are done; run the same command with --resume to make the others";
}

int render(const RenderOptions& options, const LookSource& makeLook) {
  const auto started = Clock::now();
  checkRenderOptions(options);
  const std::string& saveFile = makeLook.saveFile();
  checkOutputs({{"-o", options.output}, {"--json", options.json}, {"--save-look", saveFile}}, {});
  if (options.hasList()) checkOutputs({{"--from-list", "-"}, {"--save-look", saveFile}}, {});
  const bool reference = options.usesReference();
  const Backend backend =
      reference ? Backend::automatic : backendFromName(options.backend, ", reference");
  const Interrupt interrupt;
  const auto list = listOf(options);
  PicturePlan plan(options, *list);
  plan.noteInputs(!isMissing(options.json) || !isMissing(saveFile));
  const std::vector<Sweep> sweeps(options.sweeps.begin(), options.sweeps.end());
  const Look look = makeLook(reference ? referenceDefaults() : Look{});
  if (reference) checkReferenceAntiAliasing(look.antiAliasing);
  if (makeLook.savesResolved(look) && plan.count() != std::size_t(1))
    throw InputError(
        "--save-look: the forms that --max-error or --shading auto choose differ from picture to "
        "picture: give one model and picture");
  GlslSources sources = options.glsl.empty() ? GlslSources() : GlslSources(options.glsl);

  plan.checkOutputs();
  checkOutputs({{"--json", options.json}, {"--save-look", saveFile}}, {});

  // Loading the driver takes about as long as reading the first model, so both run concurrently.
  std::future<std::unique_ptr<Context>> opening;
  if (!reference) opening = openContextAsync(backend);
  ModelLoader loader(*list, plan, options, look);
  loader.waitForFirst();
  const auto waited = Clock::now();
  const auto context = reference ? nullptr : opening.get();
  StatusLine line;
  std::optional<Renderer> renderer;
  std::optional<GlStrings> gl;
  if (context) {
    context->makeCurrent();
    if (!context->remark().empty()) printWarning(context->remark());
    gl = glStrings();
    renderer.emplace(std::move(sources));
  }
  RenderReport report(options, line);
  report.begin(context ? backendName(context->backend()) : "reference", gl);
  report.expect(plan.count());
  PictureEncoder encoder;
  RenderRun run{options, sweeps, renderer ? &*renderer : nullptr, gl, encoder, report, line};
  if (makeLook.savesResolved(look))
    run.saveResolved = [&](const Look& resolved) { makeLook.saveResolved(resolved); };
  run.contextTime = since(waited);
  run.startTime = since(started);
  while (auto model = loader.next()) drawModel(run, std::move(*model));
  encoder.finish();
  report.finish();
  if (const int number = Interrupt::signal()) {
    line.print("glint: " + signalText(number, report, plan.count()));
    return 128 + number;
  }
  if (report.done() == 0 && plan.count() == std::size_t(0))
    printWarning("no models to draw: the list or its shard is empty");
  return report.status();
}

}  // namespace

Command addRender(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "draw pictures of models, offscreen");
  command->footer(
      examples({"render helmet.glb -o helmet.png",
                "render *.glb -o 'thumbs/{model}.png' --resolution 256,256",
                "render helmet.glb -o red.exr --material color=#c04020,exponent=200",
                "render helmet.glb -o a.png --light directional:1,2,3 --save-look a.json",
                "render helmet.glb -o b.png --look a.json --camera-azimuth-angle 90",
                "render helmet.glb -o 'turn/{frame}.png' --turntable 36",
                "render helmet.glb -o sheet.png --sweep exponent=1:1000:5:log"}));
  auto options = std::make_shared<RenderOptions>();
  addRenderOptions(*command, *options);
  auto look = addLookOptions(*command);
  return [options, look] { return render(*options, look); };
}

}  // namespace glint
