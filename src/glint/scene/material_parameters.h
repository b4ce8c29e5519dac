#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// The part of a number's range that a slider covers; typed values may go beyond.
struct SliderRange {
  double min = 0.0, max = 1.0;
  bool logarithmic = false;
};

/// One number of a material: extras.glint, --material and the panel go by this table.
struct MaterialParameter {
  std::string_view name, help;
  double min, max;
  double ShadingParameters::*value;
  std::optional<double> MaterialEdit::*edit;
  std::string_view symbol = {};  ///< in the notes
  SliderRange slider = {};
};

/// Ambient, diffuse, specular, exponent, metalness and ior; `color` stands beside them.
std::span<const MaterialParameter> materialParameters();

/// What a look makes of a scene's material: its own values with those of the edits whose keys are of
/// it (material_key.h), in their order.
Material editedMaterial(const Material&, const Look&);

/// Throws InputError if an edit is of a material that the scene does not have.
void checkMaterialNames(const Scene&, const Look&);

}  // namespace glint
