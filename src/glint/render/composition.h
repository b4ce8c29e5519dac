#pragma once

#include <string>

#include "glint/render/glsl_sources.h"
#include "glint/render/variant.h"

namespace glint {

/// The full texts of a program's two stages.
struct ComposedProgram {
  std::string name;  ///< the program's name for messages, such as "phong"
  std::string vertex, fragment;
};

/// The GLSL of a variant: #version, one #define for each feature, then the files it needs. A pure
/// function of its arguments. With `fileNames`, #line directives name the files (needs the
/// extension that fileNamesInLines() checks for), otherwise they number them in the order of
/// composition. `instances`: the most instances of a mesh that one call may draw.
ComposedProgram compose(const Variant&, const GlslSources&, bool fileNames, int instances = 1);

/// The program that draws the environment behind the model.
ComposedProgram composeBackground(Environment, const GlslSources&, bool fileNames);

/// The program that finds the next layer of the blended surfaces.
ComposedProgram composeLayer(bool multisampled, bool reversedDepth, const GlslSources&,
                             bool fileNames);

}  // namespace glint
