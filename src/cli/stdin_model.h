#pragma once

#include <string>
#include <type_traits>

#include "glint/image/error.h"

namespace glint {

/// The path of a URI "file:///...", as desktops pass it; any other text unchanged.
std::string localPath(const std::string& model);

/// Whether a model's name means standard input: "-" and "/dev/stdin".
bool isStdin(const std::string& model);

/// The name of a model in messages: "stdin", or as it was given.
inline std::string nameOf(const std::string& model) { return isStdin(model) ? "stdin" : model; }

/// The path of a file that holds the model: `model` itself, or for standard input a file in memory
/// into which all of it is read, once. Such a model must be self-contained (GLB, data URIs). Throws
/// InputError if it cannot be read, or is larger than 4 GiB.
std::string modelFile(const std::string& model);

/// `text` with the path of that file replaced by "stdin".
std::string withoutModelFile(std::string text);

/// Calls read(modelFile(model)); InputErrors name stdin as such.
template <typename Read>
auto readModelFile(const std::string& model, Read read) {
  if (!isStdin(model)) return read(model);
  try {
    return read(modelFile(model));
  } catch (const InputError& error) {
    throw InputError(withoutModelFile(error.what()));
  }
}

}  // namespace glint
