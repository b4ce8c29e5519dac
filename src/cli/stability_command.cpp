
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "commands.h"
#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/report_page.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"
#include "glint/stability/plots.h"
#include "glint/stability/profile.h"
#include "glint/stability/search.h"
#include "glint/stability/suite.h"
#include "status_line.h"

namespace glint {

extern const ReportPage stabilityPage;

namespace {

using Json = nlohmann::ordered_json;

struct StabilityOptions {
  std::string backend = "auto", json, glsl, output, highlight, fresnel, schlickExponent;
  stability::Selection selection;
  double search = 0;
  bool list = false;
};

Look formsOf(const StabilityOptions& options) {
  Look forms;
  const std::pair<const char*, const std::string*> given[] = {
      {"highlight", &options.highlight},
      {"fresnel", &options.fresnel},
      {"schlick-exponent", &options.schlickExponent}};
  for (const auto& [name, text] : given)
    if (!text->empty()) setParameter(forms, name, *text);
  return forms;
}

int runStability(const StabilityOptions& options) {
  if (options.list) {
    std::cout << stability::listText(options.selection);
    return done;
  }
  if (options.backend == "reference")
    throw InputError(
        "--rendering-backend reference: the suite tests a driver: give auto, egl, "
        "egl-software or osmesa");
  const Backend backend = backendFromName(options.backend);
  options.selection.check();
  const Look forms = formsOf(options);
  // Before the work, so that an output that cannot be written is reported at once.
  std::optional<OutputFolder> folder;
  std::optional<OutputFile> jsonFile, page;
  if (!options.json.empty()) jsonFile.emplace(options.json);
  if (!options.output.empty()) {
    folder.emplace(options.output);
    page.emplace((std::filesystem::path(options.output) / "stability.html").string());
  }
  GlslSources sources = options.glsl.empty() ? GlslSources() : GlslSources(options.glsl);

  const auto context = openContext(backend);
  context->makeCurrent();
  if (!context->remark().empty()) printWarning(context->remark());
  const GlStrings gl = glStrings();
  const std::string highlight = highlightText(forms.highlight), fresnel(fresnelText(forms.fresnel));
  std::vector<stability::CaseResult> results;
  std::vector<stability::Quality> profile;
  std::optional<stability::SearchReport> search;
  Json plots = Json::array();
  {
    stability::Bench bench(forms, std::move(sources), setParameter);
    StatusLine line;
    const auto show = [&](double share, const std::string& what) {
      line.show("stability", share, what);
    };
    results = stability::runCases(
        bench, options.selection, [&](double share, const stability::Case& item) {
          show(share, std::string(item.id) + "  " + std::string(item.input));
        });
    if (options.selection.isAll()) {
      show(1, "profile of the driver");
      profile = stability::measureProfile(bench);
    }
    if (options.search > 0) {
      search = stability::searchNotFinite(bench, std::uint64_t(options.search),
                                          [&](double share) { show(share, "search"); });
    }
    if (!options.output.empty()) {
      show(1, "plots");
      plots = stability::plotsJson(bench);
    }
  }
  const bool passed = stability::allPassed(results) && (!search || search->notFinite == 0);
  if (options.json != "-") {
    std::cout << backendName(context->backend()) << ": " << gl.renderer << ", " << gl.version
              << "\n--highlight " << highlight << " --fresnel " << fresnel << "\n";
    if (!profile.empty()) std::cout << stability::profileText(profile);
    if (search) std::cout << stability::searchText(*search);
    std::cout << stability::summaryText(results);
  }
  if (!jsonFile && !page) return passed ? done : differs;
  Json report{{"glint", GLINT_VERSION},
              {"backend", backendName(context->backend())},
              {"gl", {{"vendor", gl.vendor}, {"renderer", gl.renderer}, {"version", gl.version}}},
              {"highlight", highlight},
              {"fresnel", fresnel},
              {"passed", passed},
              {"groups", Json::object()},
              {"cases", stability::casesJson(results)},
              {"profile", stability::profileJson(profile)}};
  if (search) report["search"] = stability::searchJson(*search);
  for (const stability::Group& group : stability::groups())
    report["groups"][std::string(1, group.letter)] = group.name;
  if (jsonFile) commitText(*jsonFile, report.dump(2) + "\n");
  if (page) {
    report["plots"] = plots;
    page->write(stabilityPage.begin);
    page->write(jsonElement("data", report.dump()));
    commitText(*page, stabilityPage.end);
  }
  return passed ? done : differs;
}

}  // namespace

Command addStability(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("stability", "run the hard numerical cases on this machine's driver");
  command->footer(examples({"stability", "stability --list", "stability --group D --highlight pow",
                            "stability --output report"}));
  auto options = std::make_shared<StabilityOptions>();
  const auto text = [&](const char* name, std::string& value, const char* type, const char* help) {
    addOption(*command, name, value, type, help)->take_last();
  };
  text("--rendering-backend", options->backend, "auto|egl|egl-software|osmesa",
       "the driver to test [default: auto]");
  text("--highlight", options->highlight, "FORM", "form of the lobe to test [default: exact]");
  text("--fresnel", options->fresnel, "FORM", "form of the reflectance to test [default: exact]");
  text("--schlick-exponent", options->schlickExponent, "X",
       "exponent of Schlick's approximation [default: 5]");
  addList(*command, "--case", options->selection.ids, "ID", "run only this case; repeatable");
  addList(*command, "--group", options->selection.groups, "X", "run only this group; repeatable");
  addNumber(*command, "--search", options->search, "COUNT", 1.0, 1e12,
            "also test COUNT random points in every program (and draw COUNT/10000 random scenes, "
            "half of them pathological) and fail if anything is NaN or infinite; 1e8 takes "
            "minutes")
      ->take_last();
  command->add_flag("--list", options->list, "list the cases instead of running them");
  text("--output", options->output, "DIR",
       "write stability.html, a page with plots of this driver, into this folder");
  text("--json", options->json, "FILE", "write the report as JSON; - is stdout");
  text("--glsl", options->glsl, "DIR",
       "use the shader files in this folder instead of the built-in ones");
  return [options] { return runStability(*options); };
}

}  // namespace glint
