#pragma once

#include <string>
#include <utility>
#include <vector>

#include "glint/image/picture_writer.h"
#include "glint/render/picture_terms.h"

namespace glint {

/// A drawn picture with its terms.
struct DrawnTerms {
  Image picture;
  std::vector<std::pair<PictureTerm, Image>> terms;
};

/// Where a term is written: a layer of the EXR with its name ("OUT.exr"), or its own file
/// ("OUT.ambient.png").
std::string termOutput(const std::string& output, const PictureFormat&, const PictureTerm& term);

/// Writes the picture and its terms in the format of the options: an EXR with one layer per term,
/// or one file per term and the picture last. In formats with sRGB codes, a normal n becomes the
/// colour code (n + 1) / 2, depth runs from white at the nearest surface to black at the farthest,
/// and each instance has a colour of its own; otherwise values are unchanged. Returns the number of
/// the picture's pixels that are not numbers. Throws InputError.
std::size_t writeTerms(const std::string& output, DrawnTerms& drawn, const PictureOptions& options);

}  // namespace glint
