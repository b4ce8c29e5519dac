#include "diff_run.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "commands.h"
#include "diff_html.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"
#include "glint/image/task.h"
#include "glint/options/outputs.h"
#include "progress.h"

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool isThere(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::string endingOf(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  for (char& letter : ending)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending;
}

/// The pictures in a folder and its folders, by their paths in it. Driver folders of baselines
/// begin with "driver-".
std::vector<std::string> picturesIn(const std::string& folder, bool baselines) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end;
       i.increment(error)) {
    const fs::path relative = i->path().lexically_relative(folder);
    if (baselines && relative.begin()->string().starts_with("driver-")) continue;
    std::error_code ignored;
    if (!i->is_regular_file(ignored)) continue;
    const std::string ending = endingOf(i->path().string());
    for (const char* known : {".png", ".exr", ".pfm", ".hdr", ".jpg", ".jpeg"})
      if (ending == known) names.push_back(relative.generic_string());
  }
  if (error)
    throw InputError(printablePath(folder) + ": " + error.message() + ": check the folder");
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<DiffEntry> pairsOf(const DiffRequest& request) {
  const auto inA = isThere(request.a) ? picturesIn(request.a, true) : std::vector<std::string>();
  const auto inB = picturesIn(request.b, false);
  std::vector<std::string> all;
  std::set_union(inA.begin(), inA.end(), inB.begin(), inB.end(), std::back_inserter(all));
  if (all.empty())
    throw InputError(printablePath(request.a) + " and " + printablePath(request.b) +
                     ": no pictures in them: give folders of PNG, EXR, PFM, HDR or JPEG files");
  std::vector<DiffEntry> entries;
  for (const std::string& name : all) {
    DiffEntry entry;
    entry.name = name;
    if (std::binary_search(inA.begin(), inA.end(), name)) entry.a = request.a + "/" + name;
    if (std::binary_search(inB.begin(), inB.end(), name)) entry.b = request.b + "/" + name;
    entries.push_back(std::move(entry));
  }
  return entries;
}

void checkNames(const DiffRequest& request, const std::vector<DiffEntry>& entries) {
  for (const std::string& name : request.named) {
    const auto is = [&](const DiffEntry& entry) { return entry.name == name; };
    if (std::none_of(entries.begin(), entries.end(), is))
      throw InputError("--update " + printablePath(name) + ": no such pair: check the name");
  }
}

/// Makes B the baseline where it is wanted and not the same, and says so.
void update(const DiffRequest& request, DiffEntry& entry, const std::string& target) {
  const auto& names = request.named;
  if (!names.empty() && std::find(names.begin(), names.end(), entry.name) == names.end()) return;
  if (entry.status == done || !entry.readableB) return;
  if (endingOf(target) != endingOf(entry.b))
    throw InputError("--update: " + printablePath(entry.b) + " is no " + endingOf(target) +
                     " file as " + printablePath(target) + " is: give one of that format");
  const bool made = !isThere(target);
  std::error_code ignored;
  fs::create_directories(fs::path(target).parent_path(), ignored);
  forgetReadFile(target);
  OutputFile file(target);
  file.write(readFile(entry.b));
  file.commit();
  std::cerr << "glint: " << (made ? "made" : "replaced") << " the baseline "
            << printablePath(target) << "\n";
  entry.status = done;
  entry.error.clear();
  entry.updated = true;
  entry.note = made ? "baseline made" : "baseline replaced";
}

void comparePairs(const DiffRequest& request, DiffSettings settings, DiffHtml* page,
                  std::vector<DiffEntry>& entries) {
  int jobs = request.jobs > 0 ? request.jobs : int(std::thread::hardware_concurrency());
  jobs = std::clamp(jobs, 1, int(std::min<std::size_t>(entries.size(), 64)));
  if (jobs > 1) settings.compare.flip.threads = 1;
  std::atomic<std::size_t> next = 0;
  Progress progress("comparing");
  std::size_t compared = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < entries.size(); i = next++) {
        if (request.perDriver) useDriverBaseline(request.a, entries[i]);
        PairPictures pictures;
        diffPair(settings, entries[i], page ? &pictures : nullptr);
        const std::lock_guard lock(mutex);
        if (page) page->add(i, entries[i].result.differing > 0, std::move(pictures));
        progress.show(double(++compared) / double(entries.size()), entries[i].name);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      next = entries.size();
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 1; i < jobs && addWorker(workers, work);) ++i;
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Of several statuses the one that tells most: unusable, then differs, then noBaseline.
int statusOf(const std::vector<DiffEntry>& entries) {
  for (const int status : {int(unusable), int(differs), int(noBaseline)})
    for (const DiffEntry& entry : entries)
      if (entry.status == status) return status;
  return done;
}

