#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "glint/gl/mediump.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"
#include "glint/options/read_options.h"
#include "glint/scene/look_text.h"
#include "glint/study/cost_measurement.h"
#include "glint/study/half_forms.h"
#include "glint/study/page.h"
#include "glint/study/results.h"
#include "interrupt.h"
#include "status_line.h"
#include "stdin_model.h"

namespace glint {
namespace {

struct StudyArguments {
  std::string model, output, json, markdown, costs, half, command, backend = "auto", clock = "auto";
  bool quick = false;
  int repetitions = 0;
  double timeBudget = 0;
  double spreadLimit = 100 * largestSpread;  ///< percent
  bool resolutionGiven = false;
  bool stdoutTaken = false;  ///< by an output file "-"
  StudyFilter filter;
};

constexpr int quickRounds = 30, fullRounds = 60, quickSize = 512;
/// If a frame of exact phong takes longer than this (ms), the study uses half the width and height
/// and fewer rounds: such frames are dominated by shading.
constexpr double quickLongFrame = 15, fullLongFrame = 50;
constexpr int longRounds = 36;
constexpr int quickTruth = 4, fullTruth = 8;  ///< N x N samples per pixel of the second truth
constexpr int quickBuilds = 4, fullBuilds = 6, roundsOfBuild = 5;  ///< most builds, least rounds

/// A study takes single samples; sets what the given look leaves open.
Look studyLook(const StudyArguments& given, Look look) {
  if (look.antiAliasing != AntiAliasing{} && look.antiAliasing.mode != AntiAliasing::Mode::none)
    throw InputError("--anti-aliasing: a study compares single samples: leave it out or give none");
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  look.noBackground = true;
  if (given.quick && !given.resolutionGiven && look.resolution == Look{}.resolution)
    look.resolution = {quickSize, quickSize};
  return look;
}

/// The command line as given.
std::string commandLine(const CLI::App& command) {
  std::string line = "glint " + command.get_name();
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    if (option->get_items_expected_max() == 0) {
      line += " --" + option->get_lnames().front();
      continue;
    }
    for (const std::string& value : option->results())
      line += (option->get_positional() ? " " : " --" + option->get_lnames().front() + " ") + value;
  }
  return line;
}

int runStudy(const StudyArguments& given, const Look& givenLook) {
  if (given.backend == "reference")
    throw InputError(
        "--rendering-backend reference: a study measures GL against the reference: "
        "give another");
  const Backend backend = backendFromName(given.backend);
  // Before the work, so that an output that cannot be written is reported at once.
  std::optional<OutputFile> jsonFile, markdownFile;
  if (!given.json.empty()) jsonFile.emplace(given.json);
  if (!given.markdown.empty()) markdownFile.emplace(given.markdown);
  std::optional<OutputFolder> folder;
  if (!given.output.empty()) folder.emplace(given.output);
  StudyOptions options;
  options.keepPictures = !given.output.empty();
  options.look = studyLook(given, givenLook);
  options.truthSamples = given.quick ? quickTruth : fullTruth;
  options.filter = given.filter;
  options.filter.quick = options.quick = given.quick;
  options.rounds = given.repetitions > 0 ? given.repetitions
                   : given.quick         ? quickRounds
                                         : fullRounds;
  constexpr std::array<std::string_view, 1 + frameClocks> clocks{"auto", "wall", "cpu", "gpu"};
  if (const std::size_t clock = parseChoice(given.clock, clocks, "--clock"); clock > 0)
    options.clock = FrameClock(clock - 1);
  options.spreadLimit = given.spreadLimit / 100;
  options.builds =
      std::clamp(options.rounds / roundsOfBuild, 1, given.quick ? quickBuilds : fullBuilds);
  // With the cache, compile times would depend on what was run before.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  auto opening = openContextAsync(backend);
  // Five levels of refinement: triangles of some ten pixels, as in typical models.
  Scene scene = given.model.empty() ? sphereScene(5, sphereMaterial())
                                    : readModelFile(given.model, [&](const std::string& path) {
                                        return loadGltf(path, poseOf(options.look));
                                      });
  if (isStdin(given.model)) scene.name = "stdin";
  checkMaterialNames(scene, options.look);
  const StudyScene prepared(std::move(scene), options.look);
  const auto context = opening.get();
  context->makeCurrent();
  if (!context->remark().empty()) printWarning(context->remark());

  const Interrupt interrupt;
  const auto end = Clock::now() + std::chrono::duration<double>(given.timeBudget);
  const Stop stop = [&] {
    return Interrupt::signal() != 0 || (given.timeBudget > 0 && Clock::now() > end);
  };
  const double longFrame = given.quick ? quickLongFrame : fullLongFrame;
  const bool halved = !given.resolutionGiven &&
                      options.look.resolution == studyLook(given, Look{}).resolution &&
                      exactFrame(prepared, options.look) > longFrame;
  if (halved) {
    options.look.resolution /= 2;
    if (given.repetitions == 0) options.rounds = std::min(options.rounds, longRounds);
  }
  StudyResult result;
  {
    StatusLine line;
    result = study(prepared, options, stop, [&](std::string_view what, double share) {
      line.show("glint study", share, what);
    });
  }
  for (const std::string& warning : prepared.scene.warnings)  // after all errors
    printWarning((given.model.empty() ? "sphere" : nameOf(given.model)) + ": " + warning);
  StudyHead head;
  head.version = GLINT_VERSION;
  head.model = given.model.empty() ? "sphere (built in)" : nameOf(given.model);
  head.backend = backendName(context->backend());
  head.quick = given.quick;
  head.look = options.look;
  head.lookText = saveLook(options.look);
  head.rounds = options.rounds;
  head.warmUp = options.warmUp;
  head.builds = options.builds;
  head.longFrame = halved ? longFrame : 0;
  if (!given.stdoutTaken) std::cout << studyTable(head, result);
  const auto json = studyJson(head, result);
  const std::string jsonText =
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (jsonFile) commitText(*jsonFile, jsonText);
  if (markdownFile) commitText(*markdownFile, studyResults(head, result, given.command));
  if (!given.output.empty()) {
    writeText(given.output + "/study.json", jsonText);
    writeText(given.output + "/study.csv", studyCsv(result));
    writeText(given.output + "/study.svg", studyPlot(json));
    writeText(given.output + "/study.html", studyPage(json, result));
  }
  return done;
}

/// For a mode that needs neither model nor look: refuses all options except `allowed`.
void refuseOthers(const CLI::App& command, const std::string& mode, const std::string& allowed) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_positional() && option->get_lnames().empty()
                                 ? option->get_name()
                                 : "--" + option->get_lnames().front();
    if (name != mode && name != allowed)
      throw InputError(mode + ": measures only the forms, independently of model and look: leave " +
                       name + " out");
  }
}

