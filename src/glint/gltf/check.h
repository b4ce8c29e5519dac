#pragma once

#include <filesystem>

#include "glint/gltf/json.h"

namespace glint::gltf {

/// The structural check of a glTF document, done before anything else reads it: the version, the
/// extensions it requires, types, and that every index, offset and count stays within what it
/// points into, in 64-bit arithmetic; that the nodes are trees, each with one parent at most.
/// tinygltf checks none of this and crashes on it.
///
/// Sections that nothing here reads (animations, extras, extensions' objects) are not looked at.
/// Fails with a message that names the place; warns of extensions that are used but not known.
void checkDocument(Json& document, Messages& messages);

/// The part of it that looks at indices, offsets and counts; once more where those have changed.
void checkStructure(Json& document, const Messages& messages);

/// Bytes that the elements of an accessor span from its first to the end of its last one, `stride`
/// apart (0: one behind the other); of an accessor that has been checked.
std::uint64_t spanOfElements(Cursor accessor, std::int64_t stride);
/// Bytes of one component of a glTF type such as 5126; 0 if there is none.
std::int64_t componentBytes(std::int64_t componentType);

}  // namespace glint::gltf
