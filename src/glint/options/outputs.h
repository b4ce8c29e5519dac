#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/file.h"

namespace glint {

/// A file that an option writes: none if the path is empty, stdout if it is "-".
struct OutputOption {
  std::string option, path;
};

/// Whether two paths refer to the same file, or would.
bool isSameFile(const std::string& a, const std::string& b);

/// Throws InputError if two options would write the same file or both write to stdout, or if one
/// would overwrite a file that is read: one of `inputs`, one that a model among them refers to, or
/// one recorded before (glint/image/read_files.h). Records the inputs.
void checkOutputs(const std::vector<OutputOption>& outputs, const std::vector<std::string>& inputs);

/// The folder for --output, created before the work, so that failure is reported at once. Folders
/// that it created are removed by its destructor if nothing was written to them.
class OutputFolder {
 public:
  /// Throws InputError.
  explicit OutputFolder(const std::string& path);

 private:
  MadeFolders folders_;
};

/// Throws InputError if what was printed on std::cout could not be written.
void flushStandardOutput();

/// Prints text on stdout; if stdout is a file, whole or not at all. Throws InputError.
void printWhole(const std::string& text);

/// Writes the text as all, or the rest, of a file.
void commitText(OutputFile& file, std::string_view text);

/// Writes text to a file, or to stdout for "-".
void writeText(const std::string& path, const std::string& text);

/// "glint: warning: TEXT" on stderr, one line.
void printWarning(const std::string& text);

}  // namespace glint
