#pragma once

#include "glint/image/texture.h"
#include "glint/scene/scene.h"

namespace glint {

/// Whether alpha is 1 in all texels that the mesh can show of its material's colour texture: those
/// that its filter reads, at full size, within each triangle's box of texture coordinates (and so
/// perhaps a few more). False for a mesh without the coordinates.
bool texelsAreOpaque(const Mesh&, const Texture&, const ByteImage&);

/// Whether what is behind the mesh shows through it: its material blends, and alpha is not 1
/// everywhere, by factor, vertex colours and texels (Mesh::opaqueTexels). A surface that nothing
/// shows through is drawn as opaque.
bool isBlended(const Mesh&, const Material&);

}  // namespace glint
