#pragma once

#include <string>

#include "glint/gltf/document.h"
#include "glint/gltf/json.h"

namespace glint::gltf {

/// Whether this build supports an extension for compressed geometry.
bool readsCompression(const std::string& extension);

/// Replaces compressed geometry by uncompressed, so that later code need not know about it: the
/// data of EXT_meshopt_compression and KHR_draco_mesh_compression are decoded into buffers of their
/// own, to which the document's buffer views, accessors and primitives are redirected. Fills
/// `document.buffers`. Returns true if anything was replaced; the document must then be checked
/// again.
///
/// Fails, giving the path, on data that are damaged, that expand to more than 512 times their size,
/// or that do not match the document.
bool decompress(Document& document, const Messages& messages);

}  // namespace glint::gltf
