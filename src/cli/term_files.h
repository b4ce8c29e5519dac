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
std::string termOutput(const std::string& output, const PictureFormat&, const PictureTerm& term);

/// Writes them in the format of the options: an EXR with a layer for each term, or a file each and
/// the picture last. Where it has sRGB codes, a normal n is the colour code (n + 1) / 2 and the
/// depth goes from white at the nearest surface to black at the farthest and instances have colours
/// of their own; else all are as they are.
/// Returns the number of the picture's pixels that are not numbers. Throws InputError.
std::size_t writeTerms(const std::string& output, DrawnTerms& drawn, const PictureOptions& options);

}  // namespace glint
