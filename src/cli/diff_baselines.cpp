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

std::set<std::string> namesMeant(const std::vector<std::string>& named,
                                 const std::vector<DiffEntry>& entries) {
  std::set<std::string> all, meant;
  for (const DiffEntry& entry : entries) all.insert(entry.name);
  for (const std::string& given : named) {
    const std::string name = given.starts_with("./") ? given.substr(2) : given;
    if (all.count(name) > 0) {
      meant.insert(name);
      continue;
    }
    bool found = false;
    for (const std::string& one : all)
      if (isNamedBy(name, one)) {
        meant.insert(one);
        found = true;
      }
    if (!found)
      throw InputError("--update " + printablePath(given) + ": no such pair: check the name");
  }
  return named.empty() ? all : meant;
}

void update(const std::set<std::string>& meant, DiffEntry& entry, const std::string& target) {
  if (meant.count(entry.name) == 0) return;
  if (entry.status == done || !entry.readableB) return;
  if (pictureFormatOf(target) != pictureFormatOf(entry.b))
    throw InputError("--update: " + printablePath(entry.b) + " has a different format from " +
                     printablePath(target) + ": give one in that format");
  const bool made = isMissing(target);
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
  entry.removed = true;
  entry.notes = {"baseline removed"};
}

}  // namespace glint
