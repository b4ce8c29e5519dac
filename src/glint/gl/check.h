#pragma once

namespace glint {

/// Throws Error in words if GL has recorded an error since the last call, out of memory and a lost
/// context among them: "WHERE: out of memory (GL_OUT_OF_MEMORY): ...". Call it after each stage of
/// work, not after each call: on a GPU it waits.
void checkGl(const char* where);

/// Throws Error unless a context is current in this thread and its functions are loaded
/// (Context::makeCurrent()).
void requireContext(const char* where);

}  // namespace glint
