#include <memory>

#include "commands.h"
#include "diff_options.h"
#include "diff_run.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"

namespace glint {
namespace {

/// The options as given.
struct DiffArguments {
  ComparisonArguments comparison;
  DiffRequest request;
  std::string difference = "flip";
};

/// --update consumes all names that follow it, so if A and B come after it they are its last two.
void takePathsBack(DiffRequest& request) {
  if (!request.testRun.empty()) {
    // Only a folder: names may come before and after it.
    for (const std::string* path : {&request.a, &request.b})
      if (!path->empty())
        throw InputError("--run " + printablePath(request.testRun) + ": leave out " +
                         printablePath(*path) + ": the test results record what was compared");
    return;
  }
  for (std::string* path : {&request.b, &request.a}) {
    if (!path->empty() || request.named.empty()) continue;
    *path = request.named.back();
    request.named.pop_back();
  }
  if (request.a.empty() || request.b.empty())
    throw InputError("diff: give two pictures, or two folders: glint diff A B");
}

int diff(const CLI::App& command, DiffArguments given) {
  DiffRequest& request = given.request;
  takePathsBack(request);
  const std::string output = request.settings.output;
  const double scale = request.settings.scale;
  request.mask = given.comparison.mask;
  request.settings = comparisonSettings(command, given.comparison);
  DiffSettings& settings = request.settings;
  settings.output = output;
  settings.scale = scale;
  settings.difference = DifferenceKind(
      choiceOf(given.difference, {"flip", "absolute", "side-by-side"}, "--difference"));
  settings.allMetrics = !request.json.empty() || !request.junit.empty() || !request.html.empty() ||
                        !request.markdown.empty();
  settings.compare.regions = settings.allMetrics;
  return runDiff(std::move(request));
}

}  // namespace

Command addDiff(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("diff", "compare two pictures, or two folders of them, with baselines");
  command->footer(examples({"diff a.png b.png",
                            "diff a.png b.png --metric flip --threshold 0.05 -o difference.png",
                            "diff a.png b.png --max-pixels 0.1% --ignore-anti-aliasing",
                            "diff baselines pictures --html report.html --junit report.xml",
                            "diff baselines pictures --update"}));
  auto given = std::make_shared<DiffArguments>();
  DiffRequest& request = given->request;
  const auto text = [&](const char* name, std::string& value, const char* type, const char* help) {
    return addOption(*command, name, value, type, help)->take_last();
  };
  command->add_option(
      "A", request.a,
      "the baseline: a PNG, EXR, PFM, HDR, JPEG, WebP, TIFF, PPM, BMP or TGA file, a folder of "
      "them, or - for stdin");
  command->add_option("B", request.b, "the picture or folder to check, or - for stdin");
  addComparisonOptions(*command, given->comparison);
  text("-o,--output", request.settings.output, "FILE", "write a picture of the differences");
  text("--difference", given->difference, "flip|absolute|side-by-side",
       "content of this picture: the FLIP map, |a - b|, or a, b and |a - b| [default: flip]");
  addNumber(*command, "--scale", request.settings.scale, "K", 0.0, 1e6,
            "factor for |a - b| in this picture [default: 1]");
  text("--json", request.json, "FILE", "write all metrics as JSON; - is stdout");
  text("--junit", request.junit, "FILE", "write the results as JUnit XML, for a CI server");
  text("--markdown", request.markdown, "FILE", "write a summary for a merge request; - is stdout");
  text("--html", request.html, "FILE", "write a report as one HTML file");
  command->add_flag("--pictures-beside", request.picturesBeside,
                    "with --html: put the pictures into a folder next to it, FILE.pictures");
  addNumber(*command, "--jobs", request.jobs, "N", 1, 256,
            "number of pairs to compare at the same time [default: the number of processors]");
  text("--conditions", request.conditions, "FILE",
       "file with the conditions of some pairs of folders, in lines PATTERN OPTION... "
       "[default: glint-diff.txt in A]");
  CLI::Option* updating =
      addOption(*command, "--update", request.named, "[NAME...]",
                "replace baselines that B differs from, and create missing ones; for all pairs, or "
                "only for these names, patterns (*, ?) or folders; lists the files written")
          ->expected(0, 1 << 20);
  command->add_flag(
      "--prune", request.pruning,
      "remove baselines without a picture (with --run: those that no test uses); lists the files "
      "removed");
  text("--run", request.testRun, "FOLDER",
       "instead of A and B: report what the tests of glint_add_image_test() left in this folder");
  command->add_flag(
      "--baselines-per-driver", request.perDriver,
      "prefer baselines in a folder driver-NAME in A (next to A if it is a file), with NAME made "
      "from the GL_RENDERER recorded in B");
  return [=] {
    given->request.updating = updating->count() > 0;
    std::erase(given->request.named, "");
    return diff(*command, *given);
  };
}

}  // namespace glint
