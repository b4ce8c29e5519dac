#pragma once

#include <filesystem>

#include "glint/gltf/json.h"

namespace glint::gltf {

/// The structural check of a glTF document, done before anything else reads it: the version, the
/// required extensions, types, that every index, offset and count is within bounds, in 64-bit
/// arithmetic, and that the nodes form trees, with at most one parent each. tinygltf checks none of
/// this and crashes on violations.
///
/// The contents of animations, extras and extension objects are not checked here. Fails with a
/// message that gives the path; warns about extensions that are used but unknown.
void checkDocument(Json& document, Messages& messages);

/// The part that checks indices, offsets and counts; used again if those have changed.
void checkStructure(Json& document, const Messages& messages);

/// Bytes from an accessor's first element to the end of its last, with elements `stride` apart
/// (0: tightly packed). The accessor must have been checked.
std::uint64_t spanOfElements(Cursor accessor, std::int64_t stride);
/// Bytes per component of a glTF type such as 5126; 0 if unknown.
std::int64_t componentBytes(std::int64_t componentType);

}  // namespace glint::gltf