/// Reports whether this driver computes `mediump` in 16 bits, as the table does.
std::string driversHalves() {
  try {
    const MediumpReport driver = mediumpOfDriver();
    return "This driver, " + driver.renderer + ", computes `mediump` " +
           (driver.isHalf ? "in 16 bits: the table shows the resulting errors.\n"
                          : "in more than 16 bits: these errors do not occur here.\n");
  } catch (const ContextError& error) {
    return "No OpenGL ES 3 here to show how a driver computes `mediump`: " +
           std::string(error.what()) + ".\n";
  }
}

int runHalfPrecision(const StudyArguments& given, const CLI::App& command) {
  refuseOthers(command, "--half-precision", "");
  OutputFile file(given.half);
  commitText(file, halfTable() + "\n" + driversHalves());
  return done;
}

int runMeasureCosts(const StudyArguments& given, const CLI::App& command) {
  refuseOthers(command, "--measure-costs", "--rendering-backend");
  if (given.backend == "reference")
    throw InputError(
        "--rendering-backend reference: costs can only be measured on a driver: give another");
  const Backend backend = backendFromName(given.backend);
  OutputFile file(given.costs);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  const auto context = openContext(backend);
  context->makeCurrent();
  if (!context->remark().empty()) printWarning(context->remark());
  const Interrupt interrupt;
  CostMeasurement measured;
  {
    StatusLine line;
    measured = measureCosts(
        {}, [] { return Interrupt::signal() != 0; },
        [&](std::string_view what, double share) { line.show("glint study", share, what); });
  }
  if (!measured.complete) {
    std::cerr << "glint: stopped before everything was measured: no table was written\n";
    return 128 + Interrupt::signal();
  }
  constexpr double muchNoise = 10;
  if (measured.file.noise > muchNoise)
    printWarning("--measure-costs: the machine is busy, and costs are uncertain by up to " +
                 std::to_string(std::lround(measured.file.noise)) +
                 " hundredths: measure again when it is idle");
  commitText(file, costFileText(measured.file));
  if (given.costs != "-") std::cout << costText(measured);
  return done;
}

}  // namespace

