#pragma once

#include <string>
#include <utility>
#include <vector>

#include "glint/image/picture_writer.h"
#include "glint/render/picture_terms.h"

namespace glint {

/// A picture with its terms, drawn.
struct DrawnTerms {
  Image picture;
  std::vector<std::pair<PictureTerm, Image>> terms;
};

/// Where a term goes: a layer of the EXR with its name ("OUT.exr"), or a file of its own
/// ("OUT.ambient.png").
std::string termOutput(const std::string& output, const PictureTerm& term);

/// Writes them: an EXR with a layer for each term, or a file each and the picture last. In a PNG a
/// normal n is the colour code (n + 1) / 2 and the depth goes from white at the nearest surface to
/// black at the farthest; in the others both are as they are.
/// Returns the number of the picture's pixels that are not numbers. Throws InputError.
std::size_t writeTerms(const std::string& output, DrawnTerms& drawn, const PictureOptions& options);

}  // namespace glint
