#pragma once

// Internal to src/gl and its tests: the backends, with libraries chosen by the caller.

#include <memory>
#include <span>
#include <string>

#include "glint/gl/context.h"

namespace glint::backends {

/// A function that a library must have, and where to store its address.
struct Symbol {
  const char* name;
  void** address;
};

/// None of a backend's libraries is installed.
class MissingLibrary : public ContextError {
 public:
  using ContextError::ContextError;
};

/// Opens the first library that can be opened and has all symbols; it is never closed (drivers
/// leave threads and exit handlers behind). Throws ContextError, or MissingLibrary, with what is
/// missing and the remedy ("install ...").
void openLibrary(std::span<const char* const> sonames, std::span<const Symbol> symbols,
                 const char* remedy);

std::unique_ptr<Context> openOsmesa(std::span<const char* const> sonames);

/// OpenGL 3.3 core, or OpenGL ES 3, for which the same function pointers are loaded.
enum class Api { core33, es3 };

/// software: accept only Mesa's software renderer.
std::unique_ptr<Context> openEgl(std::span<const char* const> sonames, bool software,
                                 Api api = Api::core33);

/// An OpenGL ES 3 context from the system's EGL; the counterpart of openContext().
std::unique_ptr<Context> openSystemEs3();

/// Tries openers in turn until one returns a context. The failures of the others become the
/// context's remark or, if none succeeds, the text of a ContextError. Without a GPU, a library that
/// is not installed is no loss and is not mentioned.
struct Opener {
  const char* name;
  std::unique_ptr<Context> (*open)();
};
std::unique_ptr<Context> openFirst(std::span<const Opener> openers, bool hasGpu);

}  // namespace glint::backends
