#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace glint {

/// The texts of the GLSL files by name ("phong.glsl"): the built-in ones, each replaced by the file
/// of the same name in the user's folder, if one is given.
class GlslSources {
 public:
  GlslSources() = default;
  /// Throws InputError if the folder cannot be read or holds none of the files.
  explicit GlslSources(const std::filesystem::path& folder);

  /// The text of a file that is built in.
  const std::string& text(const std::string& name) const;

 private:
  std::map<std::string, std::string> replaced_;
};

}  // namespace glint
