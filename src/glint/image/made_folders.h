#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace glint {

/// Folders created for files that are about to be written; the destructor removes those that are
/// still empty.
class MadeFolders {
 public:
  MadeFolders() = default;
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;

  /// Creates a folder and its missing parents.
  std::error_code make(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> made_;  ///< innermost first
};

}  // namespace glint
