#include "diff_run.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "commands.h"
#include "diff_baselines.h"
#include "diff_folders.h"
#include "diff_html.h"
#include "diff_options.h"
#include "diff_test_run.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"
#include "glint/image/task.h"
#include "glint/options/outputs.h"
#include "status_line.h"

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Compares, and returns the JSON of the pairs.
Json comparePairs(const DiffRequest& request, const std::vector<PairConditions>& conditions,
                  DiffHtml* page, std::vector<DiffEntry>& entries) {
  DiffSettings settings = request.settings;
  tellUnused(conditions, entries);
  std::vector<Json> pairs(entries.size());
  const int jobs = std::min(threadsFor(request.jobs), 64);
  if (jobs > 1 && entries.size() > 1) settings.compare.flip.threads = 1;
  StatusLine line;
  std::size_t compared = 0;
  std::mutex mutex;
  inParallel(jobs, entries.size(), [&](std::size_t i, int) {
    if (request.perDriver) useDriverBaseline(request.a, entries[i]);
    PairPictures pictures;
    const DiffSettings own = settingsFor(settings, conditions, entries[i].name);
    diffPair(own, entries[i], page ? &pictures : nullptr);
    pairs[i] = diffJson(entries[i], own.compare);
    const std::lock_guard lock(mutex);
    if (page) page->add(i, entries[i].result.differing > 0, std::move(pictures));
    line.show("comparing", double(++compared) / double(entries.size()), entries[i].name);
  });
  return Json(pairs);
}

/// The most severe status: unusable, then differs, then noBaseline.
int statusOf(const Json& pairs) {
  for (const int status : {int(unusable), int(differs), int(noBaseline)})
    for (const Json& pair : pairs)
      if (pair["status"] == status) return status;
  return done;
}

struct Summary {
  std::size_t same = 0, differ = 0, missing = 0, extra = 0, errors = 0, updated = 0, removed = 0,
              drivers = 0;
  std::map<std::string, std::size_t> notFollowed;

  explicit Summary(const Json& pairs) {
    for (const Json& pair : pairs) {
      const std::string kind = kindOf(pair);
      same += kind == "same";
      differ += kind == "differs";
      missing += kind == "missing";
      extra += kind == "no baseline";
      errors += kind == "error";
      updated += pair.value("updated", false);
      removed += pair.value("removed", false);
      drivers += pair.value("acrossDrivers", false);
      if (const auto found = pair.find("notFollowed"); found != pair.end())
        for (const auto& [what, value] : found->items()) ++notFollowed[what];
    }
  }

  Json json(std::size_t pairs) const {
    return {{"pairs", pairs}, {"same", same},     {"differ", differ},   {"missing", missing},
            {"extra", extra}, {"errors", errors}, {"updated", updated}, {"acrossDrivers", drivers}};
  }

  std::string line(std::size_t pairs) const {
    std::string text = std::to_string(pairs) + (pairs == 1 ? " pair: " : " pairs: ") +
                       std::to_string(same) + " same, " + std::to_string(differ) + " differ, " +
                       std::to_string(missing) + " missing, " + std::to_string(extra) +
                       " without baseline, " + std::to_string(errors) + " unreadable";
    const auto baselines = [&](std::size_t count, const char* what) {
      if (count > 0)
        text += "; " + std::to_string(count) + (count == 1 ? " baseline " : " baselines ") + what;
    };
    baselines(updated, "updated");
    baselines(removed, "removed");
    if (drivers > 0) text += "; " + std::to_string(drivers) + " compared across drivers";
    std::string ignored;
    for (const auto& [what, count] : notFollowed)
      ignored += (ignored.empty() ? "" : ", ") + what + " of " + std::to_string(count);
    if (!ignored.empty()) text += "; ignored metadata: " + ignored;
    return text;
  }
};

