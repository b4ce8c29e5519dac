#include "glint/image/made_folders.h"

namespace glint {

namespace fs = std::filesystem;

std::error_code MadeFolders::make(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error).lexically_normal();
  std::vector<fs::path> missing;
  for (fs::path each = whole;
       !each.empty() && !fs::exists(each, error) && each != each.parent_path();
       each = each.parent_path())
    if (each.has_filename()) missing.push_back(each);
  error.clear();
  fs::create_directories(whole, error);
  // Another thread may have created it at the same time, which some libraries report as an error.
  std::error_code ignored;
  if (fs::is_directory(whole, ignored)) error.clear();
  made_.insert(made_.begin(), missing.begin(), missing.end());
  return error;
}

MadeFolders::~MadeFolders() {
  std::error_code ignored;  // from folders that are not empty
  for (const fs::path& each : made_) fs::remove(each, ignored);
}

}  // namespace glint
