#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "glint/image/made_folders.h"

namespace glint {

/// A file that an option writes: none if the path is empty, stdout if it is "-".
struct OutputOption {
  std::string option, path;
};

/// Whether two paths are one file, or would be.
bool isSameFile(const std::string& a, const std::string& b);

/// Throws InputError where two options would write one file or both stdout, or where one would
/// write over a file that is read: one of `inputs`, one that a model among them names, or one that
/// has been noted before (glint/image/read_files.h). The inputs are noted.
void checkOutputs(const std::vector<OutputOption>& outputs, const std::vector<std::string>& inputs);

/// The folder of --output, made before the work, so that what cannot be made is reported at once.
/// What it had to make is gone again with it where nothing was written there.
class OutputFolder {
 public:
  /// Throws InputError.
  explicit OutputFolder(const std::string& path);

 private:
  MadeFolders folders_;
};

/// Throws InputError if what was printed on std::cout did not arrive.
void flushStandardOutput();

/// Prints text on stdout, whole or not at all where stdout is a file. Throws InputError.
void printWhole(const std::string& text);

/// Writes text to a file, or to stdout for "-".
void writeText(const std::string& path, const std::string& text);

/// "glint: warning: TEXT" on stderr, one line.
void printWarning(const std::string& text);

}  // namespace glint