/// Quotes a word for the shell; one that looks like an option gets "./" in front.
std::string quoted(const std::string& word) {
  if (word.starts_with('-') && word != "-") return quoted("./" + word);
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("._-/+=:%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Whether a file is written to stdout, so that nothing else may be printed there.
bool writesToStdout(const DiffRequest& request) {
  const std::string* const files[] = {&request.json, &request.junit, &request.html,
                                      &request.markdown, &request.settings.output};
  return std::any_of(std::begin(files), std::end(files),
                     [](const std::string* path) { return *path == "-"; });
}

/// Writes all reports of several pairs; returns the exit status.
int report(const DiffRequest& request, Json pairs, DiffHtml* page,
           const std::vector<std::string>& unused) {
  const Summary summary(pairs);
  const int status = statusOf(pairs);
  const bool ofRun = !request.testRun.empty();
  const std::string command =
      "glint diff " +
      (ofRun ? "--run " + quoted(request.testRun) : quoted(request.a) + " " + quoted(request.b)) +
      " --update";
  Json json{{"glint", GLINT_VERSION}, {"a", request.a}, {"b", request.b}, {"status", status}};
  if (ofRun) json["run"] = request.testRun;
  json["updateCommand"] = command;
  json["pairs"] = std::move(pairs);
  if (!unused.empty()) json["unusedBaselines"] = unused;
  json["summary"] = summary.json(json["pairs"].size());
  if (!request.json.empty()) writeText(request.json, jsonText(json));
  if (!request.junit.empty()) writeText(request.junit, junitXml(json["pairs"]));
  if (!request.markdown.empty()) writeText(request.markdown, markdownText(json));
  if (page) page->finish(json);
  if (writesToStdout(request)) return status;
  for (const Json& pair : json["pairs"])
    if (pair["status"] != done || pair.contains("notCompared")) std::cout << diffLine(pair) << "\n";
  for (const std::string& path : unused)
    std::cout << printablePath(path) << ": no test uses this baseline: remove it with --prune\n";
  std::cout << summary.line(json["pairs"].size()) << "\n";
  return status;
}

std::unique_ptr<DiffHtml> openedPage(const DiffRequest& request) {
  if (request.html.empty()) return nullptr;
  return std::make_unique<DiffHtml>(request.html, request.picturesBeside);
}

int diffFolders(const DiffRequest& request) {
  if (!request.settings.output.empty())
    throw InputError("--output with folders: use --html for the pictures of differences");
  const std::vector<PairConditions> conditions = conditionsOf(request);
  std::vector<DiffEntry> entries = pairsOf(request, conditions);
  const std::set<std::string> meant = namesMeant(request.named, entries);
  const std::unique_ptr<DiffHtml> page = openedPage(request);
  Json pairs = comparePairs(request, conditions, page.get(), entries);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    DiffEntry& entry = entries[i];
    if (request.updating)
      update(meant, entry,
             request.perDriver ? driverBaseline(request.a, entry) : request.a + "/" + entry.name);
    if (request.pruning && entry.b.empty()) prune(entry);
    if (entry.updated || entry.removed) pairs[i] = diffJson(entry, request.settings.compare);
  }
  return report(request, std::move(pairs), page.get(), {});
}

/// Throws InputError for options that apply only to two folders.
void refuseOfFolders(const DiffRequest& request, bool ofPictures) {
  if (!request.conditions.empty())
    throw InputError("--conditions " + printablePath(request.conditions) +
                     ": only for two folders: give its options themselves");
  if (ofPictures && request.pruning)
    throw InputError("--prune: only for folders: remove the file yourself");
}

/// Reports on what a build's image tests left behind.
int diffTestRun(const DiffRequest& request) {
  refuseOfFolders(request, false);
  TestRun run = readTestRun(request.testRun);
  const std::set<std::string> meant = namesMeant(request.named, run.entries);
  const std::unique_ptr<DiffHtml> page = openedPage(request);
  for (std::size_t i = 0; i < run.entries.size(); ++i) {
    DiffEntry& entry = run.entries[i];
    if (page) page->add(i, entry.status != done, picturesOf(run.records[i], entry, run.pairs[i]));
    if (!request.updating) continue;
    update(meant, entry, run.records[i].baseline);
    if (!entry.updated) continue;
    Json& pair = run.pairs[i];
    pair.erase("error");
    pair["status"] = done;
    pair["same"] = pair["updated"] = true;
    pair["failures"] = Json::array();
    pair["notes"] = entry.notes;
  }
  if (request.pruning) {
    for (const std::string& path : run.unused) {
      DiffEntry entry;
      entry.a = path;
      prune(entry);
    }
    run.unused.clear();
  }
  return report(request, std::move(run.pairs), page.get(), run.unused);
}

int diffPictures(const DiffRequest& request) {
  refuseOfFolders(request, true);
  std::vector<DiffEntry> entries(1);
  DiffEntry& entry = entries[0];
  if (request.a == "-" && request.b == "-")
    throw InputError("diff - -: only one of the two can come from stdin");
  entry.name = request.b == "-" ? "stdin" : fs::path(request.b).filename().string();
  if (request.a == "-" || !isMissing(request.a)) entry.a = request.a;
  if (request.b == "-" || !isMissing(request.b)) entry.b = request.b;
  if (!entry.a.empty() && entry.a != "-") entry.others = otherBaselines(entry.a);
  if (request.updating && (request.a == "-" || request.b == "-"))
    throw InputError("--update with stdin: give both pictures as files");
  const std::set<std::string> meant = namesMeant(request.named, entries);
  std::string baseline = request.a;
  if (request.perDriver) {
    const fs::path a = request.a;
    const std::string folder = a.has_parent_path() ? a.parent_path().string() : ".";
    DiffEntry named = entry;
    named.name = a.filename().string();
    useDriverBaseline(folder, named);
    entry.a = named.a;
    baseline = driverBaseline(folder, named);
  }
  const std::unique_ptr<DiffHtml> page = openedPage(request);
  PairPictures pictures;
  diffPair(request.settings, entry, page ? &pictures : nullptr);
  if (entry.b.empty()) {
    entry.error = printablePath(request.b) + ": No such file or directory: check the path";
  } else if (entry.status == noBaseline) {
    entry.error = printablePath(request.a) + ": no baseline: look at " + printablePath(request.b) +
                  " and accept it with --update";
  }
  if (request.updating) update(meant, entry, baseline);
  Json json = diffJson(entry, request.settings.compare);
  json["glint"] = GLINT_VERSION;
  if (!request.json.empty()) writeText(request.json, jsonText(json));
  if (!request.junit.empty()) writeText(request.junit, junitXml(Json::array({json})));
  Json whole{
      {"a", request.a},
      {"b", request.b},
      {"updateCommand", "glint diff " + quoted(request.a) + " " + quoted(request.b) + " --update"},
      {"pairs", Json::array({json})}};
  if (!request.markdown.empty()) writeText(request.markdown, markdownText(whole));
  if (page) {
    page->add(0, entry.result.differing > 0, std::move(pictures));
    page->finish(whole);
  }
  if (!entry.error.empty()) {
    std::cerr << "glint: " << entry.error << "\n";
  } else if (!writesToStdout(request)) {
    std::string line = diffLine(json);
    if (const std::string text = notFollowedText(json); !text.empty())
      line += "; ignored metadata: " + text;
    std::cout << line << "\n";
  }
  return entry.status;
}

}  // namespace

int runDiff(DiffRequest request) {
  checkOutputs({{"--output", request.settings.output},
                {"--json", request.json},
                {"--junit", request.junit},
                {"--markdown", request.markdown},
                {"--html", request.html}},
               {request.a, request.b, request.mask});
  if (request.picturesBeside && (request.html.empty() || request.html == "-"))
    throw InputError("--pictures-beside: only for a report in a file: give --html FILE, too");
  if (!request.testRun.empty()) return diffTestRun(request);
  std::error_code ignored;
  const bool folderA = fs::is_directory(request.a, ignored);
  const bool folderB = fs::is_directory(request.b, ignored);
  if (folderB && (folderA || isMissing(request.a))) return diffFolders(request);
  if (folderA != folderB && !isMissing(request.a) && !isMissing(request.b))
    throw InputError(printablePath(request.a) + " and " + printablePath(request.b) +
                     ": one is a folder, the other a file: give two folders or two files");
  if (folderA)
    throw InputError(printablePath(request.b) + ": No such file or directory: check the path");
  if (request.pruning) throw InputError("--prune: only for two folders, or with --run");
  return diffPictures(request);
}

}  // namespace glint
