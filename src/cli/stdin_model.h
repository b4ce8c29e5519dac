#pragma once

#include <string>
#include <type_traits>

#include "glint/image/error.h"

namespace glint {

/// The path that a URI "file:///..." names, as desktops give it; any other text as it is.
std::string localPath(const std::string& model);

/// Whether a model's name means standard input: "-" and "/dev/stdin".
bool isStdin(const std::string& model);

/// What a model is called in messages: "stdin", or as it was given.
inline std::string nameOf(const std::string& model) { return isStdin(model) ? "stdin" : model; }

/// The path of a file that holds the model: `model` itself, or of standard input a file in memory
/// that all of it is read into, once. What the model refers to is then found in it alone (GLB, data
/// URIs). Throws InputError if it cannot be read, or has more than 4 GiB.
std::string modelFile(const std::string& model);

/// `text` with the path of that file as "stdin".
std::string withoutModelFile(std::string text);

/// read(modelFile(model)), whose InputErrors name stdin as such.
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
