#pragma once

// Internal to src/gl and its tests: the backends with their libraries to be chosen by the caller.

#include <memory>
#include <span>
#include <string>

#include "glint/gl/context.h"

namespace glint::backends {

/// A function that a library must have, and where its address goes.
struct Symbol {
  const char* name;
  void** address;
};

/// None of a backend's libraries is installed.
class MissingLibrary : public ContextError {
 public:
  using ContextError::ContextError;
};

/// Opens the first of the libraries that can be opened and has all symbols; it is never closed
/// (drivers leave threads and exit handlers behind). Throws ContextError, or MissingLibrary: what
/// is missing, and the remedy ("install ...").
void openLibrary(std::span<const char* const> sonames, std::span<const Symbol> symbols,
                 const char* remedy);

std::unique_ptr<Context> openOsmesa(std::span<const char* const> sonames);

/// OpenGL 3.3 core, or OpenGL ES 3, of which the same function pointers are loaded.
enum class Api { core33, es3 };

/// software: only Mesa's software renderer will do.
std::unique_ptr<Context> openEgl(std::span<const char* const> sonames, bool software,
                                 Api api = Api::core33);

/// An OpenGL ES 3 context of the system's EGL, as openContext() gives others.
std::unique_ptr<Context> openSystemEs3();

/// Calls openers in turn until one gives a context. The reasons of those that failed become the
/// context's remark or, if none works, the text of a ContextError. Without a GPU, nothing is lost
/// by a library that is not installed, and there is no remark about it.
struct Opener {
  const char* name;
  std::unique_ptr<Context> (*open)();
};
std::unique_ptr<Context> openFirst(std::span<const Opener> openers, bool hasGpu);

}  // namespace glint::backends
