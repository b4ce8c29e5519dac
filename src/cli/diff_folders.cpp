#include "diff_folders.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <set>

#include "diff_baselines.h"
#include "glint/image/error.h"
#include "glint/image/file.h"

namespace glint {
namespace {

namespace fs = std::filesystem;

/// The pictures in a folder and its subfolders, as paths relative to it. The folders that hold the
/// baselines of a driver begin with "driver-".
std::vector<std::string> picturesIn(const std::string& folder, bool baselines) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end;
       i.increment(error)) {
    const fs::path relative = i->path().lexically_relative(folder);
    if (baselines && relative.begin()->string().starts_with("driver-")) continue;
    std::error_code ignored;
    if (!i->is_regular_file(ignored)) continue;
    if (isPictureName(i->path().string())) names.push_back(relative.generic_string());
  }
  if (error)
    throw InputError(printablePath(folder) + ": " + error.message() + ": check the folder");
  std::sort(names.begin(), names.end());
  return names;
}

/// The path without symbolic links, "." and "..", as far as it exists.
std::string plainPath(const std::string& path) {
  std::error_code error;
  const fs::path plain = fs::weakly_canonical(path, error);
  return error ? path : plain.string();
}

}  // namespace

std::vector<PairConditions> conditionsOf(const DiffRequest& request) {
  std::string path = request.conditions;
  if (path.empty() && isThere(request.a + "/glint-diff.txt")) path = request.a + "/glint-diff.txt";
  return path.empty() ? std::vector<PairConditions>() : readConditions(path);
}

std::vector<DiffEntry> pairsOf(const DiffRequest& request,
                               const std::vector<PairConditions>& conditions) {
  auto inA = isThere(request.a) ? picturesIn(request.a, true) : std::vector<std::string>();
  // A mask is not a baseline, wherever it is.
  std::set<std::string> masks;
  if (!request.mask.empty()) masks.insert(plainPath(request.mask));
  for (const PairConditions& one : conditions)
    if (!one.settings.maskPath.empty()) masks.insert(plainPath(one.settings.maskPath));
  if (!masks.empty())
    std::erase_if(inA, [&](const std::string& name) {
      return masks.count(plainPath(request.a + "/" + name)) > 0;
    });
  const auto inB = picturesIn(request.b, false);
  std::vector<std::string> all;
  std::set_union(inA.begin(), inA.end(), inB.begin(), inB.end(), std::back_inserter(all));
  if (all.empty())
    throw InputError(
        printablePath(request.a) + " and " + printablePath(request.b) +
        ": no pictures in them: give folders of PNG, EXR, PFM, HDR, JPEG, WebP, TIFF, PPM, BMP "
        "or TGA files");
  // NAME_1.png is a further baseline of NAME.png, unless it has a picture of its own.
  std::set<std::string> alternatives;
  for (const std::string& name : inA)
    for (const std::string& other : otherBaselines(request.a + "/" + name))
      if (const std::string inside = other.substr(request.a.size() + 1);
          !std::binary_search(inB.begin(), inB.end(), inside))
        alternatives.insert(inside);
  std::vector<DiffEntry> entries;
  for (const std::string& name : all) {
    if (alternatives.count(name) > 0) continue;
    DiffEntry entry;
    entry.name = name;
    if (std::binary_search(inA.begin(), inA.end(), name))
      for (const std::string& other : otherBaselines(request.a + "/" + name))
        if (alternatives.count(other.substr(request.a.size() + 1)) > 0)
          entry.others.push_back(other);
    if (std::binary_search(inA.begin(), inA.end(), name)) entry.a = request.a + "/" + name;
    if (std::binary_search(inB.begin(), inB.end(), name)) entry.b = request.b + "/" + name;
    entries.push_back(std::move(entry));
  }
  return entries;
}

DiffSettings settingsFor(const DiffSettings& given, const std::vector<PairConditions>& conditions,
                         const std::string& name) {
  const auto found = std::find_if(conditions.rbegin(), conditions.rend(),
                                  [&](const auto& one) { return isNamedBy(one.pattern, name); });
  if (found == conditions.rend()) return given;
  DiffSettings settings = found->settings;
  settings.allMetrics = given.allMetrics;
  settings.compare.regions = given.compare.regions;
  settings.compare.flip.threads = given.compare.flip.threads;
  settings.difference = given.difference;
  settings.scale = given.scale;
  return settings;
}

void tellUnused(const std::vector<PairConditions>& conditions,
                const std::vector<DiffEntry>& entries) {
  for (const PairConditions& one : conditions)
    if (std::none_of(entries.begin(), entries.end(),
                     [&](const DiffEntry& entry) { return isNamedBy(one.pattern, entry.name); }))
      std::cerr << "glint: " << one.where << printablePath(one.pattern)
                << ": names no pair: check the pattern\n";
}

}  // namespace glint
