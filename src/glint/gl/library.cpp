#include <dlfcn.h>

#include <algorithm>
#include <string>
#include <vector>

#include "glint/gl/backends.h"

namespace glint::backends {

namespace {

std::string dlErrorText() {
  const char* text = dlerror();
  std::string line = text ? text : "unknown error";
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

/// The first symbol that the library lacks, or nullptr.
const char* resolve(void* library, std::span<const Symbol> symbols) {
  for (const Symbol& symbol : symbols) {
    *symbol.address = dlsym(library, symbol.name);
    if (!*symbol.address) return symbol.name;
  }
  return nullptr;
}

}  // namespace

void openLibrary(std::span<const char* const> sonames, std::span<const Symbol> symbols,
                 const char* remedy) {
  std::string absent;   // sonames not found
  std::string reasons;  // why the libraries found cannot be used
  for (const char* soname : sonames) {
    void* library = dlopen(soname, RTLD_NOW | RTLD_LOCAL);
    std::string reason;
    if (!library) {
      reason = dlErrorText();
      // The same words with another name in front mean that a dependency is missing.
      if (reason.starts_with(std::string(soname) + ": cannot open shared object file: No such")) {
        absent += (absent.empty() ? "" : " or ") + std::string(soname);
        continue;
      }
      reason = "cannot load " + std::string(soname) + " (" + reason + ")";
    } else if (const char* missing = resolve(library, symbols)) {
      reason = std::string(soname) + " lacks the symbol " + missing +
               " (too old, or another library of that name)";
    } else {
      return;
    }
    reasons += (reasons.empty() ? "" : "; ") + reason;
  }
  if (reasons.empty()) throw MissingLibrary(absent + " not found: " + remedy);
  throw ContextError(reasons + ": " + remedy);
}

}  // namespace glint::backends
