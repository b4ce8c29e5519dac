#pragma once

#include <string>

#include "glint/gltf/document.h"
#include "glint/gltf/json.h"

namespace glint::gltf {

/// Whether this build reads an extension that compresses geometry.
bool readsCompression(const std::string& extension);

/// Replaces compressed geometry by plain one, so that nothing behind this needs to know of it: what
/// EXT_meshopt_compression and KHR_draco_mesh_compression hold is decoded into buffers of its own,
/// and the document's buffer views, accessors and primitives point there. `document.buffers` is
/// filled. True if anything was replaced; the document is then to be checked again.
///
/// Fails, naming the place, on data that are damaged, that unfold to more than 512 times their
/// size, or that do not hold what the document says.
bool decompress(Document& document, const Messages& messages);

}  // namespace glint::gltf
