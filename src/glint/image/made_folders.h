#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace glint {

/// Folders that were made for what is to be written into them; those that are still empty at its
/// end go again.
class MadeFolders {
 public:
  MadeFolders() = default;
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;

  /// Makes a folder and those above it that are not there.
  std::error_code make(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

}  // namespace glint
