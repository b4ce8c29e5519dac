#pragma once

#include <string>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// Something that a material of the file has and the picture does not use.
struct LeftOut {
  std::string material, what;
  std::string reason;  ///< follows "is not used: "
  bool shows = false;  ///< a person would see the difference
};

/// What a look leaves out of the materials that are drawn: a pure function of both, without
/// decoding anything. What the user's own numbers replace counts as not showing.
std::vector<LeftOut> leftOut(const Scene&, const Look&);

/// One line for users: "material 'X': its normal texture is not used: ...".
std::string leftOutText(const LeftOut&);

}  // namespace glint