Command addStudy(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "study", "measure speed and error of every way of shading a model on this driver");
  command->footer(examples({"study --quick --output report", "study helmet.glb --output report",
                            "study --measure-costs costs.json"}));
  auto given = std::make_shared<StudyArguments>();
  command->add_option("MODEL", given->model,
                      "a glTF 2.0 model, .gltf or .glb; - is stdin [default: a sphere]");
  command->add_flag("--quick", given->quick,
                    "study fewer pixels (512 x 512), forms and frames, in less than a minute on "
                    "two cores");
  addNumber(*command, "--repetitions", given->repetitions, "N", 1, 100000,
            "number of frames measured for each variant, after 10 that are not [default: 60; with "
            "--quick 30]");
  addNumber(*command, "--time-budget", given->timeBudget, "SECONDS", 0.001, 1e6,
            "stop after this time (like Ctrl-C) and report what has been measured and "
            "what is missing");
  addOption(*command, "--clock", given->clock, "auto|wall|cpu|gpu",
            "clock for comparing times: wall, the time until a frame is done; cpu, the "
            "time that all threads ran meanwhile, which on a software driver is hardly "
            "affected by other programs; gpu, the GPU's own timer; auto is gpu if a GPU "
            "draws, else wall [default: auto]")
      ->take_last();
  addNumber(*command, "--spread-limit", given->spreadLimit, "PERCENT", 0.0, 1e6,
            "report no front if the same program measured twice differs by more than this "
            "[default: 10]");
  addOption(*command, "--rendering-backend", given->backend, "auto|egl|egl-software|osmesa",
            "how to open GL; auto tries egl, then osmesa [default: auto]")
      ->take_last();
  addOption(*command, "--output", given->output, "DIR",
            "write study.html (a page), study.svg (its plot), study.json and study.csv into "
            "this folder")
      ->take_last();
  addOption(*command, "--markdown", given->markdown, "FILE",
            "write the study's questions and answers, with figures, to this file");
  addDecodeLimitOption(*command);
  addOption(*command, "--json", given->json, "FILE", "write the whole result as JSON; - is stdout");
  addOption(*command, "--measure-costs", given->costs, "FILE",
            "instead of a study, measure the cost of each form on this driver (less than a "
            "minute) and write the table that --cost-table reads; - is stdout")
      ->take_last();
  addOption(*command, "--half-precision", given->half, "FILE",
            "instead of a study, compute the error of each highlight form in half floats "
            "(for all possible inputs) and write the table; - is stdout")
      ->take_last();
  auto look = addLookOptions(*command);
  return [given, look, command] {
    if (!given->half.empty()) return runHalfPrecision(*given, *command);
    if (!given->costs.empty()) return runMeasureCosts(*given, *command);
    std::vector<OutputOption> outputs{
        {"--json", given->json}, {"--markdown", given->markdown}, {"--save-look", look.saveFile()}};
    for (const char* name : {"/study.json", "/study.csv", "/study.svg", "/study.html"})
      if (!given->output.empty()) outputs.push_back({"--output", given->output + name});
    given->model = localPath(given->model);
    checkOutputs(outputs, {given->model});
    for (const std::string& path : {given->json, given->markdown, look.saveFile()})
      given->stdoutTaken = given->stdoutTaken || path == "-";
    const Look asked = look();
    const auto only = [&](const char* name) {
      const CLI::Option* option = command->get_option(std::string("--") + name);
      return option->count() > 0 ? option->results().back() : std::string();
    };
    given->filter = {only("shading"), only("highlight"), only("fresnel"), false};
    if (given->filter.shading == "auto") given->filter.shading.clear();  // chosen among all
    given->command = commandLine(*command);
    given->resolutionGiven = command->get_option("--resolution")->count() > 0;
    return runStudy(*given, asked);
  };
}

}  // namespace glint
