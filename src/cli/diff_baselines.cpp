#include "diff_baselines.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "commands.h"
#include "diff_options.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_format.h"
#include "glint/image/read_files.h"

namespace glint {

namespace fs = std::filesystem;

bool isPictureName(const std::string& path) { return pictureFormatOf(path) != nullptr; }

void checkNames(const std::vector<std::string>& named, const std::vector<DiffEntry>& entries) {
  for (const std::string& name : named) {
    const auto is = [&](const DiffEntry& entry) {
      return entry.name == name || isNamedBy(name, entry.name);
    };
    if (std::none_of(entries.begin(), entries.end(), is))
      throw InputError("--update " + printablePath(name) + ": no such pair: check the name");
  }
}

void update(const std::vector<std::string>& named, DiffEntry& entry, const std::string& target) {
  const auto means = [&](const std::string& name) {
    return name == entry.name || isNamedBy(name, entry.name);
  };
  if (!named.empty() && std::none_of(named.begin(), named.end(), means)) return;
  if (entry.status == done || !entry.readableB) return;
  if (pictureFormatOf(target) != pictureFormatOf(entry.b))
    throw InputError("--update: " + printablePath(entry.b) + " is not of the format of " +
                     printablePath(target) + ": give one that is");
  std::error_code ignored;
  const bool made = !fs::exists(target, ignored);
  forgetReadFile(target);
  OutputFile file(target);
  file.write(readFile(entry.b));
  file.commit();
  std::cerr << "glint: " << (made ? "made" : "replaced") << " the baseline "
            << printablePath(target) << "\n";
  entry.status = done;
  entry.error.clear();
  entry.updated = true;
  entry.notes = {made ? "baseline made" : "baseline replaced"};
}

void prune(DiffEntry& entry) {
  std::error_code error;
  if (!fs::remove(entry.a, error) && error)
    throw InputError("--prune: " + printablePath(entry.a) + ": " + error.message() +
                     ": check the permissions");
  std::cerr << "glint: removed the baseline " << printablePath(entry.a) << "\n";
  entry.status = done;
  entry.error.clear();
  entry.updated = true;
  entry.notes = {"baseline removed"};
}

}  // namespace glint
