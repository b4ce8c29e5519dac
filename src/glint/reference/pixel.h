#pragma once

#include "glint/reference/raster.h"
#include "glint/reference/scene.h"

namespace glint::reference {

/// C and alpha of material, vertex colour and texture.
glm::dvec4 baseColor(const Item& item, const Footprint& footprint);

/// Computes the attributes and the shading of one sample after another. Caches the last primitive,
/// which the next sample usually shares: use one object per thread.
class PixelShader {
 public:
  explicit PixelShader(const Stage& stage) : stage_(stage) {}

  /// Everything that shading reads at the sample (column, row); rows count from the top.
  Attributes attributes(int item, std::uint32_t primitive, int column, int row);

  /// Linear colour, straight alpha: what GL's fragment shader outputs.
  glm::dvec4 fragment(int item, std::uint32_t primitive, int column, int row);

 private:
  void select(int item, std::uint32_t primitive);
  void light();

  const Stage& stage_;
  int item_ = -1;
  std::uint32_t number_ = 0;
  Primitive primitive_;
  glm::dvec3 faceNormal_{0.0};
  std::array<Terms, 3> carried_;    ///< flat: only the first; gouraud: one per vertex
  std::array<Numbers, 3> numbers_;  ///< likewise
};

}  // namespace glint::reference
