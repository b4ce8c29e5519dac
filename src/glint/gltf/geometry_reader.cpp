#include "glint/gltf/geometry_reader.h"

#include <tiny_gltf.h>

#include <limits>

namespace glint::gltf {

std::string readGeometryModel(tinygltf::Model& model, const std::string& text) {
  // The length parameter has 32 bits.
  if (text.size() > std::numeric_limits<unsigned>::max()) return "its JSON is larger than 4 GiB";
  tinygltf::TinyGLTF reader;
  std::string errors, warnings;
  if (!reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                  static_cast<unsigned>(text.size()), ""))
    return errors.empty() ? "for a reason that tinygltf does not report" : errors;
  return {};
}

}  // namespace glint::gltf
