#pragma once

namespace glint {

/// Throws Error with a description if GL has recorded an error since the last call, including out
/// of memory and a lost context: "WHERE: out of memory (GL_OUT_OF_MEMORY): ...". Call it after each
/// stage of work, not after each GL call: on a GPU it waits.
void checkGl(const char* where);

/// Throws Error unless a context is current in this thread and its functions are loaded
/// (Context::makeCurrent()).
void requireContext(const char* where);

}  // namespace glint
