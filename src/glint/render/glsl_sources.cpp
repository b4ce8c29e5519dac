#include "glint/render/glsl_sources.h"

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/render/glsl_builtin.h"

namespace glint {

GlslSources::GlslSources(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError("--glsl " + folder.string() + ": not a folder: give one with .glsl files");
  for (const auto& [name, text] : builtinGlsl()) {
    const auto file = folder / name;
    if (isMissing(file)) continue;
    const auto bytes = readFile(file.string());
    replaced_[name] = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  if (replaced_.empty())
    throw InputError("--glsl " + folder.string() +
                     ": it has none of glint's shader files: copy those in glsl/ and edit them");
}

const std::string& GlslSources::text(const std::string& name) const {
  const auto found = replaced_.find(name);
  return found != replaced_.end() ? found->second : builtinGlsl().at(name);
}

}  // namespace glint