struct Summary {
  std::size_t same = 0, differ = 0, missing = 0, extra = 0, errors = 0, updated = 0, drivers = 0;

  explicit Summary(const std::vector<DiffEntry>& entries) {
    for (const DiffEntry& entry : entries) {
      same += entry.status == done;
      differ += entry.status == differs;
      missing += entry.b.empty();
      extra += entry.status == noBaseline;
      errors += entry.status == unusable && !entry.b.empty();
      updated += entry.updated;
      drivers += entry.acrossDrivers;
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
    if (updated > 0) text += "; " + std::to_string(updated) + " baselines updated";
    if (drivers > 0) text += "; " + std::to_string(drivers) + " compared across drivers";
    return text;
  }
};

int diffFolders(const DiffRequest& request) {
  if (!request.settings.output.empty())
    throw InputError("--output with folders: use --html for the pictures of differences");
  std::vector<DiffEntry> entries = pairsOf(request);
  checkNames(request, entries);
  std::optional<DiffHtml> page;
  if (!request.html.empty()) page.emplace(request.html);
  comparePairs(request, request.settings, page ? &*page : nullptr, entries);
  if (request.updating) {
    for (DiffEntry& entry : entries)
      update(request, entry,
             request.perDriver ? driverBaseline(request.a, entry) : request.a + "/" + entry.name);
  }
  const Summary summary(entries);
  const int status = statusOf(entries);
  Json json{{"glint", GLINT_VERSION}, {"a", request.a}, {"b", request.b}, {"status", status}};
  json["pairs"] = Json::array();
  const bool toStdout = request.json == "-" || request.junit == "-" || request.html == "-";
  for (const DiffEntry& entry : entries) {
    json["pairs"].push_back(diffJson(entry, request.settings.compare));
  }
  json["summary"] = summary.json(entries.size());
  if (!request.json.empty()) writeText(request.json, jsonText(json));
  if (!request.junit.empty()) writeText(request.junit, junitXml(entries));
  if (page) page->finish(json);
  for (const DiffEntry& entry : entries)
    if (entry.status != done && !toStdout) std::cout << diffLine(entry) << "\n";
  if (!toStdout) std::cout << summary.line(entries.size()) << "\n";
  return status;
}

int diffPictures(const DiffRequest& request) {
  std::vector<DiffEntry> entries(1);
  DiffEntry& entry = entries[0];
  entry.name = fs::path(request.b).filename().string();
  if (isThere(request.a)) entry.a = request.a;
  if (isThere(request.b)) entry.b = request.b;
  checkNames(request, entries);
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
  std::optional<DiffHtml> page;
  if (!request.html.empty()) page.emplace(request.html);
  PairPictures pictures;
  diffPair(request.settings, entry, page ? &pictures : nullptr);
  if (entry.b.empty()) {
    entry.error = printablePath(request.b) + ": No such file or directory: check the path";
  } else if (entry.status == noBaseline) {
    entry.error = printablePath(request.a) + ": no baseline: look at " + printablePath(request.b) +
                  " and accept it with --update";
  }
  if (request.updating) update(request, entry, baseline);
  Json json = diffJson(entry, request.settings.compare);
  json["glint"] = GLINT_VERSION;
  if (!request.json.empty()) writeText(request.json, jsonText(json));
  if (!request.junit.empty()) writeText(request.junit, junitXml(entries));
  if (page) {
    page->add(0, entry.result.differing > 0, std::move(pictures));
    page->finish({{"a", request.a}, {"b", request.b}, {"pairs", Json::array({json})}});
  }
  if (!entry.error.empty()) {
    std::cerr << "glint: " << entry.error << "\n";
  } else if (request.json != "-" && request.junit != "-" && request.html != "-") {
    std::cout << diffLine(entry) << "\n";
  }
  return entry.status;
}

}  // namespace

int runDiff(DiffRequest request) {
  checkOutputs({{"--output", request.settings.output},
                {"--json", request.json},
                {"--junit", request.junit},
                {"--html", request.html}},
               {request.a, request.b, request.mask});
  std::error_code ignored;
  const bool folderA = fs::is_directory(request.a, ignored);
  const bool folderB = fs::is_directory(request.b, ignored);
  StoredImage mask;
  if (!request.mask.empty()) {
    mask = readStoredImage(request.mask);
    request.settings.compare.mask = &mask;
  }
  if (folderB && (folderA || !isThere(request.a))) return diffFolders(request);
  if (folderA != folderB && isThere(request.a) && isThere(request.b))
    throw InputError(printablePath(request.a) + " and " + printablePath(request.b) +
                     ": one is a folder, the other a file: give two of a kind");
  if (folderA)
    throw InputError(printablePath(request.b) + ": No such file or directory: check the path");
  return diffPictures(request);
}

}  // namespace glint
